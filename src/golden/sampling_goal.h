#pragma once

#include <cstdint>

namespace sheen::golden {

/// When to stop drawing directions for a surface point.
struct SamplingGoal {
  double error = 0.01;               ///< relative standard error of the largest channel that is enough
  std::uint32_t samples = 1u << 20;  ///< directions at most
  std::uint64_t seed = 0;
};

}  // namespace sheen::golden
