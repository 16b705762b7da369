// KHR_materials_sheen: f_sheen = sheenColor D V.

struct SheenMaterial {
    vec3 sheenColor;
    float sheenRoughness;
    SheenVisibility visibility;
};

// f_sheen (N.L), in 1/sr, for N.L > 0. At sheenRoughness = 0, the default, the printed distribution divides by zero; its limit is 0.
vec3 sheen_times_NdotL(SheenMaterial material, vec3 N, vec3 H, float NdotL) {
#ifndef FORMULATION_LITERAL
    if (material.sheenRoughness < SMALLEST_SHEEN_ROUGHNESS) return vec3(0.0);
#endif
    float D = sheen_distribution(N, H, material.sheenRoughness);
    return material.sheenColor * (D * sheen_visibility_times_NdotL(material.visibility, NdotL));
}
