// The base layer, glTF 2.0, Appendix B.2: material = mix(dielectric_brdf, metal_brdf, metallic). The two BRDFs are mixed, not their f0.

struct BaseMaterial {
    vec3 baseColor;
    float metallic;
    float alpha;  // roughness^2
#ifdef SPECULAR
    vec3 f0;
    float specular;
#endif
};

// base (N.L), in 1/sr, for N.L > 0.
vec3 base_times_NdotL(BaseMaterial material, vec3 N, vec3 V, vec3 H, float NdotL, float NdotV) {
    float w = fresnel_weight(dot(V, H));
    float lobe = specular_ggx(N, H, NdotL, NdotV, material.alpha);
    vec3 diffuse = material.baseColor * (NdotL * INV_PI);
#ifdef SPECULAR
    // KHR_materials_specular with KHR_materials_ior: fr = f0 + (1 - f0) w, weighted by specular; the diffuse part gets what max3 leaves.
    vec3 fr = material.f0 + (1.0 - material.f0) * w;
    vec3 dielectric = rest(material.specular * max3(fr)) * diffuse + material.specular * lobe * fr;
#else
    float Fd = 0.04 + 0.96 * w;
    vec3 dielectric = rest(Fd) * diffuse + Fd * lobe;
#endif
    vec3 Fm = material.baseColor + (1.0 - material.baseColor) * w;
    return dielectric * rest(material.metallic) + Fm * lobe * material.metallic;
}
