#pragma once

#include <algorithm>
#include <cstdint>

#include "golden/environment_shade.h"
#include "golden/sampling_goal.h"

namespace sheen::golden::test {

/// An estimate refined until of each channel standard error and largest direction meet the goal, relative to the mean, or the directions
/// pass it.
inline Estimate refined_estimate(const Surface<double>& surface, Layers layers, const ImageLighting& lighting, const SamplingGoal& goal,
                                 std::uint64_t stream) {
  using Color = brdf::Rgb<double>;
  EnvironmentEstimate estimate(surface, layers, lighting, stream);
  CurveCache curves;
  while (estimate.refine(surface, curves, goal.samples)) {
    const Estimate now = estimate.value();
    const auto met = [&](double Color::*channel) {
      return std::max(now.standard_error.*channel, now.largest.*channel) <= goal.error * now.mean.*channel;
    };
    if (met(&Color::r) && met(&Color::g) && met(&Color::b)) {
      break;
    }
  }
  return estimate.value();
}

}  // namespace sheen::golden::test
