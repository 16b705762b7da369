#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <limits>
#include <type_traits>

#include "number/bounded_conversion.h"
#include "number/rounding_batch.h"
#include "number/truth_batch.h"

namespace sheen::number {

/// A precision under another name: what a translation unit compiled for AVX2 instantiates of number::Bounded must not be linked into
/// others.
template <class Precision>
struct Apart : Precision {};

/// Four of number::Bounded, of four samples, at once: a lane is what number::Bounded makes of the lane's operands. Rare cases, as an
/// operation on two exact numbers, are handed to it. The elementary functions are xsimd's, within 2 ulp of double.
template <class Precision>
class BoundedBatch {
 public:
  using One = Bounded<Apart<Precision>>;
  static constexpr std::size_t lanes = Batch::size;

  BoundedBatch() = default;
  /// A constant of the shader, in every lane.
  explicit BoundedBatch(double value) : BoundedBatch(One(value)) {}
  explicit BoundedBatch(const One& one)
      : center_(one.center()),
        shift_x_(one.shift_x()),
        shift_y_(one.shift_y()),
        radius_(one.radius()),
        lower_(one.range().lower),
        upper_(one.range().upper) {}

  /// A form with its range, in double and not to be rounded; unbounded about 0 in some lanes.
  static BoundedBatch of_form(const ExactBatch& x, const BatchMask& unbounded) {
    BoundedBatch b(x.center, x.shift_x, x.shift_y, x.radius, x.lower, x.upper);
    if (xsimd::any(unbounded)) b.take(unbounded, BoundedBatch(One::unbounded(0.0)));
    return b;
  }

  const Batch& center() const { return center_; }
  const Batch& shift_x() const { return shift_x_; }
  const Batch& shift_y() const { return shift_y_; }
  const Batch& radius() const { return radius_; }
  const Batch& lower() const { return lower_; }
  const Batch& upper() const { return upper_; }
  Batch displacement() const { return xsimd::abs(shift_x_) + xsimd::abs(shift_y_); }
  Batch magnitude() const { return xsimd::max(xsimd::abs(lower_), xsimd::abs(upper_)); }
  BatchMask is_unbounded() const { return radius_ == Batch(std::numeric_limits<double>::infinity()); }
  BatchMask is_exact() const { return ((radius_ | shift_x_) | shift_y_) == Batch(0.0); }

  /// One lane, and into it. Bounded and BoundedBatch keep the same numbers in the same order.
  /// @tparam Lane  Bounded of this precision, apart or not
  template <class Lane = One>
  Lane lane(std::size_t i) const {
    static_assert(std::is_trivially_copyable_v<Lane> && sizeof(Lane) == sizeof(One));
    std::array<double, numbers> values;
    for (std::size_t n = 0; n < numbers; ++n) std::memcpy(&values.at(n), bytes() + (n * lanes + i) * sizeof(double), sizeof(double));
    Lane one;
    std::memcpy(static_cast<void*>(&one), values.data(), sizeof(one));
    return one;
  }
  template <class Lane>
  void set_lane(std::size_t i, const Lane& one) {
    static_assert(std::is_trivially_copyable_v<Lane> && sizeof(Lane) == sizeof(One));
    std::array<double, numbers> values;
    std::memcpy(values.data(), static_cast<const void*>(&one), sizeof(one));
    for (std::size_t n = 0; n < numbers; ++n) std::memcpy(bytes() + (n * lanes + i) * sizeof(double), &values.at(n), sizeof(double));
  }

  friend BoundedBatch operator-(const BoundedBatch& x) { return {-x.center_, -x.shift_x_, -x.shift_y_, x.radius_, -x.upper_, -x.lower_}; }

  friend BoundedBatch operator+(const BoundedBatch& a, const BoundedBatch& b) {
    BoundedBatch sum(a.center_ + b.center_, a.shift_x_ + b.shift_x_, a.shift_y_ + b.shift_y_, a.radius_ + b.radius_);
    const BatchMask narrow = sum.round_narrow();
    const BatchMask exact = a.is_exact() | b.is_exact();
    if (!xsimd::all(narrow & ~exact)) sum.add_with_care(narrow, a, b);
    return sum;
  }

  friend BoundedBatch operator-(const BoundedBatch& a, const BoundedBatch& b) { return a + -b; }

  friend BoundedBatch operator*(const BoundedBatch& a, const BoundedBatch& b) {
    const Batch center = a.center_ * b.center_;
    const Batch size_a = xsimd::abs(a.center_);
    const Batch size_b = xsimd::abs(b.center_);
    const Batch moved_a = a.displacement();
    const Batch moved_b = b.displacement();
    const Batch first_order = size_a * moved_b + size_b * moved_a;
    const Batch radius =
        size_a * b.radius_ + size_b * a.radius_ + (moved_a + a.radius_) * (moved_b + b.radius_) + first_order * Batch(0x1p-50);
    BoundedBatch made(center, a.center_ * b.shift_x_ + b.center_ * a.shift_x_, a.center_ * b.shift_y_ + b.center_ * a.shift_y_, radius);
    const BatchMask narrow = made.round_narrow();
    const BatchMask exact = a.is_exact() | b.is_exact();
    if (!xsimd::all(narrow & ~exact)) made.multiply_with_care(narrow, radius, a, b);
    return made;
  }

  friend BoundedBatch operator/(const BoundedBatch& a, const BoundedBatch& b) {
    const Batch center = a.center_ / b.center_;
    const Batch smallest = xsimd::max(b.lower_, -b.upper_);
    const BatchMask divides = (smallest >= Batch(Precision::smallest_divisor)) & (b.magnitude() <= Batch(Precision::largest_divisor));
    const Batch shift_x = (a.shift_x_ - center * b.shift_x_) / b.center_;
    const Batch shift_y = (a.shift_y_ - center * b.shift_y_) / b.center_;
    const Batch size = xsimd::abs(center);
    const Batch moved_b = b.displacement();
    const Batch first_order = a.displacement() + size * moved_b;
    const Batch radius = (a.radius_ + size * b.radius_ + (xsimd::abs(shift_x) + xsimd::abs(shift_y)) * (moved_b + b.radius_) +
                          first_order * Batch(0x1p-50)) /
                         smallest;
    // By the far end of the divisor toward zero, by the near end away from it.
    const BatchMask negative_b = b.upper_ <= Batch(0.0);
    const Batch far = select(negative_b, -b.lower_, b.upper_);
    const Batch near = select(negative_b, -b.upper_, b.lower_);
    const Batch from = select(negative_b, -a.upper_, a.lower_);
    const Batch to = select(negative_b, -a.lower_, a.upper_);
    const Batch lower = quotient_beside(from, select(from >= Batch(0.0), far, near), -1);
    const Batch upper = quotient_beside(to, select(to <= Batch(0.0), far, near), 1);
    BoundedBatch out;
    out.round({center, shift_x, shift_y, radius, lower, upper}, Error::ulps(division_ulps), false);
    out.settle(
        BatchMask(false), a.is_unbounded() | b.is_unbounded() | ~divides, [](const One& x, const One& y) { return x / y; }, a, b);
    return out;
  }

  friend TruthBatch operator<(const BoundedBatch& a, const BoundedBatch& b) {
    const BatchMask apart = a.upper_ < b.lower_;
    if (xsimd::all(apart | (a.lower_ >= b.upper_))) return {apart, BatchMask(true)};
    const BatchMask at_center = a.center_ < b.center_;
    const BatchMask certain =
        (at_center & (greatest_difference(a, b) < Batch(0.0))) | (~at_center & (greatest_difference(b, a) <= Batch(0.0)));
    return {at_center, certain};
  }
  friend TruthBatch operator>(const BoundedBatch& a, const BoundedBatch& b) { return b < a; }
  friend TruthBatch operator<=(const BoundedBatch& a, const BoundedBatch& b) { return (b < a).negated(); }
  friend TruthBatch operator>=(const BoundedBatch& a, const BoundedBatch& b) { return (a < b).negated(); }

  friend BoundedBatch select(const TruthBatch& condition, const BoundedBatch& a, const BoundedBatch& b) {
    BoundedBatch chosen = b;
    chosen.take(condition.at_center(), a);
    const BatchMask either = condition.is_either();
    if (xsimd::any(either)) {
      for (std::size_t i = 0; i < lanes; ++i) {
        if (either.get(i)) chosen.set_lane(i, select(condition.lane(i), a.lane(i), b.lane(i)));
      }
    }
    return chosen;
  }

  friend BoundedBatch max(const BoundedBatch& a, const BoundedBatch& b) {
    const TruthBatch less = a < b;
    BoundedBatch larger = a;
    larger.take(less.at_center(), b);
    const auto single = [](const One& x, const One& y) { return max(x, y); };
    larger.settle(less.is_either(), a.is_unbounded() | b.is_unbounded(), single, a, b);
    return larger;
  }

  friend BoundedBatch min(const BoundedBatch& a, const BoundedBatch& b) {
    const TruthBatch less = b < a;
    BoundedBatch smaller = a;
    smaller.take(less.at_center(), b);
    const auto single = [](const One& x, const One& y) { return min(x, y); };
    smaller.settle(less.is_either(), a.is_unbounded() | b.is_unbounded(), single, a, b);
    return smaller;
  }
  friend BoundedBatch abs(const BoundedBatch& x) {
    BoundedBatch b = max(x, -x);
    b.lower_ = select(b.is_unbounded(), b.lower_, xsimd::max(b.lower_, Batch(0.0)));
    return b;
  }

  /// What one operation may add to its exact result, as Bounded::Error has it.
  struct Error {
    Batch count, relative, floor;
    bool is_of_ulps;

    static Error ulps(const Batch& count) {
      return {count, count * Batch(epsilon<Precision>), count * Batch(number::ulp<Precision>(0)), true};
    }
    static Error absolute(double relative, const Batch& floor) { return {Batch(0.0), Batch(relative), floor, false}; }
    Batch at(const Batch& x) const { return is_of_ulps ? count * ulp<Precision>(x) : smoothly(x); }
    Batch smoothly(const Batch& x) const { return relative * xsimd::abs(x) + floor; }
  };

  using Exact = ExactBatch;

  /// The value as an operation without error would have given it, for any precision's batch.
  ExactBatch as_exact() const { return {center_, shift_x_, shift_y_, radius_, lower_, upper_}; }

  /// Becomes the exact result after the operation's error. @param keeps_sign  correct rounding never passes zero
  void round(const Exact& x, const Error& error, bool keeps_sign) { round_here(x, error, keeps_sign); }

  /// The same where it is called, into which the error's kind is folded.
  [[gnu::always_inline]] void round_here(const Exact& x, const Error& error, bool keeps_sign) {
    center_ = x.center;
    shift_x_ = x.shift_x;
    shift_y_ = x.shift_y;
    const Batch moved = displacement();
    const Batch size = xsimd::abs(center_);
    const Batch reach = (moved + x.radius) * Batch(1 + 0x1p-48) + size * Batch(0x1p-50);
    const Batch lower = xsimd::max(x.lower, center_ - reach);
    const Batch upper = xsimd::min(x.upper, center_ + reach);
    const Batch smallest = xsimd::max(lower, -upper);
    const Batch largest = xsimd::max(-lower, upper);
    const Batch added = error.at(largest);
    lower_ = below(lower - added);
    upper_ = above(upper + added);
    const BatchMask usual = (largest <= Batch(2.0) * smallest) & (added <= Batch(0.5) * smallest) &
                            (smallest >= Batch(2 * smallest_normal<Precision>)) & (largest <= Batch(0.5 * largest_finite<Precision>)) &
                            (x.radius <= largest);
    const BatchMask clip = reach > Batch(0x1p-8) * largest;
    if (xsimd::all(usual)) {
      set_radius(x.radius, added, clip);
    } else {
      round_with_care(x.radius, {lower, upper, largest, added, largest <= Batch(2.0) * smallest}, error, keeps_sign, usual, clip);
    }
  }

  /// In `open` lanes what `of` makes of the operands' lanes, in `unbounded` ones nothing is promised.
  template <class Operation, class... Operands>
  void settle(const BatchMask& open, const BatchMask& unbounded, const Operation& of, const Operands&... operands) {
    if (xsimd::any(open | unbounded)) settle_lanes(open, unbounded, of, operands...);
  }

  /// In these lanes, this becomes the other.
  void take(const BatchMask& where, const BoundedBatch& other) {
    center_ = select(where, other.center_, center_);
    shift_x_ = select(where, other.shift_x_, shift_x_);
    shift_y_ = select(where, other.shift_y_, shift_y_);
    radius_ = select(where, other.radius_, radius_);
    lower_ = select(where, other.lower_, lower_);
    upper_ = select(where, other.upper_, upper_);
  }

 private:
  static constexpr std::size_t numbers = sizeof(One) / sizeof(double);
  static_assert(std::is_trivially_copyable_v<One> && numbers == 6);

  BoundedBatch(const Batch& center, const Batch& shift_x, const Batch& shift_y, const Batch& radius)
      : BoundedBatch(center, shift_x, shift_y, radius, center, center) {}
  BoundedBatch(const Batch& center, const Batch& shift_x, const Batch& shift_y, const Batch& radius, const Batch& lower, const Batch& upper)
      : center_(center), shift_x_(shift_x), shift_y_(shift_y), radius_(radius), lower_(lower), upper_(upper) {}

  const char* bytes() const { return reinterpret_cast<const char*>(this); }
  char* bytes() { return reinterpret_cast<char*>(this); }

  /// What the exact result may be, before its rounding.
  struct Reach {
    Batch lower, upper, largest, added;
    BatchMask narrow;
  };

  void set_radius(const Batch& exact, const Batch& added, const BatchMask& clip) {
    const Batch moved = displacement();
    const Batch unclipped = (exact + added) * Batch(1 + 0x1p-40) + (xsimd::abs(center_) + moved) * Batch(0x1p-50);
    const Batch clipped = (xsimd::max(upper_ - center_, center_ - lower_) + moved) * Batch(1 + 0x1p-50);
    radius_ = select(clip, xsimd::min(unclipped, clipped), unclipped);
  }

  /// As Bounded::round_with_care(), in the lanes that are not `usual`.
  [[gnu::noinline]] void round_with_care(const Batch& exact_radius, const Reach& r, const Error& error, bool keeps_sign,
                                         const BatchMask& usual, const BatchMask& clip) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr double normal = smallest_normal<Precision>;
    const Batch zero(0.0);
    const auto slack = [&](const Batch& end, const BatchMask& faces_zero) {
      return xsimd::min(r.added, select(faces_zero, error.smoothly(end), error.at(end)));
    };
    Batch lower = below(r.lower - slack(r.lower, r.lower > zero));
    Batch upper = above(r.upper + slack(r.upper, r.upper < zero));
    if (keeps_sign) {
      lower = select(r.lower >= zero, xsimd::max(lower, zero), lower);
      upper = select(r.upper <= zero, xsimd::min(upper, zero), upper);
    }
    lower_ = select(usual | r.narrow, lower_, lower);
    upper_ = select(usual | r.narrow, upper_, upper);
    const BatchMask flushed = ~usual & (lower_ < Batch(normal)) & (upper_ > Batch(-normal));
    const Batch largest = xsimd::max(xsimd::abs(r.lower), xsimd::abs(r.upper));
    const Batch added = select(flushed, xsimd::max(r.added, xsimd::min(largest, Batch(normal) + r.added)), r.added);
    lower_ = select(flushed, xsimd::min(lower_, zero), lower_);
    upper_ = select(flushed, xsimd::max(upper_, zero), upper_);
    const BatchMask finite = (exact_radius + added < Batch(infinity)) & (lower_ >= Batch(-largest_finite<Precision>)) &
                             (upper_ <= Batch(largest_finite<Precision>));
    set_radius(exact_radius, added, ~usual | clip);
    take(~finite, {center_, zero, zero, Batch(infinity), Batch(-infinity), Batch(infinity)});
  }

  /// Bounded::round_narrow in the lanes that are returned.
  BatchMask round_narrow() {
    const Batch size = xsimd::abs(center_);
    const Batch moved = displacement();
    const Batch slack = (size + moved) * Batch(0x1p-50);
    const Batch reach = (moved + radius_) * Batch(1 + 0x1p-48) + slack;
    const BatchMask narrow = (reach <= Batch(0x1p-8) * size) & (size >= Batch(4 * smallest_normal<Precision>)) &
                             (size <= Batch(0.25 * largest_finite<Precision>));
    const Batch added = ulp<Precision>(size + reach);
    radius_ = (radius_ + added) * Batch(1 + 0x1p-40) + slack;
    const Batch total = (reach + added) * Batch(1 + 0x1p-50) + slack;
    lower_ = center_ - total;
    upper_ = center_ + total;
    return narrow;
  }

  /// a + b, which this is already in `narrow` lanes if neither operand is exact.
  [[gnu::noinline]] void add_with_care(const BatchMask& narrow, const BoundedBatch& a, const BoundedBatch& b) {
    const BatchMask exact_a = a.is_exact();
    const BatchMask exact_b = b.is_exact();
    const BatchMask both = exact_a & exact_b;
    BatchMask done = narrow | both;
    if (Precision::holds_its_format) {
      const BatchMask a_is_0 = exact_a & (a.center_ == Batch(0.0)) & ~both;
      const BatchMask b_is_0 = exact_b & (b.center_ == Batch(0.0)) & ~both;
      if (xsimd::any(a_is_0 | b_is_0)) {
        take(a_is_0, b);
        take(b_is_0, a);
        done = done | a_is_0 | b_is_0;
      }
    }
    if (!xsimd::all(done)) {
      const Exact exact{a.center_ + b.center_, a.shift_x_ + b.shift_x_,       a.shift_y_ + b.shift_y_,
                        a.radius_ + b.radius_, sum_below(a.lower_, b.lower_), -sum_below(-a.upper_, -b.upper_)};
      take_rounded(exact, ~done);
    }
    settle(
        both, a.is_unbounded() | b.is_unbounded(), [](const One& x, const One& y) { return x + y; }, a, b);
  }

  /// a b, likewise; exact_radius is that before the rounding.
  [[gnu::noinline]] void multiply_with_care(const BatchMask& narrow, const Batch& exact_radius, const BoundedBatch& a,
                                            const BoundedBatch& b) {
    const BatchMask exact_a = a.is_exact();
    const BatchMask exact_b = b.is_exact();
    const BatchMask both = exact_a & exact_b;
    const bool squared = &a == &b;
    const BatchMask scaled = take_scaled(a, b, exact_b & ~both) | take_scaled(b, a, exact_a & ~both);
    const BatchMask wide = ~(narrow | scaled | both);
    if (xsimd::any(wide)) {
      Exact exact{center_, shift_x_, shift_y_, exact_radius, Batch(0.0), Batch(0.0)};
      if (squared) {
        extremes_of_square(a.lower_, a.upper_, exact.lower, exact.upper);
      } else {
        extremes_of_product(a.lower_, a.upper_, b.lower_, b.upper_, exact.lower, exact.upper);
      }
      take_rounded(exact, wide);
    }
    const auto multiply = [squared](const One& x, const One& y) { return squared ? x * x : x * y; };
    settle(both, a.is_unbounded() | b.is_unbounded(), multiply, a, b);
  }

  /// In these lanes, this becomes what a sum or product is after its rounding.
  void take_rounded(const Exact& exact, const BatchMask& where) {
    BoundedBatch out;
    out.round_here(exact, Error::ulps(Batch(1.0)), true);
    take(where, out);
  }

  /// Becomes x times an exact factor in the lanes where that is exact, which are returned. @param exact  where the factor is
  BatchMask take_scaled(const BoundedBatch& x, const BoundedBatch& factor, const BatchMask& exact) {
    const BatchMask candidates = exact & has_no_fraction(factor.center_);
    if (!Precision::holds_its_format || !xsimd::any(candidates)) return BatchMask(false);
    const Batch by = factor.center_;
    const Batch size = xsimd::abs(by);
    const Batch smallest = xsimd::max(x.lower_, -x.upper_) * size;
    const BatchMask keeps_bits = (size >= Batch(1.0)) | (smallest >= Batch(smallest_normal<Precision>));
    const BatchMask scales = candidates & ((by == Batch(0.0)) | (keeps_bits & (x.magnitude() * size <= Batch(largest_finite<Precision>))));
    const Batch lower = x.lower_ * by;
    const Batch upper = x.upper_ * by;
    take(scales, {x.center_ * by, x.shift_x_ * by, x.shift_y_ * by, x.radius_ * size, xsimd::min(lower, upper), xsimd::max(lower, upper)});
    return scales;
  }

  template <class Operation, class... Operands>
  [[gnu::noinline]] void settle_lanes(const BatchMask& open, const BatchMask& unbounded, const Operation& of, const Operands&... operands) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    take(unbounded, {center_, Batch(0.0), Batch(0.0), Batch(infinity), Batch(-infinity), Batch(infinity)});
    for (std::size_t i = 0; i < lanes; ++i) {
      if (open.get(i) && !unbounded.get(i)) set_lane(i, of(operands.lane(i)...));
    }
  }

  static Batch greatest_difference(const BoundedBatch& a, const BoundedBatch& b) {
    const Batch affine = (a.center_ - b.center_) + xsimd::abs(a.shift_x_ - b.shift_x_) + xsimd::abs(a.shift_y_ - b.shift_y_) + a.radius_ +
                         b.radius_ + (xsimd::abs(a.center_) + xsimd::abs(b.center_)) * Batch(0x1p-50);
    const Batch apart = a.upper_ - b.lower_;
    return select(a.is_exact() & b.is_exact(), apart, xsimd::min(affine, apart));
  }

  Batch center_, shift_x_, shift_y_, radius_, lower_, upper_;
};

}  // namespace sheen::number
