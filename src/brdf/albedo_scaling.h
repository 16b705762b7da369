#pragma once

#include "brdf/math.h"

namespace sheen::brdf {

/// How the base under the sheen is dimmed (KHR_materials_sheen, "Albedo-scaling technique"): by both directions, by the view alone (the
/// text's own simplification), not at all, or by both as printed, without the clamp to [0, 1] that keeps it from going negative where E
/// > 1.
enum class AlbedoScaling { Full, View, None, Literal };

/// The factor s on the base layer.
/// @param max_sheen_color  max3(sheenColor)
/// @param e_v, e_l         directional albedo of the sheen lobe at N.V and at N.L, white sheenColor, >= 0
template <class Real>
Real albedo_scale(AlbedoScaling scaling, Real max_sheen_color, Real e_v, Real e_l) {
  const Real view = Real(1) - max_sheen_color * e_v;
  const Real full = min(view, Real(1) - max_sheen_color * e_l);
  switch (scaling) {
    case AlbedoScaling::Full:
      return min(max(full, Real(0)), Real(1));
    case AlbedoScaling::View:
      return min(max(view, Real(0)), Real(1));
    case AlbedoScaling::Literal:
      return full;
    case AlbedoScaling::None:
      break;
  }
  return Real(1);
}

}  // namespace sheen::brdf
