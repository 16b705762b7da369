#include "conformance/mutants/mutant.h"

namespace sheen::conformance {
namespace {

/// The coat's part of the sum, and where it stops dimming what lies below.
constexpr const char* coat_begins = "#ifdef CLEARCOAT\n    reflected";
constexpr const char* coat_dimmed = "float NcdotL";
constexpr const char* coat_begins_with_what_lies_below = "#ifdef CLEARCOAT\n    vec3 below = reflected;\n    reflected";
constexpr const char* coat_lobe = "reflected += surface.k * specular_ggx(";
constexpr const char* coat_of_the_interpolated_normal = "LayerView coat_view = layer_view(toward_viewer(Ng), V);";

}  // namespace

std::vector<Mutant> clearcoat_mutants() {
  return {
      {.name = "coat.fresnel_by_v_dot_h",
       .why = "the Fresnel term of a microfacet lobe is of V.H, and the extension's mix is of N.V",
       .first = {{"core", "clearcoat.rough.*"}},
       .edits = {{"layers.glsl", coat_begins,
                  "#ifdef CLEARCOAT\n"
                  "    LayerView coat = surface.coat_view;\n"
                  "    surface.k *= (0.04 + 0.96 * fresnel_weight(dot(coat.V, normalize_or(L + coat.V, coat.N)))) / "
                  "(0.04 + 0.96 * fresnel_weight(coat.NdotV));\n"
                  "    reflected"}}},
      {.name = "coat.fresnel_twice",
       .why = "the lobe comes with its Fresnel term, and the mix multiplies by it again",
       .first = {{"core", "clearcoat.rough.*"}},
       .edits = {{"layers.glsl", coat_lobe,
                  "reflected += (0.04 + 0.96 * fresnel_weight(surface.coat_view.NdotV)) * surface.k * specular_ggx("}}},
      {.name = "coat.f0_from_the_ior_of_the_base",
       .why = "one f0 is computed for the material; the coat's is 0.04 whatever KHR_materials_ior says",
       .first = {{"semantics", "clearcoat.ior_of_the_base_leaves_it_alone"}},
       .edits = {{"clearcoat.glsl", "float clearcoat_fresnel = 0.04 + 0.96 * fresnel_weight(NcdotV);",
                  "#ifdef SPECULAR\n    float f0 = u_specular_f0;\n#else\n    float f0 = 0.04;\n#endif\n"
                  "    float clearcoat_fresnel = f0 + (1.0 - f0) * fresnel_weight(NcdotV);"}}},
      {.name = "coat.with_the_normal_map_of_the_base",
       .why = "one shading normal serves every lobe",
       .first = {{"core", "clearcoat.normals.of_the_base"}},
       .edits = {{"main.frag", coat_of_the_interpolated_normal,
                  std::string("#ifdef LIT\n    LayerView coat_view = surface.view;\n#else\n    ") + coat_of_the_interpolated_normal +
                      "\n#endif"}}},
      {.name = "coat.without_its_normal_map",
       .why = "clearcoatNormalTexture is not known",
       .first = {{"core", "clearcoat.normals.*"}},
       .alter = of_materials([](scene::Material& material) { material.clearcoat.normal_texture = {}; })},
      {.name = "coat.normal_map_reaches_the_base",
       .why = "a normal map of any layer perturbs the one normal there is",
       .first = {{"core", "clearcoat.normals.of_the_coat"}},
       .alter = of_materials([](scene::Material& material) {
         if (material.clearcoat.normal_texture.present() && !material.normal_texture.present()) {
           material.normal_texture = material.clearcoat.normal_texture;
           material.normal_scale = material.clearcoat.normal_scale;
         }
       })},
      {.name = "coat.lit_by_the_cosine_of_the_base",
       .why = "the sum over lights has one N.L",
       .first = {{"core", "clearcoat.normals.of_the_coat*"}},
       .edits = {{"layers.glsl", "min(dot(surface.coat_view.N, L), 1.0)", "min(dot(view.N, L), 1.0)"}}},
      {.name = "coat.roughness_not_squared",
       .why = "the lobe takes alpha and is handed the roughness",
       .first = {{"core", "clearcoat.rough.*"}},
       .edits = {{"main.frag", "surface.clearcoat_roughness * surface.clearcoat_roughness", "surface.clearcoat_roughness"}}},
      {.name = "coat.does_not_dim_what_lies_below",
       .why = "the coat's highlight is added, and the light it reflects is not taken away",
       .first = {{"core", "clearcoat.smooth.*"}},
       .edits = {{"layers.glsl", coat_begins, coat_begins_with_what_lies_below},
                 {"layers.glsl", coat_dimmed, "reflected = below;\n    float NcdotL"}}},
      {.name = "coat.dims_by_its_factor_alone",
       .why = "mix() is given clearcoat and the Fresnel term is left to the lobe",
       .first = {{"core", "clearcoat.half.*"}},
       .edits = {{"layers.glsl", coat_begins, coat_begins_with_what_lies_below},
                 {"layers.glsl", coat_dimmed,
                  "reflected = below * (1.0 - surface.k / (0.04 + 0.96 * fresnel_weight(surface.coat_view.NdotV)));\n    float NcdotL"}}},
      {.name = "coat.does_not_dim_emission",
       .why = "emission is added last, to whatever was shaded",
       .first = {{"core", "emission.under_a_coat*"}},
       .edits = {{"main.frag", "emission *= 1.0 - k;", ""}}},
      {.name = "coat.changes_the_interface_of_the_base",
       .why = "a base of ior 1.5 under a coat of ior 1.5 reflects nothing in nature; the extension leaves its f0 as it is",
       .first = {{"core", "clearcoat.smooth.over_no_sheen.on_dielectric"}},
       .edits = {{"base.glsl", "float Fd = 0.04 + 0.96 * w;",
                  "#ifdef CLEARCOAT\n    float Fd = w;\n#else\n    float Fd = 0.04 + 0.96 * w;\n#endif"}}},
      {.name = "coat.factor_ignored",
       .why = "a coat is there or it is not",
       .first = {{"core", "clearcoat.half.*"}},
       .alter = of_materials([](scene::Material& material) { material.clearcoat.factor = material.clearcoat.enabled() ? 1.0 : 0.0; })},
  };
}

}  // namespace sheen::conformance
