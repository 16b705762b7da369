#pragma once

#include <cstdint>

#include "number/batch.h"
#include "number/precision.h"

// The roundings of number/bounded.h, of four doubles at once.

namespace sheen::number {

using BatchMask = Batch::batch_bool_type;
using BatchBits = xsimd::batch<std::uint64_t, Batch::arch_type>;

/// An exact result before its rounding: affine form and range.
struct ExactBatch {
  Batch center, shift_x, shift_y, radius, lower, upper;
};

/// The neighbouring double on the side away from or toward minus infinity, or one a little beyond.
inline Batch above(const Batch& x) {
  return x + xsimd::abs(x) * Batch(0x1p-52);
}
inline Batch below(const Batch& x) {
  return x - xsimd::abs(x) * Batch(0x1p-52);
}

template <class Precision>
Batch ulp(const Batch& x) {
  const Batch normal(smallest_normal<Precision>);
  const BatchBits bits = xsimd::bitwise_cast<BatchBits>(xsimd::max(xsimd::abs(x), normal)) - BatchBits(std::uint64_t{1});
  const auto binade = xsimd::bitwise_cast<Batch>(bits & BatchBits(std::uint64_t{0x7ff} << 52));
  return xsimd::max(binade, normal) * Batch(power_of_two(-Precision::fraction_bits));
}

inline BatchMask has_no_fraction(const Batch& x) {
  const BatchBits fraction = xsimd::bitwise_cast<BatchBits>(x) & BatchBits((std::uint64_t{1} << 52) - 1);
  return xsimd::bitwise_cast<Batch>(fraction) == Batch(0.0);
}

/// a + b, or a double below it unless double has it exactly.
inline Batch sum_below(const Batch& a, const Batch& b) {
  const Batch s = a + b;
  const Batch virtual_b = s - a;
  return select((a - (s - virtual_b)) + (b - virtual_b) == Batch(0.0), s, below(s));
}

/// x y, or the neighbour in double on one side unless it is a power of two.
inline Batch product_beside(const Batch& x, const Batch& y, int side) {
  const Batch p = x * y;
  const BatchMask exact = has_no_fraction(p) & has_no_fraction(x) & has_no_fraction(y);
  return select(exact, p, side < 0 ? below(p) : above(p));
}

/// The least and the greatest x^2, on the sides away from each other.
inline void extremes_of_square(const Batch& x_lower, const Batch& x_upper, Batch& lower, Batch& upper) {
  const Batch smallest = xsimd::max(xsimd::max(x_lower, -x_upper), Batch(0.0));
  const Batch largest = xsimd::max(xsimd::abs(x_lower), xsimd::abs(x_upper));
  lower = product_beside(smallest, smallest, -1);
  upper = product_beside(largest, largest, 1);
}

/// The least and the greatest x y, on the sides away from each other.
inline void extremes_of_product(const Batch& x_lower, const Batch& x_upper, const Batch& y_lower, const Batch& y_upper, Batch& lower,
                                Batch& upper) {
  const Batch p[4] = {x_lower * y_lower, x_lower * y_upper, x_upper * y_lower, x_upper * y_upper};
  lower = below(xsimd::min(xsimd::min(p[0], p[1]), xsimd::min(p[2], p[3])));
  upper = above(xsimd::max(xsimd::max(p[0], p[1]), xsimd::max(p[2], p[3])));
  // Most have a fraction, and then none is exact.
  if (xsimd::any(has_no_fraction(p[0]) | has_no_fraction(p[1]) | has_no_fraction(p[2]) | has_no_fraction(p[3]))) {
    const auto extreme = [&](int side) {
      const auto of = [side](const Batch& x, const Batch& y) { return side < 0 ? xsimd::min(x, y) : xsimd::max(x, y); };
      return of(of(product_beside(x_lower, y_lower, side), product_beside(x_lower, y_upper, side)),
                of(product_beside(x_upper, y_lower, side), product_beside(x_upper, y_upper, side)));
    };
    lower = extreme(-1);
    upper = extreme(1);
  }
}

/// x / y, or the neighbour in double on one side unless it is a power of two.
inline Batch quotient_beside(const Batch& x, const Batch& y, int side) {
  const Batch q = x / y;
  return select(has_no_fraction(q) & (q * y == x), q, side < 0 ? below(q) : above(q));
}

}  // namespace sheen::number
