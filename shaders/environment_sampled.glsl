// Light of the environment by brute force: directions drawn from the image and from every lobe, weighed together by the balance heuristic
// (Veach 1997, "Robust Monte Carlo Methods for Light Transport Simulation", section 9.2). It converges to the integral:
//   sum over directions of f cos(theta) L_env / (sum over ways to draw of count * density)

// In rows by turns: points of the unit square, as x and the cosine and sine of 2 pi y; directions of the image, drawn in proportion to its
// radiance, with their density.
uniform sampler2D u_environment_points;
// Directions to draw, all ways together; but each way draws at least one.
uniform int u_environment_samples;

// Below it the sheen's lobe is drawn from by the other ways alone: it is a thin rim of next to no energy.
const highp float SMALLEST_DRAWN_SHEEN_ROUGHNESS = 1e-3;

// A lobe draws as its albedo asks, the image as much as all lobes together. A lobe of small albedo still shows the brightest lights, so
// each has its least share; that and the sheen's were found by the error of 4,096 directions under two skies, on 13 materials.
const float SMALLEST_WEIGHT = 0.05;
const float WEIGHT_OF_WHITE_SHEEN = 0.15;
const float WEIGHT_OF_SPHERE = 0.01;

// Ways to draw a direction.
const int DRAW_SPHERE = 0;
const int DRAW_COSINE = 1;
const int DRAW_GGX = 2;
#ifdef CLEARCOAT
const int DRAW_COAT = 3;
#define DRAWS_WITH_COAT 4
#else
#define DRAWS_WITH_COAT 3
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

// Everywhere alike, so that no direction's share of the light is divided by next to nothing.
vec3 draw_sphere(vec3 p) { return vec3(2.0 * sqrt(p.x * (1.0 - p.x)) * p.yz, 1.0 - 2.0 * p.x); }

vec3 draw_cosine(LayerView view, vec3 p) { return frame_around(view.N) * vec3(sqrt(p.x) * p.yz, sqrt(1.0 - p.x)); }

// Normals that the view direction sees (Heitz 2018, "Sampling the GGX Distribution of Visible Normals"), by a cap of the sphere around it
// (Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps", listing 3).
vec3 draw_ggx(LayerView view, float alpha, vec3 p) {
    mat3 frame = frame_around(view.N);
    vec3 v = view.V * frame;
    vec3 stretched = normalize(vec3(alpha * v.xy, max(v.z, MIN_N_DOT_V)));
    float below = p.x * (1.0 + stretched.z); // 1 - z of the point of the cap
    float r = sqrt(max(below * (2.0 - below), 1e-20));
    vec3 h = vec3(r * p.yz + stretched.xy, (1.0 - p.x) * (1.0 + stretched.z));
    return mirrored_at(frame * normalize(vec3(alpha * h.xy, h.z)), view.V);
}

// Densities over solid angle, 1/sr. A half vector H is drawn with D_visible(H) = D G1 V.H / N.V, a direction with a quarter of it over V.H.
float density_ggx(LayerView view, float alpha, vec3 L) {
    vec3 H = normalize_or(L + view.V, view.N);
    float a2 = alpha * alpha;
    float G1_over_4NdotV = 0.5 / (view.NdotV + sqrt(a2 + (1.0 - a2) * view.NdotV * view.NdotV));
    return D_GGX(view.N, H, alpha) * G1_over_4NdotV;
}

#ifdef SHEEN
// D cos(theta_h) integrates to sin^(2 + 1/alpha_g) up to theta_h, hence to 1.
vec3 draw_sheen(LayerView view, float sheenRoughness, vec3 p) {
    float exponent = 1.0 / (sheenRoughness * sheenRoughness);
    float sine = exp2(log2(p.x) / (exponent + 2.0));
    vec3 H = frame_around(view.N) * vec3(sine * p.yz, sqrt(max(1.0 - sine * sine, 1e-12)));
    return mirrored_at(H, view.V);
}

float density_sheen(LayerView view, float sheenRoughness, vec3 L) {
    vec3 H = normalize_or(L + view.V, view.N);
    return sheen_distribution(view.N, H, sheenRoughness) * abs(dot(view.N, H)) / (4.0 * max(dot(view.V, H), 1e-30));
}

// Seen from above, half vectors send nearly every light below the horizon. There D is ((1 - N.L) / 2)^p, p = 1 / (2 alpha_g): that is drawn.
vec3 draw_rim(LayerView view, float sheenRoughness, vec3 p) {
    float power = 0.5 / (sheenRoughness * sheenRoughness);
    float below = exp2(log2(1.0 - p.x) / (power + 1.0)); // 1 - N.L
    return frame_around(view.N) * vec3(sqrt(below * (2.0 - below)) * p.yz, 1.0 - below);
}

float density_rim(LayerView view, float sheenRoughness, vec3 L) {
    float power = 0.5 / (sheenRoughness * sheenRoughness);
    float NdotL = dot(view.N, L);
    return NdotL > 0.0 ? (power + 1.0) * exp2(power * log2(max(1.0 - NdotL, 1e-30))) / (2.0 * PI) : 0.0;
}
#endif

#ifdef ENVIRONMENT_IMAGE
// The image's texels hold their share of all directions drawn, over the texel's share of (u, v), by 2 pi^2.
float density_image(vec3 L) {
    vec3 d = u_environment_from_view * L;
    return environment_texel(L).a * inversesqrt(max(dot(d.xz, d.xz), 1e-12));
}
#endif

// A direction, and the density with which the image draws it, where there is one.
struct Drawn {
    vec3 L;
    float image_density;
};

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

vec3 direction_of_lobe(Surface surface, int way, vec3 p) {
#ifdef CLEARCOAT
    if (way == DRAW_COAT) return draw_ggx(surface.coat_view, surface.clearcoat_alpha, p);
#endif
#ifdef SHEEN
    if (way == DRAW_SHEEN) return draw_sheen(surface.view, surface.sheen.sheenRoughness, p);
    if (way == DRAW_RIM) return draw_rim(surface.view, surface.sheen.sheenRoughness, p);
#endif
    if (way == DRAW_SPHERE) return draw_sphere(p);
    if (way == DRAW_GGX) return draw_ggx(surface.view, surface.base.alpha, p);
    return draw_cosine(surface.view, p);
}

Drawn drawn_direction(Surface surface, int way, int i) {
    int width = textureSize(u_environment_points, 0).x;
    ivec2 place = ivec2(i % width, 2 * (i / width));
#ifdef ENVIRONMENT_IMAGE
    if (way == DRAW_IMAGE) {
        vec4 drawn = texelFetch(u_environment_points, place + ivec2(0, 1), 0);
        return Drawn(drawn.xyz * u_environment_from_view, drawn.w);
    }
#endif
    vec3 L = direction_of_lobe(surface, way, texelFetch(u_environment_points, place, 0).xyz);
#ifdef ENVIRONMENT_IMAGE
    return Drawn(L, density_image(L));
#else
    return Drawn(L, 0.0);
#endif
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
        if (way == DRAW_SPHERE) weights[way] = WEIGHT_OF_SPHERE;
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
float density_of_all(Surface surface, Drawn drawn, int counts[DRAWS]) {
    vec3 L = drawn.L;
    float sum = float(counts[DRAW_SPHERE]) * (0.25 * INV_PI) + float(counts[DRAW_COSINE]) * max(dot(surface.view.N, L), 0.0) * INV_PI;
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
    sum += float(counts[DRAW_IMAGE]) * drawn.image_density;
#endif
    return sum;
}

vec3 environment_light(Surface surface) {
    vec3 radiance = vec3(0.0);
    int counts[DRAWS] = directions_by_way(surface);
    int turns = DRAWS - 1;
    for (int way = 0; way < DRAWS; ++way) turns += counts[way];
    // Each way has points of its own, the next of the sequence.
    // One loop over all ways, since Mesa's llvmpipe ends the loops of a shader after 65,535 turns in all, and pixels that are drawn together
    // take as many as the one that takes the most: of one way in one, of another in another.
    int way = 0;
    int point = 0;
    int end = counts[0];
    for (int turn = 0; turn < turns; ++turn) {
        if (point == end) {
            ++way;
            end += counts[way];
        } else {
            Drawn drawn = drawn_direction(surface, way, point);
            vec3 L = drawn.L;
            float density = density_of_all(surface, drawn, counts);
            if (density > 0.0) radiance += reflected_light(surface, L) * environment_radiance(L) / density;
            ++point;
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
