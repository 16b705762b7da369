#include "conformance/function_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <tbb/parallel_for.h>

#include "number/precision.h"

namespace sheen::conformance {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double smallest_scale = 1e-3;

std::string number(double value) {
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

/// The neighbouring number of the format on the side away from, or toward, minus infinity; subnormals among them.
double rounded_outward(double x, bool upward, const NumberFormat& format) {
  if (x == 0 || !std::isfinite(x)) {
    return x;
  }
  const double step = std::ldexp(1.0, std::max(std::ilogb(x), format.min_exponent) - format.fraction_bits);
  return (upward ? std::ceil(x / step) : std::floor(x / step)) * step;
}

double ulp(double x, const NumberFormat& format) {
  return format.fraction_bits == number::Highp::fraction_bits ? number::ulp<number::Highp>(x) : number::ulp<number::Mediump>(x);
}

void hold_channel(const Promise& promise, double measured, const NumberFormat& format, SampleError& worst) {
  worst.nan = worst.nan || std::isnan(measured);
  worst.infinite = worst.infinite || std::isinf(measured);
  if (std::isfinite(measured) && std::isfinite(promise.model)) {
    worst.off_model = std::max(worst.off_model, std::abs(measured - promise.model) / std::max(std::abs(promise.model), smallest_scale));
  }
  if (!promise.is_bounded()) {
    return;
  }
  const bool above = measured > promise.value;
  const double end = rounded_outward(above ? promise.range.upper : promise.range.lower, above, format);
  const double bound = std::abs(end - promise.value);
  const double error = std::abs(measured - promise.value);
  // A value below the smallest normal number that came out 0 was flushed, which is no error.
  const bool flushed = measured == 0 && std::abs(promise.value) < format.smallest_normal();
  const double ratio = !std::isfinite(error) ? infinity : error == 0 || flushed ? 0 : error / bound;
  if (!worst.compared || ratio > worst.ratio) {
    worst.ratio = ratio;
    worst.value = promise.value;
    worst.measured = measured;
    worst.error = error;
    worst.bound = bound;
  }
  worst.compared = true;
}

}  // namespace

FunctionSamples make_samples(const FunctionCase& one) {
  FunctionSamples samples{function_spec(one.function, one.precision), false, {}, {}, {}};
  const FunctionSpec& spec = samples.spec;
  samples.must_be_finite = spec.is_finite && one.formulation == renderer::Formulation::Stable;
  samples.values = choose_values(spec.parameters, one.arguments, one.width, one.height);
  samples.arguments.resize(samples.values.size());
  samples.promises.resize(samples.values.size());
  tbb::parallel_for(std::size_t{0}, samples.values.size(), [&](std::size_t i) {
    std::vector<double> arguments = spec.place(samples.values[i]);
    for (double& x : arguments) {
      x = spec.format.nearest(x);
    }
    samples.promises[i] = spec.promise(arguments, one.formulation);
    samples.arguments[i] = std::move(arguments);
  });
  return samples;
}

image::Image argument_picture(const FunctionSamples& samples, int width, int height) {
  const auto scalars = static_cast<int>(samples.arguments.front().size());
  image::Image picture(width, height * ((scalars + 3) / 4), {"R", "G", "B", "A"});
  for (std::size_t i = 0; i < samples.arguments.size(); ++i) {
    const int x = static_cast<int>(i) % width;
    const int y = static_cast<int>(i) / width;
    for (int k = 0; k < scalars; ++k) {
      picture.at(x, y + height * (k / 4), k % 4) = static_cast<float>(samples.arguments[i][static_cast<std::size_t>(k)]);
    }
  }
  return picture;
}

std::vector<SampleError> hold_to_promises(const FunctionSamples& samples, const image::Image& measured) {
  std::vector<SampleError> errors(samples.promises.size());
  const std::size_t stride = measured.channels.size();
  for (std::size_t i = 0; i < errors.size(); ++i) {
    for (std::size_t c = 0; c < samples.promises[i].size(); ++c) {
      hold_channel(samples.promises[i][c], static_cast<double>(measured.data[stride * i + c]), samples.spec.format, errors[i]);
    }
  }
  return errors;
}

std::string describe_sample(const FunctionSamples& samples, std::size_t index) {
  std::string text;
  for (std::size_t k = 0; k < samples.spec.parameters.size(); ++k) {
    text += (k == 0 ? "" : ", ") + samples.spec.parameters[k].name + " " + number(samples.values[index][k]);
  }
  return text;
}

double in_plot_units(const FunctionSpec& spec, double value, double difference) {
  return difference / (spec.is_operation ? ulp(value, spec.format) : std::max(std::abs(value), smallest_scale));
}

Verdict judge_samples(const FunctionSamples& samples, const std::vector<SampleError>& errors, int width) {
  Verdict verdict;
  std::size_t worst = errors.size();
  std::vector<double> relative;
  std::size_t not_finite = errors.size();
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const SampleError& one = errors[i];
    if (one.nan || one.infinite) {
      ++verdict.nonfinite_pixels;
      not_finite = std::min(not_finite, i);
    }
    if (!one.compared) {
      ++verdict.excluded_pixels;
      continue;
    }
    ++verdict.compared_pixels;
    if (worst == errors.size() || one.ratio > errors[worst].ratio) {
      worst = i;
    }
    relative.push_back(one.error / std::max(std::abs(one.value), smallest_scale));
    verdict.max_abs = std::max(verdict.max_abs, one.error);
    verdict.max_rel = std::max(verdict.max_rel, relative.back());
  }
  if (worst == errors.size()) {
    verdict.message = "the rules of GLSL ES promise nothing at any of these arguments";
    return verdict;
  }
  std::sort(relative.begin(), relative.end());
  verdict.p99_rel = relative[static_cast<std::size_t>(std::ceil(0.99 * static_cast<double>(relative.size()))) - 1];
  const SampleError& at = errors[worst];
  verdict.bound_ratio = at.ratio;
  verdict.worst_x = static_cast<int>(worst) % width;
  verdict.worst_y = static_cast<int>(worst) / width;
  verdict.status = at.ratio <= 1 ? Status::Pass : Status::Fail;
  const double unit = ulp(at.value, samples.spec.format);
  verdict.message = (at.ratio <= 1 ? "nearest to its bound at " : "outside its bound at ") + describe_sample(samples, worst) + ": " +
                    number(at.measured) + " for " + number(at.value) + ", off by " + number(at.error / unit) + " ulp of " +
                    number(at.bound / unit) + " allowed";
  if (samples.must_be_finite && not_finite < errors.size() && verdict.status == Status::Pass) {
    verdict.status = Status::Fail;
    verdict.message = std::string(errors[not_finite].nan ? "NaN" : "Inf") + " at " + describe_sample(samples, not_finite);
  }
  return verdict;
}

}  // namespace sheen::conformance
