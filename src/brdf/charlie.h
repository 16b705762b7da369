#pragma once

#include "brdf/math.h"

namespace sheen::brdf {

/// Up to this alpha_g, a sheen_roughness of 3e-5, the lobe counts as nothing: what is left of it lies within 1e-4 of N.H = 0, where 1 /
/// alpha_g leaves the range of floats soon.
inline constexpr double smallest_alpha_g = 9e-10;

/// The exponent p of sin^2(theta_h) in charlie_distribution().
template <class Real>
Real charlie_exponent(Real alpha_g) {
  return Real(0.5) / alpha_g;
}

/// charlie_distribution() of the squares of cosine and sine. @param p  charlie_exponent(), found once a material
template <class Real>
Real charlie_distribution_of_squares(Real alpha_g, Real p, Real cos2, Real sin2_theta_h) {
  // log1p keeps the digits of a small cosine that "1 - cos2" loses and that a large exponent would magnify.
  // At N.H = 1, where D is 0, a logarithm of 1e-30 leaves less than 1e-15 of it.
  const Real log_sin2 = select_of(
      cos2 < Real(0.25), [&] { return Real(log1p(-min(cos2, Real(0.25)))); }, [&] { return Real(log(max(sin2_theta_h, Real(1e-30)))); });
  const auto d = [&] { return Real((Real(1) + p) * exp(p * log_sin2) * Real(1 / pi)); };
  return select_of(alpha_g > Real(smallest_alpha_g), d, [] { return Real(0); });
}

/// The "Charlie" distribution D of the sheen lobe, in 1/sr: an exponentiated sinusoid, Conty Estevez and Kulla 2017, equation 2
/// (KHR_materials_sheen, "Sheen distribution"): (2 + 1/alpha_g) sin(theta_h)^(1/alpha_g) / (2 pi).
/// For alpha_g = 0 and up to smallest_alpha_g it returns the limit for N.H > 0, which is 0 (the printed code divides by zero at 0).
/// @param alpha_g   square of sheen_roughness, [0, 1]
/// @param n_dot_h   cosine of normal and half vector, [0, 1]
/// @param sin2_theta_h  its squared sine, |N x H|^2, [0, 1]; given apart because 1 - n_dot_h^2 cancels near N.H = 1
template <class Real>
Real charlie_distribution(Real alpha_g, Real n_dot_h, Real sin2_theta_h) {
  const Real cos2 = n_dot_h * n_dot_h;
  return charlie_distribution_of_squares(alpha_g, charlie_exponent(alpha_g), cos2, sin2_theta_h);
}

/// The curve l(x) of the shadowing term Lambda, with its five coefficients at one alpha_g, so that they are found once a material:
/// l(x) = a / (1 + b x^c) + d x + e, Conty Estevez and Kulla 2017, equation 3.
template <class Real>
struct LambdaCurve {
  Real a, b, c, d, e;
  Real middle;  ///< l(0.5), about which the second branch mirrors the first

  LambdaCurve() = default;
  LambdaCurve(Real a_in, Real b_in, Real c_in, Real d_in, Real e_in) : a(a_in), b(b_in), c(c_in), d(d_in), e(e_in), middle(l(Real(0.5))) {}

  Real l(Real x) const { return a / (Real(1) + b * pow_from_zero(x, c)) + d * x + e; }

  /// Lambda(cos_theta) >= 0, cos_theta in [0, 1]; the second branch mirrors the first about 0.5 (KHR_materials_sheen, lambda_sheen).
  Real lambda(Real cos_theta) const {
    const auto grazing = cos_theta < Real(0.5);
    const Real curve = l(select(grazing, cos_theta, Real(1) - cos_theta));
    return exp(select(grazing, curve, Real(2) * middle - curve));
  }
};

/// Lambda(N.V). Apart, for number types that find it in another way near N.V = 1, where the curve has no slope.
template <class Real>
Real lambda_of_view(const LambdaCurve<Real>& curve, const Real& n_dot_v) {
  return curve.lambda(n_dot_v);
}

/// l's coefficients as KHR_materials_sheen prints them, each mix(at alpha_g 1, at alpha_g 0) of a mixture by (1 - alpha_g)^2. Table 1 of
/// Conty Estevez and Kulla 2017.
template <class Real, class Mix>
LambdaCurve<Real> mixed_charlie_coefficients(const Mix& mix) {
  return {mix(21.5473, 25.3245), mix(3.82987, 3.32435), mix(0.19823, 0.16801), mix(-1.97760, -1.27393), mix(-4.32054, -4.85967)};
}

template <class Real>
LambdaCurve<Real> charlie_lambda_curve(Real alpha_g) {
  const Real t = (Real(1) - alpha_g) * (Real(1) - alpha_g);
  return mixed_charlie_coefficients<Real>([&t](double x, double y) { return mix(x, y, t); });
}

/// l's coefficients of "refined Charlie", Enterprise PBR Shading Model 2022x, sheen: w p1 + (1-w) p0 with
/// w = -1.59612 / (1 + 0.20375 alpha^-0.55825) + 1.32805. The document prints the weights the other way round; this order is the one that
/// reproduces its published table. The coefficients are taken from the Enterprise PBR Shading Model by Dassault Systemes, licensed
/// CC BY-SA 4.0; see NOTICE.
template <class Real>
LambdaCurve<Real> refined_lambda_curve(Real alpha_g) {
  // The power grows without limit toward alpha_g = 0, where the lobe itself is nothing.
  const Real alpha = max(alpha_g, Real(1e-9));
  const Real w = Real(1.32805) - Real(1.59612) / (Real(1) + Real(0.20375) * pow(alpha, Real(-0.55825)));
  const auto at = [&w](double p0, double p1) { return mix(p0, p1, w); };
  return {at(11.9095, 13.7000), at(4.68753, 2.92754), at(0.33467, 0.28670), at(-2.22664, -0.81757), at(-1.76591, -1.22466)};
}

/// Visibility of the sheen lobe times N.L, in 1/sr: G N.L / (4 N.L N.V) = 1 / ((1 + Lambda(N.V) + Lambda(N.L)) 4 N.V).
/// Folded because the printed product is 0/0 at N.L = 0 (KHR_materials_sheen, "Sheen visibility").
/// @param lambda_v, lambda_l  Lambda at both cosines
/// @param n_dot_v   (0, 1]
template <class Real>
Real charlie_visibility_times_n_dot_l(Real lambda_v, Real lambda_l, Real n_dot_v) {
  return Real(0.25) / ((Real(1) + lambda_v + lambda_l) * n_dot_v);
}

}  // namespace sheen::brdf
