// KHR_materials_clearcoat: a layer over everything else, with its own normal Nc.
//   coated_material = mix(material, clearcoat_brdf, clearcoat * (0.04 + 0.96 (1 - |VdotNc|)^5))

// The coat's share k of the light.
float clearcoat_weight(float clearcoat, float NcdotV) {
    float clearcoat_fresnel = 0.04 + 0.96 * fresnel_weight(NcdotV);
    return clearcoat * clearcoat_fresnel;
}
