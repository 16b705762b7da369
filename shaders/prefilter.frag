// An environment's image filtered by a lobe seen from above: for each direction N the mean of the image over directions L, drawn from the
// lobe for V = N (Karis 2013) and weighted with what of the lobe they do not stand for. Each reads the level of the image's mipmaps whose
// texels are as large as its share of the lobe (Krivanek and Colbert 2008, "Real-time Shading with Filtered Importance Sampling").

uniform sampler2D u_image;   // equirect with its mipmaps
uniform sampler2D u_points;  // rows by turns: points of the unit square; nothing
uniform int u_point_count;
uniform ivec2 u_origin;      // of the part to draw, in rows from the top
uniform ivec2 u_size;
uniform int u_rows;          // of the whole picture
uniform float u_roughness;
layout(location = 0) out vec4 out_color;

vec3 read_image(vec3 direction, float density) {
    ivec2 size = picture_size(u_image, MIP_LINEAR);
    vec2 uv = equirect_coordinates(direction);
    float texel = 2.0 * PI * PI * sqrt(max(1.0 - direction.y * direction.y, 1e-6)) / (float(size.x) * float(size.y));
    float share = 1.0 / (float(u_point_count) * max(density, 1e-30));
    int last = (floatBitsToInt(float(max(size.x, size.y))) >> 23) - 127;
    float level = clamp(0.5 * log2(share / texel), 0.0, float(max(last - 2, 0)));
    int finer = int(level);
    vec4 a = texture_level(u_image, uv, size, finer, WRAP_REPEAT, WRAP_CLAMP_TO_EDGE, FILTER_LINEAR);
    vec4 b = texture_level(u_image, uv, size, min(finer + 1, last), WRAP_REPEAT, WRAP_CLAMP_TO_EDGE, FILTER_LINEAR);
    return mix(a, b, level - float(finer)).rgb;
}

// A direction in the frame of N, its density in 1/sr, and its weight in the mean.
struct Drawn {
    vec3 L;
    float density;
    float weight;
};

vec3 mirrored_about(float cosine, float phi) {
    // V = N = (0, 0, 1): L = 2 (N.H) H - N.
    float sine = sqrt(max(1.0 - cosine * cosine, 0.0));
    return vec3(2.0 * cosine * sine * vec2(cos(phi), sin(phi)), 2.0 * cosine * cosine - 1.0);
}

#if defined(KERNEL_DIFFUSE)
Drawn draw(vec2 u) {
    float phi = 2.0 * PI * u.y;
    float cosine = sqrt(max(1.0 - u.x, 0.0));
    return Drawn(vec3(sqrt(u.x) * vec2(cos(phi), sin(phi)), cosine), cosine / PI, 1.0);
}
#elif defined(KERNEL_GGX)
// D N.H is drawn; the mean is weighted by 4 Vis N.L at N.V = 1.
Drawn draw(vec2 u) {
    float a2 = u_roughness * u_roughness * u_roughness * u_roughness;
    float cosine = sqrt((1.0 - u.x) / (1.0 + (a2 - 1.0) * u.x));
    vec3 L = mirrored_about(cosine, 2.0 * PI * u.y);
    float f = cosine * cosine * (a2 - 1.0) + 1.0;
    return Drawn(L, a2 / (4.0 * PI * f * f), L.z > 0.0 ? 2.0 * L.z / (L.z + sqrt(a2 + (1.0 - a2) * L.z * L.z)) : 0.0);
}
#else
// D N.H is drawn as far as L is above the surface, theta_h < pi/4; the mean is weighted by V N.L.
Drawn draw(vec2 u) {
    float exponent = 1.0 / (u_roughness * u_roughness);
    float power = exp2(log2(max(u.x, 1e-30)) / (exponent + 2.0));
    float sine = sqrt(0.5) * power;
    vec3 L = mirrored_about(sqrt(1.0 - sine * sine), 2.0 * PI * u.y);
    float density = (exponent + 2.0) * exp2(exponent * log2(power)) / (4.0 * PI);
    return Drawn(L, density, sheen_visibility_times_NdotL(sheen_visibility_of_view(1.0, u_roughness), clamp(L.z, 0.0, 1.0)));
}
#endif

void main() {
    vec2 uv = (vec2(gl_FragCoord.x, float(u_rows) - gl_FragCoord.y) - vec2(u_origin)) / vec2(u_size);
    float phi = 2.0 * PI * (uv.x - 0.5);
    float theta = PI * uv.y;
    vec3 N = vec3(sin(theta) * cos(phi), cos(theta), sin(theta) * sin(phi));
    vec3 B = vec3(-sin(phi), 0.0, cos(phi));
    vec3 T = cross(B, N);
    vec3 sum = vec3(0.0);
    float weights = 0.0;
    int width = textureSize(u_points, 0).x;
    for (int i = 0; i < u_point_count; ++i) {
        Drawn drawn = draw(texelFetch(u_points, ivec2(i % width, 2 * (i / width)), 0).xy);
        if (drawn.weight > 0.0) {
            sum += drawn.weight * read_image(normalize(T * drawn.L.x + B * drawn.L.y + N * drawn.L.z), drawn.density);
            weights += drawn.weight;
        }
    }
    out_color = vec4(sum / max(weights, 1e-30), 1.0);
}
