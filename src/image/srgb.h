#pragma once

#include <algorithm>
#include <cmath>

namespace sheen::image {

/// Linear value in [0, 1] of an sRGB signal in [0, 1]: IEC 61966-2-1, section 5.2.
inline double srgb_to_linear(double signal) {
  return signal <= 0.04045 ? signal / 12.92 : std::pow((signal + 0.055) / 1.055, 2.4);
}

/// The sRGB signal in [0, 1] of a linear value, clipped to [0, 1]: IEC 61966-2-1, section 5.3.
inline double linear_to_srgb(double linear) {
  const double x = std::clamp(linear, 0.0, 1.0);
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
}

}  // namespace sheen::image
