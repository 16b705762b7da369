#include <algorithm>
#include <limits>
#include <memory>
#include <numbers>

#include "conformance/mutants/mutant.h"

namespace sheen::conformance {
namespace {

/// What is done to the environment's image, which outlives each call.
Alteration of_environment(const std::function<void(scene::Environment&)>& change) {
  return [change, altered = std::make_shared<scene::Environment>()](scene::Scene&, renderer::Settings& settings) {
    if (settings.environment != nullptr) {
      *altered = *settings.environment;
      change(*altered);
      settings.environment = altered.get();
    }
  };
}

}  // namespace

/// KHR_lights_punctual.
std::vector<Mutant> punctual_light_mutants() {
  return {
      {.name = "light.color_ignored",
       .why = "lights are numbers",
       .first = {{"core", "lights.*"}},
       .alter = of_lights([](scene::Light& light) { light.color = glm::dvec3(1.0); })},
      {.name = "light.of_pi_times_the_lux",
       .why = "units of lights that have pi divided out of the BRDF",
       .edits = {{"main.frag", "reflected_light(surface, light.L) * light.E", "PI * reflected_light(surface, light.L) * light.E"}}},
      {.name = "light.first_alone",
       .why = "a preview has one light",
       .first = {{"core", "lights.warm_then_cold"}},
       .edits = {{"main.frag", "i < u_light_count", "i < min(u_light_count, 1)"}}},
      {.name = "light.point_without_falloff",
       .why = "candela are taken for lux",
       .first = {{"core", "lights.point"}},
       .edits = {{"lights.glsl", "clamp(1.0 - share * share, 0.0, 1.0) / squared", "clamp(1.0 - share * share, 0.0, 1.0)"}}},
      {.name = "light.falls_off_linearly",
       .why = "1 / d where 1 / d^2 belongs",
       .first = {{"core", "lights.point"}},
       .edits = {{"lights.glsl", "clamp(1.0 - share * share, 0.0, 1.0) / squared",
                  "clamp(1.0 - share * share, 0.0, 1.0) * inversesqrt(squared)"}}},
      {.name = "light.range_ignored",
       .why = "a light without an end is simpler",
       .first = {{"core", "lights.point_with_range"}},
       .alter = of_lights([](scene::Light& light) { light.range = std::numeric_limits<double>::infinity(); })},
      {.name = "light.range_by_the_square",
       .why = "(d / range)^2 where (d / range)^4 belongs",
       .first = {{"core", "lights.point_with_range"}},
       .edits = {{"lights.glsl", "share * share", "share"}}},
      {.name = "light.range_squared_as_a_whole",
       .why = "another engine's window function, (1 - (d / range)^4)^2",
       .first = {{"core", "lights.point_with_range"}},
       .edits = {{"lights.glsl", "clamp(1.0 - share * share, 0.0, 1.0)", "pow(clamp(1.0 - share * share, 0.0, 1.0), 2.0)"}}},
      {.name = "light.cone_not_squared",
       .why = "the last square of the angular attenuation is left out",
       .first = {{"core", "lights.spot"}},
       .edits = {{"lights.glsl", "return attenuation * attenuation;", "return attenuation;"}}},
      {.name = "light.cone_by_smoothstep",
       .why = "smoothstep() is at hand",
       .first = {{"core", "lights.spot"}},
       .edits = {{"lights.glsl", "return attenuation * attenuation;", "return attenuation * attenuation * (3.0 - 2.0 * attenuation);"}}},
      {.name = "light.inner_cone_ignored",
       .why = "the attenuation is taken from the axis on",
       .first = {{"core", "lights.spot"}},
       .alter = of_lights([](scene::Light& light) { light.inner_cone = 0.0; })},
      {.name = "light.cones_are_whole_angles",
       .why = "inner and outer are half angles in the extension and whole ones elsewhere",
       .first = {{"core", "lights.spot"}},
       .alter = of_lights([](scene::Light& light) {
         light.inner_cone *= 0.5;
         light.outer_cone *= 0.5;
       })},
  };
}

std::vector<Mutant> environment_mutants() {
  return {
      {.name = "environment.turned_half_round",
       .why = "the middle of an equirect is -Z for some and +X for others",
       .first = {{"environment", "sun.metal:sun.cloth"}},
       .alter = of_environment([](scene::Environment& environment) { environment.rotation += std::numbers::pi; })},
      {.name = "environment.upside_down",
       .why = "the first row of a texture is its bottom in OpenGL",
       .first = {{"environment", "sun.metal:sun.cloth"}},
       .alter = of_environment([](scene::Environment& environment) {
         const auto row = [&](int y) { return environment.texels.begin() + static_cast<std::ptrdiff_t>(y) * environment.width; };
         for (int y = 0; 2 * y + 1 < environment.height; ++y) {
           std::swap_ranges(row(y), row(y + 1), row(environment.height - 1 - y));
         }
       })},
      {.name = "environment.of_radiance_over_pi",
       .why = "irradiance and radiance differ by pi",
       .first = {{"furnace", "white_lambert.view.charlie.*"}},
       .edits = {{"environment_sampled.glsl", "environment_radiance(L) / density", "environment_radiance(L) / (PI * density)"}}},
      {.name = "environment.density_of_half_vectors",
       .why = "what is drawn is a half vector, what is divided by a direction's density: a quarter over V.H is forgotten",
       .first = {{"furnace", "base.metal_*.bare"}},
       .edits = {{"environment_sampled.glsl", "float G1_over_4NdotV = 0.5 /", "float G1_over_4NdotV = 2.0 /"}}},
      {.name = "environment.ways_weighed_alike",
       .why = "a way is weighed as if it drew as many directions as another",
       .first = {{"furnace", "base.*.sheen"}},
       .edits = {{"environment_sampled.glsl", "counts[DRAW_COSINE]) *", "counts[DRAW_GGX]) *"}}},
      {.name = "environment.not_seen_in_a_mirror",
       .why = "a lobe of alpha 0 sends nothing to directions drawn at random",
       .first = {{"furnace", "base.mirror.*:corner.mirror_coat"}},
       .edits = {{"environment_sampled.glsl", "        radiance += mirrored;", ""}}},
      {.name = "environment.not_seen_in_a_mirror_coat",
       .why = "clearcoatRoughness is 0 by default, and only rough coats were tried",
       .first = {{"furnace", "corner.mirror_coat"}},
       .edits = {{"environment_sampled.glsl", "radiance += surface.k * environment_radiance(mirrored_direction(surface.coat_view));", ""}}},
      {.name = "environment.without_the_coat",
       .why = "the coat is lit by lamps alone",
       .first = {{"environment", "*.lacquered_cloth"}, {"furnace", "base.*.coat_over_sheen"}},
       .edits = {{"layers.glsl", "struct Surface {", "bool coat_shines = true;\n\nstruct Surface {"},
                 {"layers.glsl", "if (NcdotL > 0.0) {", "if (NcdotL > 0.0 && coat_shines) {"},
                 {"environment_sampled.glsl", "    int counts[DRAWS] =", "    coat_shines = false;\n    int counts[DRAWS] ="}}},
      {.name = "environment.without_the_sheen",
       .why = "there is no prefiltered map for the sheen",
       .first = {{"furnace", "sheen_alone.*"}},
       .edits = {{"layers.glsl", "struct Surface {", "bool cloth_shines = true;\n\nstruct Surface {"},
                 {"layers.glsl", "reflected += sheen_times_NdotL(surface.sheen, view.N, H, NdotL);",
                  "if (cloth_shines) reflected += sheen_times_NdotL(surface.sheen, view.N, H, NdotL);"},
                 {"environment_sampled.glsl", "    int counts[DRAWS] =", "    cloth_shines = false;\n    int counts[DRAWS] ="}}},
      {.name = "environment.occlusion_ignored",
       .why = "the occlusion texture is not read",
       .first = {{"furnace", "corner.occlusion"}},
       .edits = {{"main.frag", "environment_light(surface) * occlusion", "environment_light(surface)"}}},
      {.name = "environment.occlusion_of_full_strength",
       .why = "occlusionTexture.strength is not read",
       .first = {{"furnace", "corner.occlusion"}},
       .alter = of_materials([](scene::Material& material) { material.occlusion_strength = 1.0; })},
  };
}

}  // namespace sheen::conformance
