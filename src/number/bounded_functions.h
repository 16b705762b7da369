#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "number/bounded_conversion.h"

// The built-in functions of number::Bounded, by the rules of number/precision.h. The formulas of a shader find them by argument-dependent
// lookup.

namespace sheen::number {

/// A function at the centre of its argument.
struct Tangent {
  double value, slope;
  double curvature;       ///< upper bound of |f''| over the argument's range; infinite if it is not worth one
  bool is_exact = false;  ///< whether `value` is f's very value rather than its neighbour in double
};

/// f of all that x may be, before any rounding: with x = c + d + e (displaced, perturbed),
///
///   f(x) - f(c) - f'(c) d = f'(c) e + (f(x) - f(c) - f'(c) (x - c)),
///
/// where the bracket is enclosed by half the curvature times the squared width, or, over wide ranges, by its values at the ends, which are
/// its extremes if f'' keeps its sign.
/// @param f  the function in double, monotone and convex or concave over x's range, within an ulp of double
template <class Precision, class Function>
typename Bounded<Precision>::Exact image(const Bounded<Precision>& x, const Tangent& at, Function f) {
  using B = Bounded<Precision>;
  const double c = x.center();
  const Range& range = x.range();
  const double width = std::max(range.upper - c, c - range.lower);
  const auto enclosing = [](double a, double b) { return Range{B::below(B::below(std::min(a, b))), B::above(B::above(std::max(a, b)))}; };
  Range values{at.value, at.value};
  double remainder = 0;
  if (width > 0 || !at.is_exact) {
    remainder = 0.5 * at.curvature * width * width * (1 + 0x1p-40);
    if (remainder <= 0x1p-6 * std::abs(at.slope) * width) {
      const double up = at.slope * (range.upper - c);
      const double down = at.slope * (range.lower - c);
      values = enclosing(at.value + std::min(up, down), at.value + std::max(up, down));
      const double room = remainder + std::abs(at.value) * 0x1p-50;
      values = width > 0 ? Range{values.lower - room, values.upper + room} : values;
    } else {
      const double lower = f(range.lower);
      const double upper = f(range.upper);
      values = enclosing(lower, upper);
      remainder =
          std::max(std::abs(lower - at.value - at.slope * (range.lower - c)), std::abs(upper - at.value - at.slope * (range.upper - c)));
      remainder += (std::abs(lower) + std::abs(upper) + std::abs(at.value) + std::abs(at.slope) * width) * 0x1p-50;
    }
  }
  return {at.value, at.slope * x.shift_x(), at.slope * x.shift_y(), std::abs(at.slope) * x.radius() + remainder, values};
}

/// Whether x is certain to be positive for an implementation that flushes subnormals to zero.
template <class Precision>
bool is_certainly_positive(const Bounded<Precision>& x) {
  return x.is_bounded() && x.range().lower >= smallest_normal<Precision>;
}

/// Error of exp and exp2 at x.
template <class Precision>
typename Bounded<Precision>::Error exponential_error(const Bounded<Precision>& x) {
  return Bounded<Precision>::Error::ulps(Precision::exp_ulps + exp_ulps_per_argument * x.range().magnitude());
}

/// e^x within (4 + 2 |x|) ulp, in mediump (3 + 2 |x|).
template <class Precision>
Bounded<Precision> exp(const Bounded<Precision>& x) {
  const double value = std::exp(x.center());
  if (!x.is_bounded()) return Bounded<Precision>::unbounded(value);
  const double width = x.range().upper - x.range().lower;
  // Over a narrow range e^x exceeds its value at the centre by a factor of at most e^width < 1 + 2 width.
  const double curvature = width < 0x1p-8 ? value * (1 + 2 * width) : std::numeric_limits<double>::infinity();
  const auto exact = image(x, {value, value, curvature, x.center() == 0}, [](double t) { return std::exp(t); });
  return Bounded<Precision>::rounded(exact, exponential_error(x), false);
}

/// 2^x, by the same rule.
template <class Precision>
Bounded<Precision> exp2(const Bounded<Precision>& x) {
  constexpr double ln2 = 0.69314718055994530942;
  const double value = std::exp2(x.center());
  if (!x.is_bounded()) return Bounded<Precision>::unbounded(value);
  const double width = x.range().upper - x.range().lower;
  const double curvature = width < 0x1p-8 ? value * ln2 * ln2 * (1 + 2 * width) : std::numeric_limits<double>::infinity();
  const auto exact = image(x, {value, value * ln2, curvature, x.center() == std::floor(x.center())}, [](double t) { return std::exp2(t); });
  return Bounded<Precision>::rounded(exact, exponential_error(x), false);
}

/// Error of log and log2, whose exact values are `exact`, at x: an absolute one where x may lie in [0.5, 2], ulp of the result elsewhere.
template <class Precision>
typename Bounded<Precision>::Error logarithm_error(const Bounded<Precision>& x, const typename Bounded<Precision>::Exact& exact) {
  const bool near_one = x.range().lower <= 2 && x.range().upper >= 0.5;
  const bool elsewhere = x.range().lower < 0.5 || x.range().upper > 2;
  const double outside = elsewhere ? Precision::log_ulps * ulp<Precision>(exact.range.magnitude()) : 0;
  return Bounded<Precision>::Error::absolute(0, std::max(near_one ? Precision::log_near_one : 0, outside));
}

/// ln x within 4 ulp (mediump 2) outside [0.5, 2] and an absolute 2^-21 (2^-7) inside; unbounded unless x is certain to be positive.
template <class Precision>
Bounded<Precision> log(const Bounded<Precision>& x) {
  const double value = std::log(x.center());
  if (!is_certainly_positive(x)) return Bounded<Precision>::unbounded(value);
  const double steepest = 1 / x.range().lower;
  const auto exact = image(x, {value, 1 / x.center(), steepest * steepest, x.center() == 1}, [](double t) { return std::log(t); });
  return Bounded<Precision>::rounded(exact, logarithm_error(x, exact), false);
}

/// log2 x, by the same rule.
template <class Precision>
Bounded<Precision> log2(const Bounded<Precision>& x) {
  constexpr double per_ln2 = 1.4426950408889634074;
  const double value = std::log2(x.center());
  if (!is_certainly_positive(x)) return Bounded<Precision>::unbounded(value);
  const double steepest = 1 / x.range().lower;
  const auto exact = image(x, {value, per_ln2 / x.center(), per_ln2 * steepest * steepest, has_no_fraction(x.center())},
                           [](double t) { return std::log2(t); });
  return Bounded<Precision>::rounded(exact, logarithm_error(x, exact), false);
}

/// x^y as exp2(y log2 x), from which GLSL derives it; so 0^y is unbounded.
template <class Precision>
Bounded<Precision> pow(const Bounded<Precision>& x, const Bounded<Precision>& y) {
  const Bounded<Precision> power = exp2(y * log2(x));
  return power.is_bounded() ? power : Bounded<Precision>::unbounded(std::pow(x.center(), y.center()));
}

/// x^y for y in [0.02, 1] as a shader computes it that takes 0 where x is not positive, so that x may be or touch 0: pow of what is certain
/// to be positive; else, with u the largest x may be, from 0 to the most that pow makes of [u / 2, u]. Of smaller x it makes no more: log2
/// of the smallest normal number is -126, so 4 ulp of it and (4 + 2 y 126) ulp of exp2 are in all below a share of 1e-4 y + 1e-6, and 2^-y
/// is less than 1 by more than that. In mediump, whose smallest is 2^-13, they come to 0.2 y + 0.008 at most.
template <class Precision>
Bounded<Precision> pow_from_zero(const Bounded<Precision>& x, const Bounded<Precision>& y) {
  if (is_certainly_positive(x)) return pow(x, y);
  using B = Bounded<Precision>;
  const double value = x.center() > 0 ? std::pow(x.center(), y.center()) : 0;
  if (!x.is_bounded() || !y.is_bounded() || y.range().lower < 0.02 || y.range().upper > 1) return B::unbounded(value);
  const double largest = std::max(x.range().upper, 2 * smallest_normal<Precision>);
  const B most = pow(B::within(0.75 * largest, 0.25 * largest), y);
  if (!most.is_bounded()) return B::unbounded(value);
  const double top = most.range().upper;
  return B::rounded({value, 0, 0, std::max(value, top - value), {0, top}}, B::Error::absolute(0, 0), true);
}

/// ln(1 + x) for x in [-1/4, 0], unbounded elsewhere. GLSL has no such function; the bound is that of the shaders' log_one_minus
/// (sheen_distribution.glsl), highp in every precision: with t = -x / (2 + x), -2 t (1 + t^2 (1/3 + t^2 (1/5 + t^2 (1/7 + t^2 / 9)))).
/// Relative to the value and in units of highp's epsilon, 2 + x errs by 1/1.75 and the quotient by 2.5, hence t by 3.08; t^2 <= 1/49
/// leaves 0.08 of the errors inside the bracket and 1 is for its last sum, 1 for the product, 3e-10 is cut off: 5.16 in all. Of an
/// argument near the smallest normal number the quotient may be flushed.
template <class Precision>
Bounded<Precision> log1p(const Bounded<Precision>& x) {
  constexpr double relative = 5.25 * epsilon<Highp>;
  constexpr double flushed = 4 * smallest_normal<Highp>;
  const double value = std::log1p(x.center());
  if (!x.is_bounded() || !(x.range().lower >= -0.25 && x.range().upper <= 0)) return Bounded<Precision>::unbounded(value);
  const double steepest = 1 / (1 + x.range().lower);
  const auto exact = image(x, {value, 1 / (1 + x.center()), steepest * steepest, x.center() == 0}, [](double t) { return std::log1p(t); });
  using B = Bounded<Precision>;
  const B highp = B::rounded(exact, B::Error::absolute(relative, flushed), true);
  return epsilon<Precision> > epsilon<Highp> ? B::rounded(highp.as_exact(), B::Error::ulps(1), true) : highp;
}

/// 1 / sqrt(x) within 2 ulp; unbounded unless x is certain to be positive.
template <class Precision>
Bounded<Precision> inversesqrt(const Bounded<Precision>& x) {
  const double value = 1 / std::sqrt(x.center());
  if (!is_certainly_positive(x)) return Bounded<Precision>::unbounded(value);
  const double steepest = 1 / x.range().lower;
  const auto exact = image(x,
                           {value, -0.5 * value / x.center(), 0.75 * steepest * steepest * std::sqrt(steepest),
                            has_no_fraction(x.center()) && has_no_fraction(value)},
                           [](double t) { return 1 / std::sqrt(t); });
  return Bounded<Precision>::rounded(exact, Bounded<Precision>::Error::ulps(inverse_sqrt_ulps), false);
}

/// sqrt(x) as 1 / inversesqrt(x), from which GLSL derives it: its 2 ulp, relative to 1 / sqrt(x), and 2.5 ulp of the quotient. So sqrt(0)
/// is unbounded.
template <class Precision>
Bounded<Precision> sqrt(const Bounded<Precision>& x) {
  const double value = std::sqrt(x.center());
  if (!is_certainly_positive(x)) return Bounded<Precision>::unbounded(value);
  const double steepest = 1 / x.range().lower;
  const auto exact =
      image(x, {value, 0.5 / value, 0.25 * steepest * std::sqrt(steepest), has_no_fraction(x.center()) && has_no_fraction(value)},
            [](double t) { return std::sqrt(t); });
  using B = Bounded<Precision>;
  const auto inverted = [](double root, bool upward) {
    return has_no_fraction(root) ? 1 / root : (upward ? B::above(1 / root) : B::below(1 / root));
  };
  const double largest = inverted(exact.range.lower, true);
  const double smallest = inverted(exact.range.upper, false);
  const double inverse = inverse_sqrt_ulps * std::min(epsilon<Precision>, ulp<Precision>(largest) / smallest);
  const B dividend = B::rounded(exact, B::Error::absolute(inverse / (1 - inverse), 0), false);
  return dividend.is_bounded() ? B::rounded(dividend.as_exact(), B::Error::ulps(division_ulps), false) : dividend;
}

/// x (1 - t) + y t: what t may be moves it by the difference of the two constants alone.
template <class Precision>
Bounded<Precision> mix(double x, double y, const Bounded<Precision>& t) {
  using B = Bounded<Precision>;
  const double step = y - x;
  const double center = x + step * t.center();
  if (!t.is_bounded()) return B::unbounded(center);
  const double at_lower = x + step * t.range().lower;
  const double at_upper = x + step * t.range().upper;
  const double rest = std::max(std::abs(1 - t.range().lower), std::abs(1 - t.range().upper));
  return B::rounded({center,
                     step * t.shift_x(),
                     step * t.shift_y(),
                     std::abs(step) * t.radius(),
                     {std::min(at_lower, at_upper), std::max(at_lower, at_upper)}},
                    B::Error::absolute(0, mix_error<Precision>(x, y, rest, t.range().magnitude())), false);
}

}  // namespace sheen::number
