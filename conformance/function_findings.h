#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "conformance/function_case.h"
#include "conformance/function_samples.h"

namespace sheen::conformance {

/// What a function's case found, as the report tells it.
struct FunctionFindings {
  FunctionCase tested;
  std::string plots;  ///< an SVG: error and bound against each parameter
  std::string legend;
  std::int64_t nan_samples = 0;
  std::int64_t infinite_samples = 0;
  double largest_error = 0;  ///< of finite samples against the model's value, relative to max(|value|, 1e-3)
  std::string largest_at;    ///< the sample of largest_error
  /// Of dense arguments: that error over the first parameter (to the right) and the second (upward), as a PNG.
  std::vector<std::uint8_t> map;
  std::string map_axes;  ///< "theta_h over sheen_roughness"
};

FunctionFindings find(const FunctionCase& one, const FunctionSamples& samples, const std::vector<SampleError>& errors);

}  // namespace sheen::conformance
