#pragma once

#include <algorithm>
#include <cstddef>
#include <type_traits>

#include "albedo/ggx_table.h"
#include "albedo/lookup_error.h"
#include "golden/bound_all.h"
#include "number/affine_batch.h"
#include "number/bounded_batch_functions.h"
#include "number/range_batch.h"

// AlbedoReader of the numbers that bounds are shaded on, many at a time. For translation units of number::Batch alone.

namespace sheen::golden {

/// As of Bounded; lane by lane, and in a translation unit that every processor runs, what is not of one roughness.
template <class Precision>
struct AlbedoReader<number::BoundedBatch<Precision>> {
  using B = number::BoundedBatch<Precision>;
  using One = number::Bounded<Precision>;

  /// At one roughness, see SheenRange.
  class Sheen {
   public:
    Sheen(const SheenAlbedo& albedo, const B& roughness) : albedo_(albedo), roughness_(roughness) {
      for (std::size_t i = 0; albedo.around == nullptr && i < B::lanes; ++i) {
        OneAlbedo<Precision>::find_roughnesses(roughness.template lane<One>(i), roughnesses_[i]);
      }
    }

    B operator()(const B& cosine) const {
      B e(0.0);
      number::BatchMask open(true);
      if (albedo_.around != nullptr) {
        e = read(*albedo_.around, cosine, roughness_);
        open = cosine.is_unbounded();
      }
      for (std::size_t i = 0; i < B::lanes; ++i) {
        if (open.get(i)) {
          const One c = cosine.template lane<One>(i);
          e.set_lane(i, OneAlbedo<Precision>::sheen(albedo_, roughnesses_[i], c, roughness_.template lane<One>(i)));
        }
      }
      return e;
    }

   private:
    SheenAlbedo albedo_;
    B roughness_;
    SheenRoughnesses roughnesses_[B::lanes];  // where not all surfaces have one
  };

  template <class Read>
  static B for_light(const B& e_v, const B& n_dot_l, const B& n_dot_v, const Read& read) {
    const number::BatchMask smaller = (n_dot_v.lower() >= number::Batch(albedo::decreasing_from)) & (n_dot_l.lower() >= n_dot_v.upper()) &
                                      ~n_dot_v.is_unbounded() & ~n_dot_l.is_unbounded();
    if (xsimd::all(smaller)) {
      return e_v;
    }
    B e = read();
    e.take(smaller, e_v);
    return e;
  }

  /// At one alpha, see GgxRange.
  class Ggx {
   public:
    Ggx(const BaseAlbedo& albedo, const B& alpha) : albedo_(albedo), alpha_(alpha) {
      const number::BatchMask straddles = straddling();
      for (std::size_t i = 0; i < B::lanes; ++i) {
        const One a = alpha.template lane<One>(i);
        if (!is_about(a) || straddles.get(i)) {
          OneAlbedo<Precision>::find_alphas(a, alphas_[i]);
        }
      }
    }

    brdf::LobeAlbedo<B> operator()(const B& cosine) const {
      if (albedo_.around == nullptr || xsimd::any(cosine.is_unbounded() | alpha_.is_unbounded() | straddling())) {
        return each(
            [&](std::size_t i, const One& a) { return OneAlbedo<Precision>::ggx(albedo_, alphas_[i], cosine.template lane<One>(i), a); });
      }
      const GgxAround& around = *albedo_.around;
      const auto at = around.at(cosine.center());
      const auto low = around.at(cosine.lower());
      const auto high = around.at(cosine.upper());
      const number::Batch share =
          (alpha_.upper() - alpha_.lower()) / xsimd::max(alpha_.lower(), number::Batch(albedo::mirror_alpha)) +
          xsimd::abs(alpha_.center() - number::Batch(around.at.alpha())) / number::Batch(std::max(around.at.alpha(), albedo::mirror_alpha));
      const number::Batch changes = number::Batch(albedo::ggx_table_error) + number::Batch(changes_with_alpha) * share;
      Reading loss(cosine, at.loss, low.loss, high.loss);
      Reading bias(cosine, at.bias, low.bias, high.bias);
      if (xsimd::any(loss.is_lopsided())) {
        const auto middle = around.at(loss.middle());
        loss.bend = loss.include_middle(middle.loss);
        bias.bend = bias.include_middle(middle.bias);
      }
      loss.bend_within(number::BatchMask(true));
      loss.turn(around.loss);
      bias.bend_within(number::BatchMask(true));
      bias.turn(around.bias);
      return {loss.made(changes * loss.highest * loss.growth()), bias.made(changes * bias.growth())};
    }

    brdf::LobeAlbedo<B> average() const {
      return each([&](std::size_t i, const One& a) {
        if constexpr (std::is_same_v<Precision, number::Highp>) {
          if (is_about(a)) {
            return albedo_.around->average;
          }
        }
        return OneAlbedo<Precision>::ggx_average(albedo_, alphas_[i], a);
      });
    }

   private:
    /// Whether it is held by what is known around one.
    bool is_about(const One& alpha) const {
      return std::is_same_v<Precision, number::Highp> && albedo_.around != nullptr && alpha.is_bounded() &&
             albedo_.around->alpha.range().lower <= alpha.range().lower && alpha.range().upper <= albedo_.around->alpha.range().upper;
    }
    /// See GgxRange.
    number::BatchMask straddling() const {
      const number::Batch mirror(albedo::mirror_alpha);
      return (alpha_.lower() <= mirror) & ~(alpha_.upper() <= mirror);
    }

    /// @param read  of a lane and its alpha
    template <class Read>
    brdf::LobeAlbedo<B> each(const Read& read) const {
      brdf::LobeAlbedo<B> albedo;
      for (std::size_t i = 0; i < B::lanes; ++i) {
        const brdf::LobeAlbedo<One> one = read(i, alpha_.template lane<One>(i));
        albedo.loss.set_lane(i, one.loss);
        albedo.bias.set_lane(i, one.bias);
      }
      return albedo;
    }

    BaseAlbedo albedo_;
    B alpha_;
    GgxAlphas alphas_[B::lanes];  // of lanes that are not about the one alpha
  };

 private:
  /// AlbedoReader<One>::read, in lanes that are bounded: what an albedo is over the cosines.
  struct Reading {
    B cosine;
    number::Batch value, slope, lowest, highest, remainder, bend;
    number::BatchMask wide;

    /// Of its values at the centre and at the ends.
    Reading(const B& of, const number::Batch& at_center, const number::Batch& at_lower, const number::Batch& at_upper)
        : cosine(of), value(at_center), wide(width() > number::Batch(wide_cosines) * of.center()) {
      const number::Batch cut(albedo::min_n_dot_v);
      wide = wide | ((of.lower() < cut) & (of.upper() > cut));
      slope = select((width() > number::Batch(0.0)) & ~wide, (at_upper - at_lower) / width(), number::Batch(0.0));
      lowest = xsimd::min(value, xsimd::min(at_lower, at_upper));
      highest = xsimd::max(value, xsimd::max(at_lower, at_upper));
      remainder = xsimd::max(left(at_lower, of.lower()), left(at_upper, of.upper()));
      bend = remainder;
    }

    /// Whether the centre, near an end, does not tell how the albedo bends.
    number::BatchMask is_lopsided() const {
      const number::Batch quarter = number::Batch(0.25) * width();
      return (cosine.center() - cosine.lower() < quarter) | (cosine.upper() - cosine.center() < quarter);
    }
    number::Batch width() const { return cosine.upper() - cosine.lower(); }
    number::Batch left(const number::Batch& there, const number::Batch& at) const {
      return xsimd::abs(there - value - slope * (at - cosine.center()));
    }

    number::Batch middle() const { return number::Batch(0.5) * (cosine.lower() + cosine.upper()); }
    /// Where that is asked for. Returns the remainder.
    const number::Batch& include_middle(const number::Batch& at_middle) {
      remainder = select(is_lopsided(), xsimd::max(remainder, left(at_middle, middle())), remainder);
      lowest = xsimd::min(lowest, at_middle);
      highest = xsimd::max(highest, at_middle);
      return remainder;
    }

    /// What it is at another roughness too.
    void include(const number::Batch& at_center, const number::Batch& at_lower, const number::Batch& at_upper) {
      remainder = xsimd::max(remainder, left(at_center, cosine.center()));
      lowest = xsimd::min(lowest, xsimd::min(at_lower, at_upper));
      highest = xsimd::max(highest, xsimd::max(at_lower, at_upper));
      remainder = xsimd::max(remainder, xsimd::max(left(at_lower, cosine.lower()), left(at_upper, cosine.upper())));
    }

    /// Where it may turn within narrow ranges of these lanes.
    void bend_within(const number::BatchMask& lanes) {
      highest = select(lanes & ~wide, highest + bend, highest);
      lowest = select(lanes & ~wide, xsimd::max(number::Batch(0.0), lowest - bend), lowest);
    }

    /// Where wide ranges hold places between these.
    void turn(double from, double to, double least, double most) {
      const number::BatchMask turns = wide & (cosine.lower() < number::Batch(to)) & (number::Batch(from) < cosine.upper());
      highest = select(turns, xsimd::max(highest, number::Batch(most)), highest);
      lowest = select(turns, xsimd::min(lowest, number::Batch(least)), lowest);
    }
    void turn(const albedo::Turns& all) {
      for (std::size_t i = 0; i < all.count && xsimd::any(wide); ++i) {
        turn(all.turn[i].from, all.turn[i].to, all.turn[i].lowest, all.turn[i].highest);
      }
    }

    /// Of errors over a narrow range, which change by less than four times the share that the cosine does.
    number::Batch growth() const {
      const number::Batch share = width() / xsimd::max(cosine.center(), number::Batch(albedo::min_n_dot_v));
      return number::Batch(1.0) + number::Batch(4.0) * select(wide, number::Batch(0.0), share);
    }

    /// @param off  of what a shader reads
    B made(const number::Batch& off) const {
      const number::Batch rest = select(wide, xsimd::max(highest - value, value - lowest), remainder);
      B made(0.0);
      made.round({value, slope * cosine.shift_x(), slope * cosine.shift_y(), xsimd::abs(slope) * cosine.radius() + rest, lowest, highest},
                 B::Error::absolute(0, off), true);
      return made;
    }
  };

  static B read(const AlbedoAround& around, const B& cosine, const B& roughness) {
    const number::Batch c = cosine.center();
    Reading reading(cosine, around.center.e(c), around.center.e(cosine.lower()), around.center.e(cosine.upper()));
    const bool lopsided = xsimd::any(reading.is_lopsided());
    if (lopsided) {
      reading.bend = reading.include_middle(around.center.e(reading.middle()));
    }
    if (!xsimd::all(roughness.is_exact())) {
      for (const AlbedoAround::Curve* curve : {&around.lower, &around.upper}) {
        const number::Batch at_lower = curve->e(cosine.lower());
        const number::Batch at_upper = curve->e(cosine.upper());
        reading.include(curve->e(c), at_lower, at_upper);
        if (lopsided) {
          reading.include_middle(curve->e(reading.middle()));
        }
      }
    }
    const number::BatchMask may_turn = cosine.lower() < number::Batch(albedo::decreasing_from);
    const number::BatchMask wide = reading.wide;
    if (xsimd::any(may_turn)) {
      for (const AlbedoAround::Curve* curve : {&around.lower, &around.center, &around.upper}) {
        const albedo::Peak& peak = curve->peak();
        reading.turn(peak.from, peak.to, peak.e, peak.e);
      }
      reading.bend_within(may_turn);
    }
    const auto error = [&](const number::Batch& n_dot_v) { return albedo::lookup_error(reading.highest, n_dot_v, roughness.center()); };
    const number::Batch share = (roughness.upper() - roughness.lower()) / xsimd::max(roughness.lower(), number::Batch(1e-8));
    number::Batch off = error(c) * (reading.growth() + number::Batch(4.0) * select(wide, number::Batch(0.0), share));
    if (xsimd::any(wide)) {
      off = select(wide, xsimd::max(off, xsimd::max(error(cosine.lower()), error(cosine.upper()))), off);
    }
    return reading.made(off);
  }
};

template <class Precision>
inline constexpr bool finds_lookup_error<number::BoundedBatch<Precision>> = false;

/// Of forms without ranges and of ranges alone: BoundedBatch's, four lanes at a time.
template <class Eight>
struct AlbedoReaderOfHalves {
  using Bounds = AlbedoReader<typename Eight::Bounds>;

  class Sheen {
   public:
    Sheen(const SheenAlbedo& albedo, const Eight& roughness) : first_(albedo, roughness.bounds(0)), last_(albedo, roughness.bounds(1)) {}
    Eight operator()(const Eight& cosine) const { return Eight(first_(cosine.bounds(0)), last_(cosine.bounds(1))); }

   private:
    typename Bounds::Sheen first_, last_;
  };
  template <class Read>
  static Eight for_light(const Eight& e_v, const Eight& n_dot_l, const Eight& n_dot_v, const Read& read) {
    const number::FloatMask falls = n_dot_v.lower() >= number::FloatBatch(static_cast<float>(albedo::decreasing_from));
    const number::FloatMask smaller = falls & (n_dot_l.lower() >= n_dot_v.upper());
    if (xsimd::all(smaller)) {
      return e_v;
    }
    Eight e = read();
    e.take(smaller, e_v);
    return e;
  }
  class Ggx {
   public:
    Ggx(const BaseAlbedo& albedo, const Eight& alpha) : first_(albedo, alpha.bounds(0)), last_(albedo, alpha.bounds(1)) {}
    brdf::LobeAlbedo<Eight> operator()(const Eight& cosine) const { return whole(first_(cosine.bounds(0)), last_(cosine.bounds(1))); }
    brdf::LobeAlbedo<Eight> average() const { return whole(first_.average(), last_.average()); }

   private:
    template <class Half>
    static brdf::LobeAlbedo<Eight> whole(const Half& first, const Half& last) {
      return {Eight(first.loss, last.loss), Eight(first.bias, last.bias)};
    }
    typename Bounds::Ggx first_, last_;
  };
};

template <>
struct AlbedoReader<number::AffineBatch> : AlbedoReaderOfHalves<number::AffineBatch> {};
template <>
struct AlbedoReader<number::RangeBatch> : AlbedoReaderOfHalves<number::RangeBatch> {};
template <>
inline constexpr bool finds_lookup_error<number::AffineBatch> = false;
template <>
inline constexpr bool finds_lookup_error<number::RangeBatch> = false;

}  // namespace sheen::golden
