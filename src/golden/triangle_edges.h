#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>

#include "golden/geometry.h"
#include "golden/rays.h"

namespace sheen::golden {

/// A triangle's edge functions (Geometry::edge_volumes), affine in the place on the picture, about one place.
struct EdgeFunctions {
  glm::dvec3 here;              ///< proportional to the weights
  glm::dvec3 along_x, along_y;  ///< what they change a pixel
  double ahead;                 ///< has the sign that their sum has where a ray meets the plane before the camera

  /// So many pixels on: whether a ray meets the plane before the camera, and with which weights.
  struct Beside {
    bool is_met;
    glm::dvec3 weights;
  };
  Beside beside(double dx, double dy) const;
};

/// What of a triangle's edges is alike wherever on the picture it is asked for.
class TriangleEdges {
 public:
  TriangleEdges(const Geometry& geometry, const RayGenerator& rays, std::uint32_t triangle);

  /// Where a ray crosses the picture.
  EdgeFunctions at(const Geometry& geometry, const Ray& ray) const;

  /// The largest |a / depth| over the triangle beyond the near plane, of an attribute by its values at the vertices; in perspective, 1/m.
  double largest_share(const glm::dvec3& attribute) const;

 private:
  std::uint32_t triangle_;
  glm::dvec3 along_x_, along_y_;
  double ahead_;
  glm::dvec3 nearness_{0.0};  // 1 / depth of the vertices
  // Where the near plane cuts: weights of the corners of what lies beyond it, each over its own depth.
  bool is_cut_ = false;
  std::array<glm::dvec3, 6> corners_{};
  std::size_t corner_count_ = 0;

  void cut(const glm::dvec3& depth, double near);
};

}  // namespace sheen::golden
