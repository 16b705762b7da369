#pragma once

#include <cstddef>
#include <limits>

#include "number/bounded_batch_functions.h"
#include "number/float_batch.h"

namespace sheen::number {

using RangeTruth = Truths<FloatMask>;

/// Eight values in highp of which only the least and the greatest are known, in float: what samples need that are spread far wider than
/// rounding, with their displacement, spreads them. Every operation encloses what highp allows of it and rounds outward, some four times
/// as far. A lane that may leave the format, or where a function may meet what it is not defined for, is lost, and so is all that comes
/// of it.
class RangeBatch {
 public:
  static constexpr std::size_t lanes = FloatBatch::size;
  using Bounds = BoundedBatch<Highp>;

  RangeBatch() = default;
  /// A constant of the shader, in every lane.
  [[gnu::always_inline]] explicit RangeBatch(double value) : lower_(static_cast<float>(value)), upper_(lower_) {
    if (!is_representable<Highp>(value)) *this = rounded(lower_, upper_, correct_rounding, Sign::Kept);
  }
  /// In each lane what lies between the two; lost where neither is a number, which is so of both or of none.
  RangeBatch(const FloatBatch& lower, const FloatBatch& upper) : lower_(lower), upper_(upper) {}
  /// Of the first four lanes, and the last.
  RangeBatch(const Bounds& first, const Bounds& last) : RangeBatch(first.lower(), last.lower(), first.upper(), last.upper()) {}
  /// What lies between ends in double: four lower ones and four more, and the upper ones; infinite of what is unbounded.
  RangeBatch(const Batch& lower, const Batch& last_lower, const Batch& upper, const Batch& last_upper)
      : lower_(outward(lower, last_lower, -1.0F)), upper_(outward(upper, last_upper, 1.0F)) {
    const FloatBatch beyond = lost(lower_) + lost(upper_);
    lower_ += beyond;
    upper_ += beyond;
  }

  const FloatBatch& lower() const { return lower_; }
  const FloatBatch& upper() const { return upper_; }
  FloatMask is_lost() const { return ~(lower_ == lower_); }

  /// Four lanes of it. @param half  0 or 1
  Bounds bounds(std::size_t half) const {
    const Batch low = widened(lower_, half);
    const Batch high = widened(upper_, half);
    const Batch center = Batch(0.5) * (low + high);
    const Batch room = Batch(0.5 + 0x1p-50) * (high - low);
    const Batch radius = select(low == high, Batch(0.0), room + Batch(0x1p-50) * xsimd::abs(center));
    return Bounds::of_form({center, Batch(0.0), Batch(0.0), radius, low, high}, ~(low == low));
  }

  /// In these lanes, this becomes the other.
  void take(const FloatMask& where, const RangeBatch& other) {
    lower_ = xsimd::select(where, other.lower_, lower_);
    upper_ = xsimd::select(where, other.upper_, upper_);
  }

  friend RangeBatch operator-(const RangeBatch& x) { return {-x.upper_, -x.lower_}; }
  friend RangeBatch operator+(const RangeBatch& a, const RangeBatch& b) {
    return rounded(a.lower_ + b.lower_, a.upper_ + b.upper_, correct_rounding, Sign::Kept);
  }
  friend RangeBatch operator-(const RangeBatch& a, const RangeBatch& b) {
    return rounded(a.lower_ - b.upper_, a.upper_ - b.lower_, correct_rounding, Sign::Kept);
  }
  [[gnu::always_inline]] friend RangeBatch operator*(const RangeBatch& a, const RangeBatch& b) {
    if (&a == &b) {
      const RangeBatch size = abs(a);
      return rounded_positive(size.lower_ * size.lower_, size.upper_ * size.upper_);
    }
    return are_positive(a, b) ? rounded_positive(a.lower_ * b.lower_, a.upper_ * b.upper_) : rounded_product(a, b);
  }
  /// a b + c d + e f, in whatever order, the operations contracted or not: all roundings enclosed at once, as of the largest terms.
  friend RangeBatch sum_of_products(const RangeBatch& a, const RangeBatch& b, const RangeBatch& c, const RangeBatch& d, const RangeBatch& e,
                                    const RangeBatch& f) {
    const RangeBatch p[3] = {product_of_any_sign(a, b), product_of_any_sign(c, d), product_of_any_sign(e, f)};
    return summed(p[0].lower_ + p[1].lower_ + p[2].lower_, p[0].upper_ + p[1].upper_ + p[2].upper_,
                  p[0].size() + p[1].size() + p[2].size());
  }
  /// a b - c d, likewise.
  friend RangeBatch difference_of_products(const RangeBatch& a, const RangeBatch& b, const RangeBatch& c, const RangeBatch& d) {
    const RangeBatch p[2] = {product_of_any_sign(a, b), product_of_any_sign(c, d)};
    return summed(p[0].lower_ - p[1].upper_, p[0].upper_ - p[1].lower_, p[0].size() + p[1].size());
  }
  /// a a + b b + c c, likewise.
  friend RangeBatch sum_of_squares(const RangeBatch& a, const RangeBatch& b, const RangeBatch& c) {
    const RangeBatch size[3] = {abs(a), abs(b), abs(c)};
    const auto squares = [](const FloatBatch& x, const FloatBatch& y, const FloatBatch& z) { return x * x + y * y + z * z; };
    const FloatBatch upper = squares(size[0].upper_, size[1].upper_, size[2].upper_);
    const FloatBatch room = xsimd::fma(upper + upper, FloatBatch(0.0F), FloatBatch(4 * flushed));
    const FloatBatch lower = squares(size[0].lower_, size[1].lower_, size[2].lower_);
    return {xsimd::max(FloatBatch(0.0F), xsimd::fms(lower, FloatBatch(1 - of_products), room)),
            xsimd::fma(upper, FloatBatch(1 + of_products), room)};
  }
  friend RangeBatch operator/(const RangeBatch& a, const RangeBatch& b) {
    const RangeBatch size = abs(b);
    const FloatMask divides = (size.lower_ >= FloatBatch(static_cast<float>(Highp::smallest_divisor))) &
                              (size.upper_ <= FloatBatch(static_cast<float>(Highp::largest_divisor)));
    const FloatBatch one = xsimd::select(divides, FloatBatch(1.0F), FloatBatch(not_a_number));
    const RangeBatch exact = product(a, {one / b.upper_, one / b.lower_});
    return rounded(exact.lower_, exact.upper_, several_ulps, Sign::Open);
  }

  friend RangeTruth operator<(const RangeBatch& a, const RangeBatch& b) {
    const FloatMask less = a.upper_ < b.lower_;
    return {less, less | (a.lower_ >= b.upper_)};
  }
  friend RangeTruth operator>(const RangeBatch& a, const RangeBatch& b) { return b < a; }
  friend RangeTruth operator<=(const RangeBatch& a, const RangeBatch& b) { return (b < a).negated(); }
  friend RangeTruth operator>=(const RangeBatch& a, const RangeBatch& b) { return (a < b).negated(); }

  friend RangeBatch select(const RangeTruth& condition, const RangeBatch& a, const RangeBatch& b) {
    const RangeBatch either{xsimd::min(a.lower_, b.lower_) + lost(a.lower_), xsimd::max(a.upper_, b.upper_) + lost(a.upper_)};
    const auto chosen = [&](const FloatBatch& of_a, const FloatBatch& of_b, const FloatBatch& of_either) {
      return xsimd::select(condition.is_true(), of_a, xsimd::select(condition.is_false(), of_b, of_either));
    };
    return {chosen(a.lower_, b.lower_, either.lower_), chosen(a.upper_, b.upper_, either.upper_)};
  }
  friend RangeBatch max(const RangeBatch& a, const RangeBatch& b) {
    return {xsimd::max(a.lower_, b.lower_) + lost(a.lower_), xsimd::max(a.upper_, b.upper_) + lost(a.upper_)};
  }
  friend RangeBatch min(const RangeBatch& a, const RangeBatch& b) {
    return {xsimd::min(a.lower_, b.lower_) + lost(a.lower_), xsimd::min(a.upper_, b.upper_) + lost(a.upper_)};
  }
  friend RangeBatch abs(const RangeBatch& x) {
    return {xsimd::max(FloatBatch(0.0F), xsimd::max(x.lower_, -x.upper_)), xsimd::max(-x.lower_, x.upper_)};
  }

  friend RangeBatch sqrt(const RangeBatch& x) { return positive(x, xsimd::sqrt(x.lower_), xsimd::sqrt(x.upper_)); }
  friend RangeBatch inversesqrt(const RangeBatch& x) {
    const FloatBatch one(1.0F);
    return positive(x, one / xsimd::sqrt(x.upper_), one / xsimd::sqrt(x.lower_));
  }
  // The others are BoundedBatch's.
  friend RangeBatch exp(const RangeBatch& x) {
    return by_halves([](const Bounds& y) { return exp(y); }, x);
  }
  friend RangeBatch log(const RangeBatch& x) {
    return by_halves([](const Bounds& y) { return log(y); }, x);
  }
  friend RangeBatch log1p(const RangeBatch& x) {
    return by_halves([](const Bounds& y) { return log1p(y); }, x);
  }
  /// As AffineBatch's.
  friend RangeBatch mix(double x, double y, const RangeBatch& t) {
    const auto at = [&](const FloatBatch& v) {
      return xsimd::fma(FloatBatch(static_cast<float>(y - x)), v, FloatBatch(static_cast<float>(x)));
    };
    const RangeBatch exact = y < x ? RangeBatch(at(t.upper_), at(t.lower_)) : RangeBatch(at(t.lower_), at(t.upper_));
    const FloatBatch one(1.0F);
    const FloatBatch rest = xsimd::max(xsimd::abs(one - t.lower_), xsimd::abs(one - t.upper_));
    const FloatBatch errors = FloatBatch(1.5F) * mix_error<Highp>(x, y, rest, xsimd::max(xsimd::abs(t.lower_), xsimd::abs(t.upper_)));
    return {exact.lower_ - errors, exact.upper_ + errors};
  }
  friend RangeBatch pow(const RangeBatch& x, const RangeBatch& y) {
    return by_halves([](const Bounds& v, const Bounds& w) { return pow(v, w); }, x, y);
  }
  friend RangeBatch pow_from_zero(const RangeBatch& x, const RangeBatch& y) {
    return by_halves([](const Bounds& v, const Bounds& w) { return pow_from_zero(v, w); }, x, y);
  }

 private:
  static constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

  // What an end moves outward, relative to it, in units of 2^-24, of which an ulp is 2 at the most. Of one correct rounding: 2, and 1 for
  // float's of the exact end and 2 for those on the way outward. Of a quotient (2.5 ulp, taken as a product of a reciprocal), an
  // inversesqrt (2 ulp) and a sqrt (2 and 2.5 ulp): no more than 9, 2 for float's and 2 on the way.
  static constexpr float correct_rounding = 8 * 0x1p-24F;
  static constexpr float several_ulps = 16 * 0x1p-24F;
  // Of up to three products and their sum, relative to the sum of the largest: 2 for each product, 4 for both sums; of float's, 1 and 2,
  // and 2 on the way.
  static constexpr float of_products = 16 * 0x1p-24F;
  /// More than a flush takes away, and float's own roundings of subnormal numbers.
  static constexpr float flushed = 0x1p-125F;

  /// Whether an end may be rounded past zero: correct rounding never does that. Where float has several ends to choose from, a zero's own
  /// sign does not tell what it was before it was rounded.
  enum class Sign { Open, Kept, KeptBeyondZero };

  /// 0, not a number where x is none.
  static FloatBatch lost(const FloatBatch& x) { return x - x; }

  static FloatMask is_negative(const FloatBatch& x) { return FloatMask(typename FloatMask::register_type(x)); }

  static bool are_positive(const RangeBatch& a, const RangeBatch& b) { return !xsimd::any(is_negative(a.lower_ | b.lower_)); }

  /// Of the exact ends as float rounds them, those of what a shader may have.
  static RangeBatch rounded(const FloatBatch& lower, const FloatBatch& upper, float relative, Sign sign) {
    const FloatBatch size_of_lower = xsimd::abs(lower);
    const FloatBatch size_of_upper = xsimd::abs(upper);
    const FloatBatch sizes = size_of_lower + size_of_upper;
    // Not a number from the format's last binade on, of both ends.
    const FloatBatch room = xsimd::fma(sizes + sizes, FloatBatch(0.0F), FloatBatch(flushed));
    FloatBatch low = xsimd::fnma(size_of_lower, FloatBatch(relative), lower) - room;
    FloatBatch high = xsimd::fma(size_of_upper, FloatBatch(relative), upper) + room;
    const FloatBatch zero(0.0F);  // first in max() and min(), so that what is not a number stays so
    if (sign == Sign::Kept) {
      low = xsimd::select(is_negative(lower), low, xsimd::max(zero, low));
      high = xsimd::select(is_negative(upper), xsimd::min(zero, high), high);
    } else if (sign == Sign::KeptBeyondZero) {
      low = xsimd::select(lower > zero, xsimd::max(zero, low), low);
      high = xsimd::select(upper < zero, xsimd::min(zero, high), high);
    }
    return {low, high};
  }

  /// The same of ends that are not negative, correctly.
  static RangeBatch rounded_positive(const FloatBatch& lower, const FloatBatch& upper) {
    const FloatBatch room = xsimd::fma(upper + upper, FloatBatch(0.0F), FloatBatch(flushed));
    return {xsimd::max(FloatBatch(0.0F), xsimd::fms(lower, FloatBatch(1 - correct_rounding), room)),
            xsimd::fma(upper, FloatBatch(1 + correct_rounding), room)};
  }

  /// The ends of all products, each rounded by float.
  static RangeBatch product(const RangeBatch& a, const RangeBatch& b) {
    return are_positive(a, b) ? RangeBatch{a.lower_ * b.lower_, a.upper_ * b.upper_} : product_of_any_sign(a, b);
  }
  static RangeBatch product_of_any_sign(const RangeBatch& a, const RangeBatch& b) {
    const FloatBatch p[4] = {a.lower_ * b.lower_, a.lower_ * b.upper_, a.upper_ * b.lower_, a.upper_ * b.upper_};
    return {xsimd::min(xsimd::min(p[0], p[1]), xsimd::min(p[2], p[3])), xsimd::max(xsimd::max(p[0], p[1]), xsimd::max(p[2], p[3]))};
  }

  /// The largest that it may be, either way.
  FloatBatch size() const { return xsimd::max(-lower_, upper_); }

  /// Sums of products as float adds them up, after the operations' errors.
  /// @param size  of the products' sizes
  static RangeBatch summed(const FloatBatch& lower, const FloatBatch& upper, const FloatBatch& size) {
    const FloatBatch room = xsimd::fma(size, FloatBatch(of_products), xsimd::fma(size + size, FloatBatch(0.0F), FloatBatch(4 * flushed)));
    return {lower - room, upper + room};
  }

  [[gnu::noinline]] static RangeBatch rounded_product(const RangeBatch& a, const RangeBatch& b) {
    const auto by_positive = [](const RangeBatch& x, const RangeBatch& size) -> RangeBatch {
      return {xsimd::min(x.lower_ * size.lower_, x.lower_ * size.upper_), xsimd::max(x.upper_ * size.lower_, x.upper_ * size.upper_)};
    };
    const RangeBatch exact = !xsimd::any(is_negative(b.lower_))   ? by_positive(a, b)
                             : !xsimd::any(is_negative(a.lower_)) ? by_positive(b, a)
                                                                  : product_of_any_sign(a, b);
    return rounded(exact.lower_, exact.upper_, correct_rounding, Sign::KeptBeyondZero);
  }

  /// Of a function of positive numbers.
  static RangeBatch positive(const RangeBatch& x, const FloatBatch& lower, const FloatBatch& upper) {
    const FloatMask defined = x.lower_ >= FloatBatch(static_cast<float>(smallest_normal<Highp>));
    // One end that is no number loses both.
    return rounded(lower, xsimd::select(defined, upper, FloatBatch(not_a_number)), several_ulps, Sign::Open);
  }

  /// The nearest floats, and from those that lie inside one step outward.
  /// @param side  -1 for lower ends, 1 for upper ones
  static FloatBatch outward(const Batch& first, const Batch& last, float side) {
    const FloatBatch nearest = narrowed(first, last);
    const auto inside = [&](const Batch& exact, std::size_t half) {
      return select((exact - widened(nearest, half)) * Batch(side) > Batch(0.0), Batch(1.0), Batch(0.0));
    };
    const FloatBatch step = xsimd::fma(xsimd::abs(nearest), FloatBatch(side * 0x1p-23F), FloatBatch(side * 0x1p-149F));
    return xsimd::fma(narrowed(inside(first, 0), inside(last, 1)), step, nearest);
  }

  FloatBatch lower_, upper_;  // where lost, neither is a number
};

/// The lanes are samples, as BoundedBatch's.
template <>
struct Lanes<RangeBatch> {
  static constexpr std::size_t count = 1;
  static RangeBatch load(const double* values) { return RangeBatch(*values); }
};

}  // namespace sheen::number
