#pragma once

#include <cstddef>
#include <optional>
#include <type_traits>

#include "brdf/clearcoat.h"
#include "brdf/physical_base.h"
#include "brdf/sheen.h"
#include "golden/albedo_reader.h"
#include "golden/golden.h"
#include "golden/lights.h"
#include "golden/surface.h"

// The layers of a surface under one light after the other; shade.h puts them together.

namespace sheen::golden {

/// What shading depends on besides the surface. Plain pointers, so that the batched translation unit instantiates no container.
struct Lighting {
  const PreparedLight* lights = nullptr;
  std::size_t light_count = 0;
  albedo::SheenModel sheen;
  SheenAlbedo albedo;
  TermFactors factors;
  const DistantLights* distant = nullptr;  ///< of one surface, one a lane, instead of `lights`
  BaseAlbedo base_albedo = {};             ///< where there is one the base follows the physical model
};

/// Whether Shaded::lookup (shade.h) is wanted of a number type.
template <class Real>
inline constexpr bool finds_lookup_error = true;

/// One light's part, as the shading found it; see LightTerms. Where N.L is folded into the lobes, coat_lobe has it too.
template <class Real>
struct LightPart {
  Real n_dot_l, n_dot_h, d, v, e_l, scale, coat_lobe;
  brdf::Rgb<Real> sheen, base, coat;
  bool lit = false;  ///< whether it shines on any of what is shaded at once
};

/// That of a light that does not shine on it.
template <class Real>
LightPart<Real> no_light() {
  const Real none(0);
  const brdf::Rgb<Real> black{none, none, none};
  return {none, none, none, none, none, Real(1), none, black, black, black};
}

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

/// A number as the lobes' arithmetic has it, or back: the same, where that is the same.
template <class To>
struct As {
  static const To& number(const To& x) { return x; }
  template <class From>
  static To number(const From& x) {
    return converted_to(x, static_cast<const To*>(nullptr));
  }
  template <class From>
  static brdf::Rgb<To> color(const brdf::Rgb<From>& c) {
    return {number(c.r), number(c.g), number(c.b)};
  }
  template <class From>
  static Vec3<To> vector(const Vec3<From>& v) {
    return {number(v.x), number(v.y), number(v.z)};
  }
  template <class From>
  static brdf::Base<To> base(const brdf::Base<From>& b) {
    return {color(b.color), number(b.metallic), number(b.alpha), color(b.dielectric_f0), number(b.specular)};
  }
};

/// Whether N.L is multiplied into the lobes in their own arithmetic. shaders/ do that throughout: among mediump's small numbers it matters
/// which product loses its digits. In one arithmetic for all it does not.
template <class Real, class Lobe>
inline constexpr bool folds_cosines = !std::is_same_v<Real, Lobe>;

/// x N.L; or x, where the lobe that it is to weigh has N.L already.
template <class Lobe, class Real>
Real unless_folded(const Real& x, const Real& n_dot_l) {
  if constexpr (folds_cosines<Real, Lobe>) {
    return x;
  } else {
    return x * n_dot_l;
  }
}

/// The half vector's angles about a lobe's normal, as the lobes' arithmetic finds them of N, V and H.
template <class Lobe>
struct HalfAngles {
  Lobe n_dot_h, sin2_theta_h;

  HalfAngles() = default;
  template <class Real>
  HalfAngles(const LobeView<Real>& lobe, const Vec3<Real>& l) : v_(As<Lobe>::vector(lobe.v)) {
    using brdf::inversesqrt;
    using brdf::max;
    using brdf::min;
    const Vec3<Real> sum = l + lobe.v;
    // L = -V has no half vector; there N.L <= 0, so any finite one serves.
    h_ = As<Lobe>::vector(sum * inversesqrt(max(dot(sum, sum), Real(1e-30))));
    const Vec3<Lobe> n = As<Lobe>::vector(lobe.n);
    const Vec3<Lobe> sine = cross(n, h_);
    n_dot_h = min(max(dot(n, h_), Lobe(0)), Lobe(1));
    sin2_theta_h = min(dot(sine, sine), Lobe(1));
  }

  Lobe v_dot_h() const {
    using brdf::max;
    using brdf::min;
    return min(max(dot(v_, h_), Lobe(0)), Lobe(1));
  }

 private:
  Vec3<Lobe> v_, h_;
};

/// The base of the physical model at one point, with what does not depend on the light found once.
template <class Real>
struct PhysicalLayer {
  typename AlbedoReader<Real>::Ggx albedo;
  brdf::PhysicalBase<Real> base;

  PhysicalLayer(const brdf::Base<Real>& of, const Real& n_dot_v, const BaseAlbedo& base_albedo)
      : albedo(base_albedo, of.alpha), base(of, albedo(n_dot_v), albedo.average()) {}
};

/// x times one of TermFactors: x itself where that is 1, of which a shader knows nothing.
template <class Real>
Real times(const Real& x, double factor) {
  return factor == 1.0 ? x : x * Real(factor);
}
template <class Real>
brdf::Rgb<Real> times(const brdf::Rgb<Real>& c, double factor) {
  return factor == 1.0 ? c : c * Real(factor);
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
template <class Real, class Lobe = Real>
class SheenLayer {
 public:
  SheenLayer(const Surface<Real>& surface, const LobeView<Real>& lobe, const Lighting& lighting)
      : lobe_(lighting.sheen.visibility, As<Lobe>::number(surface.sheen_roughness), As<Lobe>::number(lobe.n_dot_v)),
        lighting_(lighting),
        albedo_at_(lighting.albedo, surface.sheen_roughness),
        n_dot_v_(lobe.n_dot_v),
        strength_(brdf::max3(surface.sheen_color)),
        e_v_(albedo_at_(n_dot_v_)) {}

  const Real& e_v() const { return e_v_; }
  const brdf::SheenLobe<Lobe>& lobe() const { return lobe_; }

  /// E(N.L); lanes without light cost nothing new.
  template <class Mask>
  Real e_l(const Mask& lit, const Real& n_dot_l) const {
    using brdf::select;
    return albedo_at_(select(lit, n_dot_l, n_dot_v_));
  }

  bool two_directions() const {
    return lighting_.sheen.scaling == brdf::AlbedoScaling::Full || lighting_.sheen.scaling == brdf::AlbedoScaling::Literal;
  }

  Real scale(const Real& e_l) const {
    return times(brdf::albedo_scale(lighting_.sheen.scaling, strength_, e_v_, e_l), lighting_.factors.scale);
  }

  /// The scale of a shader that reads E once, at the smaller of the two cosines.
  Real single_lookup_scale(const Real& n_dot_l, const Real& e_l) const {
    using brdf::select;
    const Real e = select(n_dot_l < n_dot_v_, e_l, e_v_);
    return times(brdf::albedo_scale(lighting_.sheen.scaling, strength_, e, e), lighting_.factors.scale);
  }

 private:
  brdf::SheenLobe<Lobe> lobe_;
  const Lighting& lighting_;
  typename AlbedoReader<Real>::Sheen albedo_at_;  // E at a cosine
  Real n_dot_v_;
  Real strength_;  // sheenColor's largest channel
  Real e_v_;
};

/// The coat at one point: its weight and its lobe (KHR_materials_clearcoat).
template <class Real, class Lobe = Real>
class CoatLayer {
 public:
  /// @param surface  has position, view, coat_normal, clearcoat and coat_alpha as Surface has
  template <class WithCoat>
  CoatLayer(const WithCoat& surface, const Lighting& lighting)
      : view_(surface.coat_normal, surface.view),
        lobe_(As<Lobe>::number(surface.coat_alpha), As<Lobe>::number(view_.n_dot_v)),
        factors_(lighting.factors),
        weight_(times(As<Real>::number(brdf::clearcoat_weight(As<Lobe>::number(surface.clearcoat), As<Lobe>::number(view_.n_dot_v))),
                      factors_.coat_weight)) {}

  const Real& weight() const { return weight_; }
  const Real& mirrored() const { return view_.mirrored; }

  /// What one light adds; see Shading::light.
  void add_light(const Arriving<Real>& light, LightPart<Real>& part) const {
    using brdf::any;
    const Real cosine = dot(view_.n, light.direction);
    if (!any(cosine > Real(0))) {
      return;
    }
    part.lit = true;
    add_lit(light, cosine, HalfAngles<Lobe>(view_, light.direction), part);
  }

  /// The same of one that shines here. @param cosine  N.L
  void add_lit(const Arriving<Real>& light, const Real& cosine, const HalfAngles<Lobe>& half, LightPart<Real>& part) const {
    using brdf::max;
    using brdf::min;
    using brdf::select;
    const auto lit = cosine > Real(0);
    const Real n_dot_l = min(max(cosine, Real(0)), Real(1));
    const Lobe of_lobe = As<Lobe>::number(n_dot_l);
    const Lobe lobe = folds_cosines<Real, Lobe> ? lobe_.value_times_n_dot_l(of_lobe, half.n_dot_h, half.sin2_theta_h)
                                                : lobe_.value(of_lobe, half.n_dot_h, half.sin2_theta_h);
    part.coat_lobe = times(As<Real>::number(lobe), factors_.coat_lobe);
    part.coat = light.irradiance * select(lit, unless_folded<Lobe>(weight_ * part.coat_lobe, n_dot_l), Real(0));
  }

 private:
  LobeView<Real> view_;
  brdf::ClearcoatLobe<Lobe> lobe_;
  const TermFactors& factors_;
  Real weight_;
};

/// What lies below the coat at one point: emission, sheen and base. There may be no coat.
template <class Real, class Lobe = Real>
class BelowCoat {
 public:
  using Color = brdf::Rgb<Real>;

  /// @param coat_weight  k of a coat, 0 where there is none
  BelowCoat(const Surface<Real>& surface, Layers layers, const Lighting& lighting, const Real& coat_weight)
      : surface_(surface),
        layers_(layers),
        lighting_(lighting),
        lobe_(surface.normal, surface.view),
        passed_(Real(1) - coat_weight),
        n_dot_v_(As<Lobe>::number(lobe_.n_dot_v)),
        base_(As<Lobe>::base(surface.base), n_dot_v_) {
    if (layers.sheen) {
      sheen_.emplace(surface, lobe_, lighting);
    }
    if (lighting.base_albedo.interpolant != nullptr) {
      physical_.emplace(base_.material(), n_dot_v_, lighting.base_albedo);
    }
  }

  const Real& n_dot_v() const { return lobe_.n_dot_v; }
  const Real& mirrored() const { return lobe_.mirrored; }
  Real e_v() const { return sheen_ ? sheen_->e_v() : Real(0); }
  Color emission() const { return through_coat(times(surface_.emission, lighting_.factors.emission)); }

  /// What one light adds; see Shading::light.
  /// @param half  becomes what the light and the base's normal enclose, if it shines there
  void add_light(const Arriving<Real>& light, bool wants_e_l, LightPart<Real>& part, Color& lookup, HalfAngles<Lobe>& half) const {
    using brdf::any;
    part.n_dot_l = dot(surface_.normal, light.direction);
    const auto lit = part.n_dot_l > Real(0);
    if (any(lit)) {
      part.lit = true;
      half = HalfAngles<Lobe>(lobe_, light.direction);
      add_lit(light, lit, wants_e_l, half, part, lookup);
    }
  }

 private:
  template <class Mask>
  void add_lit(const Arriving<Real>& light, const Mask& lit, bool wants_e_l, const HalfAngles<Lobe>& half, LightPart<Real>& part,
               Color& lookup) const {
    using brdf::max;
    using brdf::min;
    using brdf::select;
    const TermFactors& factors = lighting_.factors;
    const Real n_dot_l = min(max(part.n_dot_l, Real(0)), Real(1));
    part.n_dot_h = As<Real>::number(half.n_dot_h);
    const Color base = times(base_lobe(n_dot_l, half), factors.base);
    const Color irradiance = through_coat(light.irradiance);
    if (sheen_) {
      const bool needs_e_l = sheen_->two_directions() || wants_e_l;
      const auto read = [&] { return sheen_->e_l(lit, n_dot_l); };
      const Real e_l = needs_e_l ? AlbedoReader<Real>::for_light(sheen_->e_v(), n_dot_l, lobe_.n_dot_v, read) : Real(0);
      part.e_l = select(lit, e_l, Real(0));
      const Lobe d = times(sheen_->lobe().distribution(half.n_dot_h, half.sin2_theta_h), factors.distribution);
      const Lobe v = times(sheen_->lobe().visibility_times_n_dot_l(As<Lobe>::number(n_dot_l)), factors.visibility);
      part.d = As<Real>::number(d);
      part.v = As<Real>::number(v);
      part.scale = sheen_->scale(e_l);
      part.sheen = keep_where(lit, irradiance * As<Real>::color(As<Lobe>::color(surface_.sheen_color) * (d * v)));
      if (finds_lookup_error<Real> && sheen_->two_directions()) {
        const Real missed = sheen_->single_lookup_scale(n_dot_l, e_l) - part.scale;
        lookup = lookup + keep_where(lit, absolute(irradiance * base * unless_folded<Lobe>(missed, n_dot_l)));
      }
    }
    part.base = keep_where(lit, irradiance * base * unless_folded<Lobe>(part.scale, n_dot_l));
  }

  /// The base's BRDF; times N.L where the lobes' arithmetic folds it in.
  Color base_lobe(const Real& cosine, const HalfAngles<Lobe>& half) const {
    constexpr bool folds = folds_cosines<Real, Lobe>;
    const Lobe n_dot_l = As<Lobe>::number(cosine);
    const Lobe &h = half.n_dot_h, &sine = half.sin2_theta_h;
    if (physical_) {
      const auto albedo = physical_->albedo(n_dot_l);
      const brdf::PhysicalBase<Lobe>& base = physical_->base;
      return As<Real>::color(folds ? base.brdf_times_n_dot_l(albedo, n_dot_l, n_dot_v_, h, sine, half.v_dot_h())
                                   : base.brdf(albedo, n_dot_l, n_dot_v_, h, sine, half.v_dot_h()));
    }
    return As<Real>::color(folds ? base_.brdf_times_n_dot_l(n_dot_l, h, sine, half.v_dot_h())
                                 : base_.brdf(n_dot_l, h, sine, half.v_dot_h()));
  }

  Color through_coat(const Color& c) const { return layers_.clearcoat ? c * passed_ : c; }

  const Surface<Real>& surface_;
  Layers layers_;
  const Lighting& lighting_;
  LobeView<Real> lobe_;
  Real passed_;  // what the coat leaves of all below it
  Lobe n_dot_v_;
  brdf::BaseLayer<Lobe> base_;
  std::optional<SheenLayer<Real, Lobe>> sheen_;
  std::optional<PhysicalLayer<Lobe>> physical_;
};

}  // namespace sheen::golden
