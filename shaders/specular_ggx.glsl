// The specular lobe of glTF 2.0, Appendix B.3.2: Trowbridge and Reitz 1975 (GGX) with the height-correlated Smith term of Heitz 2014.
// Up to MIRROR_ALPHA a surface is a mirror, to which a punctual light gives no highlight.

const highp float MIRROR_ALPHA = 1e-9;

#ifdef FORMULATION_LITERAL
// D = alpha^2 X(N.H) / (pi ((N.H)^2 (alpha^2 - 1) + 1)^2)
float D_GGX(vec3 N, vec3 H, float alpha) {
    float NdotH = dot(N, H);
    float alpha_sq = alpha * alpha;
    float f = (NdotH * NdotH) * (alpha_sq - 1.0) + 1.0;
    return NdotH > 0.0 ? alpha_sq / (PI * f * f) : 0.0;
}

// Vis (N.L), Vis = X(H.L) X(H.V) / (2 (N.V sqrt(alpha^2 + (1 - alpha^2) N.L^2) + N.L sqrt(alpha^2 + (1 - alpha^2) N.V^2)))
float V_GGX_times_NdotL(float NdotL, float NdotV, float alpha) {
    float alpha_sq = alpha * alpha;
    float GGXV = NdotL * sqrt(NdotV * NdotV * (1.0 - alpha_sq) + alpha_sq);
    float GGXL = NdotV * sqrt(NdotL * NdotL * (1.0 - alpha_sq) + alpha_sq);
    return 0.5 / (GGXV + GGXL) * NdotL;
}
#else
// D = k^2 / pi with k = alpha / (|N x H|^2 + alpha^2 (N.H)^2): the same value, without the difference of two numbers near 1 (Filament,
// "Specular D", for half floats).
float D_GGX(vec3 N, vec3 H, float alpha) {
    float NdotH = dot(N, H);
    vec3 NxH = cross(N, H);
    float a = alpha * NdotH;
    float k = alpha / (dot(NxH, NxH) + a * a);
    float D = min(k * k * INV_PI, LARGEST_SHADING_VALUE);
    return NdotH > 0.0 ? D : 0.0;
}

// Vis (N.L), divided through by N.L N.V: no product of two small cosines stands alone.
float V_GGX_times_NdotL(float NdotL, float NdotV, float alpha) {
    float alpha_sq = alpha * alpha;
    float GGXV = NdotL * sqrt(NdotV * NdotV * (1.0 - alpha_sq) + alpha_sq);
    float GGXL = NdotV * sqrt(NdotL * NdotL * (1.0 - alpha_sq) + alpha_sq);
    // In half floats both may vanish.
    return 0.5 * (NdotL / max(GGXV + GGXL, SMALLEST_SHADING_VALUE));
}
#endif

// D Vis (N.L), in 1/sr, for N.L > 0.
float specular_ggx(vec3 N, vec3 H, float NdotL, float NdotV, float alpha) {
    if (alpha < MIRROR_ALPHA) return 0.0;
    highp float D = D_GGX(N, H, alpha);
    return min(D * V_GGX_times_NdotL(NdotL, NdotV, alpha), LARGEST_SHADING_VALUE);
}
