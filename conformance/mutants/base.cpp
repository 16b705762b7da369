#include "conformance/mutants/mutant.h"

namespace sheen::conformance {
namespace {

constexpr const char* metal_fresnel = "vec3 Fm = material.baseColor + (1.0 - material.baseColor) * w;";
constexpr const char* specular_lobe = "float lobe = specular_ggx(N, H, NdotL, NdotV, material.alpha);";
constexpr const char* height_correlated = "return 0.5 * (NdotL / max(GGXV + GGXL, SMALLEST_SHADING_VALUE));";
constexpr const char* blended = "out_color = vec4(radiance * alpha, alpha);";

}  // namespace

/// glTF 2.0, Appendix B.
std::vector<Mutant> base_mutants() {
  return {
      {.name = "base.diffuse_without_one_minus_f",
       .why = "the highlight is added to the diffuse part, which is not told",
       .edits = {{"base.glsl", "diffuse + Fd * lobe;", "diffuse + Fd * lobe;\n    dielectric = diffuse + Fd * lobe;"}}},
      {.name = "base.f0_mixed_before",
       .why = "one lobe with f0 = mix(0.04, baseColor, metallic) is cheaper than two BRDFs, and another diffuse part",
       .first = {{"core", "sheen.*.on_mixed"}},
       .edits = {{"base.glsl", metal_fresnel,
                  std::string(metal_fresnel) + "\n    vec3 f0 = mix(vec3(0.04), material.baseColor, material.metallic);\n"
                                               "    vec3 F = f0 + (1.0 - f0) * w;\n"
                                               "    return (1.0 - F) * (1.0 - material.metallic) * diffuse + F * lobe;"}}},
      {.name = "base.diffuse_without_pi",
       .why = "lights are given in units that have pi divided out",
       .edits = {{"base.glsl", "vec3 diffuse = material.baseColor", "vec3 diffuse = PI * material.baseColor"}}},
      {.name = "base.vertex_color_beyond_its_range",
       .why = "an interpolated colour is thought to lie between its vertices', and at a snapped sample beside the triangle does not",
       .first = {{"extremes", "vertex_colors.*"}},
       .edits = {{"material.glsl", "clamp(v_color, 0.0, 1.0)", "v_color"}}},
      {.name = "base.n_dot_l_twice",
       .why = "the lobe holds the cosine, and the sum over lights multiplies by it again",
       .edits = {{"base.glsl", specular_lobe, std::string(specular_lobe) + "\n    lobe *= NdotL;"},
                 {"base.glsl", "vec3 diffuse = material.baseColor", "vec3 diffuse = NdotL * material.baseColor"}}},
      {.name = "base.fresnel_by_n_dot_v",
       .why = "the Fresnel term of the environment's split sum is used for punctual lights",
       .edits = {{"base.glsl", "fresnel_weight(dot(V, H))", "fresnel_weight(NdotV)"}}},
      {.name = "base.fresnel_to_the_fourth_power",
       .why = "m2 * m2 is taken for the fifth power",
       .edits = {{"fresnel.glsl", "return m2 * m2 * m;", "return m2 * m2;"}}},
      {.name = "base.smith_uncorrelated",
       .why = "G1(L) G1(V) is the older form",
       .edits = {{"specular_ggx.glsl", height_correlated,
                  "return NdotL / ((NdotL + sqrt(alpha_sq + (1.0 - alpha_sq) * NdotL * NdotL)) * (NdotV + sqrt(alpha_sq + (1.0 - alpha_sq) "
                  "* NdotV * NdotV)));"}}},
      {.name = "base.smith_by_schlick",
       .why = "k = alpha / 2 is Schlick's fit, still found in many engines",
       .edits = {{"specular_ggx.glsl", height_correlated,
                  "float k = 0.5 * alpha;\n    return 0.25 * NdotL / ((NdotL * (1.0 - k) + k) * (NdotV * (1.0 - k) + k));"}}},
      {.name = "base.roughness_not_squared",
       .why = "the lobe takes alpha and is handed the roughness",
       .edits = {{"main.frag", "metallic_roughness.y * metallic_roughness.y", "metallic_roughness.y"}}},
      {.name = "base.metal_keeps_its_diffuse_part",
       .why = "metallic drives f0 alone",
       .first = {{"core", "sheen.*.on_metal"}},
       .edits = {{"base.glsl", metal_fresnel, std::string(metal_fresnel) + "\n    return dielectric + Fm * lobe * material.metallic;"}}},
      {.name = "base.black_edge_of_metals",
       .why = "Schlick's weight is left out for metals",
       .first = {{"core", "metal.*"}},
       .edits = {{"base.glsl", metal_fresnel, "vec3 Fm = material.baseColor;"}}},
  };
}

/// Emission, alpha, and what the program writes.
std::vector<Mutant> output_mutants() {
  return {
      {.name = "alpha.mask_drops_what_equals_the_cutoff",
       .why = "a fragment is kept where alpha > alphaCutoff, and the rule is >=",
       .first = {{"semantics", "alpha.mask_keeps_*"}},
       .edits = {{"main.frag", "if (base_color.a < u_alpha_cutoff) discard;", "if (base_color.a <= u_alpha_cutoff) discard;"}}},
      {.name = "alpha.mask_ignored",
       .why = "MASK is drawn as OPAQUE",
       .first = {{"core", "surface.masked_double_sided"}},
       .edits = {{"main.frag", "if (base_color.a < u_alpha_cutoff) discard;", ""}}},
      {.name = "alpha.of_opaque_materials",
       .why = "alpha is used wherever the picture has some",
       .first = {{"core", "surface.opaque_ignores_alpha"}},
       .alter = of_materials([](scene::Material& material) {
         if (material.alpha_mode == scene::AlphaMode::Opaque && material.base_color_factor.a < 1.0) {
           material.alpha_mode = scene::AlphaMode::Blend;
         }
       })},
      {.name = "alpha.not_premultiplied",
       .why = "the blend function expects colours times alpha and gets them without",
       .first = {{"core", "surface.blended"}},
       .edits = {{"main.frag", blended, "out_color = vec4(radiance, alpha);"}}},
      {.name = "alpha.premultiplied_twice",
       .why = "the shader multiplies, and the blend function does so again",
       .first = {{"core", "surface.blended"}},
       .edits = {{"main.frag", blended, "out_color = vec4(radiance * alpha * alpha, alpha);"}}},
      {.name = "alpha.coverage_of_blended_surfaces_is_one",
       .why = "the alpha that is written is that of a picture without any",
       .first = {{"core", "surface.blended"}},
       .edits = {{"main.frag", blended, "out_color = vec4(radiance * alpha, 1.0);"}}},
      {.name = "emission.ignored",
       .why = "emission is a thing of the lights",
       .first = {{"core", "emission.*"}},
       .alter = of_materials([](scene::Material& material) { material.emissive_factor = glm::dvec3(0.0); })},
      {.name = "emission.strength_ignored",
       .why = "KHR_materials_emissive_strength is not read, so that emission ends at 1",
       .first = {{"core", "emission.strong"}},
       .alter =
           of_materials([](scene::Material& material) { material.emissive_factor = glm::min(material.emissive_factor, glm::dvec3(1.0)); })},
      {.name = "output.red_and_blue_swapped",
       .why = "the target holds BGRA",
       .edits = {{"main.frag", "    out_color = vec4(radiance, 1.0);", "    out_color = vec4(radiance.bgr, 1.0);"}}},
      {.name = "output.clamped_to_one",
       .why = "the target holds codes between 0 and 1",
       .first = {{"core", "lights.*"}},
       .edits = {{"main.frag", "    out_color = vec4(radiance, 1.0);", "    out_color = vec4(min(radiance, vec3(1.0)), 1.0);"}}},
      {.name = "output.through_the_srgb_curve",
       .why = "linear radiance is asked for and the display's encoding is left on",
       .edits = {{"main.frag", "    out_color = vec4(radiance, 1.0);",
                  "    out_color = vec4(pow(max(radiance, vec3(0.0)), vec3(1.0 / 2.2)), 1.0);"}}},
  };
}

}  // namespace sheen::conformance
