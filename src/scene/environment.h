#pragma once

#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace sheen::scene {

/// Light from everywhere, in the radiance of the picture it makes (linear RGB, W/(m^2 sr) or cd/m^2: whatever the lights' unit implies).
struct Environment {
  glm::dvec3 uniform{0.0};        ///< from every direction, where there is no image
  int width = 0, height = 0;      ///< texels of the image; 0: none
  std::vector<glm::vec3> texels;  ///< equirect, rows from the top: u = 0.5 + atan2(z, x) / (2 pi), v = acos(y) / pi
  double rotation = 0.0;          ///< radians, turns the environment counter-clockwise about +Y
  bool background = false;        ///< whether pixels that show no surface show it

  bool is_image() const { return width > 0; }
  /// Where in the image a unit direction is found: u in [0, 1), v in [0, 1], the rotation undone.
  glm::dvec2 coordinates(const glm::dvec3& direction) const;
  /// The unit direction found at (u, v): the inverse of coordinates().
  glm::dvec3 direction(const glm::dvec2& coordinates) const;
  /// What arrives from a unit direction: bilinear between texel centres, around the seam in u, the edge's own row beyond the first and
  /// last.
  glm::dvec3 radiance(const glm::dvec3& direction) const;
};

/// 32 hex digits that depend on the light alone: not on where it is turned, nor on whether it is shown.
std::string content_hash(const Environment& environment);

}  // namespace sheen::scene
