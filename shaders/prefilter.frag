// An environment's image filtered by a lobe seen from above, V = N (Karis 2013, "Real Shading in Unreal Engine 4"): for each direction N
// the mean of the image over directions L, weighted by the lobe times N.L.

uniform usampler2D u_image;  // equirect with its mipmaps
uniform ivec2 u_image_size;
uniform ivec2 u_origin;     // of the part to draw, in rows from the top
uniform ivec2 u_size;
uniform int u_rows;         // of the whole picture
uniform float u_roughness;
layout(location = 0) out vec4 out_color;

vec3 direction_at(vec2 uv) {
    float phi = 2.0 * PI * (uv.x - 0.5);
    float theta = PI * uv.y;
    return vec3(sin(theta) * cos(phi), cos(theta), sin(theta) * sin(phi));
}

vec4 image_level(vec2 uv, int level) {
    return texture_level(u_image, uv, u_image_size, level, false, WRAP_REPEAT, WRAP_CLAMP_TO_EDGE, FILTER_LINEAR, STORED_FLOATS);
}

#ifdef KERNEL_GGX
// 4 Vis N.L at N.V = 1.
float ggx_shadowing(float NdotL, float a2) { return 2.0 * NdotL / (NdotL + sqrt(a2 + (1.0 - a2) * NdotL * NdotL)); }
#endif

#ifdef NARROW
// Directions are drawn from D N.H, each reading the level of the image whose texels are twice as wide as its share of the lobe (Krivanek
// and Colbert 2008, "Real-time Shading with Filtered Importance Sampling").
uniform sampler2D u_points;  // rows by turns: points of the unit square; nothing
uniform int u_point_count;

vec3 filtered(vec3 N) {
    ivec2 size = u_image_size;
    int last = max((floatBitsToInt(float(max(size.x, size.y))) >> 23) - 128, 0);
    vec3 B = normalize_or(vec3(-N.z, 0.0, N.x), vec3(0.0, 0.0, 1.0));
    vec3 T = cross(B, N);
    float a2 = u_roughness * u_roughness * u_roughness * u_roughness;
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    int width = textureSize(u_points, 0).x;
    for (int i = 0; i < u_point_count; ++i) {
        vec2 u = texelFetch(u_points, ivec2(i % width, 2 * (i / width)), 0).xy;
        float phi = 2.0 * PI * u.y;
        float cos2 = (1.0 - u.x) / (1.0 + (a2 - 1.0) * u.x);
        float NdotL = 2.0 * cos2 - 1.0;
        if (NdotL <= 0.0) continue;
        vec2 across = 2.0 * sqrt(cos2 * (1.0 - cos2)) * vec2(cos(phi), sin(phi));
        vec3 L = normalize(T * across.x + B * across.y + N * NdotL);
        float f = cos2 * (a2 - 1.0) + 1.0;
        float density = a2 / (4.0 * PI * f * f);
        float texel = 2.0 * PI * PI * sqrt(max(1.0 - L.y * L.y, 1e-6)) / (float(size.x) * float(size.y));
        float level = clamp(1.0 + 0.5 * log2(1.0 / (float(u_point_count) * density * texel)), 0.0, float(last));
        int finer = int(level);
        vec2 uv = equirect_coordinates(L);
        float weight = ggx_shadowing(NdotL, a2);
        sum += weight * mix(image_level(uv, finer), image_level(uv, min(finer + 1, last)), level - float(finer)).rgb;
        weights += weight;
    }
    return sum / max(weights, 1e-30);
}
#else
// Wide lobes meet every texel of a level of the image that is fine enough for them.
uniform int u_level;

float kernel(float NdotL) {
#if defined(KERNEL_DIFFUSE)
    return NdotL;
#elif defined(KERNEL_GGX)
    float a2 = u_roughness * u_roughness * u_roughness * u_roughness;
    float f = 0.5 * (1.0 + NdotL) * (a2 - 1.0) + 1.0;
    return ggx_shadowing(NdotL, a2) / (f * f);
#else
    // D without its factors: sin^2(theta_h) = (1 - N.L) / 2.
    float D = exp(0.5 / (u_roughness * u_roughness) * log(max(1.0 - NdotL, 1e-30)));
    return D * sheen_visibility_times_NdotL(sheen_visibility_of_view(1.0, u_roughness), NdotL);
#endif
}

vec3 filtered(vec3 N) {
    ivec2 size = max(u_image_size >> u_level, ivec2(1));
    ivec2 origin = level_origin(u_image_size, STORED_FLOATS, u_level);
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    for (int y = 0; y < size.y; ++y) {
        float sine = sin(PI * (float(y) + 0.5) / float(size.y));
        for (int x = 0; x < size.x; ++x) {
            float NdotL = min(dot(N, direction_at((vec2(x, y) + 0.5) / vec2(size))), 1.0);
            if (NdotL <= 0.0) continue;
            float weight = kernel(NdotL) * sine;
            sum += weight * uintBitsToFloat(texelFetch(u_image, origin + ivec2(x, y), 0).rgb);
            weights += weight;
        }
    }
    return sum / max(weights, 1e-30);
}
#endif

void main() {
    vec2 uv = (vec2(gl_FragCoord.x, float(u_rows) - gl_FragCoord.y) - vec2(u_origin)) / vec2(u_size);
    out_color = vec4(filtered(direction_at(uv)), 1.0);
}
