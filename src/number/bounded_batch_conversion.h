#pragma once

#include <cstddef>

#include "number/bounded_batch.h"

namespace sheen::number {

/// The lanes are samples: what is not of a sample, every one of them has.
template <class Precision>
struct Lanes<BoundedBatch<Precision>> {
  static constexpr std::size_t count = 1;
  static BoundedBatch<Precision> load(const double* values) { return BoundedBatch<Precision>(*values); }
};

/// As number::converted_to of Bounded.
template <class To, class From>
BoundedBatch<To> converted_to(const BoundedBatch<From>& x, const BoundedBatch<To>*) {
  using B = BoundedBatch<To>;
  constexpr bool widens = To::fraction_bits >= From::fraction_bits;
  using Error = typename B::Error;
  B out;
  out.round(x.as_exact(), widens ? Error::absolute(0, Batch(0.0)) : Error::ulps(Batch(1.0)), true);
  const auto one = [](const auto& lane) { return converted<Apart<To>>(lane); };
  out.settle(widens ? BatchMask(false) : x.is_exact(), x.is_unbounded(), one, x);
  return out;
}

}  // namespace sheen::number
