#pragma once

#include "brdf/fresnel.h"
#include "brdf/ggx.h"

namespace sheen::brdf {

/// The coat's weight k = clearcoat Fc, Fc = 0.04 + 0.96 (1 - |Nc.V|)^5: of N.V, not V.H, and of a fixed ior 1.5
/// (KHR_materials_clearcoat, "Layering"). Everything below the coat, emission included, is multiplied by 1 - k.
/// @param clearcoat  [0, 1]
/// @param nc_dot_v   cosine with the coat's own normal
template <class Real>
Real clearcoat_weight(Real clearcoat, Real nc_dot_v) {
  return clearcoat * (Real(0.04) + Real(0.96) * schlick_weight(nc_dot_v));
}

/// The coat's lobe D Vis, before its weight: GGX of alpha_c = clearcoatRoughness^2 about the coat's normal (KHR_materials_clearcoat,
/// "Clearcoat BRDF").
template <class Real>
using ClearcoatLobe = GgxLobe<Real>;

}  // namespace sheen::brdf
