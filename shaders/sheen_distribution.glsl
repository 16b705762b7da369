// KHR_materials_sheen, "Sheen distribution": the exponentiated sinusoidal ("Charlie") of Conty and Kulla 2017.

#ifdef FORMULATION_LITERAL
float sheen_distribution(vec3 N, vec3 H, float sheenRoughness) {
    float NdotH = dot(N, H);
    float alpha_g = sheenRoughness * sheenRoughness;
    float inv_r = 1.0 / alpha_g;
    float cos2h = NdotH * NdotH;
    float sin2h = 1.0 - cos2h;
    return (2.0 + inv_r) * pow(sin2h, inv_r * 0.5) / (2.0 * PI);
}
#else
// ln(1 - x) for 0 <= x < 1/4, as -2 atanh(x / (2 - x)); the series' next term is 3e-10 of the sum. log() would lose all digits of a small x.
highp float log_one_minus(highp float x) {
    highp float t = x / (2.0 - x);
    highp float t2 = t * t;
    return -2.0 * t * (1.0 + t2 * (1.0 / 3.0 + t2 * (1.0 / 5.0 + t2 * (1.0 / 7.0 + t2 * (1.0 / 9.0)))));
}

// The exponent is highp whatever the shading's precision: 1 / alpha_g leaves a half float's range for sheenRoughness <= 0.0039.
float sheen_distribution(vec3 N, vec3 H, float sheenRoughness) {
    highp float roughness = sheenRoughness;
    highp float inv_r = 1.0 / (roughness * roughness);
    highp float NdotH = dot(N, H);
    highp float cos2h = NdotH * NdotH;
    highp float log_sin2h;
    if (cos2h < 0.25) {
        log_sin2h = log_one_minus(cos2h);
    } else {
        highp vec3 NxH = cross(N, H);
        log_sin2h = log(max(dot(NxH, NxH), 1e-30));
    }
    highp float exponent = 0.5 * inv_r * log_sin2h;
    // e^-87.5 is below the smallest normal number.
    highp float value = exponent < -87.5 ? 0.0 : (1.0 + 0.5 * inv_r) * exp(exponent) * INV_PI;
    return min(value, LARGEST_SHADING_VALUE);
}
#endif
