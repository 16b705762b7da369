// KHR_materials_sheen, "Sheen visibility": the coefficients of the fitted l() of Conty and Kulla 2017.

#ifdef FORMULATION_LITERAL
float between(float x, float y, float t) { return mix(x, y, t); }
#else
float between(float x, float y, float t) { return x * rest(t) + y * t; }
#endif

SheenCoefficients sheen_coefficients(float alpha_g) {
    float one_minus_alpha_sq = (1.0 - alpha_g) * (1.0 - alpha_g);
    float a = between(21.5473, 25.3245, one_minus_alpha_sq);
    float b = between(3.82987, 3.32435, one_minus_alpha_sq);
    float c = between(0.19823, 0.16801, one_minus_alpha_sq);
    float d = between(-1.97760, -1.27393, one_minus_alpha_sq);
    float e = between(-4.32054, -4.85967, one_minus_alpha_sq);
    return SheenCoefficients(a, b, c, d, e);
}
