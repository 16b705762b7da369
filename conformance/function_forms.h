#pragma once

#include "brdf/clearcoat.h"
#include "brdf/printed.h"
#include "brdf/sheen.h"
#include "golden/vec3.h"
#include "number/bounded_functions.h"

// What a conforming implementation may give for each function of shaders/: the formulas of src/brdf on number::Bounded, in the precision
// that the shader declares for each step, with the guards that it puts before what GLSL ES promises nothing about.

namespace sheen::conformance::forms {

using golden::Vec3;
using number::Bounded;
using number::Highp;
using number::Mediump;

/// A value held by a variable of another precision.
template <class To, class From>
Bounded<To> as(const Bounded<From>& x) {
  if constexpr (std::is_same_v<To, From>) {
    return x;
  } else {
    return number::converted<To>(x);
  }
}
template <class To, class From>
Vec3<Bounded<To>> as(const Vec3<Bounded<From>>& v) {
  return {as<To>(v.x), as<To>(v.y), as<To>(v.z)};
}

/// One or the other: what an implementation is free to choose.
template <class P>
Bounded<P> either(const Bounded<P>& a, const Bounded<P>& b) {
  return select(number::Truth(true, false), a, b);
}

/// dot() names no order for its sum.
template <class P>
Bounded<P> dot_in_any_order(const Vec3<Bounded<P>>& a, const Vec3<Bounded<P>>& b) {
  const Bounded<P> x = a.x * b.x;
  const Bounded<P> y = a.y * b.y;
  const Bounded<P> z = a.z * b.z;
  return either((x + y) + z, either((y + z) + x, (z + x) + y));
}

/// |v|^2: its terms are squares, so that none is negative.
template <class P>
Bounded<P> squared_length(const Vec3<Bounded<P>>& v) {
  return dot_in_any_order(v, v);
}

/// number::Bounded with the guards of the stable shaders, found by the formulas in the place of the bare functions.
template <class P>
struct Guarded : Bounded<P> {
  Guarded() = default;
  explicit Guarded(double value) : Bounded<P>(value) {}
  Guarded(const Bounded<P>& b) : Bounded<P>(b) {}  // NOLINT(google-explicit-constructor): the operators of Bounded give a Bounded

  /// sheen_lambda.glsl: x > 0 ? pow(x, y) : 0, for y > 0.
  friend Guarded pow(const Guarded& x, const Guarded& y) {
    if ((x.bare() > Bounded<P>(0)).is_false()) {
      return Guarded(0);
    }
    if (number::is_certainly_positive(x.bare())) {
      return number::pow(x.bare(), y.bare());
    }
    const double largest = std::max(x.range().upper, number::smallest_normal<P>);
    return either(Bounded<P>(0), number::pow(Bounded<P>::within(largest, 0), y.bare()));
  }

  // Those of the standard library would match its type better than Bounded's own do.
  friend Guarded min(const Guarded& a, const Guarded& b) { return min(a.bare(), b.bare()); }
  friend Guarded max(const Guarded& a, const Guarded& b) { return max(a.bare(), b.bare()); }

  /// sheen_distribution.glsl: log(max(x, 1e-30)). Below it sin^2 to the power p >= 1/2 is below 1e-15, which is all that it changes.
  friend Guarded log(const Guarded& x) { return number::log(max(x.bare(), Bounded<P>(1e-30))); }

 private:
  const Bounded<P>& bare() const { return *this; }
};

/// D of the sheen lobe. The exponent is highp whatever the precision, of a dot and a cross product that are not.
template <class P>
Bounded<P> sheen_distribution(const Vec3<Bounded<P>>& n, const Vec3<Bounded<P>>& h, const Bounded<P>& sheen_roughness) {
  using H = Bounded<Highp>;
  const H roughness = as<Highp>(sheen_roughness);
  const H alpha_g = roughness * roughness;
  const H n_dot_h = as<Highp>(dot_in_any_order(n, h));
  const H sin2 = squared_length(as<Highp>(cross(n, h)));
  // Below an exponent of -87.5 the shader takes 0, as whoever flushes subnormal numbers does.
  return as<P>(brdf::charlie_distribution<Guarded<Highp>>(alpha_g, n_dot_h, sin2));
}

template <class P>
Bounded<P> printed_sheen_distribution(const Vec3<Bounded<P>>& n, const Vec3<Bounded<P>>& h, const Bounded<P>& sheen_roughness) {
  return brdf::printed::sheen_distribution(sheen_roughness, dot_in_any_order(n, h));
}

/// mix(x, y, a). GLSL ES 3.00.6, section 8.3, says x (1 - a) + y a; the Khronos conformance tests let x + (y - x) a pass as well
/// (glsBuiltinPrecisionTests, Mix), which drops the digits of a small y.
template <class P>
Bounded<P> mix(const Bounded<P>& x, const Bounded<P>& y, const Bounded<P>& a) {
  return either(x * (Bounded<P>(1) - a) + y * a, x + (y - x) * a);
}

/// l's coefficients. The refined ones are highp until they are stored.
/// @tparam Real  Guarded<P> for the stable form, Bounded<P> for the printed one
template <class Real, class P>
brdf::LambdaCurve<Real> lambda_curve(brdf::Visibility visibility, const Bounded<P>& alpha_g) {
  if (visibility == brdf::Visibility::Charlie) {
    if constexpr (std::is_same_v<Real, Guarded<P>>) {
      return brdf::charlie_lambda_curve<Real>(alpha_g);
    } else {
      const Bounded<P> t = (Bounded<P>(1) - alpha_g) * (Bounded<P>(1) - alpha_g);
      return brdf::mixed_charlie_coefficients<Real>([&t](double x, double y) { return mix(Bounded<P>(x), Bounded<P>(y), t); });
    }
  }
  using H = Bounded<Highp>;
  const auto curve = brdf::refined_lambda_curve<H>(max(as<Highp>(alpha_g), H(1e-9)));
  return {as<P>(curve.a), as<P>(curve.b), as<P>(curve.c), as<P>(curve.d), as<P>(curve.e)};
}

/// Lambda. @tparam Real  as for lambda_curve: the printed form takes powers of 0
template <class Real, class P>
Bounded<P> sheen_lambda(brdf::Visibility visibility, const Bounded<P>& cos_theta, const Bounded<P>& alpha_g) {
  return lambda_curve<Real>(visibility, alpha_g).lambda(cos_theta);
}

/// V times N.L.
template <class P>
Bounded<P> sheen_visibility(brdf::Visibility visibility, const Bounded<P>& n_dot_l, const Bounded<P>& n_dot_v,
                            const Bounded<P>& sheen_roughness) {
  if (visibility == brdf::Visibility::Ashikhmin) {
    return brdf::ashikhmin_visibility(n_dot_l, n_dot_v) * n_dot_l;
  }
  const auto curve = lambda_curve<Guarded<P>>(visibility, sheen_roughness * sheen_roughness);
  return brdf::charlie_visibility_times_n_dot_l<Bounded<P>>(curve.lambda(n_dot_v), curve.lambda(n_dot_l), n_dot_v);
}

template <class P>
Bounded<P> printed_sheen_visibility(brdf::Visibility visibility, const Bounded<P>& n_dot_l, const Bounded<P>& n_dot_v,
                                    const Bounded<P>& sheen_roughness) {
  if (visibility == brdf::Visibility::Ashikhmin) {
    return brdf::printed::sheen_visibility_ashikhmin(n_dot_l, n_dot_v) * n_dot_l;
  }
  const auto curve = lambda_curve<Bounded<P>>(visibility, sheen_roughness * sheen_roughness);
  return brdf::printed::sheen_visibility(curve.lambda(n_dot_v), curve.lambda(n_dot_l), n_dot_v, n_dot_l) * n_dot_l;
}

/// sheen_roughness below which the stable form draws no sheen (renderer/shading.h).
inline constexpr double smallest_sheen_roughness = 3e-5;

/// D V N.L of the stable form, which draws none below smallest_sheen_roughness. There the truth is 0 but at the horizon, N.H = 0, where
/// what is narrower than any pixel is left out: there nothing is promised. e^-200 of what is left out is nothing to a float.
template <class P>
Bounded<P> sheen(brdf::Visibility visibility, const Vec3<Bounded<P>>& n, const Vec3<Bounded<P>>& h, const Bounded<P>& n_dot_l,
                 const Bounded<P>& n_dot_v, const Bounded<P>& sheen_roughness) {
  const double r = sheen_roughness.center();
  if (r >= smallest_sheen_roughness) {
    return sheen_distribution(n, h, sheen_roughness) * sheen_visibility(visibility, n_dot_l, n_dot_v, sheen_roughness);
  }
  const double n_dot_h = dot(n, h).center();
  const bool vanishes = r > 0 ? n_dot_h * n_dot_h > 400 * r * r : n_dot_h > 0;
  return vanishes ? Bounded<P>(0) : Bounded<P>::unbounded(0);
}

/// GGX D, for alpha above a mirror's.
template <class P>
Bounded<P> ggx_distribution(const Vec3<Bounded<P>>& n, const Vec3<Bounded<P>>& h, const Bounded<P>& alpha) {
  const Bounded<P> n_dot_h = dot_in_any_order(n, h);
  const Bounded<P> d = brdf::ggx_distribution(alpha, n_dot_h, squared_length(cross(n, h)));
  return select(n_dot_h > Bounded<P>(0), d, Bounded<P>(0));
}

template <class P>
Bounded<P> printed_ggx_distribution(const Vec3<Bounded<P>>& n, const Vec3<Bounded<P>>& h, const Bounded<P>& alpha) {
  const Bounded<P> n_dot_h = dot_in_any_order(n, h);
  return select(n_dot_h > Bounded<P>(0), brdf::printed::ggx_distribution(alpha, n_dot_h), Bounded<P>(0));
}

/// alpha up to which the base or the coat is a mirror, which punctual lights give no highlight.
inline constexpr double mirror_alpha = 1e-9;

/// D Vis N.L of the specular lobe.
template <class P>
Bounded<P> specular_ggx(const Vec3<Bounded<P>>& n, const Vec3<Bounded<P>>& h, const Bounded<P>& n_dot_l, const Bounded<P>& n_dot_v,
                        const Bounded<P>& alpha, bool printed) {
  using B = Bounded<P>;
  const B lobe = printed ? printed_ggx_distribution(n, h, alpha) * (brdf::printed::smith_visibility(alpha, n_dot_l, n_dot_v) * n_dot_l)
                         : ggx_distribution(n, h, alpha) * (brdf::smith_visibility(alpha, n_dot_l, n_dot_v) * n_dot_l);
  return select(alpha < B(mirror_alpha), B(0), lobe);
}

/// base N.L of a dielectric of f0 0.04 mixed with a metal: brdf::base_brdf with N.L multiplied into each of its terms, of which a small one
/// may be flushed.
template <class P>
brdf::Rgb<Bounded<P>> base(const Vec3<Bounded<P>>& n, const Vec3<Bounded<P>>& v, const Vec3<Bounded<P>>& h, const Bounded<P>& n_dot_l,
                           const Bounded<P>& n_dot_v, const Vec3<Bounded<P>>& color, const Bounded<P>& metallic, const Bounded<P>& alpha) {
  using B = Bounded<P>;
  const B w = brdf::schlick_weight(dot_in_any_order(v, h));
  const B lobe = specular_ggx(n, h, n_dot_l, n_dot_v, alpha, false);
  const B dielectric_fresnel = B(0.04) + B(0.96) * w;
  const auto channel = [&](const B& c) {
    const B dielectric = (B(1) - dielectric_fresnel) * (c * (n_dot_l * B(1 / brdf::pi))) + dielectric_fresnel * lobe;
    return dielectric * (B(1) - metallic) + (c + (B(1) - c) * w) * lobe * metallic;
  };
  return {channel(color.x), channel(color.y), channel(color.z)};
}

/// v / |v| as v inversesqrt(v.v).
template <class P>
Vec3<Bounded<P>> normalized(const Vec3<Bounded<P>>& v) {
  return v * inversesqrt(squared_length(v));
}

}  // namespace sheen::conformance::forms
