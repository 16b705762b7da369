#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "albedo/ggx_table.h"
#include "golden/albedo_range.h"
#include "golden/albedo_reader.h"

namespace sheen::golden {

/// The GGX lobe's albedo over ranges of the cosine and of alpha. Of an alpha that is open by hundredths or more the ranges alone are made
/// use of: what the albedo is at places of both, between which it bends no more than parabolas do; over decades, what it is at the most.
/// Else see read_albedo.
/// @tparam B  number::Bounded
template <class B>
struct GgxRange {
  using Albedo = brdf::LobeAlbedo<double>;

  static void find(const B& alpha, GgxAlphas& alphas) {
    const auto& range = alpha.range();
    alphas.lower = albedo::GgxInterpolant::alpha(range.lower);
    alphas.center = albedo::GgxInterpolant::alpha(alpha.center());
    alphas.upper = albedo::GgxInterpolant::alpha(range.upper);
    alphas.count = 0;
    if (alpha.is_bounded() && is_wide_roughness(alpha) && !is_over_decades(alpha)) {
      const double lower = std::max(range.lower, albedo::mirror_alpha);
      const Steps<GgxAlphas::most - 1> steps(lower, range.upper, range.upper < 4 * lower ? steps_in_e : wider_steps_in_e);
      for (; alphas.count <= steps.count; ++alphas.count) {
        alphas.place[alphas.count] = albedo::GgxInterpolant::alpha(steps.place[alphas.count]);
      }
    }
  }

  /// @param alphas  what find() says of alpha
  static brdf::LobeAlbedo<B> at(const BaseAlbedo& albedo, const GgxAlphas& alphas, const B& cosine, const B& alpha) {
    if (!cosine.is_bounded() || !alpha.is_bounded()) {
      return {B::unbounded(0.0), B::unbounded(0.0)};  // their centres need not be numbers
    }
    if (albedo.around != nullptr && !straddles_mirrors(alpha)) {
      return about(*albedo.around, cosine, alpha);
    }
    const albedo::GgxInterpolant& interpolant = *albedo.interpolant;
    if (!is_wide_roughness(alpha)) {
      Kept<albedo::GgxCosine> cosines(albedo::GgxInterpolant::cosine);
      return narrow([&](double c, End a) { return interpolant(cosines.at(c), at_end(alphas, a)); }, cosine, alpha);
    }
    albedo::GgxCosine center = albedo::GgxInterpolant::cosine(cosine.center());
    const Albedo value = interpolant(center, alphas.center);
    if (is_over_decades(alpha)) {
      return up_to_most(value, std::pow(1 - cosine.range().lower, 5), alpha);
    }
    Grids grids(alphas.count);
    const double share = for_cosines(cosine, steps_in_e, [&](double c) {
      albedo::GgxCosine there = albedo::GgxInterpolant::cosine(c);
      grids.add([&](std::size_t i) { return interpolant(there, alphas.place[i]); });
    });
    return grids.held(value, share * share);
  }

  /// Over the hemisphere.
  static brdf::LobeAlbedo<B> average(const BaseAlbedo& albedo, const GgxAlphas& alphas, const B& alpha) {
    if (!alpha.is_bounded()) {
      return {B::unbounded(0.0), B::unbounded(0.0)};
    }
    const albedo::GgxInterpolant& interpolant = *albedo.interpolant;
    if (!is_wide_roughness(alpha)) {
      return narrow([&](double, End a) { return interpolant.average(at_end(alphas, a)); }, B(1), alpha);
    }
    const Albedo value = interpolant.average(alphas.center);
    if (is_over_decades(alpha)) {
      return up_to_most(value, 1.0 / 21, alpha);
    }
    Grids grids(alphas.count);
    grids.add([&](std::size_t i) { return interpolant.average(alphas.place[i]); });
    return grids.held(value, 0);
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
  // What an albedo departs by, between two cosines as near as narrow_cosines, from what it is at either, for each square of their share,
  // likewise.
  static constexpr double loss_bends = 2;
  static constexpr double bias_bends = 0.2;

 private:
  // Loss and bias bend over a ratio of e of either argument.
  static constexpr double steps_in_e = 4;
  static constexpr double wider_steps_in_e = 3;
  static constexpr double most_ratio = 130;  // that GgxAlphas has places for

  static const albedo::GgxAlpha& at_end(const GgxAlphas& alphas, End end) {
    return end == End::Center ? alphas.center : end == End::Lower ? alphas.lower : alphas.upper;
  }
  static bool is_over_decades(const B& alpha) {
    return alpha.range().upper > most_ratio * std::max(alpha.range().lower, albedo::mirror_alpha);
  }
  /// Between the ends of an alpha, relative to it.
  static double share_of(const B& alpha) {
    return (alpha.range().upper - alpha.range().lower) / std::max(alpha.range().lower, albedo::mirror_alpha);
  }
  /// Whether a shader may take it for a mirror or not, which changes by more than its share.
  static bool straddles_mirrors(const B& alpha) {
    return alpha.range().lower <= albedo::mirror_alpha && !(alpha.range().upper <= albedo::mirror_alpha);
  }

  // The shader's table holds the logarithms of loss and scale; its bias is what they leave of 1.
  static double loss_error(double loss) { return albedo::ggx_table_error * loss; }
  static double bias_error() { return albedo::ggx_table_error; }

  /// @param mirror  a mirror's bias
  static brdf::LobeAlbedo<B> up_to_most(const Albedo& value, double mirror, const B& alpha) {
    const double loss = std::max(value.loss, most_loss(alpha.range().upper));
    const double bias = std::max(value.bias, mirror + more_bias);
    return {within<B>(value.loss, {0, loss}, loss_error(loss)), within<B>(value.bias, {0, bias}, bias_error())};
  }

  class Grids {
   public:
    explicit Grids(std::size_t alphas) : loss_(alphas), bias_(alphas) {}

    /// The next cosine's. @param at  albedos at the alphas
    template <class At>
    void add(const At& at) {
      std::array<double, GgxAlphas::most> bias;
      loss_.add([&](std::size_t i) {
        const Albedo there = at(i);
        bias[i] = there.bias;
        return there.loss;
      });
      bias_.add([&](std::size_t i) { return bias[i]; });
    }

    /// @param square  of the share by which two cosines differ, if they are all
    brdf::LobeAlbedo<B> held(const Albedo& value, double square) const {
      const number::Range loss = loss_.held(value.loss, loss_bends * square, 0);
      const number::Range bias = bias_.held(value.bias, 0, bias_bends * square);
      return {within<B>(value.loss, loss, loss_error(loss.upper)), within<B>(value.bias, bias, bias_error())};
    }

   private:
    AlbedoGrid<GgxAlphas::most> loss_, bias_;
  };

  /// An albedo that is asked at the same places twice, in the same order, and found once.
  template <class OfEnds>
  class Once {
   public:
    explicit Once(const OfEnds& albedo) : albedo_(albedo) {}

    void begin() { next_ = 0; }
    Albedo operator()(double c, End a) {
      if (next_ < found_ && places_[next_].c == c && places_[next_].a == a) {
        return places_[next_++].albedo;
      }
      const Albedo there = albedo_(c, a);
      if (next_ == found_ && found_ < places_.size()) {
        places_[found_++] = {c, a, there};
        next_ = found_;
      }
      return there;
    }

   private:
    struct Place {
      double c;
      End a;
      Albedo albedo;
    };
    const OfEnds& albedo_;
    std::array<Place, 64> places_;
    std::size_t found_ = 0, next_ = 0;
  };

  /// @param albedo  of a cosine, at an end of alpha
  template <class OfEnds>
  static brdf::LobeAlbedo<B> narrow(const OfEnds& albedo, const B& cosine, const B& alpha) {
    const Steps<most_cosine_steps> cosines(std::max(cosine.range().lower, albedo::min_n_dot_v), cosine.range().upper, steps_in_e);
    const bool is_mirror = alpha.range().upper <= albedo::mirror_alpha;  // whose albedos only fall
    const double share = share_of(alpha);
    Once<OfEnds> once(albedo);
    const auto of = [&](double Albedo::*member, const auto& size, double most_together, const auto& error) {
      once.begin();
      const auto f = [&](double c, End a) { return once(c, a).*member; };
      const auto turn = [&](End end, const auto& include) {
        if (is_mirror || end != End::Center) {
          return;
        }
        cosines.include_between([&](double c) { return f(c, end); },
                                [&](double there) {
                                  const double more = changes_with_alpha * share * size(there);
                                  include(there + more);
                                  include(std::max(0.0, there - more));
                                });
      };
      const auto together = [&](double there) {
        return alpha.range().lower >= least_alpha_of_changes ? most_together * size(there) * share : not_known(there);
      };
      return read_albedo(f, turn, true, error, together, cosine, alpha);
    };
    const auto loss = of(
        &Albedo::loss, [](double there) { return there; }, loss_changes_together,
        [](double there, double, double) { return loss_error(there); });
    const auto bias = of(
        &Albedo::bias, [](double) { return 1.0; }, bias_changes_together, [](double, double, double) { return bias_error(); });
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
      return read_albedo([&f](double c, End) { return f(c); }, turn, true, error, not_known, cosine, B(1));
    };
    return {of([&](double c) { return around.at(c).loss; }, around.loss,
               [&](double loss, double, double) { return loss_error(loss) + changes * loss; }),
            of([&](double c) { return around.at(c).bias; }, around.bias, [&](double, double, double) { return bias_error() + changes; })};
  }

  static double not_known(double /*value*/) { return std::numeric_limits<double>::infinity(); }
};

}  // namespace sheen::golden
