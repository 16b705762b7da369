#pragma once

#include <cstdint>

namespace sheen::golden {

/// When to stop drawing directions toward an image that lights.
struct SamplingGoal {
  double error = 0.01;               ///< relative, that standard error and largest direction of 99 % of the covered pixels are to meet
  std::uint32_t samples = 1u << 20;  ///< directions at most, for each surface that a pixel shows; at least least_samples
  std::uint64_t seed = 0;
};

/// Of what is known by chance alone, in the bound: a normal deviate passes five once in 1.7 million.
inline constexpr double standard_errors = 5.0;

/// As seldom all directions miss a light of which they are expected to meet so many: ln(1.74e6).
inline constexpr double missed_directions = 14.37;

/// Fewer directions than this give no standard error.
inline constexpr std::uint32_t least_samples = 512;

}  // namespace sheen::golden
