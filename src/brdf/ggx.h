#pragma once

#include "brdf/math.h"

namespace sheen::brdf {

/// Up to this alpha, a roughness of 3e-5, a surface counts as a mirror: its highlight is thinner than any pixel.
inline constexpr double mirror_alpha = 1e-9;

/// GGX (Trowbridge-Reitz) distribution in 1/sr, glTF 2.0 Appendix B.3.2, in the form k^2/pi with k = alpha / (|NxH|^2 + alpha^2 (N.H)^2):
/// the printed (N.H)^2 (alpha^2 - 1) + 1 cancels near N.H = 1. A mirror gives punctual lights no highlight: 0.
/// @param alpha     square of roughness, [0, 1]
/// @param n_dot_h, sin2_theta_h  cosine and squared sine |N x H|^2 of the half vector's angle, [0, 1]
template <class Real>
Real ggx_distribution(Real alpha, Real n_dot_h, Real sin2_theta_h) {
  const auto distribution = [&] {
    const Real k = alpha / (sin2_theta_h + alpha * alpha * n_dot_h * n_dot_h);
    return Real(k * k * Real(1 / pi));
  };
  return select_of(alpha > Real(mirror_alpha), distribution, [] { return Real(0); });
}

/// Height-correlated Smith visibility G / (4 N.L N.V) of GGX, in 1/sr: Heitz 2014, equation 99; glTF 2.0 Appendix B.3.2.
/// @param n_dot_l, n_dot_v  cosines in [0, 1], not both 0
template <class Real>
Real smith_visibility(Real alpha, Real n_dot_l, Real n_dot_v) {
  const Real a2 = alpha * alpha;
  const Real v = n_dot_l * sqrt(a2 + (Real(1) - a2) * n_dot_v * n_dot_v);
  const Real l = n_dot_v * sqrt(a2 + (Real(1) - a2) * n_dot_l * n_dot_l);
  return Real(0.5) / (v + l);
}

/// The specular lobe D Vis in 1/sr. A mirror has none: 0, even where both cosines vanish with alpha and Vis has no value. Arguments as
/// above.
template <class Real>
Real specular_ggx(Real alpha, Real n_dot_l, Real n_dot_v, Real n_dot_h, Real sin2_theta_h) {
  const auto lobe = [&] { return Real(ggx_distribution(alpha, n_dot_h, sin2_theta_h) * smith_visibility(alpha, n_dot_l, n_dot_v)); };
  return select_of(alpha > Real(mirror_alpha), lobe, [] { return Real(0); });
}

}  // namespace sheen::brdf
