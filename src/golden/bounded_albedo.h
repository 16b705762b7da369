#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "albedo/ggx_places.h"
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
/// see wide_cosines, no slope is made use of, and where it turns in between is looked for. Over a wide range of roughness it may turn too
/// (E of Charlie is least at a half).
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
      const std::size_t column = c == cosine.center() ? 1 : c == cosine.range().lower ? 0 : 2;
      return grid.at(roughness == End::Center ? 1 : roughness == End::Lower ? 0 : 2).at(column);
    };
    return sheen(of_grid, *albedo.interpolant, peak, cosine, sheen_roughness);
  }

  template <class Read>
  static B for_light(const B& e_v, const B& n_dot_l, const B& n_dot_v, const Read& read) {
    const bool smaller = n_dot_v.is_bounded() && n_dot_l.is_bounded() && n_dot_v.range().lower >= albedo::decreasing_from &&
                         n_dot_l.range().lower >= n_dot_v.range().upper;
    return smaller ? e_v : read();
  }

  static brdf::LobeAlbedo<B> ggx(const BaseAlbedo& albedo, const B& cosine, const B& alpha) {
    if (albedo.around != nullptr && !straddles_mirrors(alpha)) {
      return about(*albedo.around, cosine, alpha);
    }
    const double grazing = 1 - cosine.range().lower;
    albedo::GgxPlaces places(*albedo.interpolant);
    return lobe([&](double c, double a) { return places(c, a); }, cosine, alpha, std::pow(grazing, 5) + more_bias);
  }
  static brdf::LobeAlbedo<B> ggx_average(const BaseAlbedo& albedo, const B& alpha) {
    return lobe([&](double, double a) { return albedo.interpolant->average(a); }, B(1), alpha, 1.0 / 21 + more_bias);
  }

  // Over decades of alpha (bounded_albedo_test.cpp): the most that a lobe loses at any cosine, and what its bias is at the most beyond a
  // mirror's, which is (1 - cosine)^5.
  static double most_loss(double alpha) { return 0.11 + 0.59 * std::min(alpha, 1.0); }
  static constexpr double more_bias = 0.005;

  // What changing a cosine and an alpha of at least so much brings beyond what either does, for each product of their shares: of a loss
  // relative to it, of a bias absolutely (bounded_albedo_test.cpp).
  static constexpr double least_alpha_of_changes = 1e-6;
  static constexpr double loss_changes_together = 8;
  static constexpr double bias_changes_together = 0.4;

 private:
  static double not_known(double /*value*/) { return std::numeric_limits<double>::infinity(); }
  enum class End { Lower, Center, Upper };
  /// Of a range whose ends differ by more than hundredths.
  static bool is_wide_roughness(const B& roughness) { return roughness.range().upper > 1.05 * roughness.range().lower; }

  /// f(x, y) with y given as the end of a range.
  template <class Function>
  static auto at_ends(const Function& f, const B& y) {
    return [&f, &y](double x, End end) {
      return f(x, end == End::Center ? y.center() : end == End::Lower ? y.range().lower : y.range().upper);
    };
  }

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
    return read(e, across, turn, cosine.range().lower < albedo::decreasing_from, error, not_known, cosine, roughness);
  }

  /// @param turn      includes what f may be between the ends of a wide range where it turns
  /// @param may_turn  whether it may do so in a narrow one
  /// @param across    f at any roughness
  /// @param together  what a small change of both arguments brings beyond that of either, times their shares, where f has a value; infinite
  ///                  where that is not known
  /// @param steps_y   in a ratio of e of y, where f is looked at
  /// @param least_y   below which f does not change with y
  template <class Function, class Across, class Turn, class Error, class Together>
  static B read(const Function& f, const Across& across, const Turn& turn, bool may_turn, const Error& error, const Together& together,
                const B& x, const B& y, double steps_y = 7, double least_y = 1e-3) {
    if (!x.is_bounded() || !y.is_bounded()) {
      return B::unbounded(0.0);  // their centres need not be numbers
    }
    const double value = f(x.center(), End::Center);
    const double width = x.range().upper - x.range().lower;
    const bool wide = width > wide_cosines * x.center();
    // A centre near an end does not tell how the albedo bends, the middle does.
    const bool lopsided = x.center() - x.range().lower < 0.25 * width || x.range().upper - x.center() < 0.25 * width;
    const double middle = 0.5 * (x.range().lower + x.range().upper);
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
    double low = value;
    double high = value;
    const double both = wide || lopsided || is_wide_roughness(y)
                            ? std::numeric_limits<double>::infinity()
                            : together(value) * width / std::max(x.range().lower, albedo::min_n_dot_v) * share_of(y);
    // Returns f at the centre of x.
    const auto include_ends = [&](End end) {
      const double there = f(x.center(), end);
      include(x.center(), there);
      if (std::isfinite(both)) {
        for (const double sign : {-1.0, 1.0}) {
          include(x.range().lower, low + (there - value) + sign * both);
          include(x.range().upper, high + (there - value) + sign * both);
        }
        return there;
      }
      include(x.range().lower, f(x.range().lower, end));
      if (width > 0) {
        include(x.range().upper, f(x.range().upper, end));
      }
      if (lopsided) {
        include(middle, across(middle, end == End::Lower ? y.range().lower : y.range().upper));
      }
      return there;
    };
    if (width > 0) {
      low = f(x.range().lower, End::Center);
      high = f(x.range().upper, End::Center);
      slope = wide ? 0.0 : (high - low) / width;
      include(x.range().lower, low);
      include(x.range().upper, high);
      if (lopsided) {
        include(middle, across(middle, y.center()));
      }
    }
    const double bend = remainder;
    if (!y.is_exact()) {
      const double at_lower = include_ends(End::Lower);
      const double at_upper = include_ends(End::Upper);
      // What lies between three places of a parabola is beyond them by half of this at the most.
      const double across_bend = 0.25 * std::abs(at_lower + at_upper - 2.0 * value);
      highest += across_bend;
      lowest = std::max(0.0, lowest - across_bend);
      remainder += across_bend;
      if (is_wide_roughness(y)) {
        const Steps steps(std::max(y.range().lower, least_y), y.range().upper, steps_y);
        for (const double c : {x.range().lower, x.center(), x.range().upper}) {
          include_between([&](double there) { return across(c, there); }, steps, [&](double there) { include(c, there); });
        }
      }
    }
    if (wide) {
      turn(End::Center, reach);
      if (!y.is_exact()) {
        turn(End::Lower, reach);
        turn(End::Upper, reach);
      }
      remainder = std::max(highest - value, value - lowest);
    } else if (may_turn) {
      highest += bend;
      lowest = std::max(0.0, lowest - bend);
    }
    double off = 0;
    if (wide || is_wide_roughness(y)) {
      for (const double c : {x.range().lower, x.center(), x.range().upper}) {
        for (const double r : {y.range().lower, y.center(), y.range().upper}) {
          off = std::max(off, error(highest, c, r));
        }
      }
    } else {
      // It changes by less than four times the share that its arguments do.
      const double shares = width / std::max(x.center(), albedo::min_n_dot_v) +
                            (y.is_exact() ? 0 : (y.range().upper - y.range().lower) / std::max(y.range().lower, 1e-8));
      off = error(highest, x.center(), y.center()) * (1 + 4 * shares);
    }
    return B::rounded({value, slope * x.shift_x(), slope * x.shift_y(), std::abs(slope) * x.radius() + remainder, {lowest, highest}},
                      B::Error::absolute(0, off), true);
  }

  /// Places of the same ratio each.
  struct Steps {
    static constexpr std::size_t most = 40;
    std::array<double, most + 1> place;
    std::size_t count;  ///< of steps, at least 2

    /// @param per_e  in a ratio of e, while they are not too many
    Steps(double lower, double highest, double per_e) {
      const double upper = std::max(highest, lower);
      const double logarithm = std::isfinite(upper) ? std::log(upper / lower) : 0;
      count = std::min(2 + static_cast<std::size_t>(per_e * logarithm), most);
      const double ratio = std::exp(logarithm / static_cast<double>(count));
      place[0] = lower;
      for (std::size_t i = 1; i < count; ++i) {
        place[i] = place[i - 1] * ratio;
      }
      place[count] = upper;
    }
  };

  /// What f reaches between places: what it has there, and beyond that twice as far as a parabola through three neighbours goes.
  template <class Function, class Include>
  static void include_between(const Function& f, const Steps& steps, const Include& include) {
    double first = f(steps.place[0]);
    double middle = f(steps.place[1]);
    for (std::size_t i = 2; i <= steps.count; ++i) {
      const double last = f(steps.place[i]);
      const double bend = 0.25 * std::abs(first + last - 2.0 * middle);
      include(std::max(first, std::max(middle, last)) + bend);
      include(std::max(0.0, std::min(first, std::min(middle, last)) - bend));
      first = middle;
      middle = last;
    }
  }

  /// Between the ends of an alpha, relative to it.
  static double share_of(const B& alpha) {
    return (alpha.range().upper - alpha.range().lower) / std::max(alpha.range().lower, albedo::mirror_alpha);
  }
  /// Whether a shader may take it for a mirror or not, which changes by more than its share.
  static bool straddles_mirrors(const B& alpha) {
    return alpha.range().lower <= albedo::mirror_alpha && !(alpha.range().upper <= albedo::mirror_alpha);
  }

  /// An albedo that is asked at the same places twice, in the same order, and found once.
  template <class Albedo>
  class Once {
   public:
    explicit Once(const Albedo& albedo) : albedo_(albedo) {}

    void begin() { next_ = 0; }
    brdf::LobeAlbedo<double> operator()(double c, double a) {
      if (next_ < found_ && places_[next_].c == c && places_[next_].a == a) {
        return places_[next_++].albedo;
      }
      const brdf::LobeAlbedo<double> there = albedo_(c, a);
      if (next_ == found_ && found_ < places_.size()) {
        places_[found_++] = {c, a, there};
        next_ = found_;
      }
      return there;
    }

   private:
    struct Place {
      double c, a;
      brdf::LobeAlbedo<double> albedo;
    };
    const Albedo& albedo_;
    std::array<Place, 256> places_;
    std::size_t found_ = 0, next_ = 0;
  };

  // Loss and bias bend over a ratio of e of either argument.
  static constexpr double steps_in_e = 4;

  // The shader's table holds the logarithms of loss and scale; its bias is what they leave of 1.
  static double loss_error(double loss) { return albedo::ggx_table_error * loss; }
  static double bias_error() { return albedo::ggx_table_error; }

  /// @param albedo     of a cosine and an alpha
  /// @param most_bias  of any alpha
  template <class Albedo>
  static brdf::LobeAlbedo<B> lobe(const Albedo& albedo, const B& cosine, const B& alpha, double most_bias) {
    if (cosine.is_bounded() && alpha.is_bounded() && alpha.range().upper > 4 * std::max(alpha.range().lower, albedo::mirror_alpha)) {
      const auto up_to = [](double value, double most, double off) {
        return B::rounded({value, 0, 0, most, {0, most}}, B::Error::absolute(0, off), true);
      };
      const brdf::LobeAlbedo<double> there = albedo(cosine.center(), alpha.center());
      const double loss = std::max(there.loss, most_loss(alpha.range().upper));
      return {up_to(there.loss, loss, loss_error(loss)), up_to(there.bias, std::max(there.bias, most_bias), bias_error())};
    }
    const Steps cosines(std::max(cosine.range().lower, albedo::min_n_dot_v), cosine.range().upper, steps_in_e);
    const bool is_wide_alpha = is_wide_roughness(alpha);
    const double changes = changes_with_alpha * share_of(alpha);
    Once<Albedo> once(albedo);
    const auto of = [&](double brdf::LobeAlbedo<double>::*member, const auto& size, double most_together, const auto& error) {
      once.begin();
      const auto f = [&](double c, double a) { return once(c, a).*member; };
      const auto at = at_ends(f, alpha);
      const auto turn = [&](End end, const auto& include) {
        const bool is_mirror = alpha.range().upper <= albedo::mirror_alpha;  // whose albedos only fall
        if (is_mirror || (!is_wide_alpha && end != End::Center)) {
          return;
        }
        const double more = is_wide_alpha ? 0.0 : changes;
        include_between([&](double c) { return at(c, end); }, cosines,
                        [&](double there) {
                          include(there + more * size(there));
                          include(std::max(0.0, there - more * size(there)));
                        });
      };
      const auto together = [&](double there) {
        return alpha.range().lower >= least_alpha_of_changes ? most_together * size(there) : not_known(there);
      };
      return read(at, f, turn, true, error, together, cosine, alpha, steps_in_e, albedo::mirror_alpha);
    };
    const auto loss = of(
        &brdf::LobeAlbedo<double>::loss, [](double there) { return there; }, loss_changes_together,
        [](double there, double, double) { return loss_error(there); });
    const auto bias = of(
        &brdf::LobeAlbedo<double>::bias, [](double) { return 1.0; }, bias_changes_together,
        [](double, double, double) { return bias_error(); });
    return {loss, bias};
  }

  /// At one alpha; what others change of it is an error.
  static brdf::LobeAlbedo<B> about(const GgxAround& around, const B& cosine, const B& alpha) {
    const double changes = changes_with_alpha * (share_of(alpha) + std::abs(alpha.center() - around.at.alpha()) /
                                                                       std::max(around.at.alpha(), albedo::mirror_alpha));
    const auto of = [&](const auto& f, const albedo::Turns& turns, const auto& error) {
      const auto turn = [&](End, const auto& include) {
        for (std::size_t i = 0; i < turns.count; ++i) {
          if (cosine.range().lower < turns.turn[i].to && turns.turn[i].from < cosine.range().upper) {
            include(turns.turn[i].lowest);
            include(turns.turn[i].highest);
          }
        }
      };
      const B one_alpha = alpha.is_bounded() ? B(1) : alpha;
      return read([&f](double c, End) { return f(c); }, [&f](double c, double) { return f(c); }, turn, true, error, not_known, cosine,
                  one_alpha);
    };
    return {of([&](double c) { return around.at(c).loss; }, around.loss,
               [&](double loss, double, double) { return loss_error(loss) + changes * loss; }),
            of([&](double c) { return around.at(c).bias; }, around.bias, [&](double, double, double) { return bias_error() + changes; })};
  }
};

/// The golden's own shading tells it.
template <class Precision>
inline constexpr bool finds_lookup_error<number::Bounded<Precision>> = false;

}  // namespace sheen::golden
