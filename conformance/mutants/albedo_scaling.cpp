#include "conformance/mutants/mutant.h"

namespace sheen::conformance {
namespace {

constexpr const char* looked_up = "sheen_directional_albedo(cosine, sheenRoughness)";
constexpr const char* scaled =
    "reflected *= sheen_albedo_scaling(surface.sheen.sheenColor, surface.sheen.sheenRoughness, NdotL, view.NdotV);";
constexpr const char* full_scale = "float scale = 1.0 - max3(sheenColor) * sheen_albedo_at(min(NdotV, NdotL), sheenRoughness);";

}  // namespace

/// The table of E, made or read wrongly.
std::vector<Mutant> albedo_table_mutants() {
  return {
      {.name = "scaling.ashikhmin_with_the_table_of_charlie",
       .why = "the simple visibility is taken for speed, with the table that everyone ships",
       .first = {{"core", "scaling.full.charlie.*"}},
       .edits = {{"sheen_lambda.glsl", "return 1.0 / ((1.0 + view.lambda_V + lambda_L) * (4.0 * view.NdotV));",
                  "return 0.25 * (NdotL / (NdotL + view.NdotV - NdotL * view.NdotV));"}}},
      {.name = "scaling.charlie_with_the_table_of_ashikhmin",
       .why = "the table comes from a tool whose cloth is Ashikhmin's",
       .first = {{"core", "scaling.full.charlie.*"}},
       .swaps = {{"sheen_visibility_ashikhmin.glsl", {"sheen_coefficients.glsl", "sheen_visibility_charlie.glsl", "sheen_lambda.glsl"}}},
       .alter =
           [](scene::Scene&, renderer::Settings& settings) {
             if (settings.sheen.visibility == albedo::Visibility::Charlie) {
               settings.sheen.visibility = albedo::Visibility::Ashikhmin;
             }
           }},
      {.name = "scaling.table_transposed",
       .why = "tables run over (N.V, roughness) or over (roughness, N.V)",
       .edits = {{"albedo_scaling.glsl", looked_up, "sheen_directional_albedo(sheenRoughness, cosine)"}}},
      {.name = "scaling.table_one_row_off",
       .why = "a table's rows begin at 0 or at 1, at its edge or half a texel from it",
       .edits = {{"sheen_albedo.glsl", "highp vec4 wx = sheen_cubic_weights(local.x);",
                  "first.y = min(first.y + 1, size.y - 4);\n    highp vec4 wx = sheen_cubic_weights(local.x);"}}},
      {.name = "scaling.table_one_column_off",
       .why = "the same across the cosines",
       .edits = {{"sheen_albedo.glsl", "highp vec4 wx = sheen_cubic_weights(local.x);",
                  "first.x = min(first.x + 1, size.x - 4);\n    highp vec4 wx = sheen_cubic_weights(local.x);"}}},
      {.name = "scaling.table_read_half_a_texel_off",
       .why = "a table of 128 x 128 with its nodes at the edges is sampled as if they were texel centres",
       .edits = {{"albedo_scaling.glsl", looked_up,
                  "sheen_directional_albedo(clamp((128.0 * cosine - 0.5) / 127.0, 0.0, 1.0), clamp((128.0 * sheenRoughness - 0.5) / 127.0, "
                  "0.0, 1.0))"}}},
      {.name = "scaling.table_indexed_by_the_square",
       .why = "some published tables run over alpha = roughness^2",
       .edits = {{"albedo_scaling.glsl", looked_up, "sheen_directional_albedo(cosine, sheenRoughness * sheenRoughness)"}}},
      {.name = "scaling.table_black",
       .why = "a table that was not loaded reads as 0",
       .edits = {{"albedo_scaling.glsl", looked_up, "0.0"}}},
      {.name = "scaling.table_of_eight_bits",
       .why = "the table is shipped as a picture, clamped to 1 and rounded to codes",
       .edits = {{"albedo_scaling.glsl", looked_up,
                  "floor(255.0 * min(sheen_directional_albedo(cosine, sheenRoughness), 1.0) + 0.5) / 255.0"}}},
      {.name = "scaling.table_decoded_from_srgb",
       .why = "a picture of data goes through the colours' decoding",
       .edits = {{"albedo_scaling.glsl", looked_up, "pow(min(sheen_directional_albedo(cosine, sheenRoughness), 1.0), 2.2)"}}},
  };
}

/// KHR_materials_sheen, "Albedo-scaling technique".
std::vector<Mutant> albedo_scale_mutants() {
  return {
      {.name = "scaling.none",
       .why = "the technique stands in a section of its own and is left out",
       .alter = [](scene::Scene&, renderer::Settings& settings) { settings.sheen.scaling = albedo::AlbedoScaling::None; }},
      {.name = "scaling.by_the_color_instead_of_its_maximum",
       .why = "a colour times E is subtracted channel by channel",
       .first = {{"core", "sheen.crimson.roughness_50.*"}},
       .edits = {{"layers.glsl", scaled,
                  "reflected *= clamp(1.0 - surface.sheen.sheenColor * sheen_albedo_at(min(NdotL, view.NdotV), "
                  "surface.sheen.sheenRoughness), 0.0, 1.0);"}}},
      {.name = "scaling.by_the_luminance_instead_of_the_maximum",
       .why = "one number for a colour is its luminance elsewhere",
       .first = {{"core", "sheen.crimson.roughness_50.*"}},
       .edits =
           {{"albedo_scaling.glsl", full_scale,
             "float scale = 1.0 - dot(sheenColor, vec3(0.2126, 0.7152, 0.0722)) * sheen_albedo_at(min(NdotV, NdotL), sheenRoughness);"}}},
      {.name = "scaling.by_the_last_light_alone",
       .why = "the scale is a variable of the loop over lights, and the base is scaled after it",
       .first = {{"core", "lights.warm_then_cold"}},
       .edits = {{"layers.glsl", "struct Surface {", "vec3 last_L = vec3(0.0, 0.0, 1.0);\n\nstruct Surface {"},
                 {"layers.glsl", scaled,
                  "reflected *= sheen_albedo_scaling(surface.sheen.sheenColor, surface.sheen.sheenRoughness, max(dot(view.N, last_L), "
                  "0.0), view.NdotV);"},
                 {"main.frag", "for (int i = 0; i < u_light_count; ++i) {",
                  "last_L = incident_light(u_light_count - 1, v_position).L;\n    for (int i = 0; i < u_light_count; ++i) {"}}},
      {.name = "scaling.not_of_light_from_everywhere",
       .why = "the loop over lights is scaled, and the environment is added elsewhere",
       .first = {{"furnace", "white_lambert.full.*.sheen_100"}},
       .edits = {{"layers.glsl", "struct Surface {", "bool scaling = true;\n\nstruct Surface {"},
                 {"layers.glsl", scaled, std::string("if (scaling) ") + scaled},
                 {"environment_sampled.glsl", "    int counts[DRAWS] =", "    scaling = false;\n    int counts[DRAWS] ="}}},
      {.name = "scaling.of_emission_too",
       .why = "the whole shaded colour is scaled, as the coat's mix would",
       .first = {{"core", "emission.under_sheen"}},
       .edits = {{"main.frag", "    radiance += emission;",
                  "#if defined(SHEEN) && !defined(ALBEDO_SCALING_NONE) && !defined(ALBEDO_SCALING_VIEW)\n"
                  "    emission *= sheen_albedo_scaling(sheen_inputs.rgb, sheen_inputs.a, NdotV, NdotV);\n"
                  "#endif\n"
                  "    radiance += emission;"}}},
      {.name = "scaling.of_the_sheen_too",
       .why = "the sheen is added before the sum is scaled",
       .edits = {{"layers.glsl", scaled, ""},
                 {"layers.glsl", "reflected += sheen_times_NdotL(surface.sheen, view.N, H, NdotL);",
                  std::string("reflected += sheen_times_NdotL(surface.sheen, view.N, H, NdotL);\n"
                              "#if !defined(ALBEDO_SCALING_VIEW) && !defined(ALBEDO_SCALING_NONE)\n") +
                      scaled + "\n#endif"}}},
      {.name = "scaling.of_the_diffuse_part_alone",
       .why = "energy is thought to be taken from what lies under the surface, not from its highlight",
       .edits = {{"layers.glsl", scaled,
                  "BaseMaterial bare = surface.base;\n"
                  "        bare.baseColor *= bare.metallic;\n"
                  "        vec3 highlight = base_times_NdotL(bare, view.N, view.V, H, NdotL, view.NdotV);\n"
                  "        reflected = highlight + (reflected - highlight) * sheen_albedo_scaling(surface.sheen.sheenColor, "
                  "surface.sheen.sheenRoughness, NdotL, view.NdotV);"}}},
      {.name = "scaling.by_the_product_of_both",
       .why = "what passes the layer on its way in and on its way out are multiplied, as elsewhere in layering",
       .edits = {{"albedo_scaling.glsl", full_scale,
                  "float scale = (1.0 - max3(sheenColor) * sheen_albedo_at(NdotV, sheenRoughness)) * (1.0 - max3(sheenColor) * "
                  "sheen_albedo_at(NdotL, sheenRoughness));"}}},
      {.name = "scaling.by_the_larger_of_both",
       .why = "min of the scales is taken for min of the albedos",
       .edits = {{"albedo_scaling.glsl", full_scale,
                  "float scale = 1.0 - max3(sheenColor) * sheen_albedo_at(max(NdotV, NdotL), sheenRoughness);"}}},
      {.name = "scaling.without_the_color",
       .why = "E of a white sheen is used for any",
       .first = {{"core", "sheen.crimson.roughness_50.*"}},
       .edits = {{"albedo_scaling.glsl", full_scale, "float scale = 1.0 - sheen_albedo_at(min(NdotV, NdotL), sheenRoughness);"}}},
  };
}

}  // namespace sheen::conformance
