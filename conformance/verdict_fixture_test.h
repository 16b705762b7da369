#pragma once

#include <limits>

#include <gtest/gtest.h>

#include "conformance/verdict.h"

namespace sheen::conformance {

inline constexpr int width = 20;
inline constexpr int height = 10;
inline constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();
inline constexpr float infinite_value = std::numeric_limits<float>::infinity();

/// A golden that covers the left half with a smooth colour and a bound of one part in a thousand; 100 covered pixels.
inline image::Image make_golden() {
  image::Image golden(width, height, {"R", "G", "B", "A", "bound.R", "bound.G", "bound.B", "excluded", "bound.A"});
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const bool covered = x < width / 2;
      for (int c = 0; c < 3; ++c) {
        const float value = covered ? 0.1F * static_cast<float>(c + 1) + 0.01F * static_cast<float>(x) : 0.0F;
        golden.at(x, y, c) = value;
        golden.at(x, y, 4 + c) = 1e-3F * value + 2e-5F;
      }
      golden.at(x, y, 3) = covered ? 1.0F : 0.0F;
    }
  }
  return golden;
}

inline image::Image rgba_of(const image::Image& golden) {
  image::Image candidate(golden.width, golden.height, {"R", "G", "B", "A"});
  for (int y = 0; y < golden.height; ++y) {
    for (int x = 0; x < golden.width; ++x) {
      for (int c = 0; c < 4; ++c) {
        candidate.at(x, y, c) = golden.at(x, y, c);
      }
    }
  }
  return candidate;
}

class VerdictTest : public testing::Test {
 protected:
  image::Image golden_ = make_golden();
  image::Image candidate_ = rgba_of(golden_);
  VerdictRules rules_;

  Verdict verdict() const { return judge(candidate_, golden_, rules_); }
};

}  // namespace sheen::conformance
