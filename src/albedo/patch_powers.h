#pragma once

#include <cstddef>

#include "number/lanes.h"

namespace sheen::albedo {

/// A polynomial over one of several patches, each lane's its own, by Horner's scheme.
/// @param powers  the coefficients, `nodes` a patch from the constant on
/// @param offset  of each lane's patch among them
template <int nodes, class Real>
Real patch_polynomial(const double* powers, const std::size_t* offset, const Real& at) {
  using Lanes = number::Lanes<Real>;
  Real h = Lanes::pick(powers + nodes - 1, offset);
  for (int power = nodes - 2; power >= 0; --power) {
    h = h * at + Lanes::pick(powers + power, offset);
  }
  return h;
}

}  // namespace sheen::albedo
