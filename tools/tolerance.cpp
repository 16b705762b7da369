#include "tools/tolerance.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sheen::tools {
namespace {

bool covered(const image::Image& picture, int x, int y) {
  const int alpha = picture.channel("A");
  // A coverage that is not a number is something to see, not to skip.
  return alpha < 0 || !(picture.at(x, y, alpha) <= 0.0f);
}

}  // namespace

std::int64_t values_outside(const image::Image& candidate, const image::Image& reference, const Tolerance& tolerance) {
  std::int64_t outside = 0;
  for (const char* name : {"R", "G", "B", "A"}) {
    const int c = candidate.channel(name);
    const int r = reference.channel(name);
    if (c < 0 || r < 0) {
      continue;
    }
    for (int y = 0; y < reference.height; ++y) {
      for (int x = 0; x < reference.width; ++x) {
        if (!covered(candidate, x, y) && !covered(reference, x, y)) {
          continue;
        }
        const double value = candidate.at(x, y, c);
        const double truth = reference.at(x, y, r);
        const double allowed = std::max(tolerance.absolute, tolerance.relative * std::abs(truth));
        if (!std::isfinite(value) || !std::isfinite(truth) || std::abs(value - truth) > allowed) {
          ++outside;
        }
      }
    }
  }
  return outside;
}

}  // namespace sheen::tools
