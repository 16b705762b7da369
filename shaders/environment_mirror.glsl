// What perfectly smooth layers reflect: alpha = 0 is a mirror, its lobe a delta in the direction that mirrors V, its cosine V.H that of
// the normal.

vec3 mirrored_direction(LayerView view) { return 2.0 * dot(view.N, view.V) * view.N - view.V; }

// The base's reflectance as a mirror, without the scale of albedo scaling.
vec3 base_mirror(BaseMaterial material, float NdotV) {
    float w = fresnel_weight(NdotV);
#ifdef SPECULAR
    vec3 dielectric = material.specular * (material.f0 + (1.0 - material.f0) * w);
#else
    vec3 dielectric = vec3(0.04 + 0.96 * w);
#endif
    vec3 metal = material.baseColor + (1.0 - material.baseColor) * w;
    return dielectric * rest(material.metallic) + metal * material.metallic;
}

// What albedo scaling leaves of a base whose light is not followed direction by direction: over a mirror the truth, else what
// KHR_materials_sheen allows for light from everywhere.
float scale_by_view(Surface surface) {
#if !defined(SHEEN) || defined(ALBEDO_SCALING_NONE)
    return 1.0;
#elif defined(ALBEDO_SCALING_VIEW)
    return surface.scale;
#else
    float NdotV = surface.view.NdotV;
    return sheen_albedo_scaling(surface.sheen.sheenColor, surface.sheen.sheenRoughness, NdotV, NdotV);
#endif
}
