#include "renderer/shading.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>

#include "renderer/feature_words.h"

namespace sheen::renderer {
namespace {

/// Lobes and layers, whose floats follow Settings::precision. Textures, frames, tables of E and sums over lights are highp always.
constexpr std::array<std::string_view, 13> shading_files{"base.glsl",
                                                         "base_physical.glsl",
                                                         "clearcoat.glsl",
                                                         "fresnel.glsl",
                                                         "sheen.glsl",
                                                         "sheen_coefficients.glsl",
                                                         "sheen_distribution.glsl",
                                                         "sheen_draft_2019.glsl",
                                                         "sheen_lambda.glsl",
                                                         "sheen_visibility_ashikhmin.glsl",
                                                         "sheen_visibility_charlie.glsl",
                                                         "sheen_visibility_refined.glsl",
                                                         "specular_ggx.glsl"};

}  // namespace

std::vector<std::string> shading_limits(Precision precision) {
  const bool mediump = precision == Precision::Mediump;
  std::array<char, 32> floor{};
  std::snprintf(floor.data(), floor.size(), "%.9e", albedo::min_n_dot_v);
  return {std::string("MIN_N_DOT_V=") + floor.data(),
          // Near the largest and the smallest normal value of a half float, 65504 and 6.1e-5, or of a float; below the one far enough that
          // a rounded sum of shares of it does not pass it.
          mediump ? "LARGEST_SHADING_VALUE=60000.0" : "LARGEST_SHADING_VALUE=1.0e38",
          mediump ? "SMALLEST_SHADING_VALUE=6.2e-5" : "SMALLEST_SHADING_VALUE=1.0e-37"};
}

const char* formulation_define(Formulation formulation) {
  return formulation == Formulation::Literal ? "FORMULATION_LITERAL" : "FORMULATION_STABLE";
}

ShaderFile shader_file(const std::string& name) {
  return {name, std::find(shading_files.begin(), shading_files.end(), name) != shading_files.end()};
}

std::vector<std::string> sheen_visibility_files(albedo::Visibility visibility) {
  const std::string own = "sheen_visibility_" + std::string(visibility_name(visibility)) + ".glsl";
  if (visibility == albedo::Visibility::Ashikhmin) {
    return {own};
  }
  return {"sheen_coefficients.glsl", own, "sheen_lambda.glsl"};
}

}  // namespace sheen::renderer
