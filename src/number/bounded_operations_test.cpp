#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

#include "number/bounded_functions.h"
#include "number/perturbed_test.h"

// Each operation of number::Bounded against an implementation that errs at random within the same rules.

namespace sheen::number {
namespace {

using test::Perturbed;

/// Operands about a centre: exact, uncertain or displaced, in numbers of the format.
template <class Precision>
struct Operand {
  Bounded<Precision> bound;
  double center, shift_x, shift_y, radius;

  template <class Random>
  Operand(double value, int kind, Random& uniform) {
    const test::Grid grid{Precision::fraction_bits, Precision::min_exponent};
    center = grid.down(value);
    const double size = std::abs(center) * std::pow(10, -5 * uniform());
    radius = kind == 0 ? 0 : 0.9 * size * uniform() + grid.step(center);
    shift_x = kind < 2 ? 0 : 0.5 * size * (2 * uniform() - 1);
    shift_y = kind < 2 ? 0 : 0.4 * size * (2 * uniform() - 1);
    bound = kind == 0 ? Bounded<Precision>(center) : Bounded<Precision>::at_sample(center, shift_x, shift_y, 1, radius);
  }

  /// A number that the variable may hold when the sample is displaced by (u, v).
  Perturbed<Precision> held(double u, double v, double e) const {
    const test::Grid grid{Precision::fraction_bits, Precision::min_exponent};
    const double moved = center + u * shift_x + v * shift_y;
    const double x = moved + e * radius;
    const double inside = e < 0 ? grid.up(x) : grid.down(x);
    return Perturbed<Precision>::held(std::abs(inside - moved) <= radius ? inside : center + (moved - center));
  }
};

/// One operation, of the bounded type and of the perturbed one.
template <class Precision>
struct Operation {
  const char* name;
  std::function<Bounded<Precision>(const Bounded<Precision>&, const Bounded<Precision>&)> bounded;
  std::function<Perturbed<Precision>(const Perturbed<Precision>&, const Perturbed<Precision>&)> perturbed;
  double least_reached;  ///< share of the bound that the worst of the evaluations reaches, in the median over exact operands
};

// Two ways in which a shader may have it.
template <class Precision>
Perturbed<Precision> spelled_mix(double x, double y, const Perturbed<Precision>& t) {
  using Real = Perturbed<Precision>;
  return Real(x) * (Real(1) - t) + Real(y) * t;
}
template <class Precision>
Perturbed<Precision> difference_mix(double x, double y, const Perturbed<Precision>& t) {
  using Real = Perturbed<Precision>;
  return Real(x) + (Real(y) - Real(x)) * t;
}
template <class Precision>
Bounded<Precision> spelled_mix(double x, double y, const Bounded<Precision>& t) {
  return mix(x, y, t);
}
template <class Precision>
Bounded<Precision> difference_mix(double x, double y, const Bounded<Precision>& t) {
  return mix(x, y, t);
}

template <class Precision>
std::vector<Operation<Precision>> operations() {
  const auto operation = [](const char* name, double least_reached, auto f) { return Operation<Precision>{name, f, f, least_reached}; };
  return {operation("a + b", 0.6, [](const auto& a, const auto& b) { return a + b; }),
          operation("a - b", 0.6, [](const auto& a, const auto& b) { return a - b; }),
          operation("a b", 0.6, [](const auto& a, const auto& b) { return a * b; }),
          operation("a / b", 0.7, [](const auto& a, const auto& b) { return a / b; }),
          operation("a b + a", 0.5, [](const auto& a, const auto& b) { return a * b + a; }),
          operation("a - b b", 0.5, [](const auto& a, const auto& b) { return a - b * b; }),
          operation("exp a", 0.8, [](const auto& a, const auto&) { return exp(a); }),
          operation("exp2 -b", 0.8, [](const auto&, const auto& b) { return exp2(-b); }),
          operation("log a", 0.8, [](const auto& a, const auto&) { return log(a); }),
          operation("log2 a", 0.8, [](const auto& a, const auto&) { return log2(a); }),
          operation("inversesqrt a", 0.7, [](const auto& a, const auto&) { return inversesqrt(a); }),
          operation("sqrt a", 0.6, [](const auto& a, const auto&) { return sqrt(a); }),
          operation("pow(a, b)", 0.5, [](const auto& a, const auto& b) { return pow(a, b); }),
          operation("mix", 0.2, [](const auto& a, const auto&) { return spelled_mix(21.5, 25.3, a); }),
          operation("mix by a difference", 0.2, [](const auto& a, const auto&) { return difference_mix(-2.1, 0.3, a); }),
          operation("max(a, b)", 0, [](const auto& a, const auto& b) { return max(a, b); }),
          operation("min(a, b)", 0, [](const auto& a, const auto& b) { return min(a, b); }),
          operation("|a - b|", 0.6, [](const auto& a, const auto& b) { return abs(a - b); }),
          operation("select", 0.5, [](const auto& a, const auto& b) { return select(a < b, a * a, b); }),
          operation("log1p", 0.3, [](const auto& a, const auto&) {
            using Real = std::remove_cvref_t<decltype(a)>;
            return log1p(-min(a, Real(0.25)));
          })};
}

template <class Precision>
void hold_operations() {
  std::mt19937_64 random(7);
  test::Decisions::current().seed(8);
  const auto uniform = [&random] { return std::uniform_real_distribution<double>(0, 1)(random); };
  for (const Operation<Precision>& operation : operations<Precision>()) {
    long escapes = 0, inside = 0;
    std::vector<double> reached;
    for (int i = 0; i < 600; ++i) {
      const int kind = i % 3;
      const double scale = Precision::holds_its_format ? 6 : 1.5;
      const Operand<Precision> a(std::pow(10, scale * (2 * uniform() - 1)), kind, uniform);
      const Operand<Precision> b(std::pow(10, 2 * uniform() - 1), kind, uniform);
      const Bounded<Precision> bound = operation.bounded(a.bound, b.bound);
      if (!bound.is_bounded()) continue;
      double worst = 0;
      for (int k = 0; k < 60; ++k) {
        const auto corner = [&] { return uniform() < 0.5 ? std::copysign(1.0, uniform() - 0.5) : 2 * uniform() - 1; };
        const double u = corner(), v = corner();
        test::Decisions::current().start_anew(0.7);
        const double x = operation.perturbed(a.held(u, v, corner()), b.held(u, v, corner())).value();
        const double moved = bound.center() + u * bound.shift_x() + v * bound.shift_y();
        const bool holds = std::abs(x - moved) <= bound.radius() && x >= bound.range().lower && x <= bound.range().upper;
        (holds ? inside : escapes) += 1;
        worst = std::max(worst, std::abs(x - bound.center()));
      }
      if (kind == 0 && bound.deviation() > 0) reached.push_back(worst / std::max(bound.deviation(), bound.radius()));
    }
    EXPECT_EQ(escapes, 0) << operation.name;
    EXPECT_GT(inside, 6000) << operation.name;
    if (reached.empty()) continue;
    std::nth_element(reached.begin(), reached.begin() + static_cast<long>(reached.size() / 2), reached.end());
    EXPECT_GT(reached[reached.size() / 2], operation.least_reached) << operation.name << " has too wide a bound";
  }
}

TEST(Operations, HoldWhatHighpAllowsAndNotMuchMore) {
  hold_operations<Highp>();
}

TEST(Operations, HoldWhatMediumpAllows) {
  hold_operations<Mediump>();
}

}  // namespace
}  // namespace sheen::number
