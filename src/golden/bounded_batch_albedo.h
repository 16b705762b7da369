#pragma once

#include <cstddef>

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

  static B sheen(const SheenAlbedo& albedo, const B& cosine, const B& sheen_roughness) {
    B e(0.0);
    number::BatchMask open(true);
    if (albedo.around != nullptr) {
      read(*albedo.around, cosine, sheen_roughness, e);
      open = cosine.is_unbounded();
    }
    for (std::size_t i = 0; i < B::lanes; ++i) {
      if (open.get(i)) {
        e.set_lane(i, OneAlbedo<Precision>::sheen(albedo, cosine.template lane<One>(i), sheen_roughness.template lane<One>(i)));
      }
    }
    return e;
  }

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

  static brdf::LobeAlbedo<B> ggx(const albedo::GgxInterpolant& ggx, const B& cosine, const B& alpha) {
    return each([&ggx](const One& c, const One& a) { return OneAlbedo<Precision>::ggx(ggx, c, a); }, cosine, alpha);
  }
  static brdf::LobeAlbedo<B> ggx_average(const albedo::GgxInterpolant& ggx, const B& alpha) {
    return each([&ggx](const One&, const One& a) { return OneAlbedo<Precision>::ggx_average(ggx, a); }, alpha, alpha);
  }

 private:
  template <class Read>
  static brdf::LobeAlbedo<B> each(const Read& read, const B& cosine, const B& alpha) {
    brdf::LobeAlbedo<B> albedo;
    for (std::size_t i = 0; i < B::lanes; ++i) {
      const brdf::LobeAlbedo<One> one = read(cosine.template lane<One>(i), alpha.template lane<One>(i));
      albedo.loss.set_lane(i, one.loss);
      albedo.bias.set_lane(i, one.bias);
    }
    return albedo;
  }

  /// AlbedoReader<One>::read, in lanes that are bounded.
  static void read(const AlbedoAround& around, const B& cosine, const B& roughness, B& e) {
    const number::Batch c = cosine.center();
    const number::Batch value = around.center.e(c);
    const number::Batch width = cosine.upper() - cosine.lower();
    const number::Batch low = around.center.e(cosine.lower());
    const number::Batch high = around.center.e(cosine.upper());
    const number::BatchMask wide = width > number::Batch(wide_cosines) * c;
    const number::Batch slope = select((width > number::Batch(0.0)) & ~wide, (high - low) / width, number::Batch(0.0));
    number::Batch lowest = xsimd::min(value, xsimd::min(low, high));
    number::Batch highest = xsimd::max(value, xsimd::max(low, high));
    const auto left = [&](const number::Batch& there, const number::Batch& at) { return xsimd::abs(there - value - slope * (at - c)); };
    number::Batch remainder = xsimd::max(left(low, cosine.lower()), left(high, cosine.upper()));
    const number::Batch bend = remainder;
    if (!xsimd::all(roughness.is_exact())) {
      for (const AlbedoAround::Curve* curve : {&around.lower, &around.upper}) {
        const number::Batch at_lower = curve->e(cosine.lower());
        const number::Batch at_upper = curve->e(cosine.upper());
        remainder = xsimd::max(remainder, left(curve->e(c), c));
        lowest = xsimd::min(lowest, xsimd::min(at_lower, at_upper));
        highest = xsimd::max(highest, xsimd::max(at_lower, at_upper));
        remainder = xsimd::max(remainder, xsimd::max(left(at_lower, cosine.lower()), left(at_upper, cosine.upper())));
      }
    }
    const number::BatchMask may_turn = cosine.lower() < number::Batch(albedo::decreasing_from);
    if (xsimd::any(wide | may_turn)) {
      for (const AlbedoAround::Curve* curve : {&around.lower, &around.center, &around.upper}) {
        const number::BatchMask turns =
            wide & may_turn & (cosine.lower() < number::Batch(curve->peak.to)) & (number::Batch(curve->peak.from) < cosine.upper());
        highest = select(turns, xsimd::max(highest, number::Batch(curve->peak.e)), highest);
      }
      highest = select(may_turn & ~wide, highest + bend, highest);
      lowest = select(may_turn & ~wide, xsimd::max(number::Batch(0.0), lowest - bend), lowest);
      remainder = select(wide, xsimd::max(highest - value, value - lowest), remainder);
    }
    const auto error = [&](const number::Batch& n_dot_v) { return albedo::lookup_error(highest, n_dot_v, roughness.center()); };
    const number::Batch shares = width / xsimd::max(c, number::Batch(albedo::min_n_dot_v)) +
                                 (roughness.upper() / xsimd::max(roughness.lower(), number::Batch(1e-8)) - number::Batch(1.0));
    number::Batch off = error(c) * (number::Batch(1.0) + number::Batch(4.0) * select(wide, number::Batch(0.0), shares));
    if (xsimd::any(wide)) {
      off = select(wide, xsimd::max(off, xsimd::max(error(cosine.lower()), error(cosine.upper()))), off);
    }
    const number::Batch radius = xsimd::abs(slope) * cosine.radius() + remainder;
    e.round({value, slope * cosine.shift_x(), slope * cosine.shift_y(), radius, lowest, highest}, B::Error::absolute(0, off), true);
  }
};

template <class Precision>
inline constexpr bool finds_lookup_error<number::BoundedBatch<Precision>> = false;

/// Of forms without ranges and of ranges alone: BoundedBatch's, four lanes at a time.
template <class Eight>
struct AlbedoReaderOfHalves {
  using Bounds = AlbedoReader<typename Eight::Bounds>;

  static Eight sheen(const SheenAlbedo& albedo, const Eight& cosine, const Eight& sheen_roughness) {
    return number::by_halves([&](const auto& c, const auto& r) { return Bounds::sheen(albedo, c, r); }, cosine, sheen_roughness);
  }
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
  static brdf::LobeAlbedo<Eight> ggx(const albedo::GgxInterpolant& ggx, const Eight& cosine, const Eight& alpha) {
    return of_halves([&](std::size_t half) { return Bounds::ggx(ggx, cosine.bounds(half), alpha.bounds(half)); });
  }
  static brdf::LobeAlbedo<Eight> ggx_average(const albedo::GgxInterpolant& ggx, const Eight& alpha) {
    return of_halves([&](std::size_t half) { return Bounds::ggx_average(ggx, alpha.bounds(half)); });
  }

 private:
  template <class Half>
  static brdf::LobeAlbedo<Eight> of_halves(const Half& half) {
    const auto first = half(0);
    const auto last = half(1);
    return {Eight(first.loss, last.loss), Eight(first.bias, last.bias)};
  }
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
