#pragma once

#include "brdf/base.h"
#include "brdf/multiple_scattering.h"

namespace sheen::brdf {

/// The metallic-roughness base with every bounce accounted for: positive, reciprocal, and reflecting no more than it receives; all of it
/// where nothing absorbs (a white metal, a white dielectric).
///
///   metal       = F D Vis + F_ms f_ms,   F of f0 = baseColor
///   dielectric  = specular F D Vis + F_ms f_ms + baseColor/pi (1 - E_s(l)) (1 - E_s(v)) / (1 - E_s,avg),   F of f0 = dielectric_f0
///   base        = (1 - metallic) dielectric + metallic metal
///
/// E_s is the albedo of the dielectric's specular part, both terms of it, in its largest channel, as KHR_materials_specular takes max3:
/// what is left for the diffuse part keeps the hue of baseColor. specular, the strength, weighs F at every bounce, F_avg included. A mix
/// with constant weights of two reciprocal BRDFs that conserve energy is such a BRDF. The diffuse part is that of Kelemen and Szirmay-Kalos
/// 2001, "A Microfacet Based Coupled Specular-Matte BRDF Model".
template <class Real>
class PhysicalBase {
 public:
  /// @param view     albedo of the base's lobe at N.V
  /// @param average  over the hemisphere
  PhysicalBase(const Base<Real>& base, const LobeAlbedo<Real>& view, const LobeAlbedo<Real>& average)
      : base_(base), view_(view), average_loss_(average.loss) {
    const auto ms = [this](const Rgb<Real>& f0, Real strength) {
      const auto of = [&](Real f) { return multiple_scattering_fresnel(strength * average_fresnel(f), average_loss_); };
      return Rgb<Real>{of(f0.r), of(f0.g), of(f0.b)};
    };
    dielectric_ms_ = ms(base.dielectric_f0, base.specular);
    metal_ms_ = ms(base.color, Real(1));
    transmitted_view_ = transmitted(view);
    const Real all = transmitted(average);
    // Nothing is transmitted where f0 = 1 (ior 0), and a millionth is as good as nothing.
    per_transmitted_ = Real(1) / max(all, Real(1e-6));
  }

  /// In 1/sr; arguments as for base_brdf. @param light  albedo of the lobe at N.L
  Rgb<Real> brdf(const LobeAlbedo<Real>& light, Real n_dot_l, Real n_dot_v, Real n_dot_h, Real sin2_theta_h, Real v_dot_h) const {
    const Real lobe = specular_ggx(base_.alpha, n_dot_l, n_dot_v, n_dot_h, sin2_theta_h);
    return mixed(diffuse(light), lobe, lobe * schlick_weight(v_dot_h), multiple(light));
  }

  /// brdf() N.L with the cosine multiplied into each of its terms; see GgxLobe::value_times_n_dot_l.
  Rgb<Real> brdf_times_n_dot_l(const LobeAlbedo<Real>& light, Real n_dot_l, Real n_dot_v, Real n_dot_h, Real sin2_theta_h,
                               Real v_dot_h) const {
    const Real lobe = GgxLobe<Real>(base_.alpha, n_dot_v).value_times_n_dot_l(n_dot_l, n_dot_h, sin2_theta_h);
    return mixed(diffuse(light) * n_dot_l, lobe, lobe * schlick_weight(v_dot_h), multiple(light) * n_dot_l);
  }

  /// What leaves toward the viewer under light of 1 from everywhere. f_ms and the diffuse part integrate to 1 - E(v) and 1 - E_s(v).
  /// @param specular, specular_w  integrals over the hemisphere of D Vis N.L and of D Vis w N.L
  Rgb<Real> light(Real specular, Real specular_w) const { return mixed(transmitted_view_, specular, specular_w, view_.loss); }

 private:
  /// 1 - E_s at one cosine, written as a sum of what is not negative: E_s nears 1 where f0 does.
  Real transmitted(const LobeAlbedo<Real>& albedo) const {
    const Real unreflected = (Real(1) - albedo.loss - albedo.bias) * (Real(1) - base_.specular * max3(base_.dielectric_f0));
    return unreflected + albedo.bias * (Real(1) - base_.specular) + albedo.loss * (Real(1) - max3(dielectric_ms_));
  }

  /// Of the diffuse part what the base colour multiplies, and f_ms.
  Real diffuse(const LobeAlbedo<Real>& light) const { return transmitted(light) * transmitted_view_ * per_transmitted_ * Real(1 / pi); }
  Real multiple(const LobeAlbedo<Real>& light) const { return multiple_scattering_lobe(light.loss, view_.loss, average_loss_); }

  Rgb<Real> mixed(Real diffuse, Real lobe, Real lobe_w, Real multiple) const {
    const auto schlick = [&](const Rgb<Real>& f0) { return f0 * (lobe - lobe_w) + Rgb<Real>{lobe_w, lobe_w, lobe_w}; };
    const Rgb<Real> dielectric = base_.color * diffuse + schlick(base_.dielectric_f0) * base_.specular + dielectric_ms_ * multiple;
    const Rgb<Real> metal = schlick(base_.color) + metal_ms_ * multiple;
    return dielectric * (Real(1) - base_.metallic) + metal * base_.metallic;
  }

  Base<Real> base_;
  LobeAlbedo<Real> view_;
  Real average_loss_, transmitted_view_, per_transmitted_;
  Rgb<Real> dielectric_ms_, metal_ms_;
};

}  // namespace sheen::brdf
