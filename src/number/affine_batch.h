#pragma once

#include <cstddef>
#include <limits>

#include "number/bounded_batch_functions.h"

namespace sheen::number {

/// Four of number::Bounded's affine forms without their ranges, in a third of BoundedBatch's arithmetic: what most values of a shading
/// need, which stay clear of the points where formulas branch. A lane whose result depends on more (a comparison that may go either way, a
/// function at the end of where it is defined, a range beyond the format) is lost, and so is all that comes of it: it is to be evaluated
/// on BoundedBatch. What is not lost encloses all that number::Bounded's own form does; what two exact numbers make is taken to be rounded.
template <class Precision>
class AffineBatch {
 public:
  using Bounds = BoundedBatch<Precision>;
  static_assert(Precision::holds_its_format);

  AffineBatch() = default;
  /// A constant of the shader, in every lane.
  explicit AffineBatch(double value)
      : center_(value), shift_x_(0.0), shift_y_(0.0), radius_(constant_radius(value)), spread_((1 + 0x1p-20) * constant_radius(value)) {}
  /// Forgets the range.
  explicit AffineBatch(const Bounds& x)
      : center_(x.center()),
        shift_x_(x.shift_x()),
        shift_y_(x.shift_y()),
        radius_(x.radius()),
        spread_((x.displacement() + x.radius()) * Batch(1 + 0x1p-50)) {
    spread_ += select(spread_ > Batch(0.0), xsimd::abs(center_) * Batch(0x1p-50), Batch(0.0));
  }

  const Batch& center() const { return center_; }
  Batch lower() const { return center_ - spread_; }
  Batch upper() const { return center_ + spread_; }
  Batch magnitude() const { return xsimd::abs(center_) + spread_; }
  BatchMask is_exact() const { return spread_ == Batch(0.0); }
  BatchMask is_lost() const { return ~(spread_ < Batch(std::numeric_limits<double>::infinity())); }

  /// With the range that the form implies; nothing is promised of lanes that are lost.
  Bounds bounds() const { return Bounds::of_form({center_, shift_x_, shift_y_, radius_, lower(), upper()}, is_lost()); }

  friend AffineBatch operator-(const AffineBatch& x) {
    AffineBatch out = x;
    out.center_ = -x.center_;
    out.shift_x_ = -x.shift_x_;
    out.shift_y_ = -x.shift_y_;
    return out;
  }

  friend AffineBatch operator+(const AffineBatch& a, const AffineBatch& b) {
    AffineBatch sum;
    sum.round(a.center_ + b.center_, a.shift_x_ + b.shift_x_, a.shift_y_ + b.shift_y_, a.radius_ + b.radius_);
    if (xsimd::any(xsimd::min(a.magnitude(), b.magnitude()) == Batch(0.0))) sum.keep_summand(a, b);
    return sum;
  }

  friend AffineBatch operator-(const AffineBatch& a, const AffineBatch& b) {
    AffineBatch difference;
    difference.round(a.center_ - b.center_, a.shift_x_ - b.shift_x_, a.shift_y_ - b.shift_y_, a.radius_ + b.radius_);
    if (xsimd::any(xsimd::min(a.magnitude(), b.magnitude()) == Batch(0.0))) difference.keep_summand(a, -b);
    return difference;
  }

  friend AffineBatch operator*(const AffineBatch& a, const AffineBatch& b) {
    // Double's roundings of the two parts of a shift, which may cancel, are within round()'s room: were a0 d_b far larger than the sum,
    // then either d_a <= a0 and it is no more than a0 b0, or both displacements exceed their centres and it is no more than d_a d_b.
    const Batch radius = xsimd::fma(xsimd::abs(a.center_), b.radius_, xsimd::fma(xsimd::abs(b.center_), a.radius_, a.spread_ * b.spread_));
    AffineBatch product;
    product.round(a.center_ * b.center_, xsimd::fma(a.center_, b.shift_x_, b.center_ * a.shift_x_),
                  xsimd::fma(a.center_, b.shift_y_, b.center_ * a.shift_y_), radius);
    if (xsimd::any(xsimd::min(a.spread_, b.spread_) == Batch(0.0))) product.keep_scaled(a, b);
    return product;
  }

  friend AffineBatch operator/(const AffineBatch& a, const AffineBatch& b) { return AffineBatch(a.bounds() / b.bounds()); }

  friend TruthBatch operator<(const AffineBatch& a, const AffineBatch& b) {
    return {a.center_ < b.center_, (overlap(a, b) < Batch(0.0)) | (a.is_exact() & b.is_exact())};
  }
  friend TruthBatch operator>(const AffineBatch& a, const AffineBatch& b) { return b < a; }
  friend TruthBatch operator<=(const AffineBatch& a, const AffineBatch& b) { return negated(b < a); }
  friend TruthBatch operator>=(const AffineBatch& a, const AffineBatch& b) { return negated(a < b); }

  friend AffineBatch select(const TruthBatch& condition, const AffineBatch& a, const AffineBatch& b) {
    AffineBatch chosen = b;
    chosen.take(condition.at_center(), a);
    chosen.lose(condition.is_either());
    return chosen;
  }
  friend AffineBatch max(const AffineBatch& a, const AffineBatch& b) { return outermost(a.center_ < b.center_, a, b); }
  friend AffineBatch min(const AffineBatch& a, const AffineBatch& b) { return outermost(b.center_ < a.center_, a, b); }
  friend AffineBatch abs(const AffineBatch& x) { return max(x, -x); }

  /// In these lanes, this becomes the other.
  void take(const BatchMask& where, const AffineBatch& other) {
    center_ = select(where, other.center_, center_);
    shift_x_ = select(where, other.shift_x_, shift_x_);
    shift_y_ = select(where, other.shift_y_, shift_y_);
    radius_ = select(where, other.radius_, radius_);
    spread_ = select(where, other.spread_, spread_);
  }

 private:
  /// Becomes the exact result of a sum or product after its rounding.
  void round(const Batch& center, const Batch& shift_x, const Batch& shift_y, const Batch& radius) {
    center_ = center;
    shift_x_ = shift_x;
    shift_y_ = shift_y;
    const Batch spread = xsimd::abs(shift_x) + xsimd::abs(shift_y) + radius;
    const Batch largest = (xsimd::abs(center) + spread) * Batch(1 + 0x1p-50);
    const Batch added = largest_rounding(largest);
    // For what double rounded on the way here: some eight of its roundings of no more than the largest.
    radius_ = xsimd::fma(largest, Batch(0x1p-49), radius + added);
    spread_ = xsimd::fma(largest, Batch(0x1p-48), spread + added);
  }

  /// An ulp of the largest result, or what a flush to zero takes away. Infinite from the format's last binade on, and of
  /// what is no number.
  static Batch largest_rounding(const Batch& largest) {
    constexpr int to_infinity = 1024 - Precision::max_exponent;
    const BatchBits exponent = xsimd::bitwise_cast<BatchBits>(largest) & BatchBits(std::uint64_t{0x7ff} << 52);
    const Batch ulp = xsimd::bitwise_cast<Batch>(exponent) * Batch(power_of_two(to_infinity)) *
                      Batch(power_of_two(-Precision::fraction_bits - to_infinity));
    return xsimd::max(Batch(2 * smallest_normal<Precision>), ulp);
  }

  /// Adding 0 changes nothing.
  [[gnu::noinline]] void keep_summand(const AffineBatch& a, const AffineBatch& b) {
    take(a.magnitude() == Batch(0.0), b);
    take(b.magnitude() == Batch(0.0), a);
  }

  /// Nor does a power of two round what stays a normal number.
  [[gnu::noinline]] void keep_scaled(const AffineBatch& a, const AffineBatch& b) {
    const auto keep = [this](const AffineBatch& x, const AffineBatch& by) {
      const Batch size = xsimd::abs(by.center_);
      const Batch smallest = (xsimd::abs(x.center_) - x.spread_) * size;
      const BatchMask stays_normal = (smallest >= Batch(smallest_normal<Precision>)) | (size >= Batch(1.0)) | (size == Batch(0.0));
      const BatchMask exact = by.is_exact() & has_no_fraction(by.center_) & stays_normal & ~is_lost();
      radius_ = select(exact, x.radius_ * size, radius_);
      spread_ = select(exact, x.spread_ * size, spread_);
    };
    keep(a, b);
    keep(b, a);
  }

  /// Of a constant, which stands for either neighbour where the format does not hold it.
  static double constant_radius(double value) {
    return is_representable<Precision>(value) ? 0.0 : (1 + 0x1p-20) * ulp<Precision>(value) + smallest_normal<Precision>;
  }

  /// By how much the one of smaller centre may exceed the other, at the most; where it is certainly smaller, negative.
  static Batch overlap(const AffineBatch& a, const AffineBatch& b) {
    const Batch room = (xsimd::abs(a.center_) + xsimd::abs(b.center_)) * Batch(0x1p-49);
    const Batch changes = xsimd::abs(a.shift_x_ - b.shift_x_) + xsimd::abs(a.shift_y_ - b.shift_y_);
    return (changes + (a.radius_ + b.radius_)) * Batch(1 + 0x1p-49) + room - xsimd::abs(a.center_ - b.center_);
  }

  /// Of max() and min(): b in some lanes, else a, with room for the other where that lies beyond: then it is within its own radius of its
  /// form, and no nearer than the chosen one's radius on the other side.
  static AffineBatch outermost(const BatchMask& where, const AffineBatch& a, const AffineBatch& b) {
    const BatchMask apart = (a.spread_ + b.spread_) * Batch(1 + 0x1p-50) < xsimd::abs(a.center_ - b.center_);
    if (xsimd::all(apart & ~where)) return a;
    AffineBatch chosen = a;
    chosen.take(where, b);
    if (xsimd::all(apart)) return chosen;
    const Batch radius = overlap(a, b) - chosen.radius_;
    // What is no number stays so.
    const Batch more = select((radius <= chosen.radius_) | (a.is_exact() & b.is_exact()), Batch(0.0), radius - chosen.radius_);
    chosen.radius_ += more;
    chosen.spread_ = (chosen.spread_ + more) * Batch(1 + 0x1p-50);
    return chosen;
  }

  void lose(const BatchMask& where) {
    const Batch infinity(std::numeric_limits<double>::infinity());
    radius_ = select(where, infinity, radius_);
    spread_ = select(where, infinity, spread_);
  }

  static TruthBatch negated(const TruthBatch& t) { return {~t.at_center(), ~t.is_either()}; }

  Batch center_, shift_x_, shift_y_, radius_;
  Batch spread_;  // at least |shift_x| + |shift_y| + radius; 0 only of an exact number
};

// The built-in functions are BoundedBatch's, whose results keep their form.

template <class Precision>
AffineBatch<Precision> exp(const AffineBatch<Precision>& x) {
  return AffineBatch<Precision>(exp(x.bounds()));
}
template <class Precision>
AffineBatch<Precision> log(const AffineBatch<Precision>& x) {
  return AffineBatch<Precision>(log(x.bounds()));
}
template <class Precision>
AffineBatch<Precision> log1p(const AffineBatch<Precision>& x) {
  return AffineBatch<Precision>(log1p(x.bounds()));
}
template <class Precision>
AffineBatch<Precision> sqrt(const AffineBatch<Precision>& x) {
  return AffineBatch<Precision>(sqrt(x.bounds()));
}
template <class Precision>
AffineBatch<Precision> inversesqrt(const AffineBatch<Precision>& x) {
  return AffineBatch<Precision>(inversesqrt(x.bounds()));
}
template <class Precision>
AffineBatch<Precision> pow(const AffineBatch<Precision>& x, const AffineBatch<Precision>& y) {
  return AffineBatch<Precision>(pow(x.bounds(), y.bounds()));
}
template <class Precision>
AffineBatch<Precision> pow_from_zero(const AffineBatch<Precision>& x, const AffineBatch<Precision>& y) {
  return AffineBatch<Precision>(pow_from_zero(x.bounds(), y.bounds()));
}

}  // namespace sheen::number
