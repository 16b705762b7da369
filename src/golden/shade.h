#pragma once

#include <cstddef>
#include <optional>
#include <type_traits>

#include "albedo/curve.h"
#include "albedo/ggx_interpolant.h"
#include "albedo/interpolant.h"
#include "brdf/clearcoat.h"
#include "brdf/physical_base.h"
#include "brdf/sheen.h"
#include "golden/golden.h"
#include "golden/lights.h"
#include "golden/surface.h"
#include "number/lanes.h"

namespace sheen::golden {

/// What shading depends on besides the surface. Plain pointers, so that the batched translation unit instantiates no container.
struct Lighting {
  const PreparedLight* lights = nullptr;
  std::size_t light_count = 0;
  albedo::SheenModel sheen;
  const albedo::Interpolant* albedo = nullptr;  ///< needed where a surface has sheen
  TermFactors factors;
  /// One surface under many lights: E at its roughness, and these, one a lane, instead of `lights`.
  const albedo::Curve* curve = nullptr;
  const DistantLights* distant = nullptr;
  const albedo::GgxInterpolant* ggx = nullptr;  ///< of the physical model alone, which it makes the base follow
};

/// Radiance of a surface, and what the approximations granted to a shader, and its roundings where they are magnified, may change in it.
template <class Real>
struct Shaded {
  brdf::Rgb<Real> radiance;
  brdf::Rgb<Real> magnitude;  ///< sum of the terms' absolute values: equals radiance unless a scale went negative (`literal`)
  brdf::Rgb<Real> lookup;     ///< error of reading E once, at min(N.V, N.L), instead of taking the larger of two, and at the rims of cones
  Real mirrored;              ///< 1 where N.V <= 0 mirrored V, of either lobe's normal, else 0
};

/// One light's part, as the shading found it; see LightTerms.
template <class Real>
struct LightPart {
  Real n_dot_l, n_dot_h, d, v, e_l, scale, coat_lobe;
  brdf::Rgb<Real> sheen, base, coat;
};

/// What does not depend on a light.
template <class Real>
struct ViewPart {
  Real n_dot_v, e_v, coat_weight;
  brdf::Rgb<Real> emission;
};

/// A listener that the optimiser removes.
struct NoListener {
  static constexpr bool wants_e_l = false;
  template <class Real>
  void view(const ViewPart<Real>&) {}
  template <class Real>
  void light(std::size_t, const LightPart<Real>&) {}
};

/// A lobe's normal with the view direction it is seen from: mirrored where N.V <= 0, its cosine floored.
template <class Real>
struct LobeView {
  Vec3<Real> n, v;
  Real n_dot_v;
  Real mirrored;

  LobeView(const Vec3<Real>& normal, const Vec3<Real>& view) : n(normal), v(view) {
    using brdf::max;
    using brdf::min;
    using brdf::select;
    const Real cosine = dot(normal, view);
    v = view - normal * (Real(2) * min(cosine, Real(0)));
    n_dot_v = min(max(dot(n, v), Real(albedo::min_n_dot_v)), Real(1));
    mirrored = select(cosine > Real(0), Real(0), Real(1));
  }
};

/// The half vector's angles about a lobe's normal.
template <class Real>
struct HalfAngles {
  Real n_dot_h, sin2_theta_h, v_dot_h;

  HalfAngles(const LobeView<Real>& lobe, const Vec3<Real>& l) {
    using brdf::max;
    using brdf::min;
    using brdf::sqrt;
    const Vec3<Real> sum = l + lobe.v;
    // L = -V has no half vector; there N.L <= 0, so any finite one serves.
    const Vec3<Real> h = sum * (Real(1) / sqrt(max(dot(sum, sum), Real(1e-300))));
    const Vec3<Real> sine = cross(lobe.n, h);
    n_dot_h = min(max(dot(lobe.n, h), Real(0)), Real(1));
    sin2_theta_h = min(dot(sine, sine), Real(1));
    v_dot_h = min(max(dot(lobe.v, h), Real(0)), Real(1));
  }
};

/// E for every lane.
template <class Real>
Real directional_albedo(const albedo::Interpolant& albedo, const Real& cosine, const Real& sheen_roughness) {
  constexpr std::size_t count = number::Lanes<Real>::count;
  double c[count];
  double r[count];
  number::Lanes<Real>::store(c, cosine);
  number::Lanes<Real>::store(r, sheen_roughness);
  for (std::size_t i = 0; i < count; ++i) {
    c[i] = albedo(c[i], r[i]);
  }
  return number::Lanes<Real>::load(c);
}

/// Albedo of the GGX lobe for every lane: at a cosine, or averaged over the hemisphere.
template <class Real, class Read>
brdf::LobeAlbedo<Real> ggx_albedo(const Read& read, const Real& cosine, const Real& alpha) {
  using Lanes = number::Lanes<Real>;
  double c[Lanes::count];
  double a[Lanes::count];
  Lanes::store(c, cosine);
  Lanes::store(a, alpha);
  for (std::size_t i = 0; i < Lanes::count; ++i) {
    const albedo::GgxAlbedo of = read(c[i], a[i]);
    c[i] = of.loss;
    a[i] = of.bias;
  }
  return {Lanes::load(c), Lanes::load(a)};
}

/// The base of the physical model at one point, with what does not depend on the light found once.
template <class Real>
brdf::PhysicalBase<Real> physical_base(const brdf::Base<Real>& base, const Real& n_dot_v, const albedo::GgxInterpolant& ggx) {
  const auto average = [&ggx](double, double alpha) { return ggx.average(alpha); };
  return {base, ggx_albedo(ggx, n_dot_v, base.alpha), ggx_albedo(average, n_dot_v, base.alpha)};
}

template <class Mask, class Real>
brdf::Rgb<Real> keep_where(const Mask& mask, const brdf::Rgb<Real>& c) {
  using brdf::select;
  return {select(mask, c.r, Real(0)), select(mask, c.g, Real(0)), select(mask, c.b, Real(0))};
}

template <class Real>
brdf::Rgb<Real> absolute(const brdf::Rgb<Real>& c) {
  using brdf::abs;
  return {abs(c.r), abs(c.g), abs(c.b)};
}

/// The sheen layer at one point: lobe, E and the scale it puts on what lies below (KHR_materials_sheen).
template <class Real>
class SheenLayer {
 public:
  SheenLayer(const Surface<Real>& surface, const LobeView<Real>& lobe, const Lighting& lighting)
      : lobe_(lighting.sheen.visibility, surface.sheen_roughness, lobe.n_dot_v),
        lighting_(lighting),
        roughness_(surface.sheen_roughness),
        n_dot_v_(lobe.n_dot_v),
        color_(surface.sheen_color),
        e_v_(albedo_at(n_dot_v_)) {}

  const Real& e_v() const { return e_v_; }
  const brdf::SheenLobe<Real>& lobe() const { return lobe_; }

  /// E(N.L); lanes without light cost nothing new.
  template <class Mask>
  Real e_l(const Mask& lit, const Real& n_dot_l) const {
    using brdf::select;
    return albedo_at(select(lit, n_dot_l, n_dot_v_));
  }

  bool two_directions() const {
    return lighting_.sheen.scaling == brdf::AlbedoScaling::Full || lighting_.sheen.scaling == brdf::AlbedoScaling::Literal;
  }

  Real scale(const Real& e_l) const {
    return brdf::albedo_scale(lighting_.sheen.scaling, brdf::max3(color_), e_v_, e_l) * Real(lighting_.factors.scale);
  }

  /// The scale of a shader that reads E once, at the smaller of the two cosines.
  Real single_lookup_scale(const Real& n_dot_l, const Real& e_l) const {
    using brdf::select;
    const Real e = select(n_dot_l < n_dot_v_, e_l, e_v_);
    return brdf::albedo_scale(lighting_.sheen.scaling, brdf::max3(color_), e, e) * Real(lighting_.factors.scale);
  }

 private:
  Real albedo_at(const Real& cosine) const {
    return lighting_.curve != nullptr ? (*lighting_.curve)(cosine) : directional_albedo(*lighting_.albedo, cosine, roughness_);
  }

  brdf::SheenLobe<Real> lobe_;
  const Lighting& lighting_;
  Real roughness_, n_dot_v_;
  brdf::Rgb<Real> color_;
  Real e_v_;
};

/// Radiance toward the camera, in lux / sr:
///   L_o = sum over lights E [ (1-k) (f_sheen + s base) max(N.L,0) + k D_c Vis_c max(Nc.L,0) ] + (1-k) emission.
/// Every term passes `listener`, so that what is reported and what is drawn come from one evaluation.
template <class Real, class Listener>
Shaded<Real> shade(const Surface<Real>& surface, Layers layers, const Lighting& lighting, Listener&& listener) {
  using brdf::max;
  using brdf::min;
  using brdf::select;
  using Color = brdf::Rgb<Real>;
  const Color zero{Real(0), Real(0), Real(0)};
  const TermFactors& factors = lighting.factors;
  const LobeView<Real> lobe(surface.normal, surface.view);
  const LobeView<Real> coat(layers.clearcoat ? surface.coat_normal : surface.normal, surface.view);
  const Real k = layers.clearcoat ? brdf::clearcoat_weight(surface.clearcoat, coat.n_dot_v) * Real(factors.coat_weight) : Real(0);
  const Real below = Real(1) - k;
  std::optional<SheenLayer<Real>> sheen;
  if (layers.sheen) {
    sheen.emplace(surface, lobe, lighting);
  }

  std::optional<brdf::PhysicalBase<Real>> physical;
  if (lighting.ggx != nullptr) {
    physical.emplace(physical_base(surface.base, lobe.n_dot_v, *lighting.ggx));
  }

  const Color emission = surface.emission * (below * Real(factors.emission));
  listener.view(ViewPart<Real>{lobe.n_dot_v, sheen ? sheen->e_v() : Real(0), k, emission});
  Shaded<Real> out{emission, absolute(emission), zero, max(lobe.mirrored, coat.mirrored)};

  for (std::size_t i = 0; i < lighting.light_count; ++i) {
    const Arriving<Real> light = lighting.distant != nullptr ? lighting.distant->arriving<Real>(i * number::Lanes<Real>::count)
                                                             : arriving(lighting.lights[i], surface.position);
    const Real cosine = dot(surface.normal, light.direction);
    const auto lit = cosine > Real(0);
    LightPart<Real> part{cosine, Real(0), Real(0), Real(0), Real(0), Real(1), Real(0), zero, zero, zero};

    const Real n_dot_l = min(max(cosine, Real(0)), Real(1));
    const HalfAngles<Real> half(lobe, light.direction);
    part.n_dot_h = half.n_dot_h;
    const Color base = (physical ? physical->brdf(ggx_albedo(*lighting.ggx, n_dot_l, surface.base.alpha), n_dot_l, lobe.n_dot_v,
                                                  half.n_dot_h, half.sin2_theta_h, half.v_dot_h)
                                 : brdf::base_brdf(surface.base, n_dot_l, lobe.n_dot_v, half.n_dot_h, half.sin2_theta_h, half.v_dot_h)) *
                       Real(factors.base);
    const Color irradiance_below = light.irradiance * below;
    if (sheen) {
      const bool needs_e_l = sheen->two_directions() || std::remove_cvref_t<Listener>::wants_e_l;
      const Real e_l = needs_e_l ? sheen->e_l(lit, n_dot_l) : Real(0);
      part.e_l = select(lit, e_l, Real(0));
      part.d = sheen->lobe().distribution(half.n_dot_h, half.sin2_theta_h) * Real(factors.distribution);
      part.v = sheen->lobe().visibility_times_n_dot_l(n_dot_l) * Real(factors.visibility);
      part.scale = sheen->scale(e_l);
      part.sheen = keep_where(lit, irradiance_below * surface.sheen_color * (part.d * part.v));
      if (sheen->two_directions()) {
        const Real missed = sheen->single_lookup_scale(n_dot_l, e_l) - part.scale;
        out.lookup = out.lookup + keep_where(lit, absolute(irradiance_below * base * (missed * n_dot_l)));
      }
    }
    part.base = keep_where(lit, irradiance_below * base * (part.scale * n_dot_l));

    if (layers.clearcoat) {
      const Real coat_cosine = dot(surface.coat_normal, light.direction);
      const auto coat_lit = coat_cosine > Real(0);
      const Real nc_dot_l = min(max(coat_cosine, Real(0)), Real(1));
      const HalfAngles<Real> coat_half(coat, light.direction);
      part.coat_lobe = brdf::clearcoat_lobe(surface.coat_alpha, nc_dot_l, coat.n_dot_v, coat_half.n_dot_h, coat_half.sin2_theta_h) *
                       Real(factors.coat_lobe);
      part.coat = keep_where(coat_lit, light.irradiance * (k * part.coat_lobe * nc_dot_l));
    }
    listener.light(i, part);
    out.radiance = out.radiance + part.sheen + part.base + part.coat;
    const Color magnitude = absolute(part.sheen) + absolute(part.base) + absolute(part.coat);
    out.magnitude = out.magnitude + magnitude;
    out.lookup = out.lookup + magnitude * light.rounding;
  }
  return out;
}

}  // namespace sheen::golden
