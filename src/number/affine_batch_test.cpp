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

#include "number/cpu.h"
#include "number/eight_lanes_test.h"

// number::AffineBatch against what number::BoundedBatch encloses, and against exact values of its operands.

namespace sheen::number {
namespace {

using Form = AffineBatch;
using Bounds = BoundedBatch<Highp>;
using Single = test::One<Highp>;

/// What a result owes to operands that are rounded to float, where it is closer to 0 than they are or steeper.
double more_of_operands(std::string_view operation, const Single& x, const Single& y, const Single& result) {
  const double sum = 2 * 0x1p-23 * (std::abs(x.center()) + std::abs(y.center()));
  if (operation == "a + b" || operation == "a - b" || operation == "the rest") return sum;
  if (operation == "exp" || operation == "pow" || operation == "pow_from_zero") {
    return 4 * 0x1p-23 * std::abs(result.center()) *
           (std::abs(x.center()) + std::abs(y.center()) * (1 + std::abs(std::log(std::abs(x.center())))));
  }
  if (operation == "mix") return 16 * 0x1p-23 * (1 + std::abs(x.center()));
  return operation == "log" || operation == "log1p" ? 4 * 0x1p-23 : 0;
}

/// A value that the operand may have, at one displacement.
double held(const Single& x, double u, double v, double e) {
  return x.center() + u * x.shift_x() + v * x.shift_y() + e * x.radius();
}

TEST(AffineBatch, EnclosesWhatBoundsDoAndHardlyMore) {
  if (!has_batch()) return;  // nothing runs it there
  std::mt19937_64 random(23);
  std::uniform_int_distribution<int> sign(-1, 1);
  for (const auto& operation : test::operations<Form>()) {
    int kept = 0;
    for (int i = 0; i < 3000 && !::testing::Test::HasFailure(); ++i) {
      const test::Operands a(random);
      const test::Operands b(random);
      const Form form = operation.eight(a.as<Form>(), b.as<Form>());
      for (std::size_t k = 0; k < Form::lanes; ++k) {
        SCOPED_TRACE(operation.name);
        const std::size_t half = k / Batch::size;
        const std::size_t lane = k % Batch::size;
        const Single got = form.bounds(half).lane(lane);
        const Single want = operation.bounds(a.halves[half], b.halves[half]).lane(lane);
        const Single x = a.halves[half].lane(lane);
        const Single y = b.halves[half].lane(lane);
        const bool close = test::is_close(x) && test::is_close(y) && test::is_close(want);
        EXPECT_EQ(form.is_lost().get(k), !got.is_bounded());
        if (!got.is_bounded()) {
          EXPECT_TRUE(operation.may_lose || !close);
          continue;
        }
        ++kept;
        ASSERT_TRUE(want.is_bounded());
        const double room = 0x1p-46 * want.range().magnitude();  // of xsimd's functions
        EXPECT_LE(std::abs(got.center() - want.center()), got.radius() + room);
        EXPECT_LE(got.range().lower, want.range().lower + room);
        EXPECT_GE(got.range().upper, want.range().upper - room);
        if (close) {
          const double more = 5 * ulp<Highp>(1.01 * want.center());  // float's own roundings, of operands too
          EXPECT_LE(got.deviation(), 1.01 * want.deviation() + more + more_of_operands(operation.name, x, y, want));
          EXPECT_LE(got.radius(), 1.01 * want.radius() + more + more_of_operands(operation.name, x, y, want));
        }
        for (int n = 0; n < 12; ++n) {
          const double u = sign(random);
          const double v = sign(random);
          const double exact = operation.exact(held(x, u, v, sign(random)), held(y, u, v, sign(random)));
          const double ulps = x.is_exact() || y.is_exact() ? 0 : (1 - 1e-6) * operation.ulps;
          const double off = std::abs(exact - held(got, u, v, 0)) + ulps * ulp<Highp>(exact);
          EXPECT_LE(off, got.radius() + room) << x.center() << ' ' << y.center();
        }
      }
    }
    EXPECT_GT(kept, 6000) << operation.name;
  }
}

Form form_of(const Single& x) {
  return Form(Bounds(x), Bounds(x));
}
Single lane(const Form& x) {
  return x.bounds(1).lane(1);
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
  const Form both(mixed, Bounds(Single::within(3, 0.1)));
  const Form lanes = select(both < Form(1.05), both, both);
  EXPECT_TRUE(lanes.is_lost().get(1));
  EXPECT_FALSE(lanes.is_lost().get(2));
  EXPECT_FALSE(lanes.is_lost().get(5));
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
  EXPECT_TRUE(lane(Form(0.5) - Form(0.5)).is_exact());
  EXPECT_FALSE(lane(Form(0.3) - Form(0.3)).is_exact()) << "either may stand for another neighbour";
  EXPECT_FALSE(lane(Form(0.3)).is_exact());
  EXPECT_TRUE(lane(max(x, Form(2.0))).is_exact());
  const Form faint = form_of(Single::within(0x1.8p-126, 0x1p-140));
  EXPECT_GE(lane(faint * Form(0.5)).radius(), 0x1p-126) << "what falls below the normal numbers may be flushed";
  EXPECT_GE(lane(form_of(Single::within(0x1p-70, 0x1p-90)) * form_of(Single::within(0x1p-70, 0x1p-90))).radius(), 0x1p-140);
}

TEST(AffineBatch, HoldsWhatFloatRoundsOfCentresAndShifts) {
  if (!has_batch()) return;
  Form sum = form_of(Single::at_sample(1, 0.5, 0, 1, 0));
  const Form little = form_of(Single::at_sample(0x1p-24, 0x1p-25, 0, 1, 0));  // half of what either can hold
  double largest = 1.5;
  for (int i = 0; i < 8; ++i) {
    sum = sum + little;
    largest += 0x1p-24 + 0x1p-25 + (1 - 1e-6) * 0x1p-23;
  }
  ASSERT_EQ(lane(sum).center() + lane(sum).shift_x(), 1.5);
  EXPECT_LE(largest - 1.5, lane(sum).radius());
}

TEST(AffineBatch, CancelsWhereBothMoveAlike) {
  if (!has_batch()) return;
  const Form x = form_of(Single::at_sample(0.75, 3e-2, -2e-2, 1, 0));
  EXPECT_LT(lane(x - x).deviation(), 1e-6 * lane(x).displacement());
  EXPECT_EQ(lane(x - x).displacement(), 0);
  EXPECT_FALSE(is_lost(select(x < x + Form(1e-3), x, x))) << "a comparison of what moves together is certain";
}

}  // namespace
}  // namespace sheen::number
