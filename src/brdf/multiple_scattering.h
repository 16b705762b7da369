#pragma once

#include "brdf/math.h"

// What a microfacet lobe loses because light that meets a second facet is not followed, given back: Kulla and Conty 2017, "Revisiting
// Physically Based Shading at Imageworks", for the GGX lobe D Vis of ggx.h.
//
// With F = 1 the lobe's directional albedo is E(mu) < 1. The lobe
//
//   f_ms(l, v) = (1 - E(l)) (1 - E(v)) / (pi (1 - E_avg)),   E_avg = 2 integral of E(mu) mu dmu
//
// is reciprocal and has the albedo 1 - E(v), so that D Vis + f_ms reflects everything. For another Fresnel term a share F_avg E_avg leaves
// at once, F_avg (1 - E_avg) meets the surface again, and so on; summed from the second bounce on, over the 1 - E_avg that f_ms stands for:
//
//   F_ms = F_avg^2 E_avg / (1 - F_avg (1 - E_avg))
//
// (one F_avg more than the 2017 slides print: Hill 2018, "A Multi-Faceted Exploration", part 2). F_avg = 1 gives 1.

namespace sheen::brdf {

/// Albedo of the GGX lobe at one cosine, or its average over the hemisphere, cosine-weighted. Everything that Schlick's Fresnel term needs:
/// with F = f0 + (1 - f0) w it is f0 (1 - loss - bias) + bias.
template <class Real>
struct LobeAlbedo {
  Real loss;  ///< 1 - E, [0, 1]: kept as such, since 1 - E of a smooth lobe would lose its digits
  Real bias;  ///< integral of D Vis w N.L, w = (1 - V.H)^5; [0, 1]
};

/// Average of Schlick's reflectance over the hemisphere, cosine-weighted: 2 integral of (f0 + (1 - f0) (1 - mu)^5) mu dmu.
template <class Real>
Real average_fresnel(Real f0) {
  return Real(1.0 / 21) + Real(20.0 / 21) * f0;
}

/// F_ms. @param fresnel  F_avg; above 1 (a base colour above 1) it counts as 1, where the series of bounces would not end
/// @param average_loss  1 - E_avg, [0, 1)
template <class Real>
Real multiple_scattering_fresnel(Real fresnel, Real average_loss) {
  const Real f = min(fresnel, Real(1));
  return f * f * (Real(1) - average_loss) / (Real(1) - f * average_loss);
}

/// f_ms, in 1/sr. A mirror loses nothing: 0. @param light, view, average  losses 1 - E
template <class Real>
Real multiple_scattering_lobe(Real light, Real view, Real average) {
  return light * view * Real(1 / pi) / select(average > Real(0), average, Real(1));
}

}  // namespace sheen::brdf
