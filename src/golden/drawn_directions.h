#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "golden/bound.h"
#include "golden/layers.h"

namespace sheen::golden {

/// A way in which our shaders draw a direction toward an environment (shaders/environment_sampled.glsl); Image: in proportion to its
/// radiance.
enum class Way : std::size_t { Sphere, Cosine, Ggx, Coat, Sheen, Rim, Image };
inline constexpr std::size_t way_count = 7;
constexpr std::size_t index_of(Way way) {
  return static_cast<std::size_t>(way);
}

/// How many directions each way draws, by index_of().
using WayCounts = std::array<int, way_count>;

/// Of so many directions, all ways together; but each way that draws at all draws one at least.
WayCounts drawn_counts(const Surface<double>& surface, Layers layers, bool has_image, int directions);

/// A point of the unit square as a shader has it: x, inside (0, 1), and the cosine and sine of 2 pi y.
template <class Real>
struct DrawnPoint {
  Real x, cosine, sine;
};

/// A drawn direction with what it is off by as what a displaced sample is: along two axes across it, the same in all that comes of it, so
/// that it cancels in f / p. Its length is off by 8 roundings at the most.
Vec3<Bound> displaced(const Vec3<Bound>& drawn);

/// v / |v|, of what may be short as a shader has it.
template <class Real>
Vec3<Real> unit_along(const Vec3<Real>& v) {
  using brdf::inversesqrt;
  using brdf::max;
  return v * inversesqrt(max(dot(v, v), Real(1e-30)));
}

/// The directions that our shaders draw at a surface by each way but Image, and how densely. Written from the papers, as the shaders are.
/// @tparam Lobe  the arithmetic of the lobes' distributions
template <class Real, class Lobe = Real>
class DrawnDirections {
 public:
  DrawnDirections(const Surface<Real>& surface, Layers layers, const WayCounts& counts)
      : counts_(counts),
        base_(LobeView<Real>(surface.normal, surface.view)),
        coat_(LobeView<Real>(layers.clearcoat ? surface.coat_normal : surface.normal, surface.view)),
        alpha_(surface.base.alpha),
        coat_alpha_(draws(Way::Coat) ? surface.coat_alpha : Real(1)),
        sheen_roughness_(draws(Way::Sheen) ? surface.sheen_roughness : Real(1)) {}

  /// A unit direction but for roundings; may lie below the surface. Not by Image.
  Vec3<Real> draw(Way way, const DrawnPoint<Real>& p) const {
    using brdf::max;
    using brdf::sqrt;
    using std::exp2;
    using std::log2;
    const Real one(1);
    switch (way) {
      case Way::Ggx:
        return draw_ggx(base_, alpha_, p);
      case Way::Coat:
        return draw_ggx(coat_, coat_alpha_, p);
      case Way::Sheen: {
        // D cos(theta_h) integrates to sin^(2 + 1/alpha_g) up to theta_h.
        const Real exponent = one / (sheen_roughness_ * sheen_roughness_);
        const Real sine = exp2(log2(p.x) / (exponent + Real(2)));
        const Real cosine = sqrt(max(one - sine * sine, Real(1e-12)));
        return mirrored_at(base_.from_local(sine * p.cosine, sine * p.sine, cosine), base_.lobe.v);
      }
      case Way::Rim: {
        // Half vectors of V = N: D is ((1 - N.L) / 2)^(1 / (2 alpha_g)).
        const Real power = Real(0.5) / (sheen_roughness_ * sheen_roughness_);
        const Real below = exp2(log2(one - p.x) / (power + one));
        const Real r = sqrt(below * (Real(2) - below));
        return base_.from_local(r * p.cosine, r * p.sine, one - below);
      }
      case Way::Cosine: {
        const Real r = sqrt(p.x);
        return base_.from_local(r * p.cosine, r * p.sine, sqrt(one - p.x));
      }
      default: {
        const Real r = sqrt(p.x * (one - p.x)) * Real(2);
        return {r * p.cosine, r * p.sine, one - p.x * Real(2)};
      }
    }
  }

  /// The sum over all ways but Image of how many they draw times their density, 1/sr.
  Real density(const Vec3<Real>& direction) const {
    using brdf::abs;
    using brdf::max;
    using brdf::min;
    using brdf::select;
    using std::exp2;
    using std::log2;
    const Real one(1);
    const Real n_dot_l = dot(base_.lobe.n, direction);
    Real sum = weighted(Way::Sphere) * Real(0.25 / brdf::pi) + weighted(Way::Cosine) * max(n_dot_l, Real(0)) * Real(1 / brdf::pi);
    const Half half(base_.lobe, direction);
    const auto in_lobes = [](const Real& x) { return As<Lobe>::number(x); };
    if (draws(Way::Ggx)) {
      sum = sum + weighted(Way::Ggx) * ggx_density(base_.lobe, alpha_, half);
    }
    if (draws(Way::Coat)) {
      sum = sum + weighted(Way::Coat) * ggx_density(coat_.lobe, coat_alpha_, Half(coat_.lobe, direction));
    }
    if (draws(Way::Sheen)) {
      const Real alpha_g = sheen_roughness_ * sheen_roughness_;
      const Real cosine = abs(half.n_dot_h);
      const brdf::SheenLobe<Lobe> lobe(brdf::Visibility::Ashikhmin, in_lobes(sheen_roughness_), in_lobes(base_.lobe.n_dot_v));
      const Real d = As<Real>::number(lobe.distribution(Lobe(min(abs(half.lobe_n_dot_h), Lobe(1))), half.lobe_sin2));
      sum = sum + weighted(Way::Sheen) * (d * cosine / (Real(4) * max(half.v_dot_h, Real(1e-30))));
      const Real power = Real(0.5) / alpha_g;
      const Real rim = (power + one) * exp2(power * log2(max(one - n_dot_l, Real(1e-30)))) / Real(2 * brdf::pi);
      sum = sum + weighted(Way::Rim) * select(n_dot_l > Real(0), rim, Real(0));
    }
    return sum;
  }

 private:
  /// A lobe's normal as the third of three axes, and the view direction it is seen from.
  struct Frame {
    LobeView<Real> lobe;
    Vec3<Real> t, b;

    // Duff et al. 2017, "Building an Orthonormal Basis, Revisited", listing 3. Whichever way a driver turns it, phi is drawn evenly.
    explicit Frame(const LobeView<Real>& of) : lobe(of) {
      using brdf::select;
      const Vec3<Real>& n = lobe.n;
      const Real s = select(n.z < Real(0), Real(-1), Real(1));
      const Real a = Real(-1) / (s + n.z);
      const Real c = n.x * n.y * a;
      t = {Real(1) + s * n.x * n.x * a, s * c, Real(0) - s * n.x};
      b = {c, s + n.y * n.y * a, Real(0) - n.y};
    }
    Vec3<Real> from_local(const Real& x, const Real& y, const Real& z) const { return t * x + b * y + lobe.n * z; }
  };

  struct Half {
    Real n_dot_h, v_dot_h;
    Lobe lobe_n_dot_h, lobe_sin2;

    Half(const LobeView<Real>& lobe, const Vec3<Real>& direction) {
      using brdf::min;
      const Vec3<Real> h = unit_along(direction + lobe.v);
      n_dot_h = dot(lobe.n, h);
      v_dot_h = dot(lobe.v, h);
      const Vec3<Lobe> n = As<Lobe>::vector(lobe.n);
      const Vec3<Lobe> of_lobe = As<Lobe>::vector(h);
      const Vec3<Lobe> sine = cross(n, of_lobe);
      lobe_n_dot_h = dot(n, of_lobe);
      lobe_sin2 = min(dot(sine, sine), Lobe(1));
    }
  };

  static Vec3<Real> mirrored_at(const Vec3<Real>& h, const Vec3<Real>& v) { return unit_along(h * (dot(v, h) * Real(2)) - v); }

  // Heitz 2018, "Sampling the GGX Distribution of Visible Normals", by the cap of Dupuy and Benyoub 2023, listing 3.
  static Vec3<Real> draw_ggx(const Frame& frame, const Real& alpha, const DrawnPoint<Real>& p) {
    using brdf::max;
    using brdf::sqrt;
    const Vec3<Real>& v = frame.lobe.v;
    const Vec3<Real> stretched =
        unit_along(Vec3<Real>{alpha * dot(v, frame.t), alpha * dot(v, frame.b), max(dot(v, frame.lobe.n), Real(albedo::min_n_dot_v))});
    const Real below = p.x * (Real(1) + stretched.z);  // 1 - z of the point of the cap
    const Real r = sqrt(max(below * (Real(2) - below), Real(1e-20)));
    const Vec3<Real> h = unit_along(
        Vec3<Real>{alpha * (r * p.cosine + stretched.x), alpha * (r * p.sine + stretched.y), (Real(1) - p.x) * (Real(1) + stretched.z)});
    return mirrored_at(frame.from_local(h.x, h.y, h.z), v);
  }

  // D of visible normals, D G1 V.H / N.V, over 4 V.H (Heitz 2018, equations 2 and 17).
  static Real ggx_density(const LobeView<Real>& lobe, const Real& alpha, const Half& half) {
    using brdf::max;
    using brdf::min;
    using brdf::select;
    using brdf::sqrt;
    const Real a2 = alpha * alpha;
    const Real shadowed = Real(0.5) / (lobe.n_dot_v + sqrt(a2 + (Real(1) - a2) * lobe.n_dot_v * lobe.n_dot_v));
    const Lobe cosine = min(max(half.lobe_n_dot_h, Lobe(0)), Lobe(1));
    const Lobe d = brdf::ggx_distribution(As<Lobe>::number(alpha), cosine, half.lobe_sin2);
    return As<Real>::number(select(half.lobe_n_dot_h > Lobe(0), d, Lobe(0))) * shadowed;
  }

  Real weighted(Way way) const { return Real(static_cast<double>(counts_[index_of(way)])); }
  bool draws(Way way) const { return counts_[index_of(way)] > 0; }

  WayCounts counts_;
  Frame base_, coat_;
  Real alpha_, coat_alpha_, sheen_roughness_;
};

}  // namespace sheen::golden
