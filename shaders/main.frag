// Radiance of a surface point:
//   sum over lights E ((1 - k) (f_sheen + s base) (N.L) + k coat (Nc.L)) + the same over the environment + (1 - k) emission

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
#ifdef ENVIRONMENT
    float occlusion = material_occlusion();
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
    Surface surface;
#ifdef NORMAL_TEXTURE
    vec3 normal_texel = texture_sample(u_normal_texture, NORMAL_TEXTURE_UV, NORMAL_TEXTURE_SAMPLER).xyz;
    surface.view = layer_view(toward_viewer(mapped_normal(Ng, normal_texel, u_normal_scale)), V);
#else
    surface.view = layer_view(toward_viewer(Ng), V);
#endif
    vec2 metallic_roughness = material_metallic_roughness();
    surface.base.baseColor = base_color.rgb;
    surface.base.metallic = metallic_roughness.x;
    surface.base.alpha = metallic_roughness.y * metallic_roughness.y;
    surface.roughness = metallic_roughness.y;
#ifdef SPECULAR
    vec4 specular = material_specular();
    surface.base.f0 = specular.rgb;
    surface.base.specular = specular.a;
#endif
#ifdef BASE_PHYSICAL
    surface.base.view = ggx_directional_albedo(surface.view.NdotV, surface.base.alpha);
    surface.base.average = ggx_average_albedo(surface.base.alpha);
#endif
#ifdef SHEEN
    vec4 sheen_inputs = material_sheen();
#ifdef SHEEN_DRAFT_2019
    sheen_inputs = sheen_of_draft_2019(sheen_inputs.rgb, surface.base.baseColor, metallic_roughness);
#endif
    float NdotV = surface.view.NdotV;
    surface.sheen = SheenMaterial(sheen_inputs.rgb, sheen_inputs.a, sheen_visibility_of_view(NdotV, sheen_inputs.a));
#ifdef ALBEDO_SCALING_VIEW
    surface.scale = sheen_albedo_scaling(sheen_inputs.rgb, sheen_inputs.a, NdotV);
#endif
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
    surface.coat_view = coat_view;
    surface.k = k;
    surface.clearcoat_roughness = material_clearcoat_roughness();
    surface.clearcoat_alpha = surface.clearcoat_roughness * surface.clearcoat_roughness;
#endif
#endif

#ifdef ALPHA_MASK
    if (base_color.a < u_alpha_cutoff) discard;
#endif

    vec3 radiance = vec3(0.0);
#ifdef LIGHTS
    for (int i = 0; i < u_light_count; ++i) {
        IncidentLight light = incident_light(i, v_position);
        radiance += reflected_light(surface, light.L) * light.E;
    }
#endif
#ifdef ENVIRONMENT
    radiance += environment_light(surface) * occlusion;
#endif
#ifdef EMISSION
#ifdef CLEARCOAT
    // KHR_materials_clearcoat, "Emission": the coat lies on top of it.
    emission *= 1.0 - k;
#endif
    radiance += emission;
#endif

#ifdef ALPHA_BLEND
    float alpha = clamp(base_color.a, 0.0, 1.0);
    out_color = vec4(radiance * alpha, alpha);
#else
    out_color = vec4(radiance, 1.0);
#endif
}
