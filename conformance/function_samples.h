#pragma once

#include <string>
#include <vector>

#include "conformance/function_case.h"
#include "conformance/function_spec.h"
#include "conformance/verdict.h"
#include "image/image.h"

namespace sheen::conformance {

/// The samples of a function's case, before anything is measured.
struct FunctionSamples {
  FunctionSpec spec;
  bool must_be_finite = false;                 ///< see FunctionSpec::is_finite
  std::vector<std::vector<double>> values;     ///< of the parameters, sample by sample, row by row
  std::vector<std::vector<double>> arguments;  ///< numbers of the format
  std::vector<std::vector<Promise>> promises;  ///< channel by channel
};

/// Chooses the samples of a case and computes what is promised of each, on all threads.
FunctionSamples make_samples(const FunctionCase& one);

/// The arguments as renderer::FunctionEvaluator takes them.
image::Image argument_picture(const FunctionSamples& samples, int width, int height);

/// One sample held to its promise: of its channels the one that is furthest out.
struct SampleError {
  bool nan = false, infinite = false;  ///< what any channel gave
  bool compared = false;               ///< whether anything is promised
  double ratio = 0;                    ///< error over bound: at most 1 is inside; infinite where NaN or Inf stands for a promised value
  double value = 0;                    ///< the channel's value in exact arithmetic
  double measured = 0;
  double error = 0;      ///< |measured - value|
  double bound = 0;      ///< what is allowed on the side where it fell
  double off_model = 0;  ///< largest |measured - model| / max(|model|, 1e-3) of finite channels whose model has a value
};

/// Holds what a viewer gave to the promises, sample by sample. The ends of a range that is no number of the format are rounded outward to
/// one: an implementation cannot give what lies between, and the Khronos conformance tests let the outer one pass (tcu::FloatFormat,
/// convert).
std::vector<SampleError> hold_to_promises(const FunctionSamples& samples, const image::Image& measured);

/// The verdict on a case: passes if and only if every sample of which something is promised is inside its bound, at least one is compared,
/// and none is NaN or Inf where all must be finite. Samples of which nothing is promised are excluded, and count among the not finite where
/// they are NaN or Inf.
Verdict judge_samples(const FunctionSamples& samples, const std::vector<SampleError>& errors, int width);

/// "sheen_roughness 0.5, theta_h 0.3".
std::string describe_sample(const FunctionSamples& samples, std::size_t index);

/// Error and bound in units of a plot: ulp of the exact value for an operation, else relative to max(|value|, 1e-3).
double in_plot_units(const FunctionSpec& spec, double value, double difference);

}  // namespace sheen::conformance
