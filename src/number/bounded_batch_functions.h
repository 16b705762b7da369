#pragma once

#include <limits>

#include "number/bounded_batch_conversion.h"
#include "number/bounded_functions.h"

// The built-in functions of number::BoundedBatch. Lanes of exact arguments, and of such as a function is not defined for, are handed to
// number::Bounded.

namespace sheen::number {

/// A function at the centre of its argument, as Tangent has it.
struct TangentBatch {
  Batch value, slope, curvature;
};

/// f of all that x may be, before any rounding, in lanes where x is not exact: image() of Bounded.
template <class Precision, class Function>
ExactBatch image(const BoundedBatch<Precision>& x, const TangentBatch& at, const Function& f) {
  const Batch up_to = x.upper() - x.center();
  const Batch down_to = x.center() - x.lower();
  const Batch width = xsimd::max(up_to, down_to);
  const Batch steepness = xsimd::abs(at.slope);
  Batch remainder = Batch(0.5) * at.curvature * width * width * Batch(1 + 0x1p-40);
  const Batch up = at.slope * up_to;
  const Batch down = at.slope * -down_to;
  const Batch room = remainder + xsimd::abs(at.value) * Batch(0x1p-50);
  const auto under = [](const Batch& v) { return below(below(v)); };
  const auto over = [](const Batch& v) { return above(above(v)); };
  Batch lowest = under(at.value + xsimd::min(up, down)) - room;
  Batch highest = over(at.value + xsimd::max(up, down)) + room;
  const BatchMask straight = remainder <= Batch(0x1p-6) * steepness * width;
  if (!xsimd::all(straight)) {
    const Batch lower = f(x.lower());
    const Batch upper = f(x.upper());
    lowest = select(straight, lowest, under(xsimd::min(lower, upper)));
    highest = select(straight, highest, over(xsimd::max(lower, upper)));
    const Batch left = xsimd::max(xsimd::abs(lower - at.value - down), xsimd::abs(upper - at.value - up));
    const Batch size = xsimd::abs(lower) + xsimd::abs(upper) + xsimd::abs(at.value) + steepness * width;
    remainder = select(straight, remainder, left + size * Batch(0x1p-50));
  }
  return {at.value, at.slope * x.shift_x(), at.slope * x.shift_y(), steepness * x.radius() + remainder, lowest, highest};
}

/// A function whose exact image is rounded once.
/// @param f        the function of double
/// @param defined  the lanes in which the tangent is one
/// @param of       the function of number::Bounded
template <class Precision, class Function, class OfOne>
BoundedBatch<Precision> rounded_image(const BoundedBatch<Precision>& x, const TangentBatch& at, const Function& f, const BatchMask& defined,
                                      const typename BoundedBatch<Precision>::Error& error, bool keeps_sign, const OfOne& of) {
  BoundedBatch<Precision> out;
  out.round(image(x, at, f), error, keeps_sign);
  out.settle(~defined | x.is_exact() | x.is_unbounded(), BatchMask(false), of, x);
  return out;
}

/// The lanes that is_certainly_positive().
template <class Precision>
BatchMask certainly_positive(const BoundedBatch<Precision>& x) {
  return x.lower() >= Batch(smallest_normal<Precision>);
}

/// Of exp and exp2: (4 + 2 |x|) ulp, in mediump (3 + 2 |x|).
template <class Precision>
typename BoundedBatch<Precision>::Error exponential_error(const BoundedBatch<Precision>& x) {
  return BoundedBatch<Precision>::Error::ulps(Precision::exp_ulps + exp_ulps_per_argument * x.magnitude());
}

/// Bound of the second derivative of rate^2 e^(rate x) = value rate^2 at the centre, over a range no wider than `width`.
inline Batch exponential_curvature(const Batch& value, double rate, const Batch& width) {
  return select(width < Batch(0x1p-8), value * Batch(rate * rate) * (Batch(1.0) + Batch(2.0) * width),
                Batch(std::numeric_limits<double>::infinity()));
}

template <class Precision>
BoundedBatch<Precision> exp(const BoundedBatch<Precision>& x) {
  const Batch value = xsimd::exp(x.center());
  const TangentBatch at{value, value, exponential_curvature(value, 1, x.upper() - x.lower())};
  const auto f = [](const Batch& t) { return xsimd::exp(t); };
  return rounded_image(x, at, f, BatchMask(true), exponential_error(x), false, [](const auto& one) { return exp(one); });
}

template <class Precision>
BoundedBatch<Precision> exp2(const BoundedBatch<Precision>& x) {
  constexpr double ln2 = 0.69314718055994530942;
  const Batch value = xsimd::exp2(x.center());
  const TangentBatch at{value, value * Batch(ln2), exponential_curvature(value, ln2, x.upper() - x.lower())};
  const auto f = [](const Batch& t) { return xsimd::exp2(t); };
  return rounded_image(x, at, f, BatchMask(true), exponential_error(x), false, [](const auto& one) { return exp2(one); });
}

/// log to a base of which `per_unit` is the value of e. @param f  the function of double
template <class Precision, class Function, class OfOne>
BoundedBatch<Precision> logarithm(const BoundedBatch<Precision>& x, const Function& f, double per_unit, const OfOne& of) {
  using B = BoundedBatch<Precision>;
  const Batch steepest = Batch(1.0) / x.lower();
  const TangentBatch at{f(x.center()), Batch(per_unit) / x.center(), Batch(per_unit) * steepest * steepest};
  const ExactBatch exact = image(x, at, f);
  const Batch largest = xsimd::max(xsimd::abs(exact.lower), xsimd::abs(exact.upper));
  const BatchMask near_one = (x.lower() <= Batch(2.0)) & (x.upper() >= Batch(0.5));
  const BatchMask elsewhere = (x.lower() < Batch(0.5)) | (x.upper() > Batch(2.0));
  const Batch outside = select(elsewhere, Batch(Precision::log_ulps) * ulp<Precision>(largest), Batch(0.0));
  B out;
  out.round(exact, B::Error::absolute(0, xsimd::max(select(near_one, Batch(Precision::log_near_one), Batch(0.0)), outside)), false);
  out.settle(~certainly_positive(x) | x.is_exact() | x.is_unbounded(), BatchMask(false), of, x);
  return out;
}

template <class Precision>
BoundedBatch<Precision> log(const BoundedBatch<Precision>& x) {
  return logarithm(
      x, [](const Batch& t) { return xsimd::log(t); }, 1, [](const auto& one) { return log(one); });
}

template <class Precision>
BoundedBatch<Precision> log2(const BoundedBatch<Precision>& x) {
  constexpr double per_ln2 = 1.4426950408889634074;
  return logarithm(
      x, [](const Batch& t) { return xsimd::log2(t); }, per_ln2, [](const auto& one) { return log2(one); });
}

template <class Precision>
BoundedBatch<Precision> pow(const BoundedBatch<Precision>& x, const BoundedBatch<Precision>& y) {
  BoundedBatch<Precision> power = exp2(y * log2(x));
  power.settle(
      power.is_unbounded(), BatchMask(false), [](const auto& a, const auto& b) { return pow(a, b); }, x, y);
  return power;
}

template <class Precision>
BoundedBatch<Precision> pow_from_zero(const BoundedBatch<Precision>& x, const BoundedBatch<Precision>& y) {
  BoundedBatch<Precision> power = exp2(y * log2(x));
  const BatchMask open = ~certainly_positive(x) | power.is_unbounded();
  power.settle(
      open, BatchMask(false), [](const auto& a, const auto& b) { return pow_from_zero(a, b); }, x, y);
  return power;
}

template <class Precision>
BoundedBatch<Precision> log1p(const BoundedBatch<Precision>& x) {
  // As log1p of Bounded derives it.
  constexpr double relative = 5.25 * epsilon<Highp>;
  constexpr double flushed = 4 * smallest_normal<Highp>;
  using B = BoundedBatch<Precision>;
  const auto of = [](const auto& one) { return log1p(one); };
  if constexpr (Precision::fraction_bits < Highp::fraction_bits) {
    B out = x;
    out.settle(BatchMask(true), BatchMask(false), of, x);
    return out;
  }
  const BatchMask defined = (x.lower() >= Batch(-0.25)) & (x.upper() <= Batch(0.0));
  const Batch steepest = Batch(1.0) / (Batch(1.0) + x.lower());
  const TangentBatch at{xsimd::log1p(x.center()), Batch(1.0) / (Batch(1.0) + x.center()), steepest * steepest};
  const auto f = [](const Batch& t) { return xsimd::log1p(t); };
  return rounded_image(x, at, f, defined, B::Error::absolute(relative, Batch(flushed)), true, of);
}

template <class Precision>
BoundedBatch<Precision> inversesqrt(const BoundedBatch<Precision>& x) {
  const Batch value = Batch(1.0) / xsimd::sqrt(x.center());
  const Batch steepest = Batch(1.0) / x.lower();
  const TangentBatch at{value, Batch(-0.5) * value / x.center(), Batch(0.75) * steepest * steepest * xsimd::sqrt(steepest)};
  const auto f = [](const Batch& t) { return Batch(1.0) / xsimd::sqrt(t); };
  return rounded_image(x, at, f, certainly_positive(x), BoundedBatch<Precision>::Error::ulps(Batch(inverse_sqrt_ulps)), false,
                       [](const auto& one) { return inversesqrt(one); });
}

template <class Precision>
BoundedBatch<Precision> sqrt(const BoundedBatch<Precision>& x) {
  using B = BoundedBatch<Precision>;
  const Batch value = xsimd::sqrt(x.center());
  const Batch steepest = Batch(1.0) / x.lower();
  const TangentBatch at{value, Batch(0.5) / value, Batch(0.25) * steepest * xsimd::sqrt(steepest)};
  const ExactBatch exact = image(x, at, [](const Batch& t) { return xsimd::sqrt(t); });
  const auto inverted = [](const Batch& root, int side) {
    const Batch inverse = Batch(1.0) / root;
    return select(has_no_fraction(root), inverse, side > 0 ? above(inverse) : below(inverse));
  };
  const Batch largest = inverted(exact.lower, 1);
  const Batch smallest = inverted(exact.upper, -1);
  const Batch inverse = Batch(inverse_sqrt_ulps) * xsimd::min(Batch(epsilon<Precision>), ulp<Precision>(largest) / smallest);
  B dividend;
  dividend.round(exact, {Batch(0.0), inverse / (Batch(1.0) - inverse), Batch(0.0), false}, false);
  B out;
  out.round(dividend.as_exact(), B::Error::ulps(Batch(division_ulps)), false);
  const BatchMask open = ~certainly_positive(x) | x.is_exact() | x.is_unbounded();
  out.settle(
      open, dividend.is_unbounded(), [](const auto& one) { return sqrt(one); }, x);
  return out;
}

template <class Precision>
BoundedBatch<Precision> mix(double x, double y, const BoundedBatch<Precision>& t) {
  using B = BoundedBatch<Precision>;
  const Batch step(y - x);
  const Batch at_lower = Batch(x) + step * t.lower();
  const Batch at_upper = Batch(x) + step * t.upper();
  const Batch rest = xsimd::max(xsimd::abs(Batch(1.0) - t.lower()), xsimd::abs(Batch(1.0) - t.upper()));
  const Batch largest = xsimd::max(xsimd::abs(t.lower()), xsimd::abs(t.upper()));
  B made(0.0);
  made.round({Batch(x) + step * t.center(), step * t.shift_x(), step * t.shift_y(), xsimd::abs(step) * t.radius(),
              xsimd::min(at_lower, at_upper), xsimd::max(at_lower, at_upper)},
             B::Error::absolute(0, mix_error<Precision>(x, y, rest, largest)), false);
  return made;
}

}  // namespace sheen::number
