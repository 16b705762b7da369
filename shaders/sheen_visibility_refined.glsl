// The refined coefficients of l() from the Enterprise PBR Shading Model 2022x (Dassault Systemes, licence CC BY-SA 4.0,
// https://github.com/DassaultSystemes-Technology/EnterprisePBRShadingModel). Its published interpolation is inverted: w p1 + (1 - w) p0 is
// the one that reproduces its own table.
SheenCoefficients sheen_coefficients(float alpha_g) {
    highp float alpha = alpha_g;
    alpha = max(alpha, 1e-9);
    float w = -1.59612 / (1.0 + 0.20375 * pow(alpha, -0.55825)) + 1.32805;
    float a = mix(11.9095, 13.7000, w);
    float b = mix(4.68753, 2.92754, w);
    float c = mix(0.33467, 0.28670, w);
    float d = mix(-2.22664, -0.81757, w);
    float e = mix(-1.76591, -1.22466, w);
    return SheenCoefficients(a, b, c, d, e);
}
