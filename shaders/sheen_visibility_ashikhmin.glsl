// KHR_materials_sheen, "Sheen visibility": the simpler term of Ashikhmin and Premoze 2007, as Neubelt and Pettineo 2013 use it.

struct SheenVisibility {
    float NdotV;
};

SheenVisibility sheen_visibility_of_view(float NdotV, float sheenRoughness) { return SheenVisibility(NdotV); }

// V (N.L), in 1/sr.
float sheen_visibility_times_NdotL(SheenVisibility view, float NdotL) {
#ifdef FORMULATION_LITERAL
    float sheen_visibility = 1.0 / (4.0 * (NdotL + view.NdotV - NdotL * view.NdotV));
    return sheen_visibility * NdotL;
#else
    return 0.25 * (NdotL / (NdotL + view.NdotV - NdotL * view.NdotV));
#endif
}
