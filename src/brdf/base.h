#pragma once

#include "brdf/fresnel.h"
#include "brdf/ggx.h"

namespace sheen::brdf {

/// The metallic-roughness base of glTF 2.0 Appendix B with KHR_materials_ior and KHR_materials_specular.
template <class Real>
struct Base {
  Rgb<Real> color;          ///< base colour, linear
  Real metallic;            ///< [0, 1]
  Real alpha;               ///< square of roughness, [0, 1]
  Rgb<Real> dielectric_f0;  ///< min(f0(ior) specularColor, 1); 0.04 by default
  Real specular;            ///< specularFactor, [0, 1]; 1 by default
};

/// min(f0(ior) specularColor, 1), KHR_materials_specular, "Implementation".
template <class Real>
Rgb<Real> dielectric_f0(Real ior, const Rgb<Real>& specular_color) {
  const Rgb<Real> f0 = specular_color * f0_from_ior(ior);
  return {min(f0.r, Real(1)), min(f0.g, Real(1)), min(f0.b, Real(1))};
}

/// The base layer at one point, with what does not depend on the light found once.
template <class Real>
class BaseLayer {
 public:
  /// @param n_dot_v  cosine, (0, 1]
  BaseLayer(const Base<Real>& base, Real n_dot_v)
      : base_(base),
        lobe_(base.alpha, n_dot_v),
        dielectric_rest_(rest(base.dielectric_f0)),
        metal_rest_(rest(base.color)),
        dielectric_share_(Real(1) - base.metallic) {}

  const Base<Real>& material() const { return base_; }

  /// Its BRDF in 1/sr: mix(dielectric_brdf, metal_brdf, metallic), glTF 2.0 Appendix B.3.5. Two BRDFs are mixed, not two f0: mixing f0
  /// first gives another diffuse term for 0 < metallic < 1.
  /// @param n_dot_l  cosine, (0, 1]
  /// @param n_dot_h, sin2_theta_h  cosine and squared sine of the half vector's angle
  /// @param v_dot_h  [0, 1]
  Rgb<Real> brdf(Real n_dot_l, Real n_dot_h, Real sin2_theta_h, Real v_dot_h) const {
    return mixed(lobe_.value(n_dot_l, n_dot_h, sin2_theta_h), Real(1 / pi), v_dot_h);
  }

  /// brdf() N.L with the cosine multiplied into each of its terms; see GgxLobe::value_times_n_dot_l.
  Rgb<Real> brdf_times_n_dot_l(Real n_dot_l, Real n_dot_h, Real sin2_theta_h, Real v_dot_h) const {
    return mixed(lobe_.value_times_n_dot_l(n_dot_l, n_dot_h, sin2_theta_h), n_dot_l * Real(1 / pi), v_dot_h);
  }

 private:
  Rgb<Real> mixed(const Real& lobe, const Real& diffuse, const Real& v_dot_h) const {
    const Real w = schlick_weight(v_dot_h);
    const Rgb<Real> fr = base_.dielectric_f0 + dielectric_rest_ * w;
    const Rgb<Real> dielectric = base_.color * ((Real(1) - base_.specular * max3(fr)) * diffuse) + fr * (base_.specular * lobe);
    const Rgb<Real> metal = (base_.color + metal_rest_ * w) * lobe;
    return dielectric * dielectric_share_ + metal * base_.metallic;
  }

  static Rgb<Real> rest(const Rgb<Real>& f0) { return {Real(1) - f0.r, Real(1) - f0.g, Real(1) - f0.b}; }

  Base<Real> base_;
  GgxLobe<Real> lobe_;
  Rgb<Real> dielectric_rest_, metal_rest_;  // Schlick's 1 - f0
  Real dielectric_share_;
};

/// BaseLayer::brdf() of all its arguments.
template <class Real>
Rgb<Real> base_brdf(const Base<Real>& base, Real n_dot_l, Real n_dot_v, Real n_dot_h, Real sin2_theta_h, Real v_dot_h) {
  return BaseLayer<Real>(base, n_dot_v).brdf(n_dot_l, n_dot_h, sin2_theta_h, v_dot_h);
}

}  // namespace sheen::brdf
