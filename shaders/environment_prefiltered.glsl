// Light of the environment the real-time way: each lobe's integral is parted in two (Karis 2013, "Real Shading in Unreal Engine 4"), the
// lobe's albedo for the view and the environment filtered by a lobe seen from above. The base under a sheen is scaled by the view's
// albedo alone, as KHR_materials_sheen allows for light from everywhere.

#ifndef BASE_PHYSICAL
// Split sums of the GGX lobe and of the diffuse term over (sqrt(N.V), roughness), nodes at the edges:
//   r: integral of D Vis (1 - w) N.L,  g: of D Vis w N.L,  b: of w N.L / pi,  w = (1 - V.H)^5
uniform sampler2D u_split_sum;

vec3 split_sum(float NdotV, float roughness) {
    vec2 size = vec2(textureSize(u_split_sum, 0));
    vec2 at = vec2(sqrt(NdotV), roughness) * (size - 1.0);
    ivec2 node = ivec2(min(at, size - 2.0));
    vec2 weight = at - vec2(node);
    vec4 low = mix(texelFetch(u_split_sum, node, 0), texelFetch(u_split_sum, node + ivec2(1, 0), 0), weight.x);
    vec4 high = mix(texelFetch(u_split_sum, node + ivec2(0, 1), 0), texelFetch(u_split_sum, node + ivec2(1, 1), 0), weight.x);
    return mix(low, high, weight.y).rgb;
}
#endif

#ifdef ENVIRONMENT_UNIFORM
vec3 diffuse_light(vec3 N) { return u_environment_uniform; }
vec3 specular_light(LayerView view, float roughness) { return u_environment_uniform; }
vec3 sheen_light(vec3 N, float sheenRoughness) { return u_environment_uniform; }
#else
// The maps below the image: for roughness k / 8, k = 1 to 8, from the left: GGX of 256 x 128, 128 x 64 and six of 64 x 32, each under the
// one before; sheen of 64 x 32; and the diffuse one.
const int PREFILTERED_LEVELS = 8;
const int SHEEN_COLUMN = 256;
const int DIFFUSE_COLUMN = 320;

vec3 specular_level(vec3 direction, int level) {
    if (level == 0) return environment_part(ivec2(0), u_environment_size, direction).rgb;
    int row = level == 1 ? 0 : level == 2 ? 128 : 96 + 32 * level;
    return environment_part(ivec2(0, u_environment_size.y + row), ivec2(2, 1) * max(256 >> level, 32), direction).rgb;
}

// The mean of the environment over a GGX lobe. The rougher it is, the farther it leans from the mirrored direction to the normal: Lagarde
// and de Rousiers 2014, "Moving Frostbite to Physically Based Rendering", listing 22.
vec3 specular_light(LayerView view, float roughness) {
    float alpha = roughness * roughness;
    float lean = (1.0 - alpha) * (sqrt(1.0 - alpha) + alpha);
    vec3 d = u_environment_from_view * normalize_or(mix(view.N, mirrored_direction(view), lean), view.N);
    float at = roughness * float(PREFILTERED_LEVELS);
    int level = min(int(at), PREFILTERED_LEVELS - 1);
    return mix(specular_level(d, level), specular_level(d, level + 1), at - float(level));
}

vec3 diffuse_light(vec3 N) {
    return environment_part(ivec2(DIFFUSE_COLUMN, u_environment_size.y), ivec2(64, 32), u_environment_from_view * N).rgb;
}

#ifdef SHEEN
vec3 sheen_level(vec3 direction, int level) {
    return environment_part(ivec2(SHEEN_COLUMN, u_environment_size.y + 32 * (level - 1)), ivec2(64, 32), direction).rgb;
}

// The lobe is a rim along the horizon wherever the view is from, so its mean is taken about the normal.
vec3 sheen_light(vec3 N, float sheenRoughness) {
    vec3 d = u_environment_from_view * N;
    float at = max(sheenRoughness * float(PREFILTERED_LEVELS), 1.0);
    int level = min(int(at), PREFILTERED_LEVELS - 1);
    return mix(sheen_level(d, level), sheen_level(d, level + 1), at - float(level));
}
#endif
#endif

#ifdef BASE_PHYSICAL
// Both the light of many bounces and what reaches the diffuse part are, over all L, what the lobe leaves of 1 for the view: their averages
// cancel.
vec3 base_environment(BaseMaterial material, LayerView view, float roughness) {
    vec3 F0 = dielectric_f0(material);
    float strength = specular_strength(material);
    vec3 diffuse = diffuse_light(view.N);
    vec3 specular = specular_light(view, roughness);
    vec3 F_ms = multiple_scattering_fresnel(strength * average_fresnel(F0), material.average);
    vec3 metal_F_ms = multiple_scattering_fresnel(average_fresnel(material.baseColor), material.average);
    float scale = material.view.scale;
    float missing = material.view.missing;
    float bias = max(1.0 - scale - missing, 0.0);
    float through = base_transmitted(material.view, max3(F0), strength, max3(F_ms));
    vec3 dielectric = strength * (F0 * scale + bias) * specular + (F_ms * missing + through * material.baseColor) * diffuse;
    vec3 metal = (material.baseColor * scale + bias) * specular + metal_F_ms * missing * diffuse;
    return dielectric * (1.0 - material.metallic) + metal * material.metallic;
}
#else
// The base of glTF 2.0, Appendix B.2. Its Fresnel terms are affine in w, so the split sums hold for every colour.
vec3 base_environment(BaseMaterial material, LayerView view, float roughness) {
    vec3 sums = split_sum(view.NdotV, roughness);
    vec3 diffuse = material.baseColor * diffuse_light(view.N);
    vec3 specular = specular_light(view, roughness);
#ifdef SPECULAR
    float f0 = max3(material.f0);
    vec3 dielectric = (1.0 - material.specular * (f0 + (1.0 - f0) * sums.b)) * diffuse
        + material.specular * specular * (material.f0 * sums.r + sums.g);
#else
    vec3 dielectric = (1.0 - (0.04 + 0.96 * sums.b)) * diffuse + specular * (0.04 * sums.r + sums.g);
#endif
    vec3 metal = specular * (material.baseColor * sums.r + sums.g);
    return dielectric * rest(material.metallic) + metal * material.metallic;
}
#endif

vec3 environment_light(Surface surface) {
    LayerView view = surface.view;
    vec3 reflected = base_environment(surface.base, view, surface.roughness) * scale_by_view(surface);
#ifdef SHEEN
    float sheenRoughness = surface.sheen.sheenRoughness;
    float E = sheenRoughness > 0.0 ? sheen_directional_albedo(view.NdotV, sheenRoughness) : 0.0;
    reflected += surface.sheen.sheenColor * E * sheen_light(view.N, sheenRoughness);
#endif
#ifdef CLEARCOAT
    LayerView coat = surface.coat_view;
    vec3 sums = split_sum(coat.NdotV, surface.clearcoat_roughness);
    vec3 coat_light = specular_light(coat, surface.clearcoat_roughness) * (sums.r + sums.g);
    reflected = reflected * rest(surface.k) + coat_light * surface.k;
#endif
    return reflected;
}
