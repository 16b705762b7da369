// KHR_materials_sheen, "Sheen visibility": Conty and Kulla 2017 with the coefficients of the file before this one.

float l(float x, SheenCoefficients k) {
#ifdef FORMULATION_LITERAL
    float power = pow(x, k.c);
#else
    // pow(0, c) is 0, but GLSL derives it from log2(0), for which nothing is promised.
    float power = x > 0.0 ? pow(x, k.c) : 0.0;
#endif
    return k.a / (1.0 + k.b * power) + k.d * x + k.e;
}

float lambda_sheen(float cos_theta, SheenCoefficients k) {
    return abs(cos_theta) < 0.5 ? exp(l(cos_theta, k)) : exp(2.0 * l(0.5, k) - l(1.0 - cos_theta, k));
}

// What the visibility needs to know of the view, computed once for all lights.
struct SheenVisibility {
    SheenCoefficients k;
    float NdotV;
    float lambda_V;
};

SheenVisibility sheen_visibility_of_view(float NdotV, float sheenRoughness) {
    SheenCoefficients k = sheen_coefficients(sheenRoughness * sheenRoughness);
    return SheenVisibility(k, NdotV, lambda_sheen(NdotV, k));
}

// V (N.L), in 1/sr.
float sheen_visibility_times_NdotL(SheenVisibility view, float NdotL) {
    float lambda_L = lambda_sheen(NdotL, view.k);
#ifdef FORMULATION_LITERAL
    float sheen_visibility = 1.0 / ((1.0 + view.lambda_V + lambda_L) * (4.0 * view.NdotV * NdotL));
    return sheen_visibility * NdotL;
#else
    // The light's cosine cancels, so the product stays finite where it vanishes.
    return 1.0 / ((1.0 + view.lambda_V + lambda_L) * (4.0 * view.NdotV));
#endif
}
