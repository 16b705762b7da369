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

/// The base layer's BRDF in 1/sr: mix(dielectric_brdf, metal_brdf, metallic), glTF 2.0 Appendix B.3.5. Two BRDFs are mixed, not two f0:
/// mixing f0 first gives another diffuse term for 0 < metallic < 1.
/// @param n_dot_l, n_dot_v  cosines, (0, 1]
/// @param n_dot_h, sin2_theta_h  cosine and squared sine of the half vector's angle
/// @param v_dot_h  [0, 1]
template <class Real>
Rgb<Real> base_brdf(const Base<Real>& base, Real n_dot_l, Real n_dot_v, Real n_dot_h, Real sin2_theta_h, Real v_dot_h) {
  const Real w = schlick_weight(v_dot_h);
  const auto schlick = [&w](const Rgb<Real>& f0) {
    return Rgb<Real>{f0.r + (Real(1) - f0.r) * w, f0.g + (Real(1) - f0.g) * w, f0.b + (Real(1) - f0.b) * w};
  };
  const Real lobe = specular_ggx(base.alpha, n_dot_l, n_dot_v, n_dot_h, sin2_theta_h);
  const Rgb<Real> fr = schlick(base.dielectric_f0);
  const Rgb<Real> dielectric = base.color * ((Real(1) - base.specular * max3(fr)) * Real(1 / pi)) + fr * (base.specular * lobe);
  const Rgb<Real> metal = schlick(base.color) * lobe;
  return dielectric * (Real(1) - base.metallic) + metal * base.metallic;
}

}  // namespace sheen::brdf
