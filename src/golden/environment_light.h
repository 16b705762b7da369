#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "scene/environment.h"

namespace sheen::golden {

/// An image that lights: its directions drawn in proportion to what they send, to within the filter between texels.
class EnvironmentLight {
 public:
  /// The argument must outlive this and have an image.
  explicit EnvironmentLight(const scene::Environment& environment);

  glm::dvec3 radiance(const glm::dvec3& direction) const { return environment_.radiance(direction); }
  /// A unit direction for (u, v) in [0, 1)^2.
  glm::dvec3 sample(double u, double v) const;
  /// Density of sample() over solid angle, 1/sr; > 0 wherever radiance is.
  double pdf(const glm::dvec3& direction) const;

 private:
  const scene::Environment& environment_;
  std::vector<double> row_cdf_;     // height + 1
  std::vector<double> column_cdf_;  // height rows of width + 1, each normalised
};

}  // namespace sheen::golden
