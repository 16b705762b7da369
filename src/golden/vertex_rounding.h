#pragma once

#include <array>
#include <cstdint>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "golden/geometry.h"
#include "golden/rays.h"

namespace sheen::golden {

/// Roundings of a vertex shader that multiplies a matrix of floats by a vector, in units of highp's epsilon and relative to the sum of the
/// products' magnitudes: 1 for the matrix's own digits, 1 for the product, 2 for two sums; a fourth column's product is by 1.
inline constexpr double transform_roundings = 4;

/// For each vertex of a triangle and each axis of view space, the sum of the products' magnitudes |M_ij| |p_j| and |M_i3|, metres: what the
/// roundings of the vertex's place are relative to. It may be far more than the place itself.
std::array<glm::dvec3, 3> position_magnitudes(const Geometry& geometry, const RayGenerator& rays, std::uint32_t triangle);

/// What the roundings of a triangle's vertices displace. Clip coordinates err by transform_roundings of the magnitudes, and a point of the
/// triangle by the same mean of them as it is of the vertices; the quotient by w and the viewport's scale and offset err by 2.5 + 2 of each
/// vertex's place in the window.
class VertexRounding {
 public:
  VertexRounding(const Geometry& geometry, const RayGenerator& rays, std::uint32_t triangle);

  /// How far along either axis a sample at a hit of it may be displaced, in pixels.
  double in_window(const RayGenerator& rays, const Hit& hit) const;

 private:
  std::array<glm::dvec2, 3> of_vertices_;  // in pixels times depth
};

}  // namespace sheen::golden
