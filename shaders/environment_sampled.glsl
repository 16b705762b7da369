// Light of the environment by brute force: directions drawn from the image and from every lobe, weighed together by the balance heuristic
// (Veach 1997, "Robust Monte Carlo Methods for Light Transport Simulation", section 9.2). It converges to the integral:
//   sum over directions of f cos(theta) L_env / (sum over ways to draw of count * density)

// In rows by turns: points of the unit square in r, g; directions of the image in r, g, b, drawn in proportion to its radiance.
uniform sampler2D u_environment_points;
// Directions to draw, all ways together; but each way draws at least one.
uniform int u_environment_samples;

// Below it the sheen's lobe is drawn from by the other ways alone: it is a thin rim of next to no energy.
const highp float SMALLEST_DRAWN_SHEEN_ROUGHNESS = 1e-3;

// A lobe draws as its albedo asks, the image as much as all lobes together. A lobe of small albedo still shows the brightest lights, so
// each has its least share; that and the sheen's were found by the error of 4,096 directions under two skies, on 13 materials.
const float SMALLEST_WEIGHT = 0.05;
const float WEIGHT_OF_WHITE_SHEEN = 0.15;

// Ways to draw a direction.
const int DRAW_COSINE = 0;
const int DRAW_GGX = 1;
#ifdef CLEARCOAT
const int DRAW_COAT = 2;
#define DRAWS_WITH_COAT 3
#else
#define DRAWS_WITH_COAT 2
#endif
#ifdef SHEEN
const int DRAW_SHEEN = DRAWS_WITH_COAT;
const int DRAW_RIM = DRAWS_WITH_COAT + 1;
#define DRAWS_WITH_SHEEN (DRAWS_WITH_COAT + 2)
#else
#define DRAWS_WITH_SHEEN DRAWS_WITH_COAT
#endif
#ifdef ENVIRONMENT_IMAGE
const int DRAW_IMAGE = DRAWS_WITH_SHEEN;
const int DRAWS = DRAWS_WITH_SHEEN + 1;
#else
const int DRAWS = DRAWS_WITH_SHEEN;
#endif

// A frame around N: Duff et al. 2017, "Building an Orthonormal Basis, Revisited", listing 3. Columns T, B, N.
mat3 frame_around(vec3 N) {
    float s = N.z < 0.0 ? -1.0 : 1.0;
    float a = -1.0 / (s + N.z);
    float b = N.x * N.y * a;
    return mat3(1.0 + s * N.x * N.x * a, s * b, -s * N.x, b, s + N.y * N.y * a, -N.y, N.x, N.y, N.z);
}

vec3 mirrored_at(vec3 H, vec3 V) { return normalize(2.0 * dot(V, H) * H - V); }

vec3 draw_cosine(LayerView view, vec2 u) {
    float phi = 2.0 * PI * u.y;
    return frame_around(view.N) * vec3(sqrt(u.x) * vec2(cos(phi), sin(phi)), sqrt(max(1.0 - u.x, 0.0)));
}

// Heitz 2018, "Sampling the GGX Distribution of Visible Normals", listing 1.
vec3 draw_ggx(LayerView view, float alpha, vec2 u) {
    mat3 frame = frame_around(view.N);
    vec3 v = view.V * frame;
    vec3 Vh = normalize(vec3(alpha * v.xy, max(v.z, MIN_N_DOT_V)));
    float across = dot(Vh.xy, Vh.xy);
    vec3 T1 = across > 0.0 ? vec3(-Vh.y, Vh.x, 0.0) * inversesqrt(across) : vec3(1.0, 0.0, 0.0);
    vec3 T2 = cross(Vh, T1);
    float r = sqrt(u.x);
    float phi = 2.0 * PI * u.y;
    float t1 = r * cos(phi);
    float s = 0.5 * (1.0 + Vh.z);
    float t2 = (1.0 - s) * sqrt(max(1.0 - t1 * t1, 0.0)) + s * r * sin(phi);
    vec3 Nh = t1 * T1 + t2 * T2 + sqrt(max(1.0 - t1 * t1 - t2 * t2, 0.0)) * Vh;
    return mirrored_at(frame * normalize(vec3(alpha * Nh.xy, max(Nh.z, 0.0))), view.V);
}

// Densities over solid angle, 1/sr. A half vector H is drawn with D_visible(H) = D G1 V.H / N.V, a direction with a quarter of it over V.H.
float density_ggx(LayerView view, float alpha, vec3 L) {
    vec3 H = normalize_or(L + view.V, view.N);
    float a2 = alpha * alpha;
    float G1 = 2.0 * view.NdotV / (view.NdotV + sqrt(a2 + (1.0 - a2) * view.NdotV * view.NdotV));
    return D_GGX(view.N, H, alpha) * G1 / (4.0 * view.NdotV);
}

#ifdef SHEEN
// D cos(theta_h) integrates to sin^(2 + 1/alpha_g) up to theta_h, hence to 1.
vec3 draw_sheen(LayerView view, float sheenRoughness, vec2 u) {
    float exponent = 1.0 / (sheenRoughness * sheenRoughness);
    float sine = exp2(log2(max(u.x, 1e-30)) / (exponent + 2.0));
    float phi = 2.0 * PI * u.y;
    vec3 H = frame_around(view.N) * vec3(sine * vec2(cos(phi), sin(phi)), sqrt(max(1.0 - sine * sine, 0.0)));
    return mirrored_at(H, view.V);
}

float density_sheen(LayerView view, float sheenRoughness, vec3 L) {
    vec3 H = normalize_or(L + view.V, view.N);
    return sheen_distribution(view.N, H, sheenRoughness) * abs(dot(view.N, H)) / (4.0 * max(dot(view.V, H), 1e-30));
}

// Seen from above, half vectors send nearly every light below the horizon. There D is ((1 - N.L) / 2)^p, p = 1 / (2 alpha_g): that is drawn.
vec3 draw_rim(LayerView view, float sheenRoughness, vec2 u) {
    float p = 0.5 / (sheenRoughness * sheenRoughness);
    float below = exp2(log2(max(1.0 - u.x, 1e-30)) / (p + 1.0)); // 1 - N.L
    float phi = 2.0 * PI * u.y;
    return frame_around(view.N) * vec3(sqrt(below * (2.0 - below)) * vec2(cos(phi), sin(phi)), 1.0 - below);
}

float density_rim(LayerView view, float sheenRoughness, vec3 L) {
    float p = 0.5 / (sheenRoughness * sheenRoughness);
    float NdotL = dot(view.N, L);
    return NdotL > 0.0 ? (p + 1.0) * exp2(p * log2(max(1.0 - NdotL, 1e-30))) / (2.0 * PI) : 0.0;
}
#endif

#ifdef ENVIRONMENT_IMAGE
// The image's texel holds its share of all directions drawn, over the texel's share of (u, v), by 2 pi^2.
float density_image(vec3 L) {
    vec3 d = u_environment_from_view * L;
    ivec2 texel = clamp(ivec2(equirect_coordinates(d) * vec2(u_environment_size)), ivec2(0), u_environment_size - 1);
    return texelFetch(u_environment, texel, 0).a * inversesqrt(max(1.0 - d.y * d.y, 1e-12));
}
#endif

// Whether a direction is drawn in that way.
bool draws(Surface surface, int way) {
    if (way == DRAW_GGX) return surface.base.alpha >= MIRROR_ALPHA;
#ifdef CLEARCOAT
    if (way == DRAW_COAT) return surface.clearcoat_alpha >= MIRROR_ALPHA && surface.k > 0.0;
#endif
#ifdef SHEEN
    if (way == DRAW_SHEEN || way == DRAW_RIM) return surface.sheen.sheenRoughness > SMALLEST_DRAWN_SHEEN_ROUGHNESS;
#endif
    return true;
}

vec3 drawn_direction(Surface surface, int way, int i) {
    int width = textureSize(u_environment_points, 0).x;
    ivec2 place = ivec2(i % width, 2 * (i / width));
    vec2 u = texelFetch(u_environment_points, place, 0).xy;
#ifdef CLEARCOAT
    if (way == DRAW_COAT) return draw_ggx(surface.coat_view, surface.clearcoat_alpha, u);
#endif
#ifdef SHEEN
    if (way == DRAW_SHEEN) return draw_sheen(surface.view, surface.sheen.sheenRoughness, u);
    if (way == DRAW_RIM) return draw_rim(surface.view, surface.sheen.sheenRoughness, u);
#endif
#ifdef ENVIRONMENT_IMAGE
    if (way == DRAW_IMAGE) return texelFetch(u_environment_points, place + ivec2(0, 1), 0).xyz * u_environment_from_view;
#endif
    if (way == DRAW_GGX) return draw_ggx(surface.view, surface.base.alpha, u);
    return draw_cosine(surface.view, u);
}

// What a lobe reflects of light from everywhere, about, below 1.
float weight(Surface surface, int way) {
    float under_coat = 1.0;
#ifdef CLEARCOAT
    if (way == DRAW_COAT) return surface.k;
    under_coat = 1.0 - surface.k;
#endif
#ifdef SHEEN
    if (way == DRAW_SHEEN || way == DRAW_RIM) return under_coat * WEIGHT_OF_WHITE_SHEEN * max3(surface.sheen.sheenColor);
#endif
    if (way == DRAW_GGX) return under_coat * max3(base_mirror(surface.base, surface.view.NdotV));
    return under_coat * max3(surface.base.baseColor) * (1.0 - surface.base.metallic);
}

// How many directions each way draws.
int[DRAWS] directions_by_way(Surface surface) {
    float weights[DRAWS];
    float sum = 0.0;
    for (int way = 0; way < DRAWS; ++way) {
        weights[way] = draws(surface, way) ? max(weight(surface, way), SMALLEST_WEIGHT) : 0.0;
#ifdef ENVIRONMENT_IMAGE
        if (way == DRAW_IMAGE) weights[way] = sum;
#endif
        sum += weights[way];
    }
    int counts[DRAWS];
    for (int way = 0; way < DRAWS; ++way) {
        counts[way] = draws(surface, way) ? max(int(float(u_environment_samples) * weights[way] / sum), 1) : 0;
    }
    return counts;
}

// The sum of the densities of all ways, each as many times as it is drawn from.
float density_of_all(Surface surface, vec3 L, int counts[DRAWS]) {
    float sum = float(counts[DRAW_COSINE]) * max(dot(surface.view.N, L), 0.0) / PI;
    if (counts[DRAW_GGX] > 0) sum += float(counts[DRAW_GGX]) * density_ggx(surface.view, surface.base.alpha, L);
#ifdef CLEARCOAT
    if (counts[DRAW_COAT] > 0) sum += float(counts[DRAW_COAT]) * density_ggx(surface.coat_view, surface.clearcoat_alpha, L);
#endif
#ifdef SHEEN
    if (counts[DRAW_SHEEN] > 0) {
        sum += float(counts[DRAW_SHEEN]) * density_sheen(surface.view, surface.sheen.sheenRoughness, L);
        sum += float(counts[DRAW_RIM]) * density_rim(surface.view, surface.sheen.sheenRoughness, L);
    }
#endif
#ifdef ENVIRONMENT_IMAGE
    sum += float(counts[DRAW_IMAGE]) * density_image(L);
#endif
    return sum;
}

vec3 environment_light(Surface surface) {
    vec3 radiance = vec3(0.0);
    int counts[DRAWS] = directions_by_way(surface);
    int turns = DRAWS;
    for (int way = 0; way < DRAWS; ++way) turns += counts[way];
    // One loop over all ways, since Mesa's llvmpipe ends the loops of a shader after 65,535 turns in all, and pixels that are drawn together
    // take as many as the one that takes the most: of one way in one, of another in another.
    int way = 0;
    int i = 0;
    for (int turn = 0; turn < turns; ++turn) {
        if (i == counts[way]) {
            ++way;
            i = 0;
        } else {
            vec3 L = drawn_direction(surface, way, i);
            float density = density_of_all(surface, L, counts);
            if (density > 0.0) radiance += reflected_light(surface, L) * environment_radiance(L) / density;
            ++i;
        }
    }

    // What mirrors send, which no drawn direction meets.
    LayerView view = surface.view;
    if (!draws(surface, DRAW_GGX)) {
        vec3 mirrored = base_mirror(surface.base, view.NdotV) * environment_radiance(mirrored_direction(view)) * scale_by_view(surface);
#ifdef CLEARCOAT
        mirrored *= 1.0 - surface.k;
#endif
        radiance += mirrored;
    }
#ifdef CLEARCOAT
    if (surface.clearcoat_alpha < MIRROR_ALPHA) {
        radiance += surface.k * environment_radiance(mirrored_direction(surface.coat_view));
    }
#endif
    return radiance;
}
