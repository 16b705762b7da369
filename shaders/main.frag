// Radiance of a surface point under punctual lights:
//   sum over lights E ((1 - k) (f_sheen + s base) (N.L) + k coat (Nc.L)) + (1 - k) emission
// Each lobe is weighted by the cosine of its own normal, so a light below N may still be seen in a tilted coat.

#ifdef NORMAL
in vec3 v_position;
#endif
layout(location = 0) out vec4 out_color;
#ifdef ALPHA_MASK
uniform float u_alpha_cutoff;
#endif

void main() {
    // Every texture is read first: derivatives need uniform control flow.
#ifdef BASE_COLOR
    vec4 base_color = material_base_color();
#endif
#ifdef EMISSION
    vec3 emission = material_emission();
#endif
#ifdef NORMAL
#ifdef ORTHOGRAPHIC
    vec3 V = vec3(0.0, 0.0, 1.0);
#else
    vec3 V = normalize_or(-v_position, vec3(0.0, 0.0, 1.0));
#endif
    vec3 Ng = interpolated_normal(v_position);
#endif
#ifdef LIT
#ifdef NORMAL_TEXTURE
    vec3 normal_texel = texture_sample(u_normal_texture, NORMAL_TEXTURE_UV, NORMAL_TEXTURE_SAMPLER).xyz;
    LayerView view = layer_view(toward_viewer(mapped_normal(Ng, normal_texel, u_normal_scale)), V);
#else
    LayerView view = layer_view(toward_viewer(Ng), V);
#endif
    vec2 metallic_roughness = material_metallic_roughness();
    BaseMaterial base;
    base.baseColor = base_color.rgb;
    base.metallic = metallic_roughness.x;
    base.alpha = metallic_roughness.y * metallic_roughness.y;
#ifdef SPECULAR
    vec4 specular = material_specular();
    base.f0 = specular.rgb;
    base.specular = specular.a;
#endif
#ifdef BASE_PHYSICAL
    base.view = ggx_directional_albedo(view.NdotV, base.alpha);
    base.average = ggx_average_albedo(base.alpha);
#endif
#endif
#ifdef SHEEN
    vec4 sheen_inputs = material_sheen();
#ifdef SHEEN_DRAFT_2019
    sheen_inputs = sheen_of_draft_2019(sheen_inputs.rgb, base.baseColor, metallic_roughness);
#endif
    SheenMaterial sheen = SheenMaterial(sheen_inputs.rgb, sheen_inputs.a, sheen_visibility_of_view(view.NdotV, sheen_inputs.a));
#ifdef ALBEDO_SCALING_VIEW
    float scale = sheen_albedo_scaling(sheen.sheenColor, sheen.sheenRoughness, view.NdotV);
#endif
#endif
#ifdef CLEARCOAT
#ifdef CLEARCOAT_NORMAL_TEXTURE
    vec3 coat_texel = texture_sample(u_clearcoat_normal_texture, CLEARCOAT_NORMAL_TEXTURE_UV, CLEARCOAT_NORMAL_TEXTURE_SAMPLER).xyz;
    LayerView coat_view = layer_view(toward_viewer(mapped_normal(Ng, coat_texel, u_clearcoat_normal_scale)), V);
#else
    LayerView coat_view = layer_view(toward_viewer(Ng), V);
#endif
    float k = clearcoat_weight(material_clearcoat(), coat_view.NdotV);
#ifdef LIT
    float clearcoat_roughness = material_clearcoat_roughness();
    float clearcoat_alpha = clearcoat_roughness * clearcoat_roughness;
#endif
#endif

#ifdef ALPHA_MASK
    if (base_color.a < u_alpha_cutoff) discard;
#endif

    vec3 radiance = vec3(0.0);
#ifdef LIT
    for (int i = 0; i < u_light_count; ++i) {
        IncidentLight light = incident_light(i, v_position);
        vec3 reflected = vec3(0.0);
        float NdotL = min(dot(view.N, light.L), 1.0);
        if (NdotL > 0.0) {
            vec3 H = normalize_or(light.L + view.V, view.N);
            reflected = base_times_NdotL(base, view.N, view.V, H, NdotL, view.NdotV);
#ifdef SHEEN
#ifdef ALBEDO_SCALING_VIEW
            reflected *= scale;
#elif !defined(ALBEDO_SCALING_NONE)
            reflected *= sheen_albedo_scaling(sheen.sheenColor, sheen.sheenRoughness, NdotL, view.NdotV);
#endif
            reflected += sheen_times_NdotL(sheen, view.N, H, NdotL);
#endif
        }
#ifdef CLEARCOAT
        reflected *= 1.0 - k;
        float NcdotL = min(dot(coat_view.N, light.L), 1.0);
        if (NcdotL > 0.0) {
            vec3 Hc = normalize_or(light.L + coat_view.V, coat_view.N);
            reflected += k * specular_ggx(coat_view.N, Hc, NcdotL, coat_view.NdotV, clearcoat_alpha);
        }
#endif
        radiance += reflected * light.E;
    }
#endif
#ifdef EMISSION
#ifdef CLEARCOAT
    // KHR_materials_clearcoat, "Emission": the coat lies on top of it.
    emission *= 1.0 - k;
#endif
    radiance += emission;
#endif

#ifdef ALPHA_BLEND
    out_color = vec4(radiance * base_color.a, base_color.a);
#else
    out_color = vec4(radiance, 1.0);
#endif
}
