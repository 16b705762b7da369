#include "image/flip_exposures.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace sheen::image {
namespace {

// y = (k0 x^2 + k1 x) / (k3 x^2 + k4 x + k5): Narkowicz 2016, with x replaced by 0.6 x.
constexpr double pre_exposure = 0.6;
constexpr double k0 = pre_exposure * pre_exposure * 2.51;
constexpr double k1 = pre_exposure * 0.03;
constexpr double k3 = pre_exposure * pre_exposure * 2.43;
constexpr double k4 = pre_exposure * 0.59;
constexpr double k5 = 0.14;

/// The tone mapped value at which the darkest and brightest exposure aim: Andersson et al. 2021, section 3.2, t = 0.85.
constexpr double aimed_at = 0.85;

/// The x that the curve maps to `t`: the positive root of (k0 - t k3) x^2 + (k1 - t k4) x - t k5 = 0.
double inverse_tone_map(double t) {
  const double a = k0 - t * k3;
  const double half_b = 0.5 * (k1 - t * k4) / a;
  return -half_b + std::sqrt(half_b * half_b + t * k5 / a);
}

double median(std::vector<double>& values) {
  const std::size_t half = values.size() / 2;
  const auto upper = values.begin() + static_cast<std::ptrdiff_t>(half);
  std::nth_element(values.begin(), upper, values.end());
  if (values.size() % 2 == 1) {
    return *upper;
  }
  return 0.5 * (*upper + *std::max_element(values.begin(), upper));
}

}  // namespace

float aces_tone_map(float x) {
  // Past this both polynomials overflow a float and the curve is at its clip.
  constexpr float large = 1e18f;
  if (x > large) {
    return 1.0f;
  }
  const float y = (static_cast<float>(k0) * x + static_cast<float>(k1)) * x /
                  ((static_cast<float>(k3) * x + static_cast<float>(k4)) * x + static_cast<float>(k5));
  return std::min(y, 1.0f);
}

Exposures hdr_exposures(const LinearRgb& reference, const std::vector<std::uint8_t>& mask) {
  std::vector<double> luminances;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (mask[i] == 0) {
      continue;
    }
    const auto channel = [&](std::size_t c) { return std::max(static_cast<double>(reference.values[3 * i + c]), 0.0); };
    luminances.push_back(0.2126 * channel(0) + 0.7152 * channel(1) + 0.0722 * channel(2));  // ITU-R BT.709-6, item 3.2
  }
  const double brightest = luminances.empty() ? 0.0 : *std::max_element(luminances.begin(), luminances.end());
  if (!(brightest > 0)) {
    return {};
  }
  double middle = median(luminances);
  if (!(middle > 0)) {
    std::erase_if(luminances, [](double luminance) { return !(luminance > 0); });
    middle = median(luminances);
  }
  Exposures exposures;
  exposures.start = std::log2(inverse_tone_map(aimed_at) / brightest);
  exposures.stop = std::log2(inverse_tone_map(aimed_at) / middle);
  exposures.count = static_cast<int>(std::max(2.0, std::ceil(exposures.stop - exposures.start)));
  return exposures;
}

}  // namespace sheen::image
