#pragma once

#include "brdf/math.h"

namespace sheen::brdf {

/// Schlick's weight (1 - |cos|)^5, Schlick 1994. A cosine an ulp above 1 counts as 1.
template <class Real>
Real schlick_weight(Real cosine) {
  const Real x = max(Real(1) - abs(cosine), Real(0));
  const Real x2 = x * x;
  return x2 * x2 * x;
}

/// Reflectance at normal incidence of a boundary to air: ((1 - ior)/(1 + ior))^2. ior = 0 is legal and gives 1 (KHR_materials_ior).
template <class Real>
Real f0_from_ior(Real ior) {
  const Real r = (Real(1) - ior) / (Real(1) + ior);
  return r * r;
}

}  // namespace sheen::brdf
