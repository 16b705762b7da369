#include "scene/environment.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

namespace sheen::scene {

namespace {

constexpr double pi = 3.14159265358979323846;

}  // namespace

glm::dvec2 Environment::coordinates(const glm::dvec3& direction) const {
  // L(d) = image(R_y(-rotation) d), and R_y(a) turns +Z toward +X: atan2(z, x) grows by the rotation.
  const double u = 0.5 + (std::atan2(direction.z, direction.x) + rotation) / (2.0 * pi);
  return {u - std::floor(u), std::acos(std::clamp(direction.y, -1.0, 1.0)) / pi};
}

glm::dvec3 Environment::direction(const glm::dvec2& coordinates) const {
  const double azimuth = 2.0 * pi * (coordinates.x - 0.5) - rotation;
  const double theta = pi * coordinates.y;
  return {std::sin(theta) * std::cos(azimuth), std::cos(theta), std::sin(theta) * std::sin(azimuth)};
}

glm::dvec3 Environment::radiance(const glm::dvec3& direction) const {
  if (!is_image()) {
    return uniform;
  }
  const glm::dvec2 uv = coordinates(direction);
  const double x = uv.x * width - 0.5;
  const double y = uv.y * height - 0.5;
  const double column = std::floor(x);
  const double row = std::floor(y);
  const auto texel = [&](int dx, int dy) {
    const int i = (static_cast<int>(column) + dx + width) % width;
    const int j = std::clamp(static_cast<int>(row) + dy, 0, height - 1);
    return glm::dvec3(texels[static_cast<std::size_t>(j) * static_cast<std::size_t>(width) + static_cast<std::size_t>(i)]);
  };
  return glm::mix(glm::mix(texel(0, 0), texel(1, 0), x - column), glm::mix(texel(0, 1), texel(1, 1), x - column), y - row);
}

}  // namespace sheen::scene
