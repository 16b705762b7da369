#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "albedo/ggx_table.h"
#include "albedo/lookup_error.h"
#include "golden/albedo_range.h"
#include "golden/albedo_reader.h"
#include "golden/bound_all.h"
#include "golden/ggx_range.h"
#include "golden/shade.h"
#include "number/bounded_conversion.h"

namespace sheen::golden {

/// Tabulated albedos on number::Bounded, see read_albedo: over a wide range of roughness E may turn (that of Charlie is least at a half).
template <class Precision>
struct AlbedoReader<number::Bounded<Precision>> {
  using B = number::Bounded<Precision>;

  static B sheen(const SheenAlbedo& albedo, const B& cosine, const B& sheen_roughness) {
    if (albedo.around != nullptr) {
      const auto around = [&albedo](End end) -> const AlbedoAround::Curve& {
        return end == End::Center ? albedo.around->center : end == End::Lower ? albedo.around->lower : albedo.around->upper;
      };
      return sheen([&](double c, End end) { return around(end).e(c); }, *albedo.interpolant, [&](End end) { return around(end).peak; },
                   cosine, sheen_roughness);
    }
    const auto e = at_ends(*albedo.interpolant, sheen_roughness);
    albedo::Peak of_center{};
    const auto peak = [&](End end) {
      if (end == End::Center || is_wide_roughness(sheen_roughness)) {
        return of_center = albedo::peak_of([&](double c) { return e(c, end); }, 8);
      }
      // Within hundredths of the centre's, of whose place a tenth is uncertain.
      return albedo::Peak::around(of_center.from, of_center.to, e(std::sqrt(of_center.from * of_center.to), end));
    };
    if (!cosine.is_bounded() || !sheen_roughness.is_bounded() || sheen_roughness.is_exact()) {
      return sheen(e, *albedo.interpolant, peak, cosine, sheen_roughness);
    }
    const auto three = [](const B& x) { return albedo::Interpolant::Triple{x.range().lower, x.center(), x.range().upper}; };
    const auto grid = albedo.interpolant->grid(three(cosine), three(sheen_roughness));
    const auto of_grid = [&](double c, End roughness) {
      const std::size_t column = c == cosine.center() ? 1 : c == cosine.range().lower ? 0 : c == cosine.range().upper ? 2 : 3;
      return column < 3 ? grid.at(roughness == End::Center ? 1 : roughness == End::Lower ? 0 : 2).at(column) : e(c, roughness);
    };
    return sheen(of_grid, *albedo.interpolant, peak, cosine, sheen_roughness);
  }

  template <class Read>
  static B for_light(const B& e_v, const B& n_dot_l, const B& n_dot_v, const Read& read) {
    const bool smaller = n_dot_v.is_bounded() && n_dot_l.is_bounded() && n_dot_v.range().lower >= albedo::decreasing_from &&
                         n_dot_l.range().lower >= n_dot_v.range().upper;
    return smaller ? e_v : read();
  }

  /// At one alpha, see GgxRange.
  class Ggx {
   public:
    Ggx(const BaseAlbedo& albedo, const B& alpha) : albedo_(albedo), alpha_(alpha) { GgxRange<B>::find(alpha, alphas_); }
    brdf::LobeAlbedo<B> operator()(const B& cosine) const { return GgxRange<B>::at(albedo_, alphas_, cosine, alpha_); }
    brdf::LobeAlbedo<B> average() const { return GgxRange<B>::average(albedo_, alphas_, alpha_); }

   private:
    BaseAlbedo albedo_;
    B alpha_;
    GgxAlphas alphas_;
  };

 private:
  static double not_known(double /*value*/) { return std::numeric_limits<double>::infinity(); }

  /// @param e     of a cosine, at an end of the range of roughness
  /// @param peak  where that is largest, asked of the centre first
  /// @param across  E of a cosine at any roughness
  template <class E, class Across, class PeakAt>
  static B sheen(const E& e, const Across& across, const PeakAt& peak, const B& cosine, const B& roughness) {
    const auto turn = [&](End end, const auto& include) {
      if (cosine.range().lower < albedo::decreasing_from) {
        const albedo::Peak p = peak(end);
        if (cosine.range().lower < p.to && p.from < cosine.range().upper) {
          include(p.e);
        }
      }
    };
    const auto error = [](double value, double c, double r) { return albedo::lookup_error(value, c, r); };
    const auto steps = [&](double c, const auto& include) {
      // Of a seventh of a roughness, which below a thousandth changes nothing.
      const Steps<40> places(std::max(roughness.range().lower, 1e-3), roughness.range().upper, 7);
      places.include_between([&](double r) { return across(c, r); }, include);
    };
    return read_albedo(e, steps, turn, cosine.range().lower < albedo::decreasing_from, error, not_known, cosine, roughness);
  }
};

/// The golden's own shading tells it.
template <class Precision>
inline constexpr bool finds_lookup_error<number::Bounded<Precision>> = false;

}  // namespace sheen::golden
