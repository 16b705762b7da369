// Directional albedo E of the sheen lobe for a white sheenColor (KHR_materials_sheen, "Albedo-scaling technique": E(x), looked up by cosine
// and sheenRoughness), read from a table of h in
//
//   ln E = h(x, y) - p ln(1 + T^2),   T = tan(elevation / 2) = N.X / (1 + sqrt(1 - N.X^2)),   p = 1 / (2 sheenRoughness^2)
//
// Column i of u_sheen_albedo stands at ln T = -i STEP_X, row j at DENSITY (1 - r) - ln r = j STEP_Y; between them runs the 4 x 4 Lagrange
// polynomial, which never reaches across BRANCH_COLUMN (cosine 0.5), where Lambda changes branch and h has a kink.
// Always highp: p spans ten decades.
uniform highp sampler2D u_sheen_albedo;

const highp float SHEEN_ALBEDO_STEP_X = 0.08230986855780105;
const highp float SHEEN_ALBEDO_STEP_Y = 0.12;
const highp float SHEEN_ALBEDO_DENSITY = 3.0;
const highp float SHEEN_ALBEDO_MIN_ROUGHNESS = 4.84e-6;
const int SHEEN_ALBEDO_BRANCH_COLUMN = 16;

// ln(1 + t2) for t2 in [0, 1] by the series of 2 artanh(t2 / (2 + t2)): log(1.0 + t2) would lose the digits that p magnifies.
// What is dropped is below 2e-9 of the sum.
highp float sheen_log1p(highp float t2) {
    highp float y = t2 / (2.0 + t2);
    highp float y2 = y * y;
    return 2.0 * y * (1.0 + y2 * (1.0 / 3.0 + y2 * (1.0 / 5.0 + y2 * (1.0 / 7.0 + y2 * (1.0 / 9.0 + y2 * (1.0 / 11.0
        + y2 * (1.0 / 13.0 + y2 * (1.0 / 15.0))))))));
}

// Lagrange weights of the nodes 0, 1, 2, 3 at t in [0, 3].
highp vec4 sheen_cubic_weights(highp float t) {
    highp vec4 d = vec4(t, t - 1.0, t - 2.0, t - 3.0);
    return vec4(-d.y * d.z * d.w / 6.0, d.x * d.z * d.w / 2.0, -d.x * d.y * d.w / 2.0, d.x * d.y * d.z / 6.0);
}

// E at a cosine in (0, 1] (floored at MIN_N_DOT_V) and a sheenRoughness in [0, 1]; 0 for sheenRoughness 0.
highp float sheen_directional_albedo(highp float NdotX, highp float sheenRoughness) {
    if (!(sheenRoughness > SHEEN_ALBEDO_MIN_ROUGHNESS)) {
        return 0.0;
    }
    highp float r = min(sheenRoughness, 1.0);
    highp float mu = clamp(NdotX, MIN_N_DOT_V, 1.0);
    // GLSL derives sqrt from inversesqrt, for which nothing is promised at 0.
    highp float t = mu / (1.0 + sqrt(max((1.0 - mu) * (1.0 + mu), 1e-30)));
    highp vec2 position = vec2(-log(t) / SHEEN_ALBEDO_STEP_X, (SHEEN_ALBEDO_DENSITY * (1.0 - r) - log(r)) / SHEEN_ALBEDO_STEP_Y);
    ivec2 size = textureSize(u_sheen_albedo, 0);
    ivec2 first = clamp(ivec2(position) - 1, ivec2(0), size - 4);
    first.x = position.x < float(SHEEN_ALBEDO_BRANCH_COLUMN) ? min(first.x, SHEEN_ALBEDO_BRANCH_COLUMN - 3)
                                                             : max(first.x, SHEEN_ALBEDO_BRANCH_COLUMN);
    highp vec2 local = position - vec2(first);
    highp vec4 wx = sheen_cubic_weights(local.x);
    highp vec4 wy = sheen_cubic_weights(local.y);
    highp float h = 0.0;
    for (int j = 0; j < 4; ++j) {
        highp vec4 row = vec4(texelFetch(u_sheen_albedo, first + ivec2(0, j), 0).r, texelFetch(u_sheen_albedo, first + ivec2(1, j), 0).r,
                              texelFetch(u_sheen_albedo, first + ivec2(2, j), 0).r, texelFetch(u_sheen_albedo, first + ivec2(3, j), 0).r);
        h += wy[j] * dot(wx, row);
    }
    return exp(h - 0.5 / (r * r) * sheen_log1p(t * t));
}
