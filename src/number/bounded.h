#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "number/precision.h"
#include "number/truth.h"

namespace sheen::number {

/// A closed range of numbers.
struct Range {
  double lower, upper;

  double magnitude() const { return std::max(std::abs(lower), std::abs(upper)); }
};

/// A value together with everything that a conforming implementation may compute in its place while the sample is moved by up to one step
/// along each axis of the image: an affine form (Stolfi and de Figueiredo 1997, "Self-Validated Numerical Methods", chapter 3) whose two
/// noise symbols are the sample's displacement, joined with an interval. What is computed at displacement (u, v), |u| and |v| at most one
/// step, satisfies both
///
///   |computed - (center + u shift_x + v shift_y)| <= radius      and      lower <= computed <= upper.
///
/// The center is the formula in exact arithmetic on the inputs' centres, carried in double; double's own roundings are part of the radius.
/// The shift is the derivative by the sample's position, kept as the change per step. All values share one displacement, so where it
/// cancels, as in x - x, it leaves nothing; the radius holds what is independent: roundings, and the remainder of second order, which
/// every operation encloses. The interval keeps what an affine form loses: where a wide range ends, and that max(x, 0) is not negative.
///
/// Every operation adds the error that number/precision.h grants it, as an interval operation over all that its operands may be. Sums of
/// products may be contracted: the rounding of a product and that of a sum are both counted, and together enclose the single rounding of
/// the fused operation, for they are taken over ranges that hold the exact product. What the rules promise nothing for is unbounded, and
/// so is all that comes of it, since it may be NaN.
///
/// Not enclosed: what a compiler makes of an expression that it regroups, and shader code that spells a formula differently.
template <class Precision>
class Bounded {
 public:
  Bounded() = default;

  /// A constant of the shader: exact where the precision can hold it, else rounded to either neighbour.
  explicit Bounded(double value) : Bounded(exactly(value)) {
    if (is_representable<Precision>(value)) return;
    const Exact alone{value, 0, 0, 0, range_};
    *this = rounded(alone, Error::ulps(1), true);
  }

  /// A variable that holds `value` but for an absolute error of at most `radius` >= 0.
  static Bounded within(double value, double radius) { return at_sample(value, 0, 0, 0, radius); }

  /// An input that varies over the image.
  /// @param per_pixel_x, per_pixel_y  derivative of the value by the sample's position, in 1/pixel
  /// @param step    the sample is displaced by at most this much along either axis, in pixels
  /// @param radius  what the linear form leaves out: curvature over the step, rounding of the interpolation; >= 0
  static Bounded at_sample(double value, double per_pixel_x, double per_pixel_y, double step, double radius) {
    const double shift_x = per_pixel_x * step;
    const double shift_y = per_pixel_y * step;
    const double deviation = (radius + std::abs(shift_x) + std::abs(shift_y)) * (1 + 0x1p-50);
    if (deviation == 0) return Bounded(value);
    return rounded({value, shift_x, shift_y, radius, {value - deviation, value + deviation}}, Error::absolute(0, 0), false);
  }

  /// A value about which nothing is promised.
  static Bounded unbounded(double center) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Bounded b;
    b.center_ = center;
    b.radius_ = infinity;
    b.range_ = {-infinity, infinity};
    return b;
  }

  /// The value in exact arithmetic. Of an unbounded value, what double makes of the formula, which may be NaN.
  double center() const { return center_; }
  /// First-order change when the sample moves by one step along x or y.
  double shift_x() const { return shift_x_; }
  double shift_y() const { return shift_y_; }
  /// First-order part of the deviation: |shift_x| + |shift_y|.
  double displacement() const { return std::abs(shift_x_) + std::abs(shift_y_); }
  /// What is independent of the displacement, >= 0; infinite if nothing is promised.
  double radius() const { return radius_; }
  /// All that may be computed.
  const Range& range() const { return range_; }
  /// The largest |computed - center|, of roundings and displacement together; infinite if nothing is promised, never NaN.
  double deviation() const { return is_bounded() ? above(std::max(range_.upper - center_, center_ - range_.lower)) : radius_; }
  /// Whether the rules promise anything: false where the radius is infinite.
  bool is_bounded() const { return radius_ < std::numeric_limits<double>::infinity(); }
  /// Whether every implementation holds this very number.
  bool is_exact() const { return radius_ == 0 && shift_x_ == 0 && shift_y_ == 0; }

  friend Bounded operator-(const Bounded& x) { return x.scaled(-1); }

  friend Bounded operator+(const Bounded& a, const Bounded& b) {
    const double center = a.center_ + b.center_;
    if (!a.is_bounded() || !b.is_bounded()) return unbounded(center);
    if (a.is_exact() && b.is_exact() && is_exact_sum(a.center_, b.center_) && is_representable<Precision>(center)) return exactly(center);
    if (Precision::holds_its_format && a.is_exact() && a.center_ == 0) return b;
    if (Precision::holds_its_format && b.is_exact() && b.center_ == 0) return a;
    Bounded sum(center, a.shift_x_ + b.shift_x_, a.shift_y_ + b.shift_y_, a.radius_ + b.radius_);
    if (!sum.round_narrow()) {
      const Range range{sum_below(a.range_.lower, b.range_.lower), -sum_below(-a.range_.upper, -b.range_.upper)};
      sum.round_within(range);
    }
    return sum;
  }

  friend Bounded operator-(const Bounded& a, const Bounded& b) { return a + -b; }

  /// With a = a0 + d_a + e_a (displaced, perturbed), ab - a0 b0 - (a0 d_b + b0 d_a) = a0 e_b + b0 e_a + (d_a + e_a)(d_b + e_b).
  friend Bounded operator*(const Bounded& a, const Bounded& b) {
    const double center = a.center_ * b.center_;
    if (!a.is_bounded() || !b.is_bounded()) return unbounded(center);
    if (a.is_exact() && b.is_exact() && is_representable<Precision>(center)) return exactly(center);
    if (a.scales_exactly(b)) return a.scaled(b.center_);
    if (b.scales_exactly(a)) return b.scaled(a.center_);
    // The two parts of the shift may cancel, their roundings in double do not.
    const double first_order = std::abs(a.center_) * b.displacement() + std::abs(b.center_) * a.displacement();
    const double radius = std::abs(a.center_) * b.radius_ + std::abs(b.center_) * a.radius_ +
                          (a.displacement() + a.radius_) * (b.displacement() + b.radius_) + first_order * 0x1p-50;
    Bounded made(center, a.center_ * b.shift_x_ + b.center_ * a.shift_x_, a.center_ * b.shift_y_ + b.center_ * a.shift_y_, radius);
    if (!made.round_narrow()) {
      // One and the same variable squared is not negative.
      made.round_within(&a == &b ? square(a.range_) : product(a.range_, b.range_));
    }
    return made;
  }

  /// With q = a0 / b0 and d = d_a - q d_b:  a/b - q - d/b0 = (e_a - q e_b - (d/b0) (d_b + e_b)) / b.
  /// Unbounded unless every divisor lies within the range that the rule names.
  friend Bounded operator/(const Bounded& a, const Bounded& b) {
    const double center = a.center_ / b.center_;
    if (!a.is_bounded() || !b.is_bounded()) return unbounded(center);
    const double smallest = std::max(b.range_.lower, -b.range_.upper);  // of |b|; negative if b may vanish
    if (!(smallest >= Precision::smallest_divisor && b.range_.magnitude() <= Precision::largest_divisor)) return unbounded(center);
    const double shift_x = (a.shift_x_ - center * b.shift_x_) / b.center_;
    const double shift_y = (a.shift_y_ - center * b.shift_y_) / b.center_;
    const double first_order = a.displacement() + std::abs(center) * b.displacement();
    const double radius = (a.radius_ + std::abs(center) * b.radius_ +
                           (std::abs(shift_x) + std::abs(shift_y)) * (b.displacement() + b.radius_) + first_order * 0x1p-50) /
                          smallest;
    return rounded({center, shift_x, shift_y, radius, quotient(a.range_, b.range_)}, Error::ulps(division_ulps), false);
  }

  friend Truth operator<(const Bounded& a, const Bounded& b) {
    const bool at_center = a.center_ < b.center_;
    return {at_center, at_center ? greatest_difference(a, b) < 0 : greatest_difference(b, a) <= 0};
  }
  friend Truth operator>(const Bounded& a, const Bounded& b) { return b < a; }
  friend Truth operator<=(const Bounded& a, const Bounded& b) { return negated(b < a); }
  friend Truth operator>=(const Bounded& a, const Bounded& b) { return negated(a < b); }

  /// a where the condition holds, else b; where it may be either, all that both may be, about the choice at the centre.
  friend Bounded select(Truth condition, const Bounded& a, const Bounded& b) {
    const Bounded& chosen = condition.at_center() ? a : b;
    if (!condition.is_either()) return chosen;
    if (!a.is_bounded() || !b.is_bounded()) return unbounded(chosen.center_);
    return chosen.joined(condition.at_center() ? b : a, std::abs(a.center_ - b.center_),
                         {std::min(a.range_.lower, b.range_.lower), std::max(a.range_.upper, b.range_.upper)});
  }

  friend Bounded max(const Bounded& a, const Bounded& b) {
    const Truth less = a < b;
    const Bounded& larger = less.at_center() ? b : a;
    if (!a.is_bounded() || !b.is_bounded()) return unbounded(larger.center_);
    if (!less.is_either()) return larger;
    // Never below the one that is larger at the centre; above it by what the other exceeds it.
    return larger.joined(less.at_center() ? a : b, -std::abs(a.center_ - b.center_),
                         {std::max(a.range_.lower, b.range_.lower), std::max(a.range_.upper, b.range_.upper)});
  }

  friend Bounded min(const Bounded& a, const Bounded& b) { return -max(-a, -b); }
  friend Bounded abs(const Bounded& x) {
    Bounded b = max(x, -x);
    if (b.is_bounded()) b.range_.lower = std::max(b.range_.lower, 0.0);
    return b;
  }

  /// What one operation may add to its exact result.
  struct Error {
    double count, relative, floor;

    /// So many ulp of the exact result.
    static Error ulps(double count) { return {count, count * epsilon<Precision>, count * ulp<Precision>(0)}; }
    /// At most `relative` of the exact result and `floor` besides.
    static Error absolute(double relative, double floor) { return {0, relative, floor}; }

    /// At an exact result x; at any of smaller magnitude it is no larger.
    double at(double x) const { return count > 0 ? count * ulp<Precision>(x) : smoothly(x); }
    /// A bound without the jumps of an ulp at powers of two, so that x - smoothly(x) does not fall as x grows.
    double smoothly(double x) const { return relative * std::abs(x) + floor; }
  };

  /// An exact result before its rounding: affine form and range, see the class.
  struct Exact {
    double center, shift_x, shift_y, radius;
    Range range;
  };

  /// The value as an operation without error would have given it.
  Exact as_exact() const { return {center_, shift_x_, shift_y_, radius_, range_}; }

  /// The exact result of an operation after the operation's error, with what else may happen to it: flushed to zero below the smallest
  /// normal number, unbounded beyond the largest.
  /// @param keeps_sign  correct rounding never passes zero
  static Bounded rounded(const Exact& x, const Error& error, bool keeps_sign) {
    Bounded b;
    b.center_ = x.center;
    b.shift_x_ = x.shift_x;
    b.shift_y_ = x.shift_y;
    // Of the exact result too, the form and the range each know what the other does not.
    const double reach = (b.displacement() + x.radius) * (1 + 0x1p-48) + std::abs(x.center) * 0x1p-50;
    const Range exact{std::max(x.range.lower, x.center - reach), std::min(x.range.upper, x.center + reach)};
    const double smallest = std::max(exact.lower, -exact.upper);
    const double largest = std::max(-exact.lower, exact.upper);
    const double added = error.at(largest);
    // Most results: of one sign, within a factor of two, far from either end of the format.
    const bool narrow = largest <= 2 * smallest;
    if (narrow && added <= 0.5 * smallest && smallest >= 2 * smallest_normal<Precision> && largest <= 0.5 * largest_finite<Precision> &&
        x.radius <= largest) {
      b.range_ = {below(exact.lower - added), above(exact.upper + added)};
      // Over so small a range the products of radii are nothing beside it.
      b.settle(x.radius, added, reach > 0x1p-8 * largest);
    } else {
      b.round_with_care(x, exact, error, added, narrow, keeps_sign);
    }
    return b;  // made in its place: a copy would wait for each member to be stored
  }

  /// The neighbouring double on the side away from or toward minus infinity, or one a little beyond: encloses what was rounded once.
  static double above(double x) { return x + std::abs(x) * 0x1p-52; }
  static double below(double x) { return x - std::abs(x) * 0x1p-52; }

 private:
  /// An exact result, not yet rounded.
  Bounded(double center, double shift_x, double shift_y, double radius)
      : center_(center), shift_x_(shift_x), shift_y_(shift_y), radius_(radius) {}

  /// Rounds the exact result of a sum or product, if the form alone tells that it lies far from 0 beside its width, and from either end of
  /// the format: then its interval adds nothing. Most results do.
  bool round_narrow() {
    const double magnitude = std::abs(center_);
    const double slack = (magnitude + displacement()) * 0x1p-50;
    const double reach = (displacement() + radius_) * (1 + 0x1p-48) + slack;
    if (!(reach <= 0x1p-8 * magnitude && magnitude >= 4 * smallest_normal<Precision> && magnitude <= 0.25 * largest_finite<Precision>)) {
      return false;
    }
    const double added = ulp<Precision>(magnitude + reach);
    radius_ = (radius_ + added) * (1 + 0x1p-40) + slack;
    const double total = (reach + added) * (1 + 0x1p-50) + slack;
    range_ = {center_ - total, center_ + total};
    return true;
  }
  /// Rounds it, its range being known too.
  void round_within(const Range& range) { *this = rounded({center_, shift_x_, shift_y_, radius_, range}, Error::ulps(1), true); }

  /// The radius from the exact result's and what is added to it. A few roundings of double, in the centre and in what was computed on the
  /// way here, are far below the factors' room; and what was overestimated by products of radii lies no farther off than the range's ends.
  void settle(double exact_radius, double added, bool clip) {
    radius_ = (exact_radius + added) * (1 + 0x1p-40) + (std::abs(center_) + displacement()) * 0x1p-50;
    if (clip) radius_ = std::min(radius_, (std::max(range_.upper - center_, center_ - range_.lower) + displacement()) * (1 + 0x1p-50));
  }

  /// rounded() where a range is wide, touches zero, or nears an end of the format.
  [[gnu::noinline]] void round_with_care(const Exact& x, const Range& exact, const Error& error, double added, bool narrow,
                                         bool keeps_sign) {
    range_ = {below(exact.lower - added), above(exact.upper + added)};
    if (!narrow) {
      // Of an end that faces zero, the worst result may come of an exact one further inside, beyond a power of two, where an ulp is larger;
      // of the other end, it is that of the end.
      const auto slack = [&](double end, bool faces_zero) { return std::min(added, faces_zero ? error.smoothly(end) : error.at(end)); };
      range_ = {below(exact.lower - slack(exact.lower, exact.lower > 0)), above(exact.upper + slack(exact.upper, exact.upper < 0))};
      if (keeps_sign && exact.lower >= 0) range_.lower = std::max(range_.lower, 0.0);
      if (keeps_sign && exact.upper <= 0) range_.upper = std::min(range_.upper, 0.0);
    }
    if (range_.lower < smallest_normal<Precision> && range_.upper > -smallest_normal<Precision>) {
      added = std::max(added, std::min(exact.magnitude(), smallest_normal<Precision> + added));
      range_ = {std::min(range_.lower, 0.0), std::max(range_.upper, 0.0)};
    }
    // The radius is infinite or NaN if anything before it was.
    const bool finite = x.radius + added < std::numeric_limits<double>::infinity() && range_.lower >= -largest_finite<Precision> &&
                        range_.upper <= largest_finite<Precision>;
    if (finite) {
      settle(x.radius, added, true);
    } else {
      *this = unbounded(center_);
    }
  }

  static Bounded exactly(double value) {
    Bounded b;
    b.center_ = value;
    b.range_ = {value, value};
    if (value != 0 && std::abs(value) < smallest_normal<Precision>) {
      b.radius_ = std::abs(value);
      b.range_ = {std::min(value, 0.0), std::max(value, 0.0)};
    }
    return b;
  }

  /// This value, or `other` in its place, known to lie within `range`.
  /// @param apart  by how much the other's centre may exceed this one's, on the side where it counts; may be negative
  Bounded joined(const Bounded& other, double apart, const Range& range) const {
    Bounded b = *this;
    const double excess = apart + std::abs(shift_x_ - other.shift_x_) + std::abs(shift_y_ - other.shift_y_) + other.radius_;
    const double room = (std::abs(apart) + displacement() + other.displacement() + other.radius_) * 0x1p-50;
    b.radius_ = std::max(radius_, excess + room);
    b.range_ = range;
    return b;
  }

  /// Multiplied by an exact power of two or by -1.
  Bounded scaled(double factor) const {
    Bounded b;
    b.center_ = center_ * factor;
    b.shift_x_ = shift_x_ * factor;
    b.shift_y_ = shift_y_ * factor;
    b.radius_ = is_bounded() ? radius_ * std::abs(factor) : radius_;
    b.range_ = {std::min(range_.lower * factor, range_.upper * factor), std::max(range_.lower * factor, range_.upper * factor)};
    return is_bounded() ? b : unbounded(b.center_);
  }

  /// Whether times `factor` is exact for every number this may be: by zero or by a power of two that keeps it within the format. Only a
  /// variable that holds a number of the format has no further digits to lose.
  bool scales_exactly(const Bounded& factor) const {
    if (!Precision::holds_its_format || !factor.is_exact() || !has_no_fraction(factor.center_)) return false;
    const double smallest = std::max(range_.lower, -range_.upper) * std::abs(factor.center_);
    const bool keeps_bits = std::abs(factor.center_) >= 1 || smallest >= smallest_normal<Precision>;
    return factor.center_ == 0 || (keeps_bits && range_.magnitude() * std::abs(factor.center_) <= largest_finite<Precision>);
  }

  /// Whether a + b loses nothing in double: the error term of Knuth's two-sum vanishes.
  static bool is_exact_sum(double a, double b) {
    const double s = a + b;
    const double virtual_b = s - a;
    return (a - (s - virtual_b)) + (b - virtual_b) == 0;
  }

  static double sum_below(double a, double b) { return is_exact_sum(a, b) ? a + b : below(a + b); }

  /// A product is a power of two only if both factors are, and then double has it exactly; elsewhere one rounding is enclosed. An end that
  /// is widened past a power of two would count a whole ulp where half of one is due.
  static bool is_exact_product(double a, double b) { return has_no_fraction(a * b) && has_no_fraction(a) && has_no_fraction(b); }
  static double product_below(double a, double b) { return is_exact_product(a, b) ? a * b : below(a * b); }
  static double product_above(double a, double b) { return is_exact_product(a, b) ? a * b : above(a * b); }

  /// Whether a range keeps to one side of zero; then its magnitudes run from the smaller end's to the larger's.
  static bool is_negative(const Range& x) { return x.upper <= 0; }
  static bool has_one_sign(const Range& x) { return x.lower >= 0 || x.upper <= 0; }
  static Range magnitudes(const Range& x) { return is_negative(x) ? Range{-x.upper, -x.lower} : x; }
  static Range with_sign(bool negative, const Range& x) { return negative ? Range{-x.upper, -x.lower} : x; }

  static Range product(const Range& a, const Range& b) {
    if (has_one_sign(a) && has_one_sign(b)) {
      const Range x = magnitudes(a);
      const Range y = magnitudes(b);
      return with_sign(is_negative(a) != is_negative(b), {product_below(x.lower, y.lower), product_above(x.upper, y.upper)});
    }
    return {std::min(std::min(product_below(a.lower, b.lower), product_below(a.lower, b.upper)),
                     std::min(product_below(a.upper, b.lower), product_below(a.upper, b.upper))),
            std::max(std::max(product_above(a.lower, b.lower), product_above(a.lower, b.upper)),
                     std::max(product_above(a.upper, b.lower), product_above(a.upper, b.upper)))};
  }

  static Range square(const Range& x) {
    const double smallest = std::max({x.lower, -x.upper, 0.0});
    return {product_below(smallest, smallest), product_above(x.magnitude(), x.magnitude())};
  }

  /// b does not contain 0. A quotient is a power of two only if it is exact.
  static Range quotient(const Range& a, const Range& b) {
    const auto exact = [](double x, double y) { return has_no_fraction(x / y) && (x / y) * y == x; };
    const auto under = [&](double x, double y) { return exact(x, y) ? x / y : below(x / y); };
    const auto over = [&](double x, double y) { return exact(x, y) ? x / y : above(x / y); };
    if (has_one_sign(a)) {
      const Range x = magnitudes(a);
      const Range y = magnitudes(b);
      return with_sign(is_negative(a) != is_negative(b), {under(x.lower, y.upper), over(x.upper, y.lower)});
    }
    return {
        std::min(std::min(under(a.lower, b.lower), under(a.lower, b.upper)), std::min(under(a.upper, b.lower), under(a.upper, b.upper))),
        std::max(std::max(over(a.lower, b.lower), over(a.lower, b.upper)), std::max(over(a.upper, b.lower), over(a.upper, b.upper)))};
  }

  /// Upper bound of a - b, which knows that both move with the same sample; infinite if either is unbounded.
  static double greatest_difference(const Bounded& a, const Bounded& b) {
    const double affine = (a.center_ - b.center_) + std::abs(a.shift_x_ - b.shift_x_) + std::abs(a.shift_y_ - b.shift_y_) + a.radius_ +
                          b.radius_ + (std::abs(a.center_) + std::abs(b.center_)) * 0x1p-50;
    const double apart = a.range_.upper - b.range_.lower;
    return a.is_exact() && b.is_exact() ? apart : std::min(apart, affine);
  }

  static Truth negated(Truth t) { return {!t.at_center(), !t.is_either()}; }

  double center_ = 0, shift_x_ = 0, shift_y_ = 0, radius_ = 0;
  Range range_ = {0, 0};
};

}  // namespace sheen::number
