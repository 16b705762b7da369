#pragma once

#include <cstddef>
#include <mutex>

#include "albedo/curve.h"
#include "albedo/ggx_interpolant.h"
#include "albedo/interpolant.h"
#include "albedo/peak.h"
#include "albedo/turns.h"
#include "brdf/multiple_scattering.h"
#include "golden/bound.h"
#include "number/lanes.h"

namespace sheen::golden {

/// E at a material's sheen roughness and at both ends of what a shader may hold of it.
struct AlbedoAround {
  /// Safe to call from many threads.
  class Curve {
   public:
    Curve(const albedo::Interpolant& albedo, double sheen_roughness) : e(albedo, sheen_roughness) {}
    const albedo::Curve e;
    /// Found when first asked for: it needs all of the curve near grazing angles.
    const albedo::Peak& peak() const;

   private:
    mutable std::once_flag found_;
    mutable albedo::Peak peak_{};
  };
  /// @param albedo  must outlive this
  AlbedoAround(const albedo::Interpolant& albedo, const Bound& sheen_roughness)
      : lower(albedo, sheen_roughness.range().lower),
        center(albedo, sheen_roughness.center()),
        upper(albedo, sheen_roughness.range().upper) {}
  Curve lower, center, upper;
};

/// Where E comes from. Plain pointers, so that a batched translation unit instantiates no container.
struct SheenAlbedo {
  const albedo::Interpolant* interpolant = nullptr;  ///< needed where a surface has sheen
  const albedo::Curve* curve = nullptr;              ///< at the roughness of one surface under many lights
  const AlbedoAround* around = nullptr;              ///< at the one roughness of all surfaces, for number types that have ranges
};

/// Albedo of the GGX lobe at the one alpha of a material.
struct GgxAround {
  albedo::GgxCurve at;
  albedo::Turns loss, bias;
  Bound alpha;                      ///< what a shader in highp may hold
  brdf::LobeAlbedo<Bound> average;  ///< of all of these, over the hemisphere
};

/// Where it comes from: only of the physical model.
struct BaseAlbedo {
  const albedo::GgxInterpolant* interpolant = nullptr;
  const GgxAround* around = nullptr;  ///< where all surfaces have one alpha, for number types that have ranges
};

/// With its alpha, by this much for each share of it, the loss changes at the most; the bias likewise, absolutely
/// (bounded_albedo_test.cpp).
inline constexpr double changes_with_alpha = 4;

/// A range of sheen roughness as Interpolant takes it. Plain numbers, as SheenAlbedo.
struct SheenRoughnesses {
  static constexpr std::size_t most = 36;

  albedo::SheenRoughness lower, center, upper;
  albedo::SheenRoughness place[most];  ///< between the ends of a wide one
  std::size_t count;                   ///< of those
};

/// A range of alpha as GgxInterpolant takes it, likewise.
struct GgxAlphas {
  static constexpr std::size_t most = 18;

  albedo::GgxAlpha lower, center, upper;
  albedo::GgxAlpha place[most];  ///< between the ends of a wide one
  std::size_t count;             ///< of those
};

/// A range of cosines that is wider than this share of its centre is wide: over it an albedo may bend one way and the other.
inline constexpr double wide_cosines = 1.0 / 16;

/// How a number type reads what is tabulated: lane by lane. A type that carries more than its value brings its own.
template <class Real>
struct AlbedoReader {
  using Lanes = number::Lanes<Real>;

  /// E at one sheen roughness.
  class Sheen {
   public:
    Sheen(const SheenAlbedo& albedo, const Real& sheen_roughness) : albedo_(albedo), sheen_roughness_(sheen_roughness) {}

    Real operator()(const Real& cosine) const {
      if (albedo_.curve != nullptr) {
        return (*albedo_.curve)(cosine);
      }
      double c[Lanes::count];
      double r[Lanes::count];
      Lanes::store(c, cosine);
      Lanes::store(r, sheen_roughness_);
      for (std::size_t i = 0; i < Lanes::count; ++i) {
        c[i] = (*albedo_.interpolant)(c[i], r[i]);
      }
      return Lanes::load(c);
    }

   private:
    SheenAlbedo albedo_;
    Real sheen_roughness_;
  };

  /// E(N.L), which `read` gives. A type that knows it to be no larger than E(N.V) may give that, which does as well where the larger
  /// counts.
  template <class Read>
  static Real for_light(const Real& /*e_v*/, const Real& /*n_dot_l*/, const Real& /*n_dot_v*/, const Read& read) {
    return read();
  }

  /// Albedo of the GGX lobe at one alpha.
  class Ggx {
   public:
    Ggx(const BaseAlbedo& albedo, const Real& alpha) : interpolant_(*albedo.interpolant), alpha_(alpha) {}
    brdf::LobeAlbedo<Real> operator()(const Real& cosine) const { return each(interpolant_, cosine, alpha_); }
    /// Over the hemisphere.
    brdf::LobeAlbedo<Real> average() const {
      return each([this](double, double a) { return interpolant_.average(a); }, alpha_, alpha_);
    }

   private:
    const albedo::GgxInterpolant& interpolant_;
    Real alpha_;
  };

 private:
  template <class Read>
  static brdf::LobeAlbedo<Real> each(const Read& read, const Real& cosine, const Real& alpha) {
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
};

}  // namespace sheen::golden
