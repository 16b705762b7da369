#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec4.hpp>

#include "scene/environment.h"

namespace sheen::renderer {

/// What the shader needs to draw directions from an image: in proportion to the radiance of its texels and their neighbours, times the
/// sine of their polar angle.
class ImageSampling {
 public:
  /// The argument must have an image and outlive this.
  explicit ImageSampling(const scene::Environment& environment);

  /// For each texel, what times 1 / sin(theta) is the density of directions there, 1/sr; rows from the top.
  const std::vector<float>& densities() const { return densities_; }
  /// The direction for (u, v) in [0, 1)^2, in the image's own frame: without the environment's rotation. The image is halved along its
  /// longer side again and again, so that points spread evenly over the square are spread evenly over the light. Source: Clarberg et al.
  /// 2005, "Wavelet Importance Sampling: Efficiently Evaluating Products of Complex Functions" (sample warping).
  glm::dvec3 direction(double u, double v) const;

 private:
  /// What the texels of columns [left, right) in rows [top, bottom) weigh, up to a factor.
  double weight(int left, int top, int right, int bottom) const;

  int width_, height_;
  std::vector<double> sums_;  // of the weights of all texels left of column x and above row y, by rows of width + 1: Crow 1984
  std::vector<float> densities_;
};

/// The first points of Halton's sequence in bases 2 and 3, moved around the unit square by the seed, as rows of the shader's texture of
/// points: `columns` texels wide, a row of points (x, y, 0, 0) followed by one of the image's directions for them (x, y, z, 0), or of
/// zeros without an image. Source: Halton 1960.
struct PointRows {
  int columns = 0, rows = 0;
  std::vector<glm::vec4> texels;
};
PointRows point_rows(int count, std::uint64_t seed, const ImageSampling* image);

}  // namespace sheen::renderer
