#pragma once

#include <cstddef>
#include <vector>

namespace sheen::image {

/// A rectangle of floats, rows from the top.
struct Plane {
  int width = 0;
  int height = 0;
  std::vector<float> values;

  Plane() = default;
  Plane(int width_, int height_)
      : width(width_), height(height_), values(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)) {}
  float* row(int y) { return values.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width); }
  const float* row(int y) const { return values.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width); }
};

/// A one-dimensional filter of 2 radius + 1 weights.
using Kernel = std::vector<float>;

/// Correlation along one axis; the result is smaller by the kernel's two radii along it, as no border is made up.
Plane correlate_rows(const Plane& in, const Kernel& kernel);
Plane correlate_columns(const Plane& in, const Kernel& kernel);

/// A two-dimensional filter as a sum of Gaussians, each the product of a row and a column filter.
struct SeparableGaussians {
  std::vector<Kernel> kernels;  ///< each normalised
  std::vector<float> weights;   ///< of each Gaussian in the two-dimensional sum; 1 together
};

/// The filters of FLIP for an observer; every constant is cited at its definition.
struct FlipFilters {
  int spatial_radius = 0;
  SeparableGaussians achromatic, red_green, blue_yellow;
  int feature_radius = 0;
  Kernel feature_blur, feature_edge, feature_point;
  /// What a pixel's value may depend on.
  int reach() const { return spatial_radius > feature_radius ? spatial_radius : feature_radius; }
};

/// Contrast sensitivity filters (Andersson et al. 2020, section 4.1.1, equations 1 to 3 and table 1) and feature detectors (section 4.2,
/// equation 6 and the text after it). @param pixels_per_degree  over 0
FlipFilters flip_filters(double pixels_per_degree);

}  // namespace sheen::image
