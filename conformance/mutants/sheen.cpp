#include "conformance/mutants/mutant.h"

namespace sheen::conformance {
namespace {

constexpr const char* exponent = "highp float inv_r = 1.0 / (roughness * roughness);";
constexpr const char* lambda_roughness = "sheen_coefficients(sheenRoughness * sheenRoughness)";
constexpr const char* added_sheen = "reflected += sheen_times_NdotL(surface.sheen, view.N, H, NdotL);";

}  // namespace

/// KHR_materials_sheen, "Sheen distribution" and "Sheen visibility".
std::vector<Mutant> sheen_lobe_mutants() {
  return {
      {.name = "sheen.alpha_g_is_the_roughness",
       .why = "the square of the roughness is forgotten, as in Conty and Kulla's own notation, where r is what the user sets",
       .edits = {{"sheen_distribution.glsl", exponent, "highp float inv_r = 1.0 / roughness;"},
                 {"sheen_lambda.glsl", lambda_roughness, "sheen_coefficients(sheenRoughness)"}}},
      {.name = "sheen.alpha_g_is_the_fourth_power",
       .why = "the roughness is squared where it is read and again in each function",
       .edits = {{"sheen_distribution.glsl", exponent, "highp float inv_r = 1.0 / (roughness * roughness * roughness * roughness);"},
                 {"sheen_lambda.glsl", lambda_roughness,
                  "sheen_coefficients(sheenRoughness * sheenRoughness * sheenRoughness * sheenRoughness)"}}},
      {.name = "sheen.squared_twice_in_lambda_alone",
       .why = "lambda's helper squares an alpha_g that it is handed",
       .edits = {{"sheen_lambda.glsl", lambda_roughness,
                  "sheen_coefficients(sheenRoughness * sheenRoughness * sheenRoughness * sheenRoughness)"}}},
      {.name = "sheen.not_squared_in_lambda_alone",
       .why = "lambda's helper is handed the roughness where it expects alpha_g",
       .edits = {{"sheen_lambda.glsl", lambda_roughness, "sheen_coefficients(sheenRoughness)"}}},
      {.name = "sheen.lambda_of_one_branch",
       .why = "the mirrored branch of lambda for cosines of 0.5 and more is taken for an optimisation",
       .edits = {{"sheen_lambda.glsl", "return abs(cos_theta) < 0.5 ? exp(l(cos_theta, k)) : exp(2.0 * l(0.5, k) - l(1.0 - cos_theta, k));",
                  "return exp(l(cos_theta, k));"}}},
      {.name = "sheen.coefficients_interpolated_linearly",
       .why = "(1 - alpha)^2 is read as 1 - alpha",
       .edits = {{"sheen_visibility_charlie.glsl", "(1.0 - alpha_g) * (1.0 - alpha_g)", "(1.0 - alpha_g)"}}},
      {.name = "sheen.coefficients_interpolated_the_other_way",
       .why = "the paper's table and mix() order their ends differently",
       .edits = {{"sheen_visibility_charlie.glsl", "(1.0 - alpha_g) * (1.0 - alpha_g)", "1.0 - (1.0 - alpha_g) * (1.0 - alpha_g)"}}},
      {.name = "sheen.refined_coefficients_as_published",
       .why = "the published interpolation of the refined coefficients has its two ends swapped",
       .first = {{"core", "scaling.none.refined.*"}},
       // The sum of both ends, less what is meant.
       .edits = {{"sheen_visibility_refined.glsl", "SheenCoefficients(a, b, c, d, e)",
                  "SheenCoefficients(25.6095 - a, 7.61507 - b, 0.62137 - c, -3.04421 - d, -2.99057 - e)"}}},
      {.name = "sheen.exponent_not_halved",
       .why = "sin^2 is raised to 1 / alpha_g, the exponent that belongs to the sine",
       .edits = {{"sheen_distribution.glsl", "exponent = 0.5 * inv_r * log_sin2h", "exponent = inv_r * log_sin2h"}}},
      {.name = "sheen.sin2_floored_for_half_floats",
       .why = "2^-7 under the power keeps half floats from underflow, and is kept where floats are whole",
       .first = {{"core", "sheen.white.roughness_100.*"}},
       .edits = {{"sheen_distribution.glsl", "log(max(dot(NxH, NxH), 1e-30))", "log(max(dot(NxH, NxH), 0.0078125))"}}},
      {.name = "sheen.distribution_without_pi",
       .why = "the 2 pi of the normalisation is folded into a light that has no pi in it",
       .edits = {{"sheen_distribution.glsl", "return min(value, LARGEST_SHADING_VALUE);",
                  "return min(PI * value, LARGEST_SHADING_VALUE);"}}},
      {.name = "sheen.distribution_is_ggx",
       .why = "the distribution at hand is reused",
       .edits = {{"sheen.glsl", "float D = sheen_distribution(N, H, material.sheenRoughness);",
                  "float D = D_GGX(N, H, material.sheenRoughness * material.sheenRoughness);"}}},
      {.name = "sheen.visibility_clamped_to_one",
       .why = "a visibility is taken for a share; G / (4 N.L N.V) grows without limit toward grazing angles",
       .first = {{"core", "light.behind.charlie.*"}, {"core", "light.*.charlie.*"}},
       .edits = {{"sheen_lambda.glsl", "return 1.0 / ((1.0 + view.lambda_V + lambda_L) * (4.0 * view.NdotV));",
                  "return min(1.0 / ((1.0 + view.lambda_V + lambda_L) * (4.0 * view.NdotV * NdotL)), 1.0) * NdotL;"}}},
      {.name = "sheen.ashikhmin_without_the_product",
       .why = "the term N.L N.V under the fraction is dropped",
       .first = {{"core", "scaling.none.ashikhmin.*"}},
       .edits = {{"sheen_visibility_ashikhmin.glsl", "return 0.25 * (NdotL / (NdotL + view.NdotV - NdotL * view.NdotV));",
                  "return 0.25 * (NdotL / (NdotL + view.NdotV));"}}},
      {.name = "sheen.half_vector_not_normalized",
       .why = "L + V is halved, which is a unit vector only where both are the same",
       .edits = {{"layers.glsl", "vec3 H = normalize_or(L + view.V, view.N);", "vec3 H = 0.5 * (L + view.V);"}}},
      {.name = "sheen.n_dot_l_twice",
       .why = "the lobe holds the cosine, and the sum over lights multiplies by it again",
       .edits = {{"sheen.glsl", "material.sheenColor * (D *", "material.sheenColor * (NdotL * D *"}}},
      {.name = "sheen.roughness_floored",
       .why = "sheenRoughness is held to at least 0.07 to keep half floats finite, so the default of 0 shows a sheen",
       .first = {{"core", "defaults.sheen_roughness_is_0"}},
       .edits = {{"main.frag", "vec4 sheen_inputs = material_sheen();",
                  "vec4 sheen_inputs = material_sheen();\n    sheen_inputs.a = max(sheen_inputs.a, 0.07);"}}},
  };
}

/// Where the layer stands among the others.
std::vector<Mutant> sheen_layer_mutants() {
  return {
      {.name = "sheen.replaces_the_base",
       .why = "cloth is a shading model of its own in many engines, without the base of the material",
       .edits = {{"layers.glsl", added_sheen, "reflected = sheen_times_NdotL(surface.sheen, view.N, H, NdotL);"}}},
      {.name = "sheen.above_the_coat",
       .why = "the layers are added in the order in which they were implemented",
       .first = {{"core", "clearcoat.smooth.over_sheen.*"}},
       .edits = {{"layers.glsl", "vec3 reflected = vec3(0.0);", "vec3 reflected = vec3(0.0);\n    vec3 above = vec3(0.0);"},
                 {"layers.glsl", added_sheen, "above = sheen_times_NdotL(surface.sheen, view.N, H, NdotL);"},
                 {"layers.glsl", "    return reflected;", "    return reflected + above;"}}},
      {.name = "sheen.dropped_when_coated",
       .why = "cloth and clear coat are two shading models, of which a material gets one",
       .first = {{"core", "clearcoat.smooth.over_sheen.*"}},
       .alter = of_materials([](scene::Material& material) {
         if (material.clearcoat.enabled()) {
           material.sheen.color_factor = glm::dvec3(0.0);
         }
       })},
      {.name = "sheen.by_the_interpolated_normal",
       .why = "sheen is taken for a property of the fabric, which the normal map is not thought to bend",
       .first = {{"core", "texture.normal.*"}},
       .edits = {{"layers.glsl", added_sheen,
                  "vec3 N = toward_viewer(normalize_or(v_normal, view.N));\n"
                  "        if (dot(N, L) > 0.0) reflected += sheen_times_NdotL(surface.sheen, N, H, min(dot(N, L), 1.0));"}}},
      {.name = "sheen.as_in_the_draft_of_2019",
       .why = "the viewer was written before the extension was ratified",
       .alter =
           [](scene::Scene&, renderer::Settings& settings) {
             if (settings.sheen.model == albedo::Model::Ratified) {
               settings.sheen.model = albedo::Model::Draft2019;
             }
           }},
      {.name = "sheen.in_half_floats_where_floats_are_asked_for",
       .why = "the driver, or a precision statement, makes mediump of highp",
       .alter = [](scene::Scene&, renderer::Settings& settings) { settings.precision = renderer::Precision::Mediump; }},
      {.name = "sheen.as_printed_at_roughness_zero",
       .why = "the printed distribution divides by alpha_g, which is 0 by default",
       .first = {{"core", "defaults.sheen_roughness_is_0"}},
       .alter = [](scene::Scene&, renderer::Settings& settings) { settings.formulation = renderer::Formulation::Literal; }},
  };
}

}  // namespace sheen::conformance
