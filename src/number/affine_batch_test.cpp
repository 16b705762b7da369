#include "number/affine_batch.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <string_view>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

#include "number/batch_operands_test.h"
#include "number/cpu.h"

// number::AffineBatch against what number::BoundedBatch encloses, and against exact values of its operands.

namespace sheen::number {
namespace {

using Form = AffineBatch<Highp>;
using Bounds = BoundedBatch<Highp>;
using Single = test::One<Highp>;

struct Operation {
  const char* name;
  bool may_lose;  ///< of operands that are close to their centres too
  bool rounds;    ///< once, correctly
  std::function<Form(const Form&, const Form&)> form;
  std::function<Bounds(const Bounds&, const Bounds&)> bounds;
  std::function<double(double, double)> exact;
};

std::vector<Operation> operations() {
  const auto operation = [](const char* name, bool may_lose, auto f, auto exact) {
    const std::string_view n = name;
    return Operation{name, may_lose, n == "a + b" || n == "a - b" || n == "a b" || n == "a a", f, f, exact};
  };
  const auto constant = [](const auto& like, double value) { return std::remove_cvref_t<decltype(like)>(value); };
  return {
      operation(
          "-a", false, [](const auto& a, const auto&) { return -a; }, [](double a, double) { return -a; }),
      operation(
          "a + b", false, [](const auto& a, const auto& b) { return a + b; }, [](double a, double b) { return a + b; }),
      operation(
          "a - b", false, [](const auto& a, const auto& b) { return a - b; }, [](double a, double b) { return a - b; }),
      operation(
          "a b", false, [](const auto& a, const auto& b) { return a * b; }, [](double a, double b) { return a * b; }),
      operation(
          "a a", false, [](const auto& a, const auto&) { return a * a; }, [](double a, double) { return a * a; }),
      operation(
          "a / b", false, [](const auto& a, const auto& b) { return a / b; }, [](double a, double b) { return a / b; }),
      operation(
          "max", false, [](const auto& a, const auto& b) { return max(a, b); }, [](double a, double b) { return std::max(a, b); }),
      operation(
          "min", false, [](const auto& a, const auto& b) { return min(a, b); }, [](double a, double b) { return std::min(a, b); }),
      operation(
          "abs", false, [](const auto& a, const auto&) { return abs(a); }, [](double a, double) { return std::abs(a); }),
      operation(
          "select <", true, [](const auto& a, const auto& b) { return select(a < b, a, b); },
          [](double a, double b) { return a < b ? a : b; }),
      operation(
          "select >=", true, [](const auto& a, const auto& b) { return select(a >= b, a, b); },
          [](double a, double b) { return a >= b ? a : b; }),
      operation(
          "a constant", false, [constant](const auto& a, const auto&) { return constant(a, 0.1) * a; },
          [](double a, double) { return 0.1 * a; }),
      operation(
          "a power of two", false, [constant](const auto& a, const auto&) { return constant(a, 0.5) * a; },
          [](double a, double) { return 0.5 * a; }),
      operation(
          "nothing", false, [constant](const auto& a, const auto& b) { return constant(a, 0) * a + b; },
          [](double, double b) { return b; }),
      operation(
          "the rest", false, [constant](const auto& a, const auto&) { return constant(a, 1) - a; }, [](double a, double) { return 1 - a; }),
      operation(
          "inversesqrt", true, [](const auto& a, const auto&) { return inversesqrt(a); },
          [](double a, double) { return 1 / std::sqrt(a); }),
      operation(
          "sqrt", true, [](const auto& a, const auto&) { return sqrt(a); }, [](double a, double) { return std::sqrt(a); }),
      operation(
          "exp", true, [](const auto& a, const auto&) { return exp(a); }, [](double a, double) { return std::exp(a); }),
      operation(
          "log", true, [](const auto& a, const auto&) { return log(a); }, [](double a, double) { return std::log(a); }),
      operation(
          "log1p", true, [](const auto& a, const auto&) { return log1p(-a); }, [](double a, double) { return std::log1p(-a); }),
      operation(
          "pow", true, [](const auto& a, const auto& b) { return pow(a, b); }, [](double a, double b) { return std::pow(a, b); }),
      operation(
          "pow_from_zero", true, [](const auto& a, const auto& b) { return pow_from_zero(a, b); },
          [](double a, double b) { return std::pow(std::max(a, 0.0), b); }),
  };
}

bool is_close(const Single& x) {
  return x.is_bounded() && x.deviation() <= 1e-3 * std::abs(x.center()) && std::abs(x.center()) > 1e-30 && std::abs(x.center()) < 1e30;
}

/// A value that the operand may have, at one displacement.
double held(const Single& x, double u, double v, double e) {
  return x.center() + u * x.shift_x() + v * x.shift_y() + e * x.radius();
}

TEST(AffineBatch, EnclosesWhatBoundsDoAndHardlyMore) {
  if (!has_batch()) return;  // nothing runs it there
  std::mt19937_64 random(23);
  std::uniform_int_distribution<int> sign(-1, 1);
  for (const Operation& operation : operations()) {
    int kept = 0;
    for (int i = 0; i < 3000 && !::testing::Test::HasFailure(); ++i) {
      Bounds a(0.0);
      Bounds b(0.0);
      for (std::size_t lane = 0; lane < Batch::size; ++lane) {
        a.set_lane(lane, test::operand<Highp>(random));
        b.set_lane(lane, test::operand<Highp>(random));
      }
      const Form form = operation.form(Form(a), Form(b));
      const Bounds as_bounds = form.bounds();
      const Bounds wanted = operation.bounds(a, b);
      for (std::size_t lane = 0; lane < Batch::size; ++lane) {
        SCOPED_TRACE(operation.name);
        const Single got = as_bounds.lane(lane);
        const Single want = wanted.lane(lane);
        const Single x = a.lane(lane);
        const Single y = b.lane(lane);
        EXPECT_EQ(form.is_lost().get(lane), !got.is_bounded());
        if (!got.is_bounded()) {
          EXPECT_TRUE(operation.may_lose || !want.is_bounded() || !is_close(x) || !is_close(y) || !is_close(want));
          continue;
        }
        ++kept;
        ASSERT_TRUE(want.is_bounded());
        const double room = 0x1p-46 * want.range().magnitude();  // of xsimd's functions
        EXPECT_NEAR(got.center(), want.center(), room);
        EXPECT_LE(got.range().lower, want.range().lower + room);
        EXPECT_GE(got.range().upper, want.range().upper - room);
        if (is_close(x) && is_close(y) && is_close(want)) {
          const bool of_exact = x.is_exact() || y.is_exact();  // whose results may be numbers of the format, which only bounds look at
          const double more = of_exact ? 1.01 * ulp<Highp>(1.0001 * want.center()) : room;
          EXPECT_LE(got.deviation(), 1.01 * want.deviation() + more);
          EXPECT_LE(got.radius(), 1.01 * want.radius() + more);
        }
        for (int k = 0; k < 12; ++k) {
          const double u = sign(random);
          const double v = sign(random);
          const double exact = operation.exact(held(x, u, v, sign(random)), held(y, u, v, sign(random)));
          const bool may_round = operation.rounds && !x.is_exact() && !y.is_exact();
          const double off = std::abs(exact - held(got, u, v, 0)) + (may_round ? (1 - 1e-6) * ulp<Highp>(exact) : 0);
          EXPECT_LE(off, got.radius() + room) << x.center() << ' ' << y.center();
        }
      }
    }
    EXPECT_GT(kept, 3000) << operation.name;
  }
}

Form form_of(const Single& x) {
  return Form(Bounds(x));
}
Single lane(const Form& x) {
  return x.bounds().lane(1);
}
bool is_lost(const Form& x) {
  return xsimd::all(x.is_lost());
}

TEST(AffineBatch, KeepsWhatIsLost) {
  if (!has_batch()) return;
  const Form lost = form_of(Single::unbounded(0.5));
  const Form x(2.0);
  const Form moving = form_of(Single::within(2, 0.1));
  ASSERT_TRUE(is_lost(lost));
  for (const Form& other : {x, moving, Form(0.0), Form(1.0)}) {
    EXPECT_TRUE(is_lost(lost + other));
    EXPECT_TRUE(is_lost(other - lost));
    EXPECT_TRUE(is_lost(lost * other));
    EXPECT_TRUE(is_lost(other * lost));
    EXPECT_TRUE(is_lost(max(lost, other)));
    EXPECT_TRUE(is_lost(max(other, lost)));
    EXPECT_TRUE(is_lost(min(lost, other)));
    EXPECT_TRUE(is_lost(min(other, lost)));
    EXPECT_TRUE(is_lost(other / lost));
    const Form nan = lost * Form(0.0);  // infinity times nothing
    EXPECT_TRUE(is_lost(nan + other));
    EXPECT_TRUE(is_lost(max(nan, other)));
    EXPECT_TRUE(is_lost(min(other, nan)));
  }
  EXPECT_FALSE(is_lost(select(Form(1.0) < Form(2.0), x, lost))) << "a branch that is not taken";
  EXPECT_TRUE(is_lost(select(Form(2.0) < Form(1.0), x, lost)));
  EXPECT_TRUE(is_lost(select(lost < Form(2.0), x, x)));
}

TEST(AffineBatch, LosesWhatIsOpenOrBeyondTheFormat) {
  if (!has_batch()) return;
  const Form x = form_of(Single::within(1, 0.1));
  EXPECT_TRUE(is_lost(select(x < Form(1.05), x, x)));
  EXPECT_FALSE(is_lost(select(x < Form(1.2), x, x)));
  EXPECT_TRUE(is_lost(sqrt(x - Form(1.0))));
  EXPECT_TRUE(is_lost(Form(1.0) / (x - Form(1.0))));
  EXPECT_TRUE(is_lost(Form(0x1p126) * Form(4.0)));
  EXPECT_TRUE(is_lost(form_of(Single::within(0x1p126, 0x1p100)) * x * Form(2.5)));
  EXPECT_TRUE(is_lost(form_of(Single::within(0x1p126, 0x1p100)) + form_of(Single::within(0x1p126, 0x1p100))));
  Bounds mixed(Single::within(1, 0.1));
  mixed.set_lane(2, Single::within(3, 0.1));
  const Form lanes = select(Form(mixed) < Form(1.05), Form(mixed), Form(mixed));
  EXPECT_TRUE(lanes.is_lost().get(1));
  EXPECT_FALSE(lanes.is_lost().get(2));
}

TEST(AffineBatch, RoundsNothingWhereBoundsDoNot) {
  if (!has_batch()) return;
  const Form x = form_of(Single::at_sample(0.7, 1e-3, -2e-3, 1, 1e-5));
  const auto same = [&x](const Form& y, double scale) {
    EXPECT_EQ(lane(y).radius(), scale * lane(x).radius());
    EXPECT_EQ(lane(y).shift_x(), scale * lane(x).shift_x());
    EXPECT_EQ(lane(y).center(), scale * lane(x).center());
  };
  same(x + Form(0.0), 1);
  same(Form(0.0) + x, 1);
  same(x - Form(0.0), 1);
  same(x * Form(1.0), 1);
  same(Form(2.0) * x, 2);
  same(x * Form(0.25), 0.25);
  EXPECT_GT(lane(x * Form(0.75)).radius(), 0.75 * lane(x).radius() + 0x1p-26) << "which rounds";
  EXPECT_TRUE(lane(x * Form(0.0)).is_exact());
  EXPECT_TRUE(lane(Form(0.0) * Form(0.3)).is_exact());
  EXPECT_TRUE(lane(Form(0.5)).is_exact());
  EXPECT_FALSE(lane(Form(0.3)).is_exact());
  EXPECT_TRUE(lane(max(x, Form(2.0))).is_exact());
  const Form faint = form_of(Single::within(0x1.8p-126, 0x1p-140));
  EXPECT_GE(lane(faint * Form(0.5)).radius(), 0x1p-126) << "what falls below the normal numbers may be flushed";
  EXPECT_GE(lane(form_of(Single::within(0x1p-70, 0x1p-90)) * form_of(Single::within(0x1p-70, 0x1p-90))).radius(), 0x1p-140);
}

TEST(AffineBatch, CancelsWhereBothMoveAlike) {
  if (!has_batch()) return;
  const Form x = form_of(Single::at_sample(0.7, 3e-2, -2e-2, 1, 0));
  EXPECT_LT(lane(x - x).deviation(), 1e-14);
  EXPECT_EQ(lane(x - x).displacement(), 0);
  EXPECT_FALSE(is_lost(select(x < x + Form(1e-3), x, x))) << "a comparison of what moves together is certain";
}

}  // namespace
}  // namespace sheen::number
