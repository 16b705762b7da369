#pragma once

#include <cstddef>

#include "albedo/coordinates.h"
#include "brdf/math.h"
#include "number/lanes.h"

namespace sheen::albedo {

class Interpolant;

/// E at one roughness, as a function of the cosine alone, in any number type: what Interpolant::at_roughness gives, to rounding. A surface
/// that is lit from a thousand directions asks for E as often.
class Curve {
 public:
  static constexpr int nodes = 12;                  ///< of a patch
  static constexpr int patches = 16;                ///< down to n_dot_v = 5e-5
  static constexpr double patch_x = -branch_x / 2;  ///< the length of a patch in x, so that the branch point is a border

  double sheen_roughness() const { return sheen_roughness_; }

  /// E, >= 0. Cosines below min_n_dot_v count as min_n_dot_v.
  template <class Real>
  Real operator()(const Real& n_dot_v) const {
    using brdf::exp;
    using brdf::log;
    using brdf::max;
    using brdf::min;
    using brdf::select;
    using brdf::sqrt;
    using Lanes = number::Lanes<Real>;
    if (!(sheen_roughness_ > 0)) {
      return Real(0);
    }
    const Real mu = min(max(n_dot_v, Real(min_n_dot_v)), Real(1));
    if (!usable_) {
      double each[Lanes::count];
      Lanes::store(each, mu);
      for (double& e : each) {
        e = slowly(e);
      }
      return Lanes::load(each);
    }
    const Real t = mu / (Real(1) + sqrt((Real(1) - mu) * (Real(1) + mu)));
    const Real drop = log(Real(1) + t * t) * Real(0.5 / (sheen_roughness_ * sheen_roughness_));
    const Real along = log(t) * Real(-1 / patch_x);
    double position[Lanes::count];
    double patch[Lanes::count];
    std::size_t offset[Lanes::count];
    Lanes::store(position, along);
    for (std::size_t i = 0; i < Lanes::count; ++i) {
      const int index = position[i] < patches - 1 ? static_cast<int>(position[i]) : patches - 1;
      patch[i] = index;
      offset[i] = static_cast<std::size_t>(index) * nodes;
    }
    const Real local = Real(1) - Real(2) * (along - Lanes::load(patch));
    Real h = Lanes::pick(powers_[0] + nodes - 1, offset);
    for (int power = nodes - 2; power >= 0; --power) {
      h = h * local + Lanes::pick(powers_[0] + power, offset);
    }
    return select(drop < Real(negligible_drop), exp(min(h, Real(700)) - drop), Real(0));
  }

 private:
  friend class Interpolant;
  Curve(const Interpolant& interpolant, double sheen_roughness) : interpolant_(&interpolant), sheen_roughness_(sheen_roughness) {}
  double slowly(double n_dot_v) const;

  const Interpolant* interpolant_;
  double sheen_roughness_;
  bool usable_ = true;
  double powers_[patches][nodes] = {};  // of h over each patch, its ends at 1 (the larger cosine) and -1
};

}  // namespace sheen::albedo
