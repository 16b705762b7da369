#pragma once

#include <cstddef>

#include "number/bounded.h"
#include "number/lanes.h"

namespace sheen::number {

template <class Precision>
struct Lanes<Bounded<Precision>> {
  static constexpr std::size_t count = 1;
  static Bounded<Precision> load(const double* values) { return Bounded<Precision>(*values); }
};

/// The value as a variable of another precision holds it: correctly rounded, from mediump to highp exact.
template <class To, class From>
Bounded<To> converted(const Bounded<From>& x) {
  if (!x.is_bounded()) return Bounded<To>::unbounded(x.center());
  const bool exact = To::fraction_bits >= From::fraction_bits || (x.is_exact() && is_representable<To>(x.center()));
  using Error = typename Bounded<To>::Error;
  return Bounded<To>::rounded({x.center(), x.shift_x(), x.shift_y(), x.radius(), x.range()}, exact ? Error::absolute(0, 0) : Error::ulps(1),
                              true);
}

/// The same, to the type that the second argument points to; it is not looked at.
template <class To, class From>
Bounded<To> converted_to(const Bounded<From>& x, const Bounded<To>*) {
  return converted<To>(x);
}

}  // namespace sheen::number
