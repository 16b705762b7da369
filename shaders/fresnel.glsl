// Schlick 1994, "An Inexpensive BRDF Model for Physically-based Rendering": the weight (1 - |cos|)^5.
#ifdef FORMULATION_LITERAL
float fresnel_weight(float cos_theta) { return pow(1.0 - abs(cos_theta), 5.0); }
#else
// Held to [0, 1] where a cosine of two unit vectors is an ulp above 1.
float fresnel_weight(float cos_theta) {
    float m = clamp(1.0 - abs(cos_theta), 0.0, 1.0);
    float m2 = m * m;
    return m2 * m2 * m;
}
#endif
