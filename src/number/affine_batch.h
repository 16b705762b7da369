#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "number/bounded_batch_functions.h"
#include "number/float_batch.h"

namespace sheen::number {

/// Eight of number::Bounded's affine forms of highp, without their ranges and in float: what most values of a shading need, which stay
/// clear of the points where formulas branch, in a fraction of BoundedBatch's arithmetic. A lane whose result depends on more (a comparison
/// that may go either way, a function at the end of where it is defined, a range beyond the format) is lost, and so is all that comes of
/// it: it is to be evaluated on BoundedBatch. What is not lost encloses all that number::Bounded's own form does; what two exact numbers
/// make is taken to be rounded, unless it is 0. Centres are off what double would make of them, by less than the radius.
class AffineBatch {
 public:
  using Bounds = BoundedBatch<Highp>;
  static constexpr std::size_t lanes = FloatBatch::size;

  AffineBatch() = default;
  /// A constant of the shader, in every lane.
  explicit AffineBatch(double value)
      : center_(static_cast<float>(value)),
        shift_x_(0.0F),
        shift_y_(0.0F),
        radius_(constant_radius(value)),
        spread_(2.5F * constant_radius(value)) {}
  /// Forgets the range. Of the first four lanes, and the last.
  AffineBatch(const Bounds& first, const Bounds& last)
      : center_(narrowed(first.center(), last.center())),
        shift_x_(narrowed(first.shift_x(), last.shift_x())),
        shift_y_(narrowed(first.shift_y(), last.shift_y())) {
    const auto radius = [this](const Bounds& x, std::size_t half) {
      const Batch off = xsimd::abs(x.center() - widened(center_, half));
      return grown(x.radius() + off + x.displacement() * Batch(2 * unit), Batch(0.0));
    };
    const Batch radius_first = radius(first, 0);
    const Batch radius_last = radius(last, 1);
    const auto spread = [](const Bounds& x, const Batch& of_radius) {
      return grown(of_radius + x.displacement(), xsimd::abs(x.center()) * Batch(2 * unit));
    };
    radius_ = narrowed(radius_first, radius_last);
    spread_ = narrowed(spread(first, radius_first), spread(last, radius_last));
  }

  const FloatBatch& center() const { return center_; }
  const FloatBatch& radius() const { return radius_; }
  /// At least what lies between the centre and anything that the value may be; 0 only of an exact number.
  const FloatBatch& spread() const { return spread_; }
  FloatBatch displacement() const { return xsimd::abs(shift_x_) + xsimd::abs(shift_y_); }
  FloatBatch lower() const { return center_ - spread_; }
  FloatBatch upper() const { return center_ + spread_; }
  FloatBatch magnitude() const { return xsimd::abs(center_) + spread_; }
  FloatMask is_exact() const { return spread_ == FloatBatch(0.0F); }
  FloatMask is_lost() const { return ~(spread_ < FloatBatch(infinity)); }

  /// Four lanes with the range that the form implies; nothing is promised of lanes that are lost. @param half  0 or 1
  Bounds bounds(std::size_t half) const {
    const Batch center = widened(center_, half);
    const Batch spread = widened(spread_, half);
    return Bounds::of_form(
        {center, widened(shift_x_, half), widened(shift_y_, half), widened(radius_, half), center - spread, center + spread},
        ~(spread < Batch(std::numeric_limits<double>::infinity())));
  }

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
    if (xsimd::any(xsimd::min(a.magnitude(), b.magnitude()) == FloatBatch(0.0F))) sum.keep_summand(a, b);
    return sum;
  }

  friend AffineBatch operator-(const AffineBatch& a, const AffineBatch& b) {
    AffineBatch difference;
    difference.round(a.center_ - b.center_, a.shift_x_ - b.shift_x_, a.shift_y_ - b.shift_y_, a.radius_ + b.radius_);
    if (xsimd::any(xsimd::min(a.magnitude(), b.magnitude()) == FloatBatch(0.0F))) difference.keep_summand(a, -b);
    if (xsimd::any(a.center_ == b.center_)) difference.keep_cancelled(a, b);
    return difference;
  }

  friend AffineBatch operator*(const AffineBatch& a, const AffineBatch& b) {
    // Of a shift's two parts one is rounded before they are added, and may then be all that is left of it.
    const FloatBatch radius_a = xsimd::fma(a.spread_, FloatBatch(2 * unit), a.radius_);
    const FloatBatch first_order = xsimd::fma(xsimd::abs(a.center_), b.radius_, xsimd::abs(b.center_) * radius_a);
    AffineBatch product;
    product.round(a.center_ * b.center_, xsimd::fma(a.center_, b.shift_x_, b.center_ * a.shift_x_),
                  xsimd::fma(a.center_, b.shift_y_, b.center_ * a.shift_y_), xsimd::fma(a.spread_, b.spread_, first_order));
    if (xsimd::any(xsimd::min(a.spread_, b.spread_) == FloatBatch(0.0F))) product.keep_scaled(a, b);
    return product;
  }

  friend AffineBatch operator/(const AffineBatch& a, const AffineBatch& b) {
    const FloatBatch size = xsimd::abs(b.center_);
    const FloatBatch smallest = size - b.spread_;
    const FloatBatch inverse = FloatBatch(1.0F) / b.center_;
    const FloatBatch quotient = a.center_ / b.center_;
    const FloatBatch shift_x = xsimd::fnma(quotient, b.shift_x_, a.shift_x_) * inverse;
    const FloatBatch shift_y = xsimd::fnma(quotient, b.shift_y_, a.shift_y_) * inverse;
    // With d the difference of a and the quotient times b, of which a part is displaced, that part over b's centre has left this of d / b.
    // The quotient's own rounding comes into both shifts.
    const FloatBatch radius_b = xsimd::fma(b.spread_, FloatBatch(4 * unit), b.radius_);
    const FloatBatch rest = xsimd::fma(xsimd::abs(quotient), radius_b, a.radius_) + (xsimd::abs(shift_x) + xsimd::abs(shift_y)) * b.spread_;
    // Among subnormal numbers the dividend's terms lose more than their share, which a small divisor makes great.
    const FloatBatch subnormal(0x1p-146F);
    AffineBatch out;
    out.round(quotient, shift_x, shift_y, (rest + subnormal) / smallest, division_ulps);
    out.lose(~((smallest >= FloatBatch(static_cast<float>(Highp::smallest_divisor))) &
               (size + b.spread_ <= FloatBatch(static_cast<float>(Highp::largest_divisor)))));
    return out;
  }

  friend Truths<FloatMask> operator<(const AffineBatch& a, const AffineBatch& b) {
    return {a.center_ < b.center_, (overlap(a, b) < FloatBatch(0.0F)) | (a.is_exact() & b.is_exact())};
  }
  friend Truths<FloatMask> operator>(const AffineBatch& a, const AffineBatch& b) { return b < a; }
  friend Truths<FloatMask> operator<=(const AffineBatch& a, const AffineBatch& b) { return (b < a).negated(); }
  friend Truths<FloatMask> operator>=(const AffineBatch& a, const AffineBatch& b) { return (a < b).negated(); }

  friend AffineBatch select(const Truths<FloatMask>& condition, const AffineBatch& a, const AffineBatch& b) {
    AffineBatch chosen = b;
    chosen.take(condition.at_center(), a);
    chosen.lose(condition.is_either());
    return chosen;
  }
  friend AffineBatch max(const AffineBatch& a, const AffineBatch& b) { return outermost(a.center_ < b.center_, a, b); }
  friend AffineBatch min(const AffineBatch& a, const AffineBatch& b) { return outermost(b.center_ < a.center_, a, b); }
  friend AffineBatch abs(const AffineBatch& x) { return max(x, -x); }

  /// As of Bounded: of inversesqrt's 2 ulp, relative to it, four units come out on the way, and one is float's.
  friend AffineBatch sqrt(const AffineBatch& x) {
    constexpr Power root{0.5F, 0.155F, 5 * unit, division_ulps};
    return power(root, x, xsimd::sqrt(x.center_), [](const Bounds& y) { return sqrt(y); });
  }
  friend AffineBatch inversesqrt(const AffineBatch& x) {
    constexpr Power inverse_root{-0.5F, 0.53F, 2 * unit, inverse_sqrt_ulps};
    return power(inverse_root, x, FloatBatch(1.0F) / xsimd::sqrt(x.center_), [](const Bounds& y) { return inversesqrt(y); });
  }
  // The other functions are BoundedBatch's, whose results keep their form.
  friend AffineBatch exp(const AffineBatch& x) {
    return by_halves([](const Bounds& y) { return exp(y); }, x);
  }
  friend AffineBatch log(const AffineBatch& x) {
    return by_halves([](const Bounds& y) { return log(y); }, x);
  }
  friend AffineBatch log1p(const AffineBatch& x) {
    return by_halves([](const Bounds& y) { return log1p(y); }, x);
  }
  friend AffineBatch pow(const AffineBatch& x, const AffineBatch& y) {
    return by_halves([](const Bounds& v, const Bounds& w) { return pow(v, w); }, x, y);
  }
  friend AffineBatch pow_from_zero(const AffineBatch& x, const AffineBatch& y) {
    return by_halves([](const Bounds& v, const Bounds& w) { return pow_from_zero(v, w); }, x, y);
  }

  /// Float's own roundings, of both constants and of the centre, are no more than half of a shader's.
  friend AffineBatch mix(double x, double y, const AffineBatch& t) {
    const FloatBatch step(static_cast<float>(y - x));
    const FloatBatch rest = xsimd::abs(FloatBatch(1.0F) - t.center_) + t.spread_;
    const FloatBatch errors = FloatBatch(1.5F) * mix_error<Highp>(x, y, rest, t.magnitude());
    AffineBatch mixed;
    mixed.round(xsimd::fma(step, t.center_, FloatBatch(static_cast<float>(x))), step * t.shift_x_, step * t.shift_y_,
                xsimd::fma(xsimd::abs(step), t.radius_, errors), 0);
    return mixed;
  }

  /// In these lanes, this becomes the other.
  void take(const FloatMask& where, const AffineBatch& other) {
    center_ = xsimd::select(where, other.center_, center_);
    shift_x_ = xsimd::select(where, other.shift_x_, shift_x_);
    shift_y_ = xsimd::select(where, other.shift_y_, shift_y_);
    radius_ = xsimd::select(where, other.radius_, radius_);
    spread_ = xsimd::select(where, other.spread_, spread_);
  }

 private:
  static constexpr float infinity = std::numeric_limits<float>::infinity();
  /// What a rounding of float changes, relative to what it rounds, at the most.
  static constexpr float unit = 0x1p-24F;

  /// x^exponent.
  struct Power {
    float exponent;
    /// Half the second derivative's largest, in x^(exponent - 2), where x is no less than 7/8 of the centre.
    float bend;
    float relative;  ///< what else the centre's power is off, relative to it
    double ulps;     ///< of the function
  };

  /// @param value       at the centre
  /// @param of_bounds   the function, for lanes where x may be near 0 or is spread by more than an eighth
  template <class OfBounds>
  static AffineBatch power(const Power& p, const AffineBatch& x, const FloatBatch& value, const OfBounds& of_bounds) {
    const FloatBatch inverse = FloatBatch(1.0F) / x.center_;
    const FloatBatch share = x.spread_ * inverse;
    const FloatBatch slope = value * FloatBatch(p.exponent);  // times the centre
    const FloatBatch of_radius = (x.radius_ * inverse + share * FloatBatch(8 * unit)) * xsimd::abs(slope);
    AffineBatch out;
    out.round(value, x.shift_x_ * inverse * slope, x.shift_y_ * inverse * slope,
              of_radius + value * xsimd::fma(share * share, FloatBatch(p.bend), FloatBatch(p.relative)), p.ulps);
    const FloatMask straight =
        (share <= FloatBatch(0.125F)) & (x.center_ - x.spread_ >= FloatBatch(static_cast<float>(smallest_normal<Highp>)));
    if (!xsimd::all(straight)) out.take(~straight, by_halves(of_bounds, x));
    return out;
  }

  /// Becomes an exact result after an operation's error.
  /// @param radius  short of its own roundings and the shifts' last
  /// @param ulps    of the operation; 1 is correct rounding
  void round(const FloatBatch& center, const FloatBatch& shift_x, const FloatBatch& shift_y, const FloatBatch& radius, double ulps = 1) {
    center_ = center;
    shift_x_ = shift_x;
    shift_y_ = shift_y;
    const FloatBatch spread = xsimd::abs(shift_x) + xsimd::abs(shift_y) + radius;
    const FloatBatch added = largest_rounding((xsimd::abs(center) + spread) * FloatBatch(1 + 16 * unit));
    // The shader's error and half an ulp for the centre's. Some eight roundings of the radius and the shifts are of no more than the
    // spread.
    const auto errors = static_cast<float>(ulps + 0.5 + 16 * unit);
    radius_ = xsimd::fma(spread, FloatBatch(16 * unit), xsimd::fma(added, FloatBatch(errors), radius));
    spread_ = xsimd::fma(spread, FloatBatch(1 + 32 * unit), added * FloatBatch(errors + 1));
  }

  /// An ulp of the largest result, or twice what a flush to zero takes away. Infinite from the format's last binade on, and of what is no
  /// number.
  static FloatBatch largest_rounding(const FloatBatch& largest) {
    const auto binade = xsimd::bitwise_cast<FloatBatch>(xsimd::bitwise_cast<FloatBits>(largest) & FloatBits(std::uint32_t{0xff} << 23));
    const FloatBatch ulp = binade * FloatBatch(2.0F) * FloatBatch(0.5F * 0x1p-23F);
    return xsimd::max(FloatBatch(static_cast<float>(2 * smallest_normal<Highp>)), ulp);
  }

  /// Adding 0 changes nothing.
  [[gnu::noinline]] void keep_summand(const AffineBatch& a, const AffineBatch& b) {
    take(a.magnitude() == FloatBatch(0.0F), b);
    take(b.magnitude() == FloatBatch(0.0F), a);
  }

  /// Of two exact numbers that are the same nothing is left.
  [[gnu::noinline]] void keep_cancelled(const AffineBatch& a, const AffineBatch& b) {
    take((a.center_ == b.center_) & a.is_exact() & b.is_exact(), AffineBatch(0.0));
  }

  /// Nor does a power of two round what stays a normal number.
  [[gnu::noinline]] void keep_scaled(const AffineBatch& a, const AffineBatch& b) {
    const auto keep = [this](const AffineBatch& x, const AffineBatch& by) {
      const FloatBatch size = xsimd::abs(by.center_);
      const FloatBatch smallest = (xsimd::abs(x.center_) - x.spread_) * size;
      const FloatMask grows = (size >= FloatBatch(1.0F)) | (size == FloatBatch(0.0F));
      const FloatMask stays_normal = grows | (smallest >= FloatBatch(static_cast<float>(2 * smallest_normal<Highp>)));
      const FloatBits fraction = xsimd::bitwise_cast<FloatBits>(size) & FloatBits((std::uint32_t{1} << 23) - 1);
      const FloatMask is_power = xsimd::bitwise_cast<FloatBatch>(fraction) == FloatBatch(0.0F);
      const FloatMask exact = by.is_exact() & is_power & stays_normal & ~is_lost();
      // What remains of a radius may be subnormal.
      const auto scaled = [&](const FloatBatch& r) {
        return r * size + xsimd::select(grows | (r == FloatBatch(0.0F)), FloatBatch(0.0F), FloatBatch(0x1p-148F));
      };
      radius_ = xsimd::select(exact, scaled(x.radius_), radius_);
      spread_ = xsimd::select(exact, scaled(x.spread_), spread_);
    };
    keep(a, b);
    keep(b, a);
  }

  /// Of a constant, which stands for either neighbour where the format does not hold it.
  static float constant_radius(double value) {
    if (!(value <= largest_finite<Highp> && -value <= largest_finite<Highp>)) return infinity;
    return is_representable<Highp>(value) ? 0.0F : static_cast<float>((1 + 0x1p-20) * ulp<Highp>(value) + smallest_normal<Highp>);
  }

  /// A radius or spread with room for being rounded to float, and more; 0 stays so.
  static Batch grown(const Batch& x, const Batch& more) {
    return select(x > Batch(0.0), (x + more) * Batch(1 + 4 * unit) + Batch(0x1p-140), x);
  }

  /// By how much the one of smaller centre may exceed the other, at the most; where it is certainly smaller, negative.
  static FloatBatch overlap(const AffineBatch& a, const AffineBatch& b) {
    const FloatBatch changes = xsimd::abs(a.shift_x_ - b.shift_x_) + xsimd::abs(a.shift_y_ - b.shift_y_);
    return (changes + (a.radius_ + b.radius_)) * FloatBatch(1 + 16 * unit) - xsimd::abs(a.center_ - b.center_) * FloatBatch(1 - 4 * unit);
  }

  /// Of max() and min(): b in some lanes, else a, with room for the other where that lies beyond: then it is within its own radius of its
  /// form, and no nearer than the chosen one's radius on the other side.
  static AffineBatch outermost(const FloatMask& where, const AffineBatch& a, const AffineBatch& b) {
    const FloatMask apart = a.spread_ + b.spread_ < xsimd::abs(a.center_ - b.center_);
    if (xsimd::all(apart & ~where)) return a;
    AffineBatch chosen = a;
    chosen.take(where, b);
    if (xsimd::all(apart)) return chosen;
    const FloatBatch beyond = overlap(a, b) - chosen.radius_;
    // What is no number stays so.
    const FloatBatch more =
        xsimd::select((beyond <= chosen.radius_) | (a.is_exact() & b.is_exact()), FloatBatch(0.0F), beyond - chosen.radius_);
    chosen.radius_ = (chosen.radius_ + more) * FloatBatch(1 + 4 * unit);
    const FloatBatch of_center =
        xsimd::select(more == FloatBatch(0.0F), FloatBatch(0.0F), FloatBatch(2 * unit) * xsimd::abs(chosen.center_));
    chosen.spread_ = (chosen.spread_ + more + of_center) * FloatBatch(1 + 4 * unit);
    return chosen;
  }

  void lose(const FloatMask& where) {
    radius_ = xsimd::select(where, FloatBatch(infinity), radius_);
    spread_ = xsimd::select(where, FloatBatch(infinity), spread_);
  }

  FloatBatch center_, shift_x_, shift_y_, radius_;
  FloatBatch
      spread_;  // more than |shift_x| + |shift_y| + radius by what float rounds of the sum with the centre; 0 only of an exact number
};

/// The lanes are samples, as BoundedBatch's.
template <>
struct Lanes<AffineBatch> {
  static constexpr std::size_t count = 1;
  static AffineBatch load(const double* values) { return AffineBatch(*values); }
};

}  // namespace sheen::number
