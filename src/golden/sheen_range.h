#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "albedo/lookup_error.h"
#include "golden/albedo_range.h"
#include "golden/albedo_reader.h"

namespace sheen::golden {

/// E over ranges of the cosine and of the sheen roughness, as GgxRange. Over a wide range of roughness it may turn: that of Charlie is
/// least at a half.
/// @tparam B  number::Bounded
template <class B>
struct SheenRange {
  static void find(const B& roughness, SheenRoughnesses& roughnesses) {
    const auto& range = roughness.range();
    roughnesses.lower = albedo::Interpolant::roughness(range.lower);
    roughnesses.center = albedo::Interpolant::roughness(roughness.center());
    roughnesses.upper = albedo::Interpolant::roughness(range.upper);
    roughnesses.count = 0;
    if (roughness.is_bounded() && is_wide_roughness(roughness)) {
      const Steps<SheenRoughnesses::most - 1> steps(std::max(range.lower, least_roughness), range.upper, steps_in_e);
      for (; roughnesses.count <= steps.count; ++roughnesses.count) {
        roughnesses.place[roughnesses.count] = albedo::Interpolant::roughness(steps.place[roughnesses.count]);
      }
    }
  }

  /// @param roughnesses  what find() says of the roughness; not needed where all surfaces have one
  static B at(const SheenAlbedo& albedo, const SheenRoughnesses& roughnesses, const B& cosine, const B& roughness) {
    if (!cosine.is_bounded() || !roughness.is_bounded()) {
      return B::unbounded(0.0);  // their centres need not be numbers
    }
    if (albedo.around != nullptr) {
      const auto around = [&albedo](End end) -> const AlbedoAround::Curve& {
        return end == End::Center ? albedo.around->center : end == End::Lower ? albedo.around->lower : albedo.around->upper;
      };
      return narrow([&](double c, End end) { return around(end).e(c); }, [&](End end) { return around(end).peak(); }, cosine, roughness);
    }
    const albedo::Interpolant& interpolant = *albedo.interpolant;
    Kept<albedo::SheenCosine> cosines(albedo::Interpolant::cosine);
    if (!is_wide_roughness(roughness)) {
      const auto e = [&](double c, End end) { return interpolant(cosines.at(c), of_end(roughnesses, end)); };
      albedo::Peak of_center{};
      const auto peak = [&](End end) {
        if (end == End::Center) {
          return of_center = albedo::peak_of([&](double c) { return e(c, end); }, 8);
        }
        // Within hundredths of the centre's, of whose place a tenth is uncertain.
        return albedo::Peak::around(of_center.from, of_center.to, e(std::sqrt(of_center.from * of_center.to), end));
      };
      return narrow(e, peak, cosine, roughness);
    }
    const auto& range = cosine.range();
    AlbedoGrid<SheenRoughnesses::most> grid(roughnesses.count);
    const double share = for_cosines(cosine, steps_in_e, [&](double c) {
      albedo::SheenCosine there = albedo::Interpolant::cosine(c);
      grid.add([&](std::size_t i) { return interpolant(there, roughnesses.place[i]); });
    });
    const double value = interpolant(cosines.at(cosine.center()), roughnesses.center);
    const double bends = e_bends * share * share;
    double off = 0;
    const number::Range held = grid.held(value, bends, bends);
    for (const double c : {range.lower, range.upper}) {
      for (const double r : {roughness.range().lower, roughness.center(), roughness.range().upper}) {
        off = std::max(off, albedo::lookup_error(held.upper, c, r));
      }
    }
    return within<B>(value, held, off);
  }

  /// What E departs by, between two cosines as near as narrow_cosines, from what it is at either, for each square of their share: where it
  /// is less than 1 absolutely, else relatively (bounded_albedo_test.cpp).
  static constexpr double e_bends = 30;

 private:
  /// Up to it E is nothing at any cosine from min_n_dot_v on.
  static constexpr double least_roughness = 7e-6;
  /// It bends over a ratio of e of either argument. SheenRoughnesses has room for steps of a third from least_roughness to 1.
  static constexpr double steps_in_e = 4;

  static const albedo::SheenRoughness& of_end(const SheenRoughnesses& roughnesses, End end) {
    return end == End::Center ? roughnesses.center : end == End::Lower ? roughnesses.lower : roughnesses.upper;
  }

  /// @param e     of a cosine, at an end of the range of roughness
  /// @param peak  where that is largest, asked of the centre first
  template <class E, class PeakAt>
  static B narrow(const E& e, const PeakAt& peak, const B& cosine, const B& roughness) {
    const bool may_turn = cosine.range().lower < albedo::decreasing_from;
    const auto turn = [&](End end, const auto& include) {
      if (may_turn) {
        const albedo::Peak p = peak(end);
        if (cosine.range().lower < p.to && p.from < cosine.range().upper) {
          include(p.e);
        }
      }
    };
    const auto error = [](double value, double c, double r) { return albedo::lookup_error(value, c, r); };
    const auto together = [](double) { return std::numeric_limits<double>::infinity(); };
    return read_albedo(e, turn, may_turn, error, together, cosine, roughness);
  }
};

}  // namespace sheen::golden
