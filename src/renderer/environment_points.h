#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec4.hpp>

#include "scene/environment.h"

namespace sheen::renderer {

/// What the shader needs to draw directions from an image: in proportion to its radiance, R + G + B, but for what the sine of the polar
/// angle changes between two rows. Bilinear filtering is a sum of tents, one a texel; a texel is drawn, then a place under its tent.
class ImageSampling {
 public:
  /// The argument must have an image and outlive this.
  explicit ImageSampling(const scene::Environment& environment);

  /// For each texel what, bilinear between them as radiance is, times 1 / sin(theta) is the density of directions, 1/sr; rows from the top.
  const std::vector<float>& densities() const { return densities_; }
  struct Drawn {
    glm::dvec3 direction;
    double density;  ///< 1/sr
  };
  /// What (u, v) in [0, 1)^2 draws, in the image's own frame: without the environment's rotation. The image is halved along its longer side
  /// again and again, so that points spread evenly over the square are spread evenly over the light. Source: Clarberg et al. 2005, "Wavelet
  /// Importance Sampling: Efficiently Evaluating Products of Complex Functions" (sample warping).
  Drawn draw(double u, double v) const;

 private:
  /// Without the sine, at a place in texels.
  double density_at(double x, double y) const;
  /// What the texels of columns [left, right) in rows [top, bottom) weigh, up to a factor.
  double weight(int left, int top, int right, int bottom) const;

  int width_, height_;
  std::vector<double> sums_;  // of the weights of all texels left of column x
                              // and above row y, by rows of width + 1: Crow 1984
  std::vector<float> densities_;
};

/// The first points of Halton's sequence in bases 2 and 3, moved around the unit square by what each seed but 0 makes as if at random
/// (Cranley and Patterson 1976), as rows of the shader's texture of points: `columns` texels wide, a row of points (x, y) as (x, cos 2 pi
/// y, sin 2 pi y, 0), for GLSL ES promises nothing of its own sine, followed by one of the image's directions for them (x, y, z, density),
/// or of zeros without an image. x lies within (0, 1). Source: Halton 1960.
struct PointRows {
  int columns = 0, rows = 0;
  std::vector<glm::vec4> texels;
};
PointRows point_rows(int count, std::uint64_t seed, const ImageSampling* image);

}  // namespace sheen::renderer
