#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

// What the OpenGL ES Shading Language promises of floating-point arithmetic: GLSL ES 3.00.6, section 4.5.1 "Range and Precision", and
// GLSL ES 3.20.5, section 4.7.1 of the same name. The table of operation precisions there is highp's:
//
//   a + b, a - b, a * b   correctly rounded; the rounding mode is undefined, so either neighbour of the exact result may come out
//   a / b                 2.5 ulp for |b| in [2^-126, 2^126]
//   a * b + c             one correctly rounded operation or a sequence of two
//   exp, exp2             (3 + 2 |x|) ulp
//   log, log2             3 ulp outside [0.5, 2], an absolute 2^-21 inside
//   inversesqrt           2 ulp
//   pow(x, y), sqrt(x)    inherited from exp2(y * log2(x)) and from 1.0 / inversesqrt(x)
//   conversions           correctly rounded; min, max, abs, negation and comparisons exact
//
// For mediump the section gives a range, (-2^14, 2^14), and a relative precision, 2^-10. What its built-in functions then owe is the
// reading of the Khronos conformance tests (VK-GL-CTS, functional.shaders.builtin_functions.precision): numbers of 9 fraction bits and
// exponents -13 to 13, with the figures below. Subnormals may be flushed to zero in either precision, at any time.

namespace sheen::number {

/// IEEE 754 single precision under the rules above.
struct Highp {
  static constexpr int fraction_bits = 23;
  static constexpr int min_exponent = -126;
  static constexpr int max_exponent = 127;
  static constexpr double smallest_divisor = 0x1p-126;
  static constexpr double largest_divisor = 0x1p126;
  /// The table says 3. The conformance tests round the ends of what that allows outward to numbers of the format, so no implementation is
  /// held to less than one more (tcu::FloatFormat::convert); Mesa's llvmpipe makes use of it.
  static constexpr double exp_ulps = 4;
  /// The table says 3. 4 pass the conformance tests with a quality warning, so no implementation is held to less.
  static constexpr double log_ulps = 4;
  static constexpr double log_near_one = 0x1p-21;
  /// Whether a variable holds a number of the format. Storage is binary32 by the section's own words.
  static constexpr bool holds_its_format = true;
};

/// The least that mediump may be. An implementation may hold more digits, so a variable need not hold a number of this format.
struct Mediump {
  static constexpr int fraction_bits = 9;
  static constexpr int min_exponent = -13;
  static constexpr int max_exponent = 13;
  static constexpr double smallest_divisor = 0x1p-13;
  static constexpr double largest_divisor = 0x1p12;
  static constexpr double exp_ulps = 3;  ///< 2, and one more as above
  static constexpr double log_ulps = 2;
  static constexpr double log_near_one = 0x1p-7;
  static constexpr bool holds_its_format = false;
};

inline constexpr double division_ulps = 2.5;
inline constexpr double inverse_sqrt_ulps = 2;
inline constexpr double exp_ulps_per_argument = 2;

/// 2^exponent, for exponents of normal doubles.
constexpr double power_of_two(int exponent) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
}

/// Whether x is +-2^k (or 0, infinite): no bit of its fraction is set.
constexpr bool has_no_fraction(double x) {
  return (std::bit_cast<std::uint64_t>(x) & ((std::uint64_t{1} << 52) - 1)) == 0;
}

template <class Precision>
inline constexpr double smallest_normal = power_of_two(Precision::min_exponent);

template <class Precision>
inline constexpr double largest_finite = (2 - power_of_two(-Precision::fraction_bits)) * power_of_two(Precision::max_exponent);

/// Distance of neighbouring numbers at 1 on the side away from 0: what an ulp is at most, relative to its number.
template <class Precision>
inline constexpr double epsilon = power_of_two(-Precision::fraction_bits);

/// One unit in the last place of an exact value x: the distance of the two numbers of the format that enclose it, at a power of two the
/// smaller of the two distances there (Harrison 1999, "A Machine-Checked Theory of Floating Point Arithmetic"; so do the conformance
/// tests, tcu::FloatFormat::ulp). Below the smallest normal it is the step of the subnormals. It never falls as |x| grows.
template <class Precision>
constexpr double ulp(double x) {
  const std::uint64_t magnitude = std::bit_cast<std::uint64_t>(x) & ~(std::uint64_t{1} << 63);
  // One less than the bits of a power of two belongs to the binade below it.
  const int exponent = magnitude == 0 ? Precision::min_exponent : static_cast<int>((magnitude - 1) >> 52) - 1023;
  return power_of_two(std::max(exponent, Precision::min_exponent) - Precision::fraction_bits);
}

/// Whether x is a number of the format, subnormals among them.
template <class Precision>
bool is_representable(double x) {
  const double magnitude = std::abs(x);
  if constexpr (largest_finite<Precision> == std::numeric_limits<float>::max()) {
    return magnitude <= largest_finite<Precision> && static_cast<double>(static_cast<float>(x)) == x;
  }
  if (magnitude >= smallest_normal<Precision> && magnitude <= largest_finite<Precision>) {
    constexpr std::uint64_t beyond = (std::uint64_t{1} << (52 - Precision::fraction_bits)) - 1;
    return (std::bit_cast<std::uint64_t>(x) & beyond) == 0;
  }
  const double steps = magnitude / ulp<Precision>(0);  // a division by a power of two
  return magnitude < smallest_normal<Precision> && steps == std::floor(steps);
}

/// What a shader's x (1 - t) + y t of two constants may be off, or x + (y - x) t, as some make of the built-in mix(): the constants'
/// roundings, the last sum's, and those of 1 - t and both products, or of the difference and its product.
/// @param rest, t  the largest |1 - t| and |t|
template <class Precision, class Number>
Number mix_error(double x, double y, const Number& rest, const Number& t) {
  using std::max;
  constexpr double unit = epsilon<Precision> * (1 + 0x1p-20);  // and errors of errors
  const double of_x = (is_representable<Precision>(x) ? 1 : 2) * std::abs(x);
  const double of_y = (is_representable<Precision>(y) ? 1 : 2) * std::abs(y);
  const double flushed = 4 * smallest_normal<Precision> * (1 + std::abs(x) + std::abs(y));  // of constants, products and sums
  const Number products = Number(2 * unit * std::abs(x)) * rest + Number(unit * std::abs(y)) * t;
  const Number difference = Number(2 * unit * std::abs(y - x)) * t;
  return (Number(unit * of_x) * rest + Number(unit * of_y) * t) + (max(products, difference) + Number(flushed) * (Number(1.0) + rest + t));
}

}  // namespace sheen::number
