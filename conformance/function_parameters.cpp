#include "conformance/function_parameters.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iterator>
#include <random>

#include "brdf/math.h"

namespace sheen::conformance {
namespace {

constexpr double smallest_roughness_shown = 1e-3;

double within_axis(double share) {
  return std::clamp(share, 0.0, 1.0);
}

/// std::uniform_real_distribution may differ between libraries; the top 53 bits do not.
double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11) * 0x1p-53;
}

std::vector<double> squares(std::vector<double> values) {
  for (double& x : values) {
    x *= x;
  }
  return values;
}

std::vector<double> special_roughnesses(const NumberFormat& format) {
  return {0,   format.smallest_normal(), 1e-7, 2.9e-5, 3.1e-5, 1e-4, 1e-3, 0.0039, 0.01, 0.03, 0.1, 0.125, 0.25,
          0.5, 1 - format.ulp_below_1(), 1.0};
}

std::vector<double> grid(const std::vector<Parameter>& parameters, double x, double y) {
  std::vector<double> values;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    values.push_back(i == 0 ? parameters[i].at(x) : i == 1 ? parameters[i].at(y) : parameters[i].typical);
  }
  return values;
}

std::vector<double> drawn(const std::vector<Parameter>& parameters, std::mt19937_64& random) {
  std::vector<double> values;
  for (const Parameter& parameter : parameters) {
    const double u = uniform(random);
    const bool small = uniform(random) < 0.5;
    values.push_back(parameter.at(small ? std::pow(10, -6 * u) : u));
  }
  return values;
}

/// Combination `index` of all, the first parameter running fastest.
std::vector<double> combination(const std::vector<Parameter>& parameters, std::uint64_t index) {
  std::vector<double> values;
  for (const Parameter& parameter : parameters) {
    values.push_back(parameter.special[index % parameter.special.size()]);
    index /= parameter.special.size();
  }
  return values;
}

}  // namespace

double NumberFormat::nearest(double x) const {
  if (std::abs(x) < 0.5 * smallest_normal()) {
    return 0;
  }
  const int exponent = std::max(std::ilogb(x), min_exponent);
  const double step = std::ldexp(1.0, exponent - fraction_bits);
  const double rounded = std::nearbyint(x / step) * step;
  return std::abs(rounded) < smallest_normal() ? std::copysign(smallest_normal(), x) : rounded;
}

double NumberFormat::smallest_normal() const {
  return std::ldexp(1.0, min_exponent);
}

double NumberFormat::ulp_above_1() const {
  return std::ldexp(1.0, -fraction_bits);
}

Parameter roughness_parameter(const std::string& name, const NumberFormat& format, double least) {
  const auto share = [](double r) { return within_axis(1 - std::log10(std::max(r, 1e-30)) / std::log10(smallest_roughness_shown)); };
  return {name, [](double u) { return std::pow(smallest_roughness_shown, 1 - u); }, share, special_roughnesses(format), 0.5, least, "0.001",
          "1"};
}

Parameter alpha_parameter(const std::string& name, const NumberFormat& format, double least) {
  const Parameter root = roughness_parameter(name, format);
  return {name,
          [root](double u) { return root.at(u) * root.at(u); },
          [root](double alpha) { return root.share(std::sqrt(std::max(alpha, 0.0))); },
          squares(root.special),
          0.25,
          least,
          "1e-6",
          "1"};
}

Parameter cosine_parameter(const std::string& name, const NumberFormat& format, double least, bool beyond) {
  std::vector<double> special{
      0,    format.smallest_normal(), 1e-7, 1e-4, 1e-3, 0.25, 0.5 - 0.5 * format.ulp_below_1(), 0.5, 0.5 + 0.5 * format.ulp_above_1(),
      0.75, 1 - format.ulp_below_1(), 1.0};
  if (beyond) {
    special.push_back(1 + format.ulp_above_1());
  }
  return {name, [](double u) { return u; }, within_axis, std::move(special), 0.6, least, "0", "1"};
}

Parameter signed_cosine_parameter(const std::string& name, const NumberFormat& format) {
  Parameter parameter = cosine_parameter(name, format, -1 - format.ulp_above_1(), true);
  const std::vector<double> positive = parameter.special;
  std::transform(positive.begin(), positive.end(), std::back_inserter(parameter.special), std::negate<>());
  parameter.at = [](double u) { return 2 * u - 1; };
  parameter.share = [](double x) { return within_axis(0.5 * (x + 1)); };
  parameter.low = "-1";
  return parameter;
}

Parameter angle_parameter(const std::string& name) {
  const double right = 0.5 * brdf::pi;
  return {name,
          [right](double u) { return right * u * u; },
          [right](double angle) { return within_axis(std::sqrt(std::max(angle, 0.0) / right)); },
          {0, 1e-20, 1e-7, 1e-4, 1e-3, 0.01, 0.1, 0.5, 1.0, 1.0471975, 1.0471976, 1.4, right - 1e-3, right - 1e-7, right},
          0.3,
          0,
          "0",
          "90 degrees"};
}

Parameter turn_parameter(const std::string& name) {
  const double full = 2 * brdf::pi;
  return {name,         [full](double u) { return full * u; }, [full](double x) { return within_axis(x / full); }, {0, 1, 4}, 0.7, 0, "0",
          "360 degrees"};
}

Parameter operand_parameter(const std::string& name, double low, double high, std::vector<double> special) {
  const auto text = [](double x) { return std::to_string(static_cast<int>(x)); };
  return {name,
          [low, high](double u) { return low + (high - low) * u; },
          [low, high](double x) { return high > low ? within_axis((x - low) / (high - low)) : 0; },
          std::move(special),
          0.5 * (low + high),
          low,
          text(low),
          text(high)};
}

Parameter magnitude_parameter(const std::string& name, double low, double high, bool is_signed, std::vector<double> special) {
  const double octaves = std::log2(high / low);
  const auto of_share = [low, octaves](double u) { return low * std::exp2(octaves * u); };
  const auto share_of = [low, octaves](double x) { return within_axis(std::log2(std::max(std::abs(x), low) / low) / octaves); };
  const std::string power = "2^";
  Parameter parameter{name,
                      of_share,
                      share_of,
                      std::move(special),
                      1,
                      is_signed ? -high : low,
                      power + std::to_string(std::ilogb(low)),
                      power + std::to_string(std::ilogb(high))};
  if (is_signed) {
    parameter.at = [of_share](double u) { return u < 0.5 ? -of_share(1 - 2 * u) : of_share(2 * u - 1); };
    parameter.share = [share_of](double x) { return 0.5 + (x < 0 ? -0.5 : 0.5) * share_of(x); };
    parameter.low = "-" + parameter.high;
  }
  return parameter;
}

std::vector<std::vector<double>> choose_values(const std::vector<Parameter>& parameters, ArgumentSet set, int width, int height) {
  std::mt19937_64 random(20170731);
  const auto samples = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  std::uint64_t combinations = 1;
  for (const Parameter& parameter : parameters) {
    combinations = std::min(combinations * parameter.special.size(), std::uint64_t{1} << 40);
  }
  std::vector<std::vector<double>> chosen;
  for (std::uint64_t i = 0; i < samples; ++i) {
    const int column = static_cast<int>(i) % width;
    const int row = static_cast<int>(i) / width;
    if (set == ArgumentSet::Dense && parameters.size() == 1) {
      chosen.push_back({parameters.front().at(static_cast<double>(i) / static_cast<double>(std::max(samples - 1, std::uint64_t{1})))});
    } else if (set == ArgumentSet::Dense) {
      // The second parameter grows upward, as in a plot.
      const auto share = [](int at, int side) { return static_cast<double>(at) / std::max(side - 1, 1); };
      chosen.push_back(grid(parameters, share(column, width), 1 - share(row, height)));
    } else if (set == ArgumentSet::Random) {
      chosen.push_back(drawn(parameters, random));
    } else {
      chosen.push_back(combination(parameters, combinations <= samples ? i % combinations : random() % combinations));
    }
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      chosen.back()[k] = std::max(chosen.back()[k], parameters[k].least);
    }
  }
  return chosen;
}

}  // namespace sheen::conformance
