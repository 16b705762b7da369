#include <cmath>

#include "conformance/mutants/mutant.h"

namespace sheen::conformance {

std::vector<Mutant> reader_mutants() {
  return {
      {.name = "reader.sheen_roughness_of_zero_is_one",
       .why = "`factor || 1` takes a 0, and what is not there, for 1",
       .first = {{"core", "defaults.sheen_roughness_is_0"}},
       .alter = of_materials(
           [](scene::Material& m) { m.sheen.roughness_factor = m.sheen.roughness_factor == 0.0 ? 1.0 : m.sheen.roughness_factor; })},
      {.name = "reader.sheen_color_is_white_where_there_is_a_texture",
       .why = "other factors are 1 by default, so that a texture alone shows; sheenColorFactor is 0",
       .first = {{"core", "defaults.sheen_color_texture_alone_is_black"}},
       .alter = of_materials([](scene::Material& m) {
         if (!m.sheen.enabled() && m.sheen.color_texture.present()) {
           m.sheen.color_factor = glm::dvec3(1.0);
         }
       })},
      {.name = "reader.coat_roughness_of_zero_is_one",
       .why = "`factor || 1` takes a 0, and what is not there, for 1",
       .first = {{"core", "defaults.clearcoat_roughness_is_0"}},
       .alter = of_materials([](scene::Material& m) {
         m.clearcoat.roughness_factor = m.clearcoat.roughness_factor == 0.0 ? 1.0 : m.clearcoat.roughness_factor;
       })},
      {.name = "reader.metallic_of_one_is_zero",
       .why = "metallicFactor is taken to be 0 by default; it is 1",
       .first = {{"core", "defaults.material_is_white_metal"}},
       .alter = of_materials([](scene::Material& m) {
         if (m.metallic_factor == 1.0 && m.roughness_factor == 1.0 && !m.metallic_roughness_texture.present()) {
           m.metallic_factor = 0.0;
         }
       })},
      {.name = "reader.colors_are_decoded",
       .why = "factors are linear, and are picked in a dialogue of sRGB colours",
       .alter = of_materials([](scene::Material& m) { m.sheen.color_factor = glm::pow(m.sheen.color_factor, glm::dvec3(2.2)); })},
      {.name = "reader.sheen_ignored",
       .why = "KHR_materials_sheen is not known, and not reported so",
       .alter = of_materials([](scene::Material& m) { m.sheen = {}; })},
      {.name = "reader.clearcoat_ignored",
       .why = "KHR_materials_clearcoat is not known, and not reported so",
       .first = {{"core", "clearcoat.rough.*"}},
       .alter = of_materials([](scene::Material& m) { m.clearcoat = {}; })},
      {.name = "reader.ior_ignored",
       .why = "KHR_materials_ior is not known, and not reported so",
       .first = {{"core", "surface.ior_and_specular"}},
       .alter = of_materials([](scene::Material& m) { m.ior = 1.5; })},
      {.name = "reader.specular_factor_ignored",
       .why = "KHR_materials_specular is read for its colour",
       .first = {{"core", "surface.lambert"}},
       .alter = of_materials([](scene::Material& m) { m.specular.factor = 1.0; })},
      {.name = "reader.specular_color_ignored",
       .why = "KHR_materials_specular is read for its strength",
       .first = {{"core", "surface.ior_and_specular"}},
       .alter = of_materials([](scene::Material& m) { m.specular.color_factor = glm::dvec3(1.0); })},
      {.name = "reader.alpha_cutoff_is_half",
       .why = "alphaCutoff is not read",
       .first = {{"core", "surface.masked_double_sided"}},
       .alter = of_materials([](scene::Material& m) { m.alpha_cutoff = 0.5; })},
      {.name = "reader.vertex_colors_ignored",
       .why = "COLOR_0 is not read",
       .first = {{"core", "surface.vertex_colors"}},
       .alter =
           [](scene::Scene& scene, renderer::Settings&) {
             for (scene::Primitive& primitive : scene.primitives) {
               primitive.colors.clear();
             }
           }},
      {.name = "reader.vertex_colors_decoded",
       .why = "COLOR_0 is linear, and is decoded like a texture",
       .first = {{"core", "surface.vertex_colors"}},
       .alter =
           [](scene::Scene& scene, renderer::Settings&) {
             for (scene::Primitive& primitive : scene.primitives) {
               for (glm::vec4& color : primitive.colors) {
                 color = glm::vec4(glm::pow(glm::vec3(color), glm::vec3(2.2F)), color.a);
               }
             }
           }},
      {.name = "reader.field_of_view_is_of_a_wide_picture",
       .why = "yfov is the vertical angle, and is taken for the horizontal one of a picture of 4 : 3",
       .first = {{"core", "shape.cloth.velvet"}},
       .alter =
           [](scene::Scene& scene, renderer::Settings&) {
             for (scene::Camera& camera : scene.cameras) {
               camera.yfov = 2.0 * std::atan(0.75 * std::tan(0.5 * camera.yfov));
             }
           }},
  };
}

}  // namespace sheen::conformance
