#pragma once

#include <cstddef>

#include "albedo/coordinates.h"
#include "albedo/ggx_albedo.h"
#include "albedo/patch_powers.h"
#include "brdf/math.h"
#include "number/lanes.h"

namespace sheen::albedo {

class GgxInterpolant;

/// ggx_albedo at one alpha, as a function of the cosine alone, in any number type: what GgxInterpolant::at_alpha gives, to rounding. All
/// surfaces of a material may have one alpha.
class GgxCurve {
 public:
  static constexpr int nodes = 9;          ///< of a patch
  static constexpr double patch_x = 0.66;  ///< of ln T, see coordinates.h
  static constexpr int patches = 16;       ///< down to n_dot_v = 5e-5

  double alpha() const { return alpha_; }

  /// Cosines below min_n_dot_v count as min_n_dot_v.
  template <class Real>
  brdf::LobeAlbedo<Real> operator()(const Real& n_dot_v) const {
    using brdf::exp;
    using brdf::log;
    using brdf::max;
    using brdf::min;
    using Lanes = number::Lanes<Real>;
    const Real mu = min(max(n_dot_v, Real(min_n_dot_v)), Real(1));
    if (!usable_) {
      double loss[Lanes::count];
      double bias[Lanes::count];
      Lanes::store(loss, mu);
      for (std::size_t i = 0; i < Lanes::count; ++i) {
        const GgxAlbedo slow = slowly(loss[i]);
        loss[i] = slow.loss;
        bias[i] = slow.bias;
      }
      return {Lanes::load(loss), Lanes::load(bias)};
    }
    const Real along = log(half_elevation_tangent(mu)) * Real(-1 / patch_x);
    double position[Lanes::count];
    double start[Lanes::count];
    std::size_t offset[Lanes::count];
    Lanes::store(position, along);
    for (std::size_t i = 0; i < Lanes::count; ++i) {
      const int patch = position[i] < patches ? static_cast<int>(position[i]) : patches - 1;
      start[i] = patch;
      offset[i] = static_cast<std::size_t>(patch) * nodes;
    }
    const Real local = Real(1) - Real(2) * (along - Lanes::load(start));
    return {exp(patch_polynomial<nodes>(log_loss_[0], offset, local)), patch_polynomial<nodes>(bias_[0], offset, local)};
  }

 private:
  friend class GgxInterpolant;
  GgxCurve(const GgxInterpolant& interpolant, double alpha) : interpolant_(&interpolant), alpha_(alpha) {}
  GgxAlbedo slowly(double n_dot_v) const;

  const GgxInterpolant* interpolant_;
  double alpha_;
  bool usable_ = true;
  // Over each patch, its ends at 1 (the larger cosine) and -1.
  double log_loss_[patches][nodes] = {};
  double bias_[patches][nodes] = {};
};

}  // namespace sheen::albedo
