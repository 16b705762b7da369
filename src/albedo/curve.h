#pragma once

#include <atomic>
#include <cstddef>

#include "albedo/coordinates.h"
#include "albedo/patch_places.h"
#include "albedo/patch_powers.h"
#include "brdf/math.h"
#include "number/lanes.h"

namespace sheen::albedo {

class Interpolant;

/// E at one roughness, as a function of the cosine alone, in any number type: what the interpolant gives, to rounding. A surface that is
/// lit from a thousand directions asks for E as often. Each patch is made when first asked for. Safe to call from many threads.
class Curve {
 public:
  /// @param interpolant  must outlive this
  Curve(const Interpolant& interpolant, double sheen_roughness);
  Curve(const Curve&) = delete;
  Curve& operator=(const Curve&) = delete;

  static constexpr int nodes = 12;                  ///< of a patch
  static constexpr double patch_x = -branch_x / 2;  ///< the length of a patch in x, so that the branch point is a border
  /// Patches reach down to n_dot_v = 5e-5. What would be the first is four: about normal incidence a rough cloth's E bends within 1 / p.
  static constexpr int quarters = 4;
  static constexpr int patches = quarters + 15;

  /// The patch that a place lies in, places being counted in lengths of a patch.
  static int patch_at(double place) {
    return place < 1                    ? static_cast<int>(place * quarters)
           : place < patches - quarters ? static_cast<int>(place) + quarters - 1
                                        : patches - 1;
  }
  static double start_of(int patch) { return patch < quarters ? patch * (1.0 / quarters) : patch - (quarters - 1); }
  static double length_of(int patch) { return patch < quarters ? 1.0 / quarters : 1.0; }

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
    const Real t = mu / (Real(1) + sqrt((Real(1) - mu) * (Real(1) + mu)));
    const Real drop = log(Real(1) + t * t) * Real(0.5 / (sheen_roughness_ * sheen_roughness_));
    const Real along = log(t) * Real(-1 / patch_x);
    double position[Lanes::count];
    double start[Lanes::count];
    double per_length[Lanes::count];
    std::size_t offset[Lanes::count];
    Lanes::store(position, along);
    bool usable = true;
    for (std::size_t i = 0; i < Lanes::count; ++i) {
      const int patch = patch_at(position[i]);
      usable = is_usable(patch) && usable;
      start[i] = start_of(patch);
      per_length[i] = 1 / length_of(patch);
      offset[i] = static_cast<std::size_t>(patch) * nodes;
    }
    if (!usable) {
      double each[Lanes::count];
      Lanes::store(each, mu);
      for (double& e : each) {
        e = slowly(e);
      }
      return Lanes::load(each);
    }
    const Real local = Real(1) - Real(2) * (along - Lanes::load(start)) * Lanes::load(per_length);
    const Real h = patch_polynomial<nodes>(powers_[0], offset, local);
    return select(drop < Real(negligible_drop), exp(min(h, Real(700)) - drop), Real(0));
  }

 private:
  enum class State : unsigned char { Unmade, Usable, Unusable };

  bool is_usable(int patch) const {
    const State state = state_[patch].load(std::memory_order_acquire);
    return (state == State::Unmade ? make(patch) : state) == State::Usable;
  }
  State make(int patch) const;
  double slowly(double n_dot_v) const;

  const Interpolant* interpolant_;
  double sheen_roughness_;
  PlaceInRow<nodes> place_;                         // of the roughness among the interpolant's, where it is above 0
  mutable std::atomic<State> state_[patches] = {};  // of the powers
  mutable double powers_[patches][nodes] = {};      // of h over each patch, its ends at 1 (the larger cosine) and -1
};

}  // namespace sheen::albedo
