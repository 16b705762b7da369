#include "renderer/lights.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

namespace sheen::renderer {
namespace {

float type_code(scene::LightType type) {
  switch (type) {
    case scene::LightType::Directional:
      return 0.0f;
    case scene::LightType::Point:
      return 1.0f;
    case scene::LightType::Spot:
      return 2.0f;
  }
  return 0.0f;
}

}  // namespace

std::vector<glm::vec4> pack_lights(const std::vector<scene::Light>& lights, const glm::dmat4& view_from_world) {
  std::vector<glm::vec4> vectors;
  vectors.reserve(lights.size() * 4);
  for (const scene::Light& light : lights) {
    const glm::dvec3 axis = glm::normalize(glm::dmat3(view_from_world) * light.direction);
    const glm::dvec3 position(view_from_world * glm::dvec4(light.position, 1.0));
    const double inverse_range = std::isinf(light.range) ? 0.0 : 1.0 / light.range;
    const double cone_scale = 1.0 / std::max(0.001, std::cos(light.inner_cone) - std::cos(light.outer_cone));
    vectors.emplace_back(glm::vec3(light.color * light.intensity), type_code(light.type));
    vectors.emplace_back(glm::vec3(light.type == scene::LightType::Directional ? -axis : position), static_cast<float>(inverse_range));
    vectors.emplace_back(glm::vec3(axis), static_cast<float>(cone_scale));
    vectors.emplace_back(static_cast<float>(std::cos(light.outer_cone)), 0.0f, 0.0f, 0.0f);
  }
  return vectors;
}

}  // namespace sheen::renderer
