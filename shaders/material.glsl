// The material's inputs: factor times texture, each in the channel and colour space its specification gives. For every texture the
// program states X_UV (its coordinates, transformed by KHR_texture_transform) and X_SAMPLER (its size, wrap, filter, and how it is stored).

#ifdef TEXCOORD_0
in vec2 v_texcoord_0;
#endif
#ifdef TEXCOORD_1
in vec2 v_texcoord_1;
#endif

// glTF 2.0, section 3.9.2: baseColorFactor * baseColorTexture * COLOR_0.
#ifdef BASE_COLOR
uniform vec4 u_base_color_factor;
#ifdef VERTEX_COLOR
in vec4 v_color;
#endif
#ifdef BASE_COLOR_TEXTURE
uniform usampler2D u_base_color_texture;
uniform ivec2 u_base_color_texture_size;
#ifdef BASE_COLOR_TEXTURE_TRANSFORM
uniform mat3 u_base_color_texture_transform;
#endif
#endif
vec4 material_base_color() {
    vec4 value = u_base_color_factor;
#ifdef BASE_COLOR_TEXTURE
    value *= texture_sample(u_base_color_texture, BASE_COLOR_TEXTURE_UV, BASE_COLOR_TEXTURE_SAMPLER);
#endif
#ifdef VERTEX_COLOR
    // A sample may lie beyond its triangle: snapped to the driver's grid, or by rounding.
    value *= clamp(v_color, 0.0, 1.0);
#endif
    return value;
}
#endif

// glTF 2.0, section 3.9.2: metallic in b, roughness in g. Returns (metallic, roughness).
#ifdef LIT
uniform float u_metallic_factor;
uniform float u_roughness_factor;
#ifdef METALLIC_ROUGHNESS_TEXTURE
uniform usampler2D u_metallic_roughness_texture;
uniform ivec2 u_metallic_roughness_texture_size;
#ifdef METALLIC_ROUGHNESS_TEXTURE_TRANSFORM
uniform mat3 u_metallic_roughness_texture_transform;
#endif
#endif
vec2 material_metallic_roughness() {
    vec2 value = vec2(u_metallic_factor, u_roughness_factor);
#ifdef METALLIC_ROUGHNESS_TEXTURE
    value *= texture_sample(u_metallic_roughness_texture, METALLIC_ROUGHNESS_TEXTURE_UV, METALLIC_ROUGHNESS_TEXTURE_SAMPLER).bg;
#endif
    return value;
}
#endif

// KHR_materials_specular: strength in specularTexture.a, colour in specularColorTexture.rgb; u_specular_f0 = ((1-ior)/(1+ior))^2 of
// KHR_materials_ior. Returns (f0, strength).
#ifdef SPECULAR
uniform float u_specular_f0;
uniform float u_specular_factor;
uniform vec3 u_specular_color_factor;
#ifdef SPECULAR_TEXTURE
uniform usampler2D u_specular_texture;
uniform ivec2 u_specular_texture_size;
#ifdef SPECULAR_TEXTURE_TRANSFORM
uniform mat3 u_specular_texture_transform;
#endif
#endif
#ifdef SPECULAR_COLOR_TEXTURE
uniform usampler2D u_specular_color_texture;
uniform ivec2 u_specular_color_texture_size;
#ifdef SPECULAR_COLOR_TEXTURE_TRANSFORM
uniform mat3 u_specular_color_texture_transform;
#endif
#endif
vec4 material_specular() {
    vec3 color = u_specular_color_factor;
    float strength = u_specular_factor;
#ifdef SPECULAR_COLOR_TEXTURE
    color *= texture_sample(u_specular_color_texture, SPECULAR_COLOR_TEXTURE_UV, SPECULAR_COLOR_TEXTURE_SAMPLER).rgb;
#endif
#ifdef SPECULAR_TEXTURE
    strength *= texture_sample(u_specular_texture, SPECULAR_TEXTURE_UV, SPECULAR_TEXTURE_SAMPLER).a;
#endif
    return vec4(min(u_specular_f0 * color, vec3(1.0)), strength);
}
#endif

// KHR_materials_sheen: "sheenColor = sheenColorFactor * sampleLinear(sheenColorTexture).rgb", "sheenRoughness = sheenRoughnessFactor *
// sample(sheenRoughnessTexture).a". Returns (sheenColor, sheenRoughness).
#ifdef SHEEN
uniform vec3 u_sheen_color_factor;
#ifndef SHEEN_DRAFT_2019
uniform float u_sheen_roughness_factor;
#endif
#ifdef SHEEN_COLOR_TEXTURE
uniform usampler2D u_sheen_color_texture;
uniform ivec2 u_sheen_color_texture_size;
#ifdef SHEEN_COLOR_TEXTURE_TRANSFORM
uniform mat3 u_sheen_color_texture_transform;
#endif
#endif
#ifdef SHEEN_ROUGHNESS_TEXTURE
uniform usampler2D u_sheen_roughness_texture;
uniform ivec2 u_sheen_roughness_texture_size;
#ifdef SHEEN_ROUGHNESS_TEXTURE_TRANSFORM
uniform mat3 u_sheen_roughness_texture_transform;
#endif
#endif
vec4 material_sheen() {
#ifdef SHEEN_DRAFT_2019
    vec4 value = vec4(u_sheen_color_factor, 0.0);  // the draft has no roughness of its own
#else
    vec4 value = vec4(u_sheen_color_factor, u_sheen_roughness_factor);
#endif
#ifdef SHEEN_COLOR_TEXTURE
    value.rgb *= texture_sample(u_sheen_color_texture, SHEEN_COLOR_TEXTURE_UV, SHEEN_COLOR_TEXTURE_SAMPLER).rgb;
#endif
#ifdef SHEEN_ROUGHNESS_TEXTURE
    value.a *= texture_sample(u_sheen_roughness_texture, SHEEN_ROUGHNESS_TEXTURE_UV, SHEEN_ROUGHNESS_TEXTURE_SAMPLER).a;
#endif
    return value;
}
#endif

// KHR_materials_clearcoat: "clearcoat = clearcoatFactor * clearcoatTexture.r", "clearcoatRoughness = clearcoatRoughnessFactor *
// clearcoatRoughnessTexture.g".
#ifdef CLEARCOAT
uniform float u_clearcoat_factor;
#ifdef CLEARCOAT_TEXTURE
uniform usampler2D u_clearcoat_texture;
uniform ivec2 u_clearcoat_texture_size;
#ifdef CLEARCOAT_TEXTURE_TRANSFORM
uniform mat3 u_clearcoat_texture_transform;
#endif
#endif
float material_clearcoat() {
    float value = u_clearcoat_factor;
#ifdef CLEARCOAT_TEXTURE
    value *= texture_sample(u_clearcoat_texture, CLEARCOAT_TEXTURE_UV, CLEARCOAT_TEXTURE_SAMPLER).r;
#endif
    return value;
}
#ifdef LIT
uniform float u_clearcoat_roughness_factor;
#ifdef CLEARCOAT_ROUGHNESS_TEXTURE
uniform usampler2D u_clearcoat_roughness_texture;
uniform ivec2 u_clearcoat_roughness_texture_size;
#ifdef CLEARCOAT_ROUGHNESS_TEXTURE_TRANSFORM
uniform mat3 u_clearcoat_roughness_texture_transform;
#endif
#endif
float material_clearcoat_roughness() {
    float value = u_clearcoat_roughness_factor;
#ifdef CLEARCOAT_ROUGHNESS_TEXTURE
    value *= texture_sample(u_clearcoat_roughness_texture, CLEARCOAT_ROUGHNESS_TEXTURE_UV, CLEARCOAT_ROUGHNESS_TEXTURE_SAMPLER).g;
#endif
    return value;
}
#endif
#endif

// glTF 2.0, section 3.9.3, with KHR_materials_emissive_strength folded into the factor.
#ifdef EMISSION
uniform vec3 u_emissive_factor;
#ifdef EMISSIVE_TEXTURE
uniform usampler2D u_emissive_texture;
uniform ivec2 u_emissive_texture_size;
#ifdef EMISSIVE_TEXTURE_TRANSFORM
uniform mat3 u_emissive_texture_transform;
#endif
#endif
vec3 material_emission() {
    vec3 value = u_emissive_factor;
#ifdef EMISSIVE_TEXTURE
    value *= texture_sample(u_emissive_texture, EMISSIVE_TEXTURE_UV, EMISSIVE_TEXTURE_SAMPLER).rgb;
#endif
    return value;
}
#endif

// glTF 2.0, section 3.9.3: occlusionTexture.r, linear, "1.0 + strength * (occlusionTexture - 1.0)"; of light from the environment alone.
#ifdef ENVIRONMENT
#ifdef OCCLUSION_TEXTURE
uniform usampler2D u_occlusion_texture;
uniform ivec2 u_occlusion_texture_size;
uniform float u_occlusion_strength;
#ifdef OCCLUSION_TEXTURE_TRANSFORM
uniform mat3 u_occlusion_texture_transform;
#endif
#endif
float material_occlusion() {
#ifdef OCCLUSION_TEXTURE
    return 1.0 + u_occlusion_strength * (texture_sample(u_occlusion_texture, OCCLUSION_TEXTURE_UV, OCCLUSION_TEXTURE_SAMPLER).r - 1.0);
#else
    return 1.0;
#endif
}
#endif
