#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "number/precision.h"

// One conforming implementation of the rules of number/precision.h, chosen at random or step by step toward the worst: a number type that
// evaluates the shading formulas while every operation errs within what it is granted. It shares with number::Bounded the rules' figures
// and the ulp, and no arithmetic.

namespace sheen::number::test {

/// The decisions of one evaluation, each a number in [-1, 1]: where in its allowance an operation errs, whether a subnormal is flushed,
/// whether a sum is fused with a product. An operation takes the same ones as long as its operands stay of one kind, so that one decision
/// can be changed and the others kept.
class Decisions {
 public:
  explicit Decisions(std::uint64_t seed) : random_(seed) {}

  void seed(std::uint64_t seed) { random_.seed(seed); }
  /// Forgets all; `extreme` is the share of decisions that will be -1 or 1.
  void start_anew(double extreme) {
    extreme_ = extreme;
    made_.clear();
    next_ = 0;
  }
  /// Begins the same evaluation again.
  void repeat() { next_ = 0; }
  std::size_t count() const { return made_.size(); }
  double& operator[](std::size_t i) { return made_[i]; }

  double next() {
    if (next_ == made_.size()) {
      const double x = std::uniform_real_distribution<double>(-1, 1)(random_);
      const bool is_extreme = std::uniform_real_distribution<double>(0, 1)(random_) < extreme_;
      made_.push_back(is_extreme ? std::copysign(1.0, x) : x);
    }
    return made_[next_++];
  }

  /// Those of the evaluation under way, which a number's operations cannot be handed. A test seeds them anew: what it sees depends on no
  /// other test.
  static Decisions& current() {
    static Decisions decisions(1);
    return decisions;
  }

 private:
  std::mt19937_64 random_;
  std::vector<double> made_;
  std::size_t next_ = 0;
  double extreme_ = 0.5;
};

/// Grid of a format: fraction bits and the exponent below which numbers are subnormal.
struct Grid {
  int fraction_bits, min_exponent;

  double step(double x) const {
    const int exponent = static_cast<int>(std::bit_cast<std::uint64_t>(std::abs(x)) >> 52) - 1023;
    return power_of_two(std::max(exponent, min_exponent) - fraction_bits);
  }
  double down(double x) const { return std::floor(x / step(x)) * step(x); }
  double up(double x) const { return std::ceil(x / step(x)) * step(x); }
};

/// Exact results are computed in double. A sum or product that double rounds onto a number of the format has that number beside it; what
/// double adds to the allowance of another operation, `nearly_all` of it takes off.
inline constexpr double nearly_all = 1 - 0x1p-24;

template <class Precision>
class Perturbed {
 public:
  Perturbed() = default;
  explicit Perturbed(double value) { *this = rounded(value); }

  /// A variable that holds this very number.
  static Perturbed held(double value) {
    Perturbed x;
    x.value_ = value;
    return x;
  }
  double value() const { return value_; }

  friend Perturbed operator-(const Perturbed& x) { return held(-x.value_); }
  friend Perturbed operator-(const Perturbed& a, const Perturbed& b) {
    Perturbed negative = -b;
    negative.product_ = -b.product_;
    negative.is_product_ = b.is_product_;
    return a + negative;
  }

  /// Either operand may be the product of a fused multiply-add, which forgets its rounding.
  friend Perturbed operator+(const Perturbed& a, const Perturbed& b) {
    if (a.is_product_ || b.is_product_) {
      const double fuse = decide();
      if (a.is_product_ && fuse < -0.33) return rounded(a.product_ + b.value_);
      if (b.is_product_ && fuse > 0.33) return rounded(a.value_ + b.product_);
    }
    return rounded(a.value_ + b.value_);
  }

  friend Perturbed operator*(const Perturbed& a, const Perturbed& b) {
    const double product = a.value_ * b.value_;
    Perturbed x = rounded(product);
    x.product_ = product;
    x.is_product_ = true;
    return x;
  }

  friend Perturbed operator/(const Perturbed& a, const Perturbed& b) {
    const double divisor = std::abs(b.value_);
    const Perturbed x = erring(a.value_ / b.value_, division_ulps);
    return divisor >= Precision::smallest_divisor && divisor <= Precision::largest_divisor ? x : anything();
  }

  friend bool operator<(const Perturbed& a, const Perturbed& b) { return a.value_ < b.value_; }
  friend bool operator>(const Perturbed& a, const Perturbed& b) { return a.value_ > b.value_; }
  friend Perturbed select(bool condition, const Perturbed& a, const Perturbed& b) { return condition ? a : b; }
  friend Perturbed max(const Perturbed& a, const Perturbed& b) { return a.value_ < b.value_ ? b : a; }
  friend Perturbed min(const Perturbed& a, const Perturbed& b) { return b.value_ < a.value_ ? b : a; }
  friend Perturbed abs(const Perturbed& x) { return held(std::abs(x.value_)); }

  friend Perturbed exp(const Perturbed& x) { return erring(std::exp(x.value_), Precision::exp_ulps + 2 * std::abs(x.value_)); }
  friend Perturbed exp2(const Perturbed& x) { return erring(std::exp2(x.value_), Precision::exp_ulps + 2 * std::abs(x.value_)); }
  friend Perturbed log(const Perturbed& x) { return logarithm(x, std::log(x.value_)); }
  friend Perturbed log2(const Perturbed& x) { return logarithm(x, std::log2(x.value_)); }
  friend Perturbed pow(const Perturbed& x, const Perturbed& y) { return exp2(y * log2(x)); }

  friend Perturbed inversesqrt(const Perturbed& x) {
    const Perturbed y = erring(1 / std::sqrt(x.value_), inverse_sqrt_ulps);
    return x.value_ >= smallest_normal<Precision> ? y : anything();
  }
  friend Perturbed sqrt(const Perturbed& x) { return Perturbed(1) / inversesqrt(x); }

  /// The shaders' log_one_minus(-x), highp whatever the precision.
  friend Perturbed log1p(const Perturbed& argument) {
    using H = Perturbed<Highp>;
    const H x = H::held(-argument.value_);
    const H t = x / (H(2) - x);
    const H t2 = t * t;
    const auto third = [](double n) { return H(1) / H(n); };
    const H sum = H(1) + t2 * (third(3) + t2 * (third(5) + t2 * (third(7) + t2 * third(9))));
    return rounded((H(-2) * t * sum).value());
  }

  /// Correct rounding to either side, in mediump to the format of some implementation; then flushed or not.
  static Perturbed rounded(double exact) {
    const Grid grid = implementation();
    const double side = decide();
    return stored(side < 0 ? grid.down(exact) : grid.up(exact), grid);
  }

 private:
  static double decide() { return Decisions::current().next(); }
  static Perturbed anything() { return held(std::numeric_limits<double>::quiet_NaN()); }

  /// mediump may be single precision or half precision too.
  static Grid implementation() {
    const double format = Precision::holds_its_format ? 0 : decide();
    if (format > 0.7) return {Highp::fraction_bits, Highp::min_exponent};
    if (format > 0.4) return {10, -14};
    return {Precision::fraction_bits, Precision::min_exponent};
  }

  static Perturbed stored(double value, const Grid& grid) {
    if (value != 0 && std::abs(value) < power_of_two(grid.min_exponent) && decide() < 0) return held(0);
    return held(std::abs(value) <= largest_finite<Precision> ? value : std::numeric_limits<double>::infinity());
  }

  /// A number of the format within so many ulp of the exact value.
  static Perturbed erring(double exact, double ulps) { return erring_by(exact, ulps * ulp<Precision>(exact)); }
  static Perturbed erring_by(double exact, double most) {
    const Grid grid = implementation();
    const double side = decide();
    const double target = exact + side * most * nearly_all;
    return stored(side < 0 ? grid.up(target) : grid.down(target), grid);
  }

  static Perturbed logarithm(const Perturbed& x, double exact) {
    const bool near_one = x.value_ >= 0.5 && x.value_ <= 2;
    const Perturbed y = near_one ? erring_by(exact, Precision::log_near_one) : erring(exact, Precision::log_ulps);
    return x.value_ >= smallest_normal<Precision> ? y : anything();
  }

  double value_ = 0;
  double product_ = 0;
  bool is_product_ = false;
};

/// The worst of `tries` evaluations of `formula`, measured by `badness(result)`: some at random, the rest climbing one decision at a time
/// from the worst so far, so that the errors align as no random choice would align them.
template <class Formula, class Badness>
double worst_of(int tries, const Formula& formula, const Badness& badness) {
  Decisions& decisions = Decisions::current();
  double worst = 0;
  const int at_random = tries / 10;
  for (int i = 0; i < at_random; ++i) {
    decisions.start_anew(i % 3 == 0 ? 0.0 : 0.9);
    worst = std::max(worst, badness(formula()));
  }
  decisions.start_anew(1.0);
  double current = badness(formula());
  for (int i = at_random + 1; i < tries; ++i) {
    const std::size_t turn = static_cast<std::size_t>(i - at_random - 1) % decisions.count();
    const double before = decisions[turn];
    decisions[turn] = before < 0 ? 1 : -1;
    decisions.repeat();
    const double changed = badness(formula());
    if (changed < current) {
      decisions[turn] = before;
    }
    current = std::max(current, changed);
  }
  return std::max(worst, current);
}

}  // namespace sheen::number::test
