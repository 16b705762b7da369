#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include <glm/vec3.hpp>

#include "golden/geometry.h"
#include "golden/rays.h"
#include "golden/triangle_edges.h"

namespace sheen::golden {

/// What all pixels that show a triangle share of it: what a vertex shader gives at its vertices, in view space, and its edges.
struct TriangleInView {
  TriangleInView(const Geometry& geometry, const RayGenerator& rays, std::uint32_t triangle_in);

  /// A vector at each vertex, and the roundings of the matrix product that gave it: absolute, the largest of the three.
  struct Vectors {
    std::array<glm::dvec3, 3> at;
    glm::dvec3 rounding;

    std::array<double, 3> axis(int k) const { return {at[0][k], at[1][k], at[2][k]}; }
  };

  std::uint32_t triangle;
  TriangleEdges edges;
  Vectors position;                ///< metres
  std::optional<Vectors> normal;   ///< of lengths near 1 for normals of length 1; none where the primitive has none
  std::optional<Vectors> tangent;  ///< none where the primitive has none or all three are zero, without direction
};

/// Keeps the triangles that were asked for last.
class TrianglesInView {
 public:
  /// The arguments must outlive this.
  TrianglesInView(const Geometry& geometry, const RayGenerator& rays) : geometry_(geometry), rays_(rays) {}

  /// Good until the next is asked for.
  const TriangleInView& at(std::uint32_t triangle);

 private:
  const Geometry& geometry_;
  const RayGenerator& rays_;
  std::array<std::optional<TriangleInView>, 16> kept_;
};

}  // namespace sheen::golden
