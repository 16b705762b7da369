#include "image/metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "image/compared.h"
#include "image/flip.h"
#include "image/flip_exposures.h"

namespace sheen::image {
namespace {

struct Summary {
  double max = 0, mean = 0, p99 = 0;
};

/// Nearest-rank 99th percentile: Hyndman and Fan 1996, definition 1. Reorders `values`.
Summary summarise(std::vector<double>& values) {
  if (values.empty()) {
    return {};
  }
  double sum = 0;
  for (const double value : values) {
    sum += value;
  }
  const std::size_t rank = (values.size() * 99 + 99) / 100;  // ceil(0.99 n) without rounding
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(rank - 1);
  std::nth_element(values.begin(), nth, values.end());
  return {*std::max_element(nth, values.end()), sum / static_cast<double>(values.size()), *nth};
}

/// R, G, B (a missing one is 0), everything that is not finite as 0.
LinearRgb finite_rgb(const Image& image) {
  const std::array<int, 3> channels = {image.channel("R"), image.channel("G"), image.channel("B")};
  LinearRgb rgb{image.width, image.height, {}};
  rgb.values.reserve(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 3);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      for (const int c : channels) {
        const float value = c < 0 ? 0.0f : image.at(x, y, c);
        rgb.values.push_back(std::isfinite(value) ? value : 0.0f);
      }
    }
  }
  return rgb;
}

bool displayable(const LinearRgb& rgb) {
  return std::all_of(rgb.values.begin(), rgb.values.end(), [](float value) { return value >= 0 && value <= 1; });
}

/// Mean of the FLIP map over the compared pixels; `mask` holds 1 for them.
double mean_flip(const Image& candidate, const Image& reference, const std::vector<std::uint8_t>& mask, std::int64_t count) {
  const LinearRgb test = finite_rgb(candidate);
  const LinearRgb truth = finite_rgb(reference);
  const bool ldr = displayable(test) && displayable(truth);
  const std::vector<float> map = ldr ? ldr_flip(truth, test) : hdr_flip(truth, test, hdr_exposures(truth, mask));
  double sum = 0;
  for (std::size_t i = 0; i < map.size(); ++i) {
    sum += mask[i] != 0 ? static_cast<double>(map[i]) : 0.0;
  }
  return sum / static_cast<double>(count);
}

}  // namespace

Comparison compare(const Image& candidate, const Image& reference, Flip flip) {
  const Compared compared(candidate, reference);
  Comparison result;
  std::vector<std::uint8_t> mask(static_cast<std::size_t>(reference.width) * static_cast<std::size_t>(reference.height), 0);
  std::vector<double> absolute;
  std::vector<double> relative;
  double squares = 0;
  double worst = -1;
  for (int y = 0; y < reference.height; ++y) {
    for (int x = 0; x < reference.width; ++x) {
      const Standing standing = compared.standing(x, y);
      if (standing == Standing::Nonfinite) {
        ++result.nonfinite_pixels;
      }
      if (standing != Standing::Compared) {
        continue;
      }
      ++result.compared_pixels;
      mask[static_cast<std::size_t>(y) * static_cast<std::size_t>(reference.width) + static_cast<std::size_t>(x)] = 1;
      for (const auto& channel : compared.channels()) {
        const double error = compared.error(x, y, channel);
        const double ratio = compared.relative_error(x, y, channel);
        squares += error * error;
        absolute.push_back(error);
        relative.push_back(ratio);
        if (ratio > worst) {
          worst = ratio;
          result.worst_x = x;
          result.worst_y = y;
        }
      }
    }
  }
  const double mse = absolute.empty() ? 0.0 : squares / static_cast<double>(absolute.size());
  result.psnr = mse > 0 ? -10.0 * std::log10(mse) : std::numeric_limits<double>::infinity();
  const Summary a = summarise(absolute);
  const Summary r = summarise(relative);
  result.max_abs = a.max;
  result.mean_abs = a.mean;
  result.p99_abs = a.p99;
  result.max_rel = r.max;
  result.mean_rel = r.mean;
  result.p99_rel = r.p99;
  if (flip == Flip::Compute && result.compared_pixels > 0) {
    result.flip = mean_flip(candidate, reference, mask, result.compared_pixels);
  }
  return result;
}

}  // namespace sheen::image
