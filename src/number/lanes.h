#pragma once

#include <cstddef>

namespace sheen::number {

/// How many doubles a number type holds, and the way in and out of it; number::Batch has its own in batch.h.
template <class Real>
struct Lanes;

template <>
struct Lanes<double> {
  static constexpr std::size_t count = 1;
  static double load(const double* values) { return *values; }
  static void store(double* values, double x) { *values = x; }
  static double sum(double x) { return x; }
  /// The numbers at `offsets`, one a lane.
  static double pick(const double* values, const std::size_t* offsets) { return values[*offsets]; }
};

}  // namespace sheen::number
