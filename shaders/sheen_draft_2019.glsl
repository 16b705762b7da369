// Sheen of the draft of KHR_materials_sheen from 2019:
//   "The sheen roughness is identical to the material roughness"
//   sheenTerm = sheenColor * sheenIntensity * sheenDistribution * sheenVisibility;    f_sheen = lightColor * sheenTerm * PI * ndotl
//   specularity = mix(metallicF0, baseColor, metallic);    reflectance = max(max(specularity.r, specularity.g), specularity.b)
//   final = f_emissive + f_diffuse + f_specular + (1 - reflectance) * f_sheen
// A ratified asset has no intensity (the draft's sheenFactor, 1 by default). metallicF0 is 0.04: the draft knows no index of refraction.

// What stands for (sheenColor, sheenRoughness) in the lobe.
vec4 sheen_of_draft_2019(vec3 sheenColor, vec3 baseColor, vec2 metallic_roughness) {
    vec3 specularity = mix(vec3(0.04), baseColor, metallic_roughness.x);
    float reflectance = min(max3(specularity), 1.0);
    return vec4((1.0 - reflectance) * PI * sheenColor, metallic_roughness.y);
}
