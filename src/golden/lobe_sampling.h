#pragma once

#include <cstddef>

#include "golden/shade.h"

namespace sheen::golden {

/// Ways to draw a direction toward the light at a surface: from the two parts of an image, and from each lobe that the surface has.
enum class Strategy : std::size_t { Soft, Bright, Cosine, Ggx, CoatGgx, Sheen };
inline constexpr std::size_t strategy_count = 6;
inline constexpr std::size_t first_lobe = 2;  // strategies before it draw from the image

constexpr std::size_t index_of(Strategy strategy) {
  return static_cast<std::size_t>(strategy);
}

/// A lobe's normal with tangents, and the view direction it is seen from.
struct LobeFrame {
  Vec3<double> t, b, n, v;
  double n_dot_v;
};

/// What directions are drawn from at one surface; plain numbers.
struct LobeSampling {
  LobeFrame base, coat;
  double alpha = 0, coat_alpha = 0, sheen_exponent = 0;
  static constexpr unsigned largest_total_weight = 19;
  unsigned weights[strategy_count] = {};  ///< how often each strategy draws: a power of two, or 0

  unsigned total_weight() const {
    unsigned sum = 0;
    for (const unsigned w : weights) {
      sum += w;
    }
    return sum;
  }
};

/// @param soft    whether to draw from that part of the image
/// @param bright  weight of the bright part: a power of two up to 4, or 0
LobeSampling lobe_sampling(const Surface<double>& surface, Layers layers, bool soft, unsigned bright);

/// A lobe of GGX with the constants that drawing from it takes.
template <class Real>
struct GgxSampler {
  double alpha;
  Vec3<Real> t, b, n, v;
  Vec3<Real> stretched;  // the view direction in the lobe's frame, stretched to the hemisphere of alpha = 1
  Real g1_over_4_n_dot_v;

  GgxSampler(const LobeFrame& frame, double alpha_in)
      : alpha(alpha_in), t(spread(frame.t)), b(spread(frame.b)), n(spread(frame.n)), v(spread(frame.v)) {
    using brdf::sqrt;
    const Real cosine(frame.n_dot_v);
    const Real a2(alpha * alpha);
    // Smith's G1 (Heitz 2018, equation 2) over 4 N.V.
    g1_over_4_n_dot_v = Real(0.5) / (cosine + sqrt(a2 + (Real(1) - a2) * cosine * cosine));
    const Vec3<Real> local{dot(v, t) * Real(alpha), dot(v, b) * Real(alpha), cosine};
    stretched = local * (Real(1) / sqrt(dot(local, local)));
  }

  static Vec3<Real> spread(const Vec3<double>& a) { return {Real(a.x), Real(a.y), Real(a.z)}; }

  Vec3<Real> world(const Real& x, const Real& y, const Real& z) const { return t * x + b * y + n * z; }

  /// Normals that the view direction sees, mirrored (Heitz 2018, by the cap of Dupuy and Benyoub 2023, listing 3).
  Vec3<Real> draw(const Real& u, const Real& cosine, const Real& sine) const {
    using brdf::max;
    using brdf::sqrt;
    const Real z = (Real(1) - u) * (Real(1) + stretched.z) - stretched.z;
    const Real r = sqrt(max(Real(1) - z * z, Real(0)));
    const Vec3<Real> h{(r * cosine + stretched.x) * Real(alpha), (r * sine + stretched.y) * Real(alpha), z + stretched.z};
    const Vec3<Real> unit = h * (Real(1) / sqrt(max(dot(h, h), Real(1e-300))));
    return mirrored(world(unit.x, unit.y, unit.z));
  }

  Vec3<Real> mirrored(const Vec3<Real>& h) const { return h * (Real(2) * dot(v, h)) - v; }

  /// D G1 / (4 N.V), 1/sr (Heitz 2018, equation 17).
  Real density(const Real& n_dot_h, const Real& sin2_theta_h) const {
    using brdf::min;
    using brdf::select;
    const Real d = brdf::ggx_distribution(Real(alpha), min(n_dot_h, Real(1)), sin2_theta_h);
    return select(n_dot_h > Real(0), d * g1_over_4_n_dot_v, Real(0));
  }
};

/// Draws from a surface's lobes, and says how densely.
template <class Real>
class LobeSampler {
 public:
  explicit LobeSampler(const LobeSampling& sampling)
      : sampling_(sampling), base_(sampling.base, sampling.alpha), coat_(sampling.coat, sampling.coat_alpha) {}

  /// A unit direction by a lobe's strategy for u in [0, 1) and an angle's cosine and sine; may lie below the surface.
  Vec3<Real> draw(Strategy strategy, const Real& u, const Real& cosine, const Real& sine) const {
    using brdf::exp;
    using brdf::log;
    using brdf::max;
    using brdf::sqrt;
    switch (strategy) {
      case Strategy::Ggx:
        return base_.draw(u, cosine, sine);
      case Strategy::CoatGgx:
        return coat_.draw(u, cosine, sine);
      case Strategy::Sheen: {
        // D cos(theta_h) integrates to 1 over the hemisphere, to sin^(n+2) up to theta_h.
        const Real s = exp(log(u) * Real(1 / (sampling_.sheen_exponent + 2)));
        return base_.mirrored(base_.world(s * cosine, s * sine, sqrt(max(Real(1) - s * s, Real(0)))));
      }
      default: {
        const Real r = sqrt(u);
        return base_.world(r * cosine, r * sine, sqrt(Real(1) - u));
      }
    }
  }

  /// Sum over the lobes' strategies of weight times density, 1/sr.
  Real weighted_density(const Vec3<Real>& direction) const {
    using brdf::abs;
    using brdf::exp;
    using brdf::log;
    using brdf::max;
    using brdf::min;
    using brdf::sqrt;
    const auto weight = [this](Strategy s) { return Real(static_cast<double>(sampling_.weights[index_of(s)])); };
    Real sum = max(dot(base_.n, direction), Real(0)) * (weight(Strategy::Cosine) * Real(1 / brdf::pi));
    const Half base(base_, direction);
    if (sampling_.weights[index_of(Strategy::Ggx)] > 0) {
      sum = sum + base_.density(base.n_dot_h, base.sin2) * weight(Strategy::Ggx);
    }
    if (sampling_.weights[index_of(Strategy::Sheen)] > 0) {
      const double n = sampling_.sheen_exponent;
      // V.H is half the length of V + L. A half vector drawn on the far side of V mirrors it as its opposite does.
      const Real d = exp(log(max(base.sin2, Real(1e-300))) * Real(0.5 * n)) * Real((n + 2) / (2 * brdf::pi));
      sum = sum + d * abs(base.n_dot_h) * base.inverse_length * (Real(0.5) * weight(Strategy::Sheen));
    }
    if (sampling_.weights[index_of(Strategy::CoatGgx)] > 0) {
      const Half coat(coat_, direction);
      sum = sum + coat_.density(coat.n_dot_h, coat.sin2) * weight(Strategy::CoatGgx);
    }
    return sum;
  }

 private:
  struct Half {
    Real n_dot_h, sin2, inverse_length;

    Half(const GgxSampler<Real>& lobe, const Vec3<Real>& direction) {
      using brdf::max;
      using brdf::min;
      using brdf::sqrt;
      const Vec3<Real> sum = direction + lobe.v;
      inverse_length = Real(1) / sqrt(max(dot(sum, sum), Real(1e-300)));
      const Vec3<Real> h = sum * inverse_length;
      const Vec3<Real> sine = cross(lobe.n, h);
      n_dot_h = dot(lobe.n, h);
      sin2 = min(dot(sine, sine), Real(1));
    }
  };

  const LobeSampling& sampling_;
  GgxSampler<Real> base_, coat_;
};

}  // namespace sheen::golden
