// KHR_materials_sheen, "Albedo-scaling technique": what the sheen leaves of the light for the base.
//   full:  min(1 - max3(sheenColor) E(VdotN), 1 - max3(sheenColor) E(LdotN))    view: 1 - max3(sheenColor) E(VdotN)
// The smaller of the two is 1 - max3(sheenColor) max(E(VdotN), E(LdotN)), and E falls with its cosine (for Charlie from 0.008 up), so
// one look-up at the smaller cosine does for both. E exceeds 1 toward grazing angles: the scale is held to [0, 1]; `literal` leaves it as
// it is printed.

float sheen_albedo_at(float NdotX, float sheenRoughness) {
    float cosine = clamp(NdotX, MIN_N_DOT_V, 1.0);
    return sheenRoughness > 0.0 ? sheen_directional_albedo(cosine, sheenRoughness) : 0.0;
}

#ifdef ALBEDO_SCALING_VIEW
float sheen_albedo_scaling(vec3 sheenColor, float sheenRoughness, float NdotV) {
    return clamp(1.0 - max3(sheenColor) * sheen_albedo_at(NdotV, sheenRoughness), 0.0, 1.0);
}
#else
float sheen_albedo_scaling(vec3 sheenColor, float sheenRoughness, float NdotL, float NdotV) {
    float scale = 1.0 - max3(sheenColor) * sheen_albedo_at(min(NdotV, NdotL), sheenRoughness);
#ifdef ALBEDO_SCALING_LITERAL
    return scale;
#else
    return clamp(scale, 0.0, 1.0);
#endif
}
#endif
