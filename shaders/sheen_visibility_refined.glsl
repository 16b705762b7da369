// The refined coefficients of l() from the Enterprise PBR Shading Model 2022x (Dassault Systemes, licence CC BY-SA 4.0,
// https://github.com/DassaultSystemes-Technology/EnterprisePBRShadingModel). Its published interpolation is inverted: w p1 + (1 - w) p0 is
// the one that reproduces its own table.
SheenCoefficients sheen_coefficients(float alpha_g) {
    highp float alpha = alpha_g;
    alpha = max(alpha, 1e-9);
    highp float q = 1.59612 / (1.0 + 0.20375 * pow(alpha, -0.55825));
    highp float w = 1.32805 - q;
    highp float v = q - 0.32805;  // 1 - w
    float a = 13.7000 * w + 11.9095 * v;
    float b = 2.92754 * w + 4.68753 * v;
    float c = 0.28670 * w + 0.33467 * v;
    float d = -0.81757 * w - 2.22664 * v;
    float e = -1.22466 * w - 1.76591 * v;
    return SheenCoefficients(a, b, c, d, e);
}
