#pragma once

#include <functional>
#include <string>
#include <vector>

namespace sheen::conformance {

/// The numbers that arguments are taken from, so that they reach the shader without a rounding: those of the precision under test.
struct NumberFormat {
  int fraction_bits;
  int min_exponent;

  /// The nearest number of the format; 0 below half of the smallest normal one.
  double nearest(double x) const;
  double smallest_normal() const;
  /// Distance from 1 to the next number above, and to the next below.
  double ulp_above_1() const;
  double ulp_below_1() const { return 0.5 * ulp_above_1(); }
};

/// One thing that the arguments of a function are made of, and where it is tried: a cosine, a roughness, an angle between vectors.
struct Parameter {
  std::string name;
  std::function<double(double)> at;     ///< its value at a share in [0, 1] of its axis: grids and plots run along it
  std::function<double(double)> share;  ///< the reverse, held to [0, 1]
  std::vector<double> special;          ///< adversarial values
  double typical;                       ///< where a grid over two others holds it
  double least;                         ///< values below it count as it: what the shader's caller never passes
  std::string low, high;                ///< the axis' ends, for a plot
};

/// sheen_roughness or roughness in [least, 1], by its logarithm from 1e-3.
Parameter roughness_parameter(const std::string& name, const NumberFormat& format, double least = 0);
/// Roughness squared.
Parameter alpha_parameter(const std::string& name, const NumberFormat& format, double least = 0);
/// A cosine or factor in [least, 1], and an ulp beyond 1 where `beyond`.
Parameter cosine_parameter(const std::string& name, const NumberFormat& format, double least = 0, bool beyond = false);
/// A cosine in [-1, 1], and an ulp beyond either end.
Parameter signed_cosine_parameter(const std::string& name, const NumberFormat& format);
/// An angle in [0, 90 degrees], in radians; axes run with its root, for the lobes are narrow about 0.
Parameter angle_parameter(const std::string& name);
/// What turns a figure without changing its shape: an azimuth in radians, in [0, 2 pi].
Parameter turn_parameter(const std::string& name);
/// An operand in [low, high].
Parameter operand_parameter(const std::string& name, double low, double high, std::vector<double> special);
/// An operand of either sign (`is_signed`) whose magnitude lies in [low, high], by its logarithm.
Parameter magnitude_parameter(const std::string& name, double low, double high, bool is_signed, std::vector<double> special);

/// How the values of parameters are chosen.
enum class ArgumentSet {
  Dense,       ///< a grid over the first two, the rest at their typical values; all along the axis of one that is alone
  Random,      ///< half along the axes, half toward their small ends
  Adversarial  ///< every combination of special values, or as many as there is room for, drawn at random
};

/// Values for width * height samples, row by row: result[sample][parameter]. The same on every call.
std::vector<std::vector<double>> choose_values(const std::vector<Parameter>& parameters, ArgumentSet set, int width, int height);

}  // namespace sheen::conformance
