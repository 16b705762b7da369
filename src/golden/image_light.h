#pragma once

#include <cstddef>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "golden/image_lookup.h"

namespace sheen::golden {

/// A direction drawn from an image, what arrives from there, and how densely such are drawn, 1/sr. Eight doubles: a cache line.
struct alignas(64) LightPoint {
  double x, y, z;
  double r, g, b;
  double density;
};

/// An equirect that lights, with its directions drawn exactly in proportion to what scene::Environment::radiance() makes of it. Bilinear
/// filtering is a sum of tents, one a texel, each weighted by its texel; so a texel is drawn by its weight, then a point under its tent.
/// The weight is R + G + B times the sine of the row's angle from the pole, so density over solid angle follows R + G + B to within the
/// difference of the sine and its chords.
class ImageLight {
 public:
  /// @param texels    rows from the top, radiance >= 0
  /// @param rotation  as of scene::Environment
  ImageLight(int width, int height, const std::vector<glm::vec3>& texels, double rotation);

  /// For (u, v) in [0, 1)^2.
  LightPoint sample(double u, double v) const;
  /// What sample() draws from, for any direction; valid while this lives.
  const ImageTexels& texels() const { return lookup_; }
  bool dark() const { return !(total_ > 0.0); }

  ImageLight(ImageLight&&) noexcept = default;
  ImageLight& operator=(ImageLight&&) noexcept = default;
  ImageLight(const ImageLight&) = delete;
  ImageLight& operator=(const ImageLight&) = delete;
  ~ImageLight() = default;

 private:
  std::vector<float> rgbw_;         // w: weight over the sum of all, over 2 pi^2 a texel: density times the sine of the angle from the pole
  std::vector<double> row_cdf_;     // height + 1
  std::vector<double> column_cdf_;  // height rows of width + 1, each normalised
  double total_ = 0.0;
  ImageTexels lookup_;
};

}  // namespace sheen::golden
