#pragma once

#include <algorithm>
#include <cmath>

#include "albedo/ggx_table.h"
#include "albedo/lookup_error.h"
#include "golden/albedo_reader.h"
#include "golden/bound_all.h"
#include "golden/shade.h"
#include "number/bounded_conversion.h"

namespace sheen::golden {

/// Tabulated albedos on number::Bounded: value and slope at the centre, all that the arguments' ranges reach, and what a shader that reads
/// a table in highp is off. Over a narrow range of cosines an albedo bends one way at the most, so that what is left of the slope is found
/// at the ends, each with each of the other's and with its centre, and it exceeds what is found there by no more than that; of a wide one,
/// see wide_cosines, no slope is made use of, and where it turns in between is looked for.
template <class Precision>
struct AlbedoReader<number::Bounded<Precision>> {
  using B = number::Bounded<Precision>;

  static B sheen(const SheenAlbedo& albedo, const B& cosine, const B& sheen_roughness) {
    if (albedo.around != nullptr) {
      const auto around = [&albedo](End end) -> const AlbedoAround::Curve& {
        return end == End::Center ? albedo.around->center : end == End::Lower ? albedo.around->lower : albedo.around->upper;
      };
      return sheen([&](double c, End end) { return around(end).e(c); }, [&](End end) { return around(end).peak; }, cosine, sheen_roughness);
    }
    const auto e = at_ends(*albedo.interpolant, sheen_roughness);
    albedo::Peak of_center{};
    const auto peak = [&](End end) {
      if (end == End::Center || sheen_roughness.range().upper > widest_of_one_peak * sheen_roughness.range().lower) {
        return of_center = albedo::peak_of([&](double c) { return e(c, end); }, 8);
      }
      // Within hundredths of the centre's, of whose place a tenth is uncertain.
      return albedo::Peak::around(of_center.from, of_center.to, e(std::sqrt(of_center.from * of_center.to), end));
    };
    if (!cosine.is_bounded() || !sheen_roughness.is_bounded() || sheen_roughness.is_exact()) {
      return sheen(e, peak, cosine, sheen_roughness);
    }
    const auto three = [](const B& x) { return albedo::Interpolant::Triple{x.range().lower, x.center(), x.range().upper}; };
    const auto grid = albedo.interpolant->grid(three(cosine), three(sheen_roughness));
    const auto of_grid = [&](double c, End roughness) {
      const std::size_t column = c == cosine.center() ? 1 : c == cosine.range().lower ? 0 : 2;
      return grid.at(roughness == End::Center ? 1 : roughness == End::Lower ? 0 : 2).at(column);
    };
    return sheen(of_grid, peak, cosine, sheen_roughness);
  }

  template <class Read>
  static B for_light(const B& e_v, const B& n_dot_l, const B& n_dot_v, const Read& read) {
    const bool smaller = n_dot_v.is_bounded() && n_dot_l.is_bounded() && n_dot_v.range().lower >= albedo::decreasing_from &&
                         n_dot_l.range().lower >= n_dot_v.range().upper;
    return smaller ? e_v : read();
  }

  static brdf::LobeAlbedo<B> ggx(const albedo::GgxInterpolant& ggx, const B& cosine, const B& alpha) {
    return lobe([&ggx](double c, double a) { return ggx(c, a); }, cosine, alpha);
  }
  static brdf::LobeAlbedo<B> ggx_average(const albedo::GgxInterpolant& ggx, const B& alpha) {
    return lobe([&ggx](double, double a) { return ggx.average(a); }, B(1), alpha);
  }

 private:
  enum class End { Lower, Center, Upper };
  static constexpr double widest_of_one_peak = 1.05;  // ranges of roughness, the upper end over the lower

  /// f(x, y) with y given as the end of a range.
  template <class Function>
  static auto at_ends(const Function& f, const B& y) {
    return [&f, &y](double x, End end) {
      return f(x, end == End::Center ? y.center() : end == End::Lower ? y.range().lower : y.range().upper);
    };
  }

  /// @param e     of a cosine, at an end of the range of roughness
  /// @param peak  where that is largest, asked of the centre first
  template <class E, class PeakAt>
  static B sheen(const E& e, const PeakAt& peak, const B& cosine, const B& roughness) {
    const auto turn = [&](End end, const auto& include) {
      if (cosine.range().lower < albedo::decreasing_from) {
        const albedo::Peak p = peak(end);
        if (cosine.range().lower < p.to && p.from < cosine.range().upper) {
          include(p.e);
        }
      }
    };
    const auto error = [](double value, double c, double r) { return albedo::lookup_error(value, c, r); };
    return read(e, turn, cosine.range().lower < albedo::decreasing_from, error, cosine, roughness);
  }

  /// @param turn      includes what f may be between the ends of a wide range where it turns
  /// @param may_turn  whether it may do so in a narrow one
  template <class Function, class Turn, class Error>
  static B read(const Function& f, const Turn& turn, bool may_turn, const Error& error, const B& x, const B& y) {
    if (!x.is_bounded() || !y.is_bounded()) {
      return B::unbounded(0.0);  // their centres need not be numbers
    }
    const double value = f(x.center(), End::Center);
    const double width = x.range().upper - x.range().lower;
    const bool wide = width > wide_cosines * x.center();
    double lowest = value;
    double highest = value;
    double slope = 0;
    double remainder = 0;
    const auto reach = [&](double there) {
      lowest = std::min(lowest, there);
      highest = std::max(highest, there);
    };
    const auto include = [&](double cosine, double there) {
      reach(there);
      remainder = std::max(remainder, std::abs(there - value - slope * (cosine - x.center())));
    };
    const auto include_ends = [&](End end) {
      include(x.range().lower, f(x.range().lower, end));
      if (width > 0) {
        include(x.range().upper, f(x.range().upper, end));
      }
    };
    if (width > 0) {
      const double low = f(x.range().lower, End::Center);
      const double high = f(x.range().upper, End::Center);
      slope = wide ? 0.0 : (high - low) / width;
      include(x.range().lower, low);
      include(x.range().upper, high);
    }
    if (!y.is_exact()) {
      include_ends(End::Lower);
      include_ends(End::Upper);
    }
    if (wide) {
      turn(End::Center, reach);
      if (!y.is_exact()) {
        turn(End::Lower, reach);
        turn(End::Upper, reach);
      }
      remainder = std::max(highest - value, value - lowest);
    } else if (may_turn) {
      highest += remainder;
      lowest = std::max(0.0, lowest - remainder);
    }
    const double off = error(highest, x.center(), y.center());
    return B::rounded({value, slope * x.shift_x(), slope * x.shift_y(), std::abs(slope) * x.radius() + remainder, {lowest, highest}},
                      B::Error::absolute(0, off), true);
  }

  /// What a function of cosines reaches between two, that turns no more often than once an octave: at a few of them, and beyond by what
  /// neighbours differ.
  template <class Function, class Include>
  static void include_between(const Function& f, const number::Range& cosines, const Include& include) {
    constexpr int steps = 32;
    const double from = std::log(std::max(cosines.lower, albedo::min_n_dot_v));
    const double step = (std::log(std::max(cosines.upper, albedo::min_n_dot_v)) - from) / steps;
    double before = f(std::exp(from));
    for (int i = 1; i <= steps; ++i) {
      const double here = f(std::exp(from + i * step));
      include(std::max(here, before) + std::abs(here - before));
      include(std::max(0.0, std::min(here, before) - std::abs(here - before)));
      before = here;
    }
  }

  template <class Albedo>
  static brdf::LobeAlbedo<B> lobe(const Albedo& albedo, const B& cosine, const B& alpha) {
    const auto loss = [&albedo](double c, double a) { return albedo(c, a).loss; };
    const auto bias = [&albedo](double c, double a) { return albedo(c, a).bias; };
    // The shader's table holds the logarithms of loss and scale; its bias is what they leave of 1.
    const auto of_loss = [](double value, double, double) { return albedo::ggx_table_error * value; };
    const auto of_bias = [](double, double, double) { return albedo::ggx_table_error; };
    const auto of = [&](const auto& f, const auto& error) {
      const auto at = at_ends(f, alpha);
      const auto turn = [&](End end, const auto& include) {
        include_between([&](double c) { return at(c, end); }, cosine.range(), include);
      };
      return read(at, turn, true, error, cosine, alpha);
    };
    return {of(loss, of_loss), of(bias, of_bias)};
  }
};

/// The golden's own shading tells it.
template <class Precision>
inline constexpr bool finds_lookup_error<number::Bounded<Precision>> = false;

}  // namespace sheen::golden
