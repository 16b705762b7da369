#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "number/batch_operands_test.h"
#include "number/bounded_batch_functions.h"
#include "number/cpu.h"

// A lane of number::BoundedBatch against number::Bounded of the lane's operands.

namespace sheen::number {
namespace {

using test::One;
using test::operand;

template <class Precision>
struct Operation {
  const char* name;
  double ulps;  ///< of double, by which xsimd's functions may differ from the C library's: 0 where the same operations are carried out
  std::function<BoundedBatch<Precision>(const BoundedBatch<Precision>&, const BoundedBatch<Precision>&)> batch;
  std::function<One<Precision>(const One<Precision>&, const One<Precision>&)> one;
};

template <class Precision>
std::vector<Operation<Precision>> operations() {
  const auto operation = [](const char* name, double ulps, auto f) { return Operation<Precision>{name, ulps, f, f}; };
  return {operation("-a", 0, [](const auto& a, const auto&) { return -a; }),
          operation("a + b", 0, [](const auto& a, const auto& b) { return a + b; }),
          operation("a - b", 0, [](const auto& a, const auto& b) { return a - b; }),
          operation("a b", 0, [](const auto& a, const auto& b) { return a * b; }),
          operation("a a", 0, [](const auto& a, const auto&) { return a * a; }),
          operation("a / b", 0, [](const auto& a, const auto& b) { return a / b; }),
          operation("max", 0, [](const auto& a, const auto& b) { return max(a, b); }),
          operation("min", 0, [](const auto& a, const auto& b) { return min(a, b); }),
          operation("abs", 0, [](const auto& a, const auto&) { return abs(a); }),
          operation("select <", 0, [](const auto& a, const auto& b) { return select(a < b, a, b); }),
          operation("select >=", 0, [](const auto& a, const auto& b) { return select(a >= b, a, b); }),
          operation("a constant", 0, [](const auto& a, const auto&) { return std::remove_cvref_t<decltype(a)>(0.1) * a; }),
          operation("a power of two", 0, [](const auto& a, const auto&) { return std::remove_cvref_t<decltype(a)>(0.5) * a; }),
          operation("nothing", 0, [](const auto& a, const auto& b) { return std::remove_cvref_t<decltype(a)>(0) * a + b; }),
          operation("mix", 0, [](const auto& a, const auto&) { return mix(0.3, -2.1, a); }),
          operation("inversesqrt", 0, [](const auto& a, const auto&) { return inversesqrt(a); }),
          operation("sqrt", 0, [](const auto& a, const auto&) { return sqrt(a); }),
          operation("exp", 4, [](const auto& a, const auto&) { return exp(a); }),
          operation("exp2", 4, [](const auto& a, const auto&) { return exp2(a); }),
          operation("log", 4, [](const auto& a, const auto&) { return log(a); }),
          operation("log2", 4, [](const auto& a, const auto&) { return log2(a); }),
          operation("log1p", 4, [](const auto& a, const auto&) { return log1p(-a); }),
          operation("pow", 512, [](const auto& a, const auto& b) { return pow(a, b); }),
          operation("pow_from_zero", 512, [](const auto& a, const auto& b) { return pow_from_zero(a, b); })};
}

bool is_near(double a, double b, double room) {
  return a == b || std::abs(a - b) <= room || (std::isnan(a) && std::isnan(b));
}

template <class Precision>
void expect_lanes_of(const Operation<Precision>& operation) {
  std::mt19937_64 random(11);
  for (int i = 0; i < 4000; ++i) {
    BoundedBatch<Precision> a(0.0);
    BoundedBatch<Precision> b(0.0);
    for (std::size_t lane = 0; lane < Batch::size; ++lane) {
      a.set_lane(lane, operand<Precision>(random));
      b.set_lane(lane, operand<Precision>(random));
    }
    const BoundedBatch<Precision> result = operation.batch(a, b);
    for (std::size_t lane = 0; lane < Batch::size; ++lane) {
      const One<Precision> got = result.lane(lane);
      const One<Precision> wanted = operation.one(a.lane(lane), b.lane(lane));
      ASSERT_EQ(got.is_bounded(), wanted.is_bounded()) << operation.name;
      if (!wanted.is_bounded()) continue;
      const double room = operation.ulps * 0x1p-52 * wanted.range().magnitude();
      EXPECT_TRUE(is_near(got.center(), wanted.center(), room)) << operation.name << ' ' << got.center() - wanted.center();
      EXPECT_TRUE(is_near(got.shift_x(), wanted.shift_x(), room)) << operation.name << ' ' << got.shift_x() << ' ' << wanted.shift_x();
      EXPECT_TRUE(is_near(got.shift_y(), wanted.shift_y(), room)) << operation.name;
      EXPECT_TRUE(is_near(got.radius(), wanted.radius(), room)) << operation.name << ' ' << got.radius() << ' ' << wanted.radius();
      EXPECT_TRUE(is_near(got.range().lower, wanted.range().lower, room)) << operation.name;
      EXPECT_TRUE(is_near(got.range().upper, wanted.range().upper, room)) << operation.name;
      if (::testing::Test::HasFailure()) return;
    }
  }
}

TEST(BoundedBatch, LanesAreBoundedInHighp) {
  if (!has_batch()) return;  // nothing runs it there
  for (const auto& operation : operations<Highp>()) expect_lanes_of(operation);
}

TEST(BoundedBatch, LanesAreBoundedInMediump) {
  if (!has_batch()) return;
  for (const auto& operation : operations<Mediump>()) expect_lanes_of(operation);
}

TEST(BoundedBatch, ConvertsLikeBounded) {
  if (!has_batch()) return;
  std::mt19937_64 random(5);
  const auto same = [](const auto& a, const auto& b) {
    return a.radius() == b.radius() && a.range().lower == b.range().lower && a.range().upper == b.range().upper;
  };
  for (int i = 0; i < 4000; ++i) {
    BoundedBatch<Highp> high(0.0);
    BoundedBatch<Mediump> medium(0.0);
    for (std::size_t lane = 0; lane < Batch::size; ++lane) {
      high.set_lane(lane, operand<Highp>(random));
      medium.set_lane(lane, operand<Mediump>(random));
    }
    const BoundedBatch<Mediump> narrowed = converted_to(high, static_cast<const BoundedBatch<Mediump>*>(nullptr));
    const BoundedBatch<Highp> widened = converted_to(medium, static_cast<const BoundedBatch<Highp>*>(nullptr));
    for (std::size_t lane = 0; lane < Batch::size; ++lane) {
      EXPECT_TRUE(same(narrowed.lane(lane), converted<Apart<Mediump>>(high.lane(lane))));
      EXPECT_TRUE(same(widened.lane(lane), converted<Apart<Highp>>(medium.lane(lane))));
    }
  }
}

// image() takes what xsimd gives for within 2 ulp of double.
TEST(BoundedBatch, FunctionsOfDoubleAreWithinTwoUlp) {
  if (!has_batch()) return;
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto check = [](const char* name, const Batch& got, const Batch& x, auto exact) {
    for (std::size_t i = 0; i < Batch::size; ++i) {
      const long double truth = exact(static_cast<long double>(x.get(i)));
      const double ulp = std::nextafter(std::abs(static_cast<double>(truth)), 1e300) - std::abs(static_cast<double>(truth));
      EXPECT_LE(std::abs(static_cast<double>(got.get(i) - truth)), 2 * ulp) << name << ' ' << x.get(i);
    }
  };
  for (int i = 0; i < 20000 && !::testing::Test::HasFailure(); ++i) {
    const auto four = [&](auto f) { return Batch{f(), f(), f(), f()}; };
    const Batch exponent = four([&] { return 170 * uniform(random) - 85; });
    const Batch positive = four([&] { return std::exp2(250 * uniform(random) - 125); });
    const Batch near_one = four([&] { return 0.5 + 1.5 * uniform(random); });
    const Batch small = four([&] { return -0.25 * std::exp2(-30 * uniform(random)); });
    check("exp", xsimd::exp(exponent), exponent, [](long double x) { return std::exp(x); });
    check("exp2", xsimd::exp2(exponent), exponent, [](long double x) { return std::exp2(x); });
    check("log", xsimd::log(positive), positive, [](long double x) { return std::log(x); });
    check("log", xsimd::log(near_one), near_one, [](long double x) { return std::log(x); });
    check("log2", xsimd::log2(positive), positive, [](long double x) { return std::log2(x); });
    check("log2", xsimd::log2(near_one), near_one, [](long double x) { return std::log2(x); });
    check("log1p", xsimd::log1p(small), small, [](long double x) { return std::log1p(x); });
  }
}

TEST(TruthBatch, ChoosesOnlyWhatIsAsked) {
  if (!has_batch()) return;
  using B = BoundedBatch<Highp>;
  const auto of = [](double value, double radius) { return B(One<Highp>::within(value, radius)); };
  int calls = 0;
  const auto counted = [&calls](double value) {
    return [&calls, value] {
      ++calls;
      return B(value);
    };
  };
  EXPECT_EQ(select_of(of(1, 0.1) < of(2, 0.1), counted(3), counted(4)).lane(2).center(), 3);
  EXPECT_EQ(calls, 1);
  const B either = select_of(of(1, 1.1) < of(2, 1.1), counted(3), counted(4));
  EXPECT_EQ(calls, 3);
  EXPECT_EQ(either.lane(1).range().upper, 4);
  B mixed = of(1, 0.1);
  mixed.set_lane(3, One<Highp>(5));
  const TruthBatch below = mixed < of(2, 0.1);
  EXPECT_TRUE(any(below));
  EXPECT_FALSE(any(of(3, 0.1) < of(2, 0.1)));
  EXPECT_EQ(select(below, B(3), B(4)).lane(3).center(), 4);
}

}  // namespace
}  // namespace sheen::number
