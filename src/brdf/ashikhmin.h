#pragma once

#include "brdf/math.h"

namespace sheen::brdf {

/// Visibility of the sheen lobe, G / (4 N.L N.V), in 1/sr: Ashikhmin and Premoze 2007, the form Neubelt and Pettineo 2013 use.
/// No transcendental and finite where both cosines vanish; with albedo scaling it conserves energy only for
/// sheen_roughness >= 0.4518 (KHR_materials_sheen warns of it, "Sheen visibility").
/// @param n_dot_l, n_dot_v  cosines in [0, 1], not both 0
template <class Real>
Real ashikhmin_visibility(Real n_dot_l, Real n_dot_v) {
  return Real(0.25) / (n_dot_l + n_dot_v - n_dot_l * n_dot_v);
}

}  // namespace sheen::brdf
