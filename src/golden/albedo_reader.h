#pragma once

#include <cstddef>

#include "albedo/curve.h"
#include "albedo/ggx_interpolant.h"
#include "albedo/interpolant.h"
#include "brdf/multiple_scattering.h"
#include "number/lanes.h"

namespace sheen::golden {

/// How a number type reads what is tabulated: lane by lane. A type that carries more than its value brings its own.
template <class Real>
struct AlbedoReader {
  using Lanes = number::Lanes<Real>;

  /// E at a cosine and a sheen_roughness; from `curve`, if there is one, at that one's roughness.
  static Real sheen(const albedo::Interpolant* albedo, const albedo::Curve* curve, const Real& cosine, const Real& sheen_roughness) {
    if (curve != nullptr) {
      return (*curve)(cosine);
    }
    double c[Lanes::count];
    double r[Lanes::count];
    Lanes::store(c, cosine);
    Lanes::store(r, sheen_roughness);
    for (std::size_t i = 0; i < Lanes::count; ++i) {
      c[i] = (*albedo)(c[i], r[i]);
    }
    return Lanes::load(c);
  }

  /// Whether E(N.L) is certain to be no larger than E(N.V), so that it need not be read.
  static bool is_smaller_for_light(const Real&, const Real&) { return false; }

  /// Albedo of the GGX lobe at a cosine.
  static brdf::LobeAlbedo<Real> ggx(const albedo::GgxInterpolant& ggx, const Real& cosine, const Real& alpha) {
    return each([&ggx](double c, double a) { return ggx(c, a); }, cosine, alpha);
  }
  /// Its average over the hemisphere.
  static brdf::LobeAlbedo<Real> ggx_average(const albedo::GgxInterpolant& ggx, const Real& alpha) {
    return each([&ggx](double, double a) { return ggx.average(a); }, alpha, alpha);
  }

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
