#include "conformance/code_rounding.h"

#include <algorithm>
#include <cmath>

#include "image/srgb.h"

namespace sheen::conformance {
namespace {

/// How far a linear value may lie from that of the nearest of 256 sRGB codes.
double half_code(double linear) {
  const double code = std::round(255.0 * image::linear_to_srgb(linear));
  const double here = image::srgb_to_linear(code / 255.0);
  const double below = here - image::srgb_to_linear(std::max(code - 0.5, 0.0) / 255.0);
  const double above = image::srgb_to_linear(std::min(code + 0.5, 255.0) / 255.0) - here;
  return std::max(below, above);
}

}  // namespace

double color_rounding(double value, double alpha) {
  if (alpha <= 0) {
    return 0;
  }
  const double straight = value / alpha;
  return half_code(straight) * alpha + (alpha < 1 ? straight * alpha_rounding : 0.0);
}

}  // namespace sheen::conformance
