#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "image/compared.h"
#include "image/io.h"
#include "image/metrics.h"
#include "image/srgb.h"

namespace sheen::image {
namespace {

/// The cubehelix map: sRGB signals for t in [0, 1], from black to white with evenly growing perceived brightness, in colour and in grey
/// print. Green 2011, "A colour scheme for the display of astronomical intensity images", Bull. Astr. Soc. India 39, equation 2 and its
/// default start 0.5, rotations -1.5, hue 1, gamma 1.
std::array<double, 3> cubehelix(double t) {
  constexpr double start = 0.5, rotations = -1.5, hue = 1.0;
  const double angle = 2 * std::numbers::pi * (start / 3 + 1 + rotations * t);
  const double amplitude = hue * t * (1 - t) / 2;
  const double c = std::cos(angle), s = std::sin(angle);
  return {t + amplitude * (-0.14861 * c + 1.78277 * s), t + amplitude * (-0.29227 * c - 0.90649 * s), t + amplitude * (1.97294 * c)};
}

}  // namespace

Image heatmap(const Image& candidate, const Image& reference, double full_scale) {
  if (!(full_scale > 0) || !std::isfinite(full_scale)) {
    throw Error("a heat map's full scale must be a finite number over 0");
  }
  const Compared compared(candidate, reference);
  Image map(reference.width, reference.height, {"R", "G", "B"});
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      std::array<double, 3> signal{};
      const Standing standing = compared.standing(x, y);
      if (standing == Standing::Nonfinite) {
        signal = {1, 0, 1};
      } else if (standing == Standing::Compared) {
        double worst = 0;
        for (const auto& channel : compared.channels()) {
          worst = std::max(worst, compared.relative_error(x, y, channel));
        }
        signal = cubehelix(std::min(worst / full_scale, 1.0));
      }
      for (std::size_t c = 0; c < 3; ++c) {
        map.at(x, y, static_cast<int>(c)) = static_cast<float>(srgb_to_linear(std::clamp(signal[c], 0.0, 1.0)));
      }
    }
  }
  return map;
}

}  // namespace sheen::image
