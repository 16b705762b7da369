#pragma once

#include "brdf/math.h"

namespace sheen::brdf {

/// Up to this alpha, a roughness of 3e-5, a surface counts as a mirror: its highlight is thinner than any pixel.
inline constexpr double mirror_alpha = 1e-9;
constexpr bool is_mirror(double alpha) {
  return !(alpha > mirror_alpha);
}

/// GGX (Trowbridge-Reitz) distribution in 1/sr, glTF 2.0 Appendix B.3.2, in the form k^2/pi with k = alpha / (|NxH|^2 + alpha^2 (N.H)^2):
/// the printed (N.H)^2 (alpha^2 - 1) + 1 cancels near N.H = 1. A mirror gives punctual lights no highlight: 0. Of one angle's sine and
/// cosine the divisor is never below alpha^2; half of it is said in so many words, for number types that hold the two apart, where the half
/// vector may have any direction.
/// @param alpha     square of roughness, [0, 1]
/// @param n_dot_h, sin2_theta_h  cosine and squared sine |N x H|^2 of the half vector's angle, [0, 1]
template <class Real>
Real ggx_distribution(Real alpha, Real n_dot_h, Real sin2_theta_h) {
  const auto distribution = [&] {
    const Real a2 = alpha * alpha;
    const Real k = alpha / max(sin2_theta_h + a2 * n_dot_h * n_dot_h, a2 * Real(0.5));
    return Real(k * k * Real(1 / pi));
  };
  return select_of(alpha > Real(mirror_alpha), distribution, [] { return Real(0); });
}

/// The GGX lobe at one point, with what does not depend on the light found once.
template <class Real>
class GgxLobe {
 public:
  /// @param alpha    square of roughness, [0, 1]
  /// @param n_dot_v  [0, 1]
  GgxLobe(Real alpha, Real n_dot_v) : alpha_(alpha), n_dot_v_(n_dot_v), a2_(alpha * alpha), rest_(Real(1) - a2_), root_v_(root(n_dot_v)) {}

  /// Height-correlated Smith visibility G / (4 N.L N.V), in 1/sr: Heitz 2014, equation 99; glTF 2.0 Appendix B.3.2.
  /// @param n_dot_l  [0, 1], not 0 where N.V is
  Real visibility(Real n_dot_l) const {
    const Real v = n_dot_l * root_v_;
    const Real l = n_dot_v_ * root(n_dot_l);
    return Real(0.5) / (v + l);
  }

  /// The specular lobe D Vis in 1/sr. A mirror has none: 0, even where both cosines vanish with alpha and Vis has no value.
  /// @param n_dot_h, sin2_theta_h  as for ggx_distribution
  Real value(Real n_dot_l, Real n_dot_h, Real sin2_theta_h) const {
    return unless_mirror([&] { return Real(ggx_distribution(alpha_, n_dot_h, sin2_theta_h) * visibility(n_dot_l)); });
  }

  /// value() N.L with the cosine multiplied into Vis, as a shader has it whose small numbers lose their digits.
  Real value_times_n_dot_l(Real n_dot_l, Real n_dot_h, Real sin2_theta_h) const {
    return unless_mirror([&] { return Real(ggx_distribution(alpha_, n_dot_h, sin2_theta_h) * (visibility(n_dot_l) * n_dot_l)); });
  }

 private:
  Real root(const Real& cosine) const { return sqrt(a2_ + rest_ * cosine * cosine); }
  template <class Lobe>
  Real unless_mirror(const Lobe& lobe) const {
    return select_of(alpha_ > Real(mirror_alpha), lobe, [] { return Real(0); });
  }

  Real alpha_, n_dot_v_, a2_, rest_, root_v_;
};

/// GgxLobe::visibility() of all its arguments.
template <class Real>
Real smith_visibility(Real alpha, Real n_dot_l, Real n_dot_v) {
  return GgxLobe<Real>(alpha, n_dot_v).visibility(n_dot_l);
}

/// GgxLobe::value(), likewise.
template <class Real>
Real specular_ggx(Real alpha, Real n_dot_l, Real n_dot_v, Real n_dot_h, Real sin2_theta_h) {
  return GgxLobe<Real>(alpha, n_dot_v).value(n_dot_l, n_dot_h, sin2_theta_h);
}

}  // namespace sheen::brdf
