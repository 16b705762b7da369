#pragma once

#include "brdf/math.h"

namespace sheen::brdf {

/// The factor on D V of the sheen in the draft of KHR_materials_sheen from 2019, status "Experimental":
///
///   reflectance = max3(mix(0.04, baseColor, metallic))
///   f = base + (1 - reflectance) f_sheen,   f_sheen = sheenFactor sheenColor D V PI
///
/// D is Charlie's, V Ashikhmin's, sheenRoughness the roughness of the base, and the base is not scaled. The PI is the draft's: it
/// multiplies "lightColor", the light of a directional light as glTF has it, so its sheen is pi times as bright as D V says. What a
/// ratified asset leaves open, and the choice taken: it has no sheenFactor, which counts as 1, the draft's default; sheenColor is that of
/// the asset, by the ratified defaults; "metallicF0" is 0.04, for KHR_materials_ior and KHR_materials_specular came later; a base colour
/// above 1 (by COLOR_0) leaves no sheen rather than a negative one.
template <class Real>
Rgb<Real> draft_sheen_color(const Rgb<Real>& sheen_color, const Rgb<Real>& base_color, Real metallic) {
  const Real reflectance = Real(0.04) * (Real(1) - metallic) + max3(base_color) * metallic;
  return sheen_color * (max(Real(1) - reflectance, Real(0)) * Real(pi));
}

}  // namespace sheen::brdf
