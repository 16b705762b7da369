#include "image/flip_filters.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <numbers>
#include <vector>

namespace sheen::image {
namespace {

/// A contrast sensitivity function in the spatial domain is a sum of Gaussians a sqrt(pi/b) exp(-pi^2 d^2 / b), d in degrees.
struct Gaussian {
  double a, b;
};

// Andersson et al. 2020, table 1. The second Gaussian of the first two rows has weight 0.
constexpr Gaussian achromatic_csf[] = {{1.0, 0.0047}};
constexpr Gaussian red_green_csf[] = {{1.0, 0.0053}};
constexpr Gaussian blue_yellow_csf[] = {{34.1, 0.04}, {13.5, 0.025}};
/// The largest b of the table: three standard deviations of it are every filter's radius.
constexpr double widest_b = 0.04;
/// Peak-to-trough width in degrees of the human edge detector: Andersson et al. 2020, section 4.2, w = 0.082; two standard deviations.
constexpr double feature_width = 0.082;

constexpr double pi = std::numbers::pi;

Kernel to_floats(const std::vector<double>& weights) {
  return {weights.begin(), weights.end()};
}

template <std::size_t N>
SeparableGaussians spatial_filter(const Gaussian (&csf)[N], int radius, double pixels_per_degree) {
  SeparableGaussians filter;
  std::vector<double> amplitudes;
  double total = 0;
  for (const Gaussian& gaussian : csf) {
    std::vector<double> kernel;
    double sum = 0;
    for (int x = -radius; x <= radius; ++x) {
      const double degrees = x / pixels_per_degree;
      kernel.push_back(std::exp(-pi * pi * degrees * degrees / gaussian.b));
      sum += kernel.back();
    }
    for (double& weight : kernel) {
      weight /= sum;
    }
    // The two-dimensional filter is normalised as a whole, so a Gaussian counts by the sum of its weights in two dimensions.
    amplitudes.push_back(gaussian.a * std::sqrt(pi / gaussian.b) * sum * sum);
    total += amplitudes.back();
    filter.kernels.push_back(to_floats(kernel));
  }
  for (const double amplitude : amplitudes) {
    filter.weights.push_back(static_cast<float>(amplitude / total));
  }
  return filter;
}

/// Positive weights scaled to a sum of 1, negative ones to -1: Andersson et al. 2020, section 4.2.
Kernel balanced(std::vector<double> kernel) {
  double positive = 0, negative = 0;
  for (const double weight : kernel) {
    (weight > 0 ? positive : negative) += std::abs(weight);
  }
  for (double& weight : kernel) {
    if (weight != 0) {
      weight /= weight > 0 ? positive : negative;
    }
  }
  return to_floats(kernel);
}

}  // namespace

Plane correlate_rows(const Plane& in, const Kernel& kernel) {
  const int taps = static_cast<int>(kernel.size());
  Plane out(in.width - taps + 1, in.height);
  for (int y = 0; y < out.height; ++y) {
    float* target = out.row(y);
    for (int k = 0; k < taps; ++k) {
      const float* source = in.row(y) + k;
      const float weight = kernel[static_cast<std::size_t>(k)];
      for (int x = 0; x < out.width; ++x) {
        target[x] += weight * source[x];
      }
    }
  }
  return out;
}

Plane correlate_columns(const Plane& in, const Kernel& kernel) {
  const int taps = static_cast<int>(kernel.size());
  Plane out(in.width, in.height - taps + 1);
  for (int y = 0; y < out.height; ++y) {
    float* target = out.row(y);
    for (int k = 0; k < taps; ++k) {
      const float* source = in.row(y + k);
      const float weight = kernel[static_cast<std::size_t>(k)];
      for (int x = 0; x < out.width; ++x) {
        target[x] += weight * source[x];
      }
    }
  }
  return out;
}

FlipFilters flip_filters(double pixels_per_degree) {
  FlipFilters filters;
  filters.spatial_radius = static_cast<int>(std::ceil(3 * std::sqrt(widest_b / (2 * pi * pi)) * pixels_per_degree));
  filters.achromatic = spatial_filter(achromatic_csf, filters.spatial_radius, pixels_per_degree);
  filters.red_green = spatial_filter(red_green_csf, filters.spatial_radius, pixels_per_degree);
  filters.blue_yellow = spatial_filter(blue_yellow_csf, filters.spatial_radius, pixels_per_degree);

  const double deviation = 0.5 * feature_width * pixels_per_degree;
  filters.feature_radius = static_cast<int>(std::ceil(3 * deviation));
  std::vector<double> blur, edge, point;
  double sum = 0;
  for (int x = -filters.feature_radius; x <= filters.feature_radius; ++x) {
    const double gaussian = std::exp(-x * x / (2 * deviation * deviation));
    blur.push_back(gaussian);
    sum += gaussian;
    edge.push_back(-x * gaussian);                                      // first derivative, up to a factor
    point.push_back((x * x / (deviation * deviation) - 1) * gaussian);  // second derivative, up to a factor
  }
  for (double& weight : blur) {
    weight /= sum;
  }
  filters.feature_blur = to_floats(blur);
  filters.feature_edge = balanced(edge);
  filters.feature_point = balanced(point);
  return filters;
}

}  // namespace sheen::image
