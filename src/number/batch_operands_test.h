#pragma once

#include <cmath>
#include <random>

#include "number/bounded_batch.h"

namespace sheen::number::test {

template <class Precision>
using One = typename BoundedBatch<Precision>::One;

/// Operands of every kind: exact, uncertain, displaced, wide, about zero, near the format's ends, unbounded.
template <class Precision, class Random>
One<Precision> operand(Random& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  const int kind = std::uniform_int_distribution<int>(0, 20)(random);
  const double sign = uniform(random) < 0.3 ? -1 : 1;
  const double value = sign * std::pow(10, (Precision::holds_its_format ? 4 : 1.5) * (2 * uniform(random) - 1));
  const double size = std::abs(value) * std::pow(10, -3 - 4 * uniform(random));
  switch (kind) {
    case 0:
      return One<Precision>(0);
    case 1:
      return One<Precision>(std::ldexp(sign, std::uniform_int_distribution<int>(-9, 9)(random)));
    case 2:
      return One<Precision>(value);
    case 3:
      return One<Precision>::unbounded(value);
    case 4:
      return One<Precision>::within(value, 0.7 * std::abs(value));
    case 5:
      return One<Precision>::at_sample(0, size, -size, 1, 0.1 * size);
    case 6:
      return One<Precision>::within(value * smallest_normal<Precision>, size * smallest_normal<Precision>);
    case 7:
      return One<Precision>::within(0.4 * value * largest_finite<Precision> / 1e4, size);
    case 8:
      return One<Precision>::within(sign, 0x1p-20);
    default:
      return One<Precision>::at_sample(value, size * (2 * uniform(random) - 1), size * uniform(random), 1, kind % 2 * 1e-3 * size);
  }
}

}  // namespace sheen::number::test
