#pragma once

#include <array>
#include <vector>

#include "golden/geometry.h"
#include "golden/rays.h"
#include "golden/triangle_edges.h"

namespace sheen::golden {

/// What a shader may find in an interpolated variable while the sample is displaced by up to one step along each axis.
struct Varying {
  double value = 0;                 ///< at the sample itself, exactly interpolated
  double shift_x = 0, shift_y = 0;  ///< first-order change for a step along x and along y
  double radius = 0;                ///< all else: curvature over the step, the vertex shader's rounding, the rasteriser's; may be infinite
};

/// One triangle under one sample, ready to interpolate whatever stands at its vertices (OpenGL ES 3.0.6, section 3.6.1).
class Interpolation {
 public:
  /// @param edges  of the triangle; must outlive this
  /// @param hit    on the triangle's plane under `ray`; of a triangle that the step reaches beyond, any of it
  /// @param step   of the sample's displacement, pixels
  Interpolation(const Geometry& geometry, const RayGenerator& rays, const TriangleEdges& edges, const Hit& hit, const Ray& ray,
                double step);

  /// @param rounding  absolute error of the values, the largest of the three
  Varying operator()(const std::array<double, 3>& at_vertices, double rounding) const;

  /// Whether the triangle is so narrow here, a sliver or seen edge on at a silhouette, that the step reaches beyond all of it.
  bool is_edge_on() const { return !within_; }

  /// Of the triangle, about the sample.
  const EdgeFunctions& edge_functions() const { return functions_; }

 private:
  std::vector<glm::dvec3> shown_;  // unless within_: weights, which hold all that samples moved by the step may be given

  const TriangleEdges& edges_;
  glm::dvec3 weights_;
  EdgeFunctions functions_;
  glm::dvec3 volumes_x_, volumes_y_;  // what the edge functions, affine in the sample's place, change a step
  double sum_x_, sum_y_;
  double per_sum_;            // 1 over the sum of the volumes
  double bent_;               // of a first-order change, what the exact one may be off
  bool within_;               // whether the step is small beside the triangle and the horizon of its plane
  double depth_ = 0;          // in perspective alone
  double shares_;             // sum of the weights' magnitudes
  double steps_x_, steps_y_;  // the picture's size, in steps
};

}  // namespace sheen::golden
