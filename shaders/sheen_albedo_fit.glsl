// Directional albedo E of the sheen lobe by an analytic fit of twelve coefficients, for N.X >= 0.005: within 0.0205 (Charlie) and 0.0150
// (Ashikhmin) for sheenRoughness >= 0.1, 0.0325 and 0.0367 for >= 0.05, and of no use below.
//   E = min(1, exp(-z + cubic(t, s))),  z = -ln((1 + sqrt(1 - N.X^2)) / 2) / (2 sheenRoughness^2)
float sheen_directional_albedo(float NdotX, float sheenRoughness) {
    if (sheenRoughness <= 0.0) return 0.0;
    float r = sheenRoughness;
    float z = -log(0.5 * (1.0 + sqrt(max(1.0 - NdotX * NdotX, 1e-30)))) / (2.0 * r * r);
#ifdef VISIBILITY_CHARLIE
    float t = log(NdotX + 2.88269 * r);
    float s = pow(r, 0.744932);
    float cubic = -3.13455 + 0.163006 * t - 0.680986 * s - 0.728669 * t * t - 2.8079 * t * s + 12.3291 * s * s - 0.396477 * t * t * t
        + 9.72261 * t * t * s - 22.5119 * t * s * s + 8.45563 * s * s * s;
#else
    float t = NdotX / (NdotX + 1.25362 * r + 0.0158812);
    float s = 1.0 / (r + 0.1);
    float cubic = -1.08842 - 3.30651 * t + 0.727668 * s + 4.16853 * t * t + 0.0313427 * t * s - 0.0714525 * s * s - 3.94648 * t * t * t
        - 1.66093 * t * t * s + 0.179991 * t * s * s - 0.00242272 * s * s * s;
#endif
    return min(1.0, exp(cubic - z));
}
