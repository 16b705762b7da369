#pragma once

#include "golden/environment_light.h"
#include "golden/sampling_goal.h"
#include "golden/shade.h"

namespace sheen::golden {

/// A mean with its standard error, each a radiance.
struct Estimate {
  brdf::Rgb<double> mean{0, 0, 0}, standard_error{0, 0, 0};
};

/// Radiance toward the camera that an image sends by way of a surface, without emission: the integral itself, by directions drawn from the
/// image and from every lobe together (balance heuristic: Veach, "Robust Monte Carlo Methods", 1997, section 9.2), each a directional light
/// for the same shading as punctual lights get. Points are Sobol's, shifted at random in each of 32 replicas; what these differ by is the
/// standard error. Deterministic for a given seed.
Estimate shade_environment(const Surface<double>& surface, Layers layers, const Lighting& lighting, const EnvironmentLight& light,
                           const SamplingGoal& goal);

}  // namespace sheen::golden
