// Directional albedo of the specular lobe D Vis and its averages over the hemisphere, from a table. With the Fresnel term F0 + (1 - F0) w,
// w = (1 - VdotH)^5, the albedo is F0 scale + bias; with F = 1 it is E = scale + bias, and 1 - E is missing. r holds ln(missing), g holds
// ln(scale): both vanish toward grazing angles, and logarithms keep their digits.
// Column i stands at ln T = -i STEP_X with T = tan(elevation / 2) = mu / (1 + sqrt(1 - mu^2)), but the last holds the averages;
// row j stands at ln alpha = -j STEP_Y; between them runs the 4 x 4 Lagrange polynomial.
// Always highp: what is missing from a smooth surface is smaller than a half float can tell from nothing.
uniform highp sampler2D u_ggx_albedo;

const highp float GGX_ALBEDO_STEP_X = 0.165;
const highp float GGX_ALBEDO_STEP_Y = 0.2;
const highp float GGX_ALBEDO_MIRROR_ALPHA = 9.9e-9;  // up to here a mirror is taken, which loses nothing

struct GgxAlbedo {
    highp float missing;
    highp float scale;
};

// Lagrange weights of the nodes 0, 1, 2, 3 at t in [0, 3].
highp vec4 ggx_cubic_weights(highp float t) {
    highp vec4 d = vec4(t, t - 1.0, t - 2.0, t - 3.0);
    return vec4(-d.y * d.z * d.w / 6.0, d.x * d.z * d.w / 2.0, -d.x * d.y * d.w / 2.0, d.x * d.y * d.z / 6.0);
}

// The first of the four rows around alpha, and their weights.
int ggx_albedo_rows(highp float alpha, out highp vec4 weights) {
    highp float position = -log(min(alpha, 1.0)) / GGX_ALBEDO_STEP_Y;
    int first = clamp(int(position) - 1, 0, textureSize(u_ggx_albedo, 0).y - 4);
    weights = ggx_cubic_weights(position - float(first));
    return first;
}

// At a cosine in (0, 1], floored at MIN_N_DOT_V.
GgxAlbedo ggx_directional_albedo(highp float NdotX, highp float alpha) {
    highp float mu = clamp(NdotX, MIN_N_DOT_V, 1.0);
    if (alpha <= GGX_ALBEDO_MIRROR_ALPHA) {
        highp float m = 1.0 - mu;
        return GgxAlbedo(0.0, 1.0 - m * m * m * m * m);
    }
    // GLSL derives sqrt from inversesqrt, for which nothing is promised at 0.
    highp float t = mu / (1.0 + sqrt(max((1.0 - mu) * (1.0 + mu), 1e-30)));
    highp float position = -log(t) / GGX_ALBEDO_STEP_X;
    int column = clamp(int(position) - 1, 0, textureSize(u_ggx_albedo, 0).x - 5);
    highp vec4 wx = ggx_cubic_weights(position - float(column));
    highp vec4 wy;
    int row = ggx_albedo_rows(alpha, wy);
    highp vec2 sum = vec2(0.0);
    for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) {
            sum += wx[i] * wy[j] * texelFetch(u_ggx_albedo, ivec2(column + i, row + j), 0).rg;
        }
    }
    return GgxAlbedo(exp(sum.x), exp(sum.y));
}

// Averages over the hemisphere, weighted by the cosine.
GgxAlbedo ggx_average_albedo(highp float alpha) {
    if (alpha <= GGX_ALBEDO_MIRROR_ALPHA) {
        return GgxAlbedo(0.0, 20.0 / 21.0);
    }
    int column = textureSize(u_ggx_albedo, 0).x - 1;
    highp vec4 wy;
    int row = ggx_albedo_rows(alpha, wy);
    highp vec2 sum = vec2(0.0);
    for (int j = 0; j < 4; ++j) {
        sum += wy[j] * texelFetch(u_ggx_albedo, ivec2(column, row + j), 0).rg;
    }
    return GgxAlbedo(exp(sum.x), exp(sum.y));
}
