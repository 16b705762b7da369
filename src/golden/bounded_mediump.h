#pragma once

#include "brdf/math.h"
#include "number/bounded_conversion.h"

namespace sheen::brdf {

/// shaders/ take the exponent of the sheen's distribution in highp whatever the precision of the rest: 1 / alpha_g leaves mediump's range.
template <>
struct Exponents<number::Bounded<number::Mediump>> {
  using Type = number::Bounded<number::Highp>;
  static Type widened(const number::Bounded<number::Mediump>& x) { return number::converted<number::Highp>(x); }
  static number::Bounded<number::Mediump> narrowed(const Type& x) { return number::converted<number::Mediump>(x); }
};

}  // namespace sheen::brdf
