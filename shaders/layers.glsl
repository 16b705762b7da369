// A surface point with every input read, and what it reflects of light from one direction:
//   (1 - k) (f_sheen + s base) (N.L) + k coat (Nc.L)
// Each lobe is weighted by the cosine of its own normal, so a light below N may still be seen in a tilted coat.

struct Surface {
    LayerView view;
    BaseMaterial base;
    float roughness;
#ifdef SHEEN
    SheenMaterial sheen;
#ifdef ALBEDO_SCALING_VIEW
    float scale;
#endif
#endif
#ifdef CLEARCOAT
    LayerView coat_view;
    float k;
    float clearcoat_roughness;
    float clearcoat_alpha;
#endif
};

// In 1/sr, cosines included, for a unit L.
vec3 reflected_light(Surface surface, vec3 L) {
    LayerView view = surface.view;
    vec3 reflected = vec3(0.0);
    float NdotL = min(dot(view.N, L), 1.0);
    if (NdotL > 0.0) {
        vec3 H = normalize_or(L + view.V, view.N);
        reflected = base_times_NdotL(surface.base, view.N, view.V, H, NdotL, view.NdotV);
#ifdef SHEEN
#ifdef ALBEDO_SCALING_VIEW
        reflected *= surface.scale;
#elif !defined(ALBEDO_SCALING_NONE)
        reflected *= sheen_albedo_scaling(surface.sheen.sheenColor, surface.sheen.sheenRoughness, NdotL, view.NdotV);
#endif
        reflected += sheen_times_NdotL(surface.sheen, view.N, H, NdotL);
#endif
    }
#ifdef CLEARCOAT
    reflected *= rest(surface.k);
    float NcdotL = min(dot(surface.coat_view.N, L), 1.0);
    if (NcdotL > 0.0) {
        vec3 Hc = normalize_or(L + surface.coat_view.V, surface.coat_view.N);
        reflected += surface.k * specular_ggx(surface.coat_view.N, Hc, NcdotL, surface.coat_view.NdotV, surface.clearcoat_alpha);
    }
#endif
    return reflected;
}
