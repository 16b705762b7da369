// The base layer with every bounce accounted for: reciprocal and conserving energy. In the place of base.glsl.
//   metal      = F D Vis + F_ms f_ms
//   dielectric = F D Vis + F_ms f_ms + baseColor / PI * (1 - Es(l)) (1 - Es(v)) / (1 - Es_avg)
// Kulla and Conty 2017, "Revisiting Physically Based Shading at Imageworks", with F_ms as Hill 2018 ("A Multi-Faceted Exploration", part 2)
// puts it right:
//   f_ms = (1 - E(l)) (1 - E(v)) / (PI (1 - E_avg)),    F_ms = F_avg^2 E_avg / (1 - F_avg (1 - E_avg)),    F_avg = 1/21 + 20/21 F0
// Es is the albedo of F D Vis + F_ms f_ms with the dielectric's largest F0; the diffuse part after Kelemen and Szirmay-Kalos 2001.
// Two such BRDFs mixed by `metallic` are such a BRDF.

struct BaseMaterial {
    vec3 baseColor;
    float metallic;
    float alpha;  // roughness^2
#ifdef SPECULAR
    vec3 f0;
    float specular;
#endif
    GgxAlbedo view;     // of the lobe at N.V
    GgxAlbedo average;  // over the hemisphere
};

// KHR_materials_ior and KHR_materials_specular, or what holds without them.
#ifdef SPECULAR
vec3 dielectric_f0(BaseMaterial material) { return material.f0; }
float specular_strength(BaseMaterial material) { return material.specular; }
#else
vec3 dielectric_f0(BaseMaterial material) { return vec3(0.04); }
float specular_strength(BaseMaterial material) { return 1.0; }
#endif

// Schlick's term averaged over the hemisphere; a base colour above 1 reflects no more than all.
vec3 average_fresnel(vec3 F0) { return min(1.0 / 21.0 + 20.0 / 21.0 * F0, vec3(1.0)); }

highp vec3 multiple_scattering_fresnel(highp vec3 F_avg, GgxAlbedo average) {
    return F_avg * F_avg * (1.0 - average.missing) / (1.0 - F_avg * average.missing);
}

// 1 - Es at one cosine, Es = strength (F0 scale + bias) + F_ms missing: taken part by part from 1 = scale + bias + missing, for near grazing
// angles it is a small rest.
highp float base_transmitted(GgxAlbedo albedo, highp float F0, highp float strength, highp float F_ms) {
    highp float bias = max(1.0 - albedo.scale - albedo.missing, 0.0);
    return (1.0 - strength * F0) * albedo.scale + (1.0 - strength) * bias + (1.0 - F_ms) * albedo.missing;
}

// base (N.L), in 1/sr, for N.L > 0.
vec3 base_times_NdotL(BaseMaterial material, vec3 N, vec3 V, vec3 H, float NdotL, float NdotV) {
    vec3 F0 = dielectric_f0(material);
    float strength = specular_strength(material);
    GgxAlbedo light = ggx_directional_albedo(NdotL, material.alpha);
    // A mirror misses nothing, and a dielectric of F0 = 1 lets nothing through.
    highp float f_ms = light.missing * material.view.missing / (PI * max(material.average.missing, 1e-30));
    highp vec3 F_ms = multiple_scattering_fresnel(strength * average_fresnel(F0), material.average);
    highp vec3 metal_F_ms = multiple_scattering_fresnel(average_fresnel(material.baseColor), material.average);
    highp float largest_F0 = max3(F0);
    highp float largest_F_ms = max(max(F_ms.x, F_ms.y), F_ms.z);
    highp float through = base_transmitted(light, largest_F0, strength, largest_F_ms) *
                          base_transmitted(material.view, largest_F0, strength, largest_F_ms) /
                          max(base_transmitted(material.average, largest_F0, strength, largest_F_ms), 1e-6);

    float w = fresnel_weight(dot(V, H));
    float lobe = specular_ggx(N, H, NdotL, NdotV, material.alpha);
    vec3 F = strength * (F0 + (1.0 - F0) * w);
    vec3 metal_F = material.baseColor + (1.0 - material.baseColor) * w;
    highp float multiple = f_ms * NdotL;
    highp float diffuse = through * NdotL / PI;
    vec3 dielectric = F * lobe + multiple * F_ms + diffuse * material.baseColor;
    vec3 metal = metal_F * lobe + multiple * metal_F_ms;
    return dielectric * rest(material.metallic) + metal * material.metallic;
}
