#pragma once

#include "brdf/charlie.h"
#include "brdf/math.h"

// The shading code that the specifications print, operation by operation as it stands there. In exact arithmetic each function has the
// value of its counterpart in charlie.h, ashikhmin.h, ggx.h and fresnel.h; in floats it loses digits, divides by zero or takes a power of
// 0 where those do not. It serves to say how far.

namespace sheen::brdf::printed {

/// KHR_materials_sheen, "Sheen distribution", in 1/sr. sin2h cancels near N.H = 1; alpha_g = 0 divides by zero.
/// @param sheen_roughness  [0, 1]
template <class Real>
Real sheen_distribution(Real sheen_roughness, Real n_dot_h) {
  const Real alpha_g = sheen_roughness * sheen_roughness;
  const Real inv_r = Real(1) / alpha_g;
  const Real cos2h = n_dot_h * n_dot_h;
  const Real sin2h = Real(1) - cos2h;
  return (Real(2) + inv_r) * pow(sin2h, inv_r * Real(0.5)) / Real(2 * pi);
}

/// KHR_materials_sheen, "Sheen visibility", in 1/sr; Lambda is that of LambdaCurve, which the text prints as it is. Infinite at N.L = 0,
/// where its product with N.L is not.
template <class Real>
Real sheen_visibility(Real lambda_v, Real lambda_l, Real n_dot_v, Real n_dot_l) {
  return Real(1) / ((Real(1) + lambda_v + lambda_l) * (Real(4) * n_dot_v * n_dot_l));
}

/// The simpler visibility of the same section, in 1/sr.
template <class Real>
Real sheen_visibility_ashikhmin(Real n_dot_l, Real n_dot_v) {
  return Real(1) / (Real(4) * (n_dot_l + n_dot_v - n_dot_l * n_dot_v));
}

/// glTF 2.0, Appendix B.3.2: D = alpha^2 / (pi ((N.H)^2 (alpha^2 - 1) + 1)^2), in 1/sr. The bracket cancels near N.H = 1.
template <class Real>
Real ggx_distribution(Real alpha, Real n_dot_h) {
  const Real alpha_sq = alpha * alpha;
  const Real f = n_dot_h * n_dot_h * (alpha_sq - Real(1)) + Real(1);
  return alpha_sq / (Real(pi) * f * f);
}

/// The same section: the height-correlated visibility, in 1/sr.
template <class Real>
Real smith_visibility(Real alpha, Real n_dot_l, Real n_dot_v) {
  const Real alpha_sq = alpha * alpha;
  const Real ggx_v = n_dot_l * sqrt(n_dot_v * n_dot_v * (Real(1) - alpha_sq) + alpha_sq);
  const Real ggx_l = n_dot_v * sqrt(n_dot_l * n_dot_l * (Real(1) - alpha_sq) + alpha_sq);
  return Real(0.5) / (ggx_v + ggx_l);
}

/// glTF 2.0, Appendix B.3.2, and KHR_materials_clearcoat, "Layering": (1 - |cos|)^5 by pow, whose base is negative for a cosine an ulp
/// above 1.
template <class Real>
Real schlick_weight(Real cosine) {
  return pow(Real(1) - abs(cosine), Real(5));
}

}  // namespace sheen::brdf::printed
