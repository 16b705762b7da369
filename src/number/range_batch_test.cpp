#include "number/range_batch.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "number/cpu.h"
#include "number/eight_lanes_test.h"

// number::RangeBatch against exact values of its operands and the ranges of number::BoundedBatch.

namespace sheen::number {
namespace {

using Bounds = BoundedBatch<Highp>;
using Single = test::One<Highp>;

TEST(RangeBatch, EnclosesAllThatItsOperandsMake) {
  if (!has_batch()) return;  // nothing runs it there
  std::mt19937_64 random(29);
  std::uniform_int_distribution<int> third(0, 2);
  for (const auto& operation : test::operations<RangeBatch>()) {
    int kept = 0;
    for (int i = 0; i < 3000 && !::testing::Test::HasFailure(); ++i) {
      const test::Operands a(random);
      const test::Operands b(random);
      const RangeBatch ranges = operation.eight(a.as<RangeBatch>(), b.as<RangeBatch>());
      for (std::size_t k = 0; k < RangeBatch::lanes; ++k) {
        SCOPED_TRACE(operation.name);
        const std::size_t half = k / Batch::size;
        const std::size_t lane = k % Batch::size;
        const Single got = ranges.bounds(half).lane(lane);
        const Single x = a.halves[half].lane(lane);
        const Single y = b.halves[half].lane(lane);
        EXPECT_EQ(ranges.is_lost().get(k), !got.is_bounded());
        if (!got.is_bounded()) {
          EXPECT_TRUE(operation.may_lose || !test::is_close(x) || !test::is_close(y));
          continue;
        }
        ++kept;
        const double room = 0x1p-46 * got.range().magnitude();  // of xsimd's functions
        for (int n = 0; n < 9; ++n) {
          const auto in = [](const Single& of, int at) {
            return at == 0 ? of.range().lower : at == 1 ? of.range().upper : 0.5 * (of.range().lower + of.range().upper);
          };
          const double exact = operation.exact(in(x, n / 3), in(y, n % 3));
          const double ulps = x.is_exact() || y.is_exact() ? 0 : (1 - 1e-6) * operation.ulps;
          const double rounding = ulps > 0 ? ulps * ulp<Highp>(exact) : 0;
          // To zero at the most, where small numbers may be flushed too.
          const bool flushes = operation.ulps == 1 && std::abs(exact) < smallest_normal<Highp>;
          const double least = exact >= 0 ? std::max(exact - rounding, 0.0) : exact - rounding;
          const double most = exact <= 0 ? std::min(exact + rounding, 0.0) : exact + rounding;
          EXPECT_GE(flushes ? std::min(least, 0.0) : least, got.range().lower - room) << x.center() << ' ' << y.center();
          EXPECT_LE(flushes ? std::max(most, 0.0) : most, got.range().upper + room) << x.center() << ' ' << y.center();
        }
      }
    }
    EXPECT_GT(kept, 6000) << operation.name;
  }
}

RangeBatch range(double lower, double upper) {
  return {FloatBatch(static_cast<float>(lower)), FloatBatch(static_cast<float>(upper))};
}
bool is_lost(const RangeBatch& x) {
  return xsimd::all(x.is_lost());
}
/// @param rounded  the size of what is rounded, if not the ends
void expect_near(const RangeBatch& x, double lower, double upper, double rounded = 0) {
  const auto range = x.bounds(1).lane(2).range();
  const double room = 32 * 0x1p-24;
  EXPECT_NEAR(range.lower, lower, room * std::max(rounded, std::abs(lower)));
  EXPECT_NEAR(range.upper, upper, room * std::max(rounded, std::abs(upper)));
}

TEST(RangeBatch, ReachesNoFartherThanOperandsDo) {
  if (!has_batch()) return;
  expect_near(range(1, 3) + range(-5, -2), -4, 1);
  expect_near(range(1, 3) - range(-5, -2), 3, 8);
  expect_near(range(1, 3) * range(2, 5), 2, 15);
  expect_near(range(-1, 3) * range(2, 5), -5, 15);
  expect_near(range(-1, 3) * range(-2, 5), -6, 15);
  const RangeBatch x = range(-1, 3);
  expect_near(x * x, 0, 9);
  expect_near(sum_of_products(range(1, 3), range(2, 5), range(1, 3), range(2, 5), range(1, 2), range(2, 3)), 6, 36, 36);
  expect_near(sum_of_products(range(1, 3), range(2, 5), range(-1, 3), range(-2, 5), range(1, 2), range(-4, -3)), -12, 27, 38);
  expect_near(difference_of_products(range(1, 3), range(2, 5), range(-1, 3), range(-2, 5)), -13, 21, 30);
  expect_near(sum_of_squares(range(-1, 3), range(2, 3), range(-5, -4)), 20, 43);
  EXPECT_EQ(sum_of_squares(x, x, x).bounds(0).lane(0).range().lower, 0);
  expect_near(range(1, 3) / range(2, 5), 0.2, 1.5);
  expect_near(range(-1, 3) / range(-5, -2), -1.5, 0.5);
  expect_near(max(range(-1, 3), range(0.5, 2)), 0.5, 3);
  expect_near(min(range(-1, 3), range(0.5, 2)), -1, 2);
  expect_near(abs(range(-4, 3)), 0, 4);
  expect_near(sqrt(range(4, 9)), 2, 3);
  expect_near(inversesqrt(range(4, 16)), 0.25, 0.5);
  expect_near(select(range(1, 2) < range(3, 4), range(5, 6), range(7, 8)), 5, 6);
  expect_near(select(range(3, 4) < range(1, 2), range(5, 6), range(7, 8)), 7, 8);
  expect_near(select(range(1, 3) < range(2, 4), range(5, 6), range(7, 8)), 5, 8);
  expect_near(select(range(1, 2) <= range(2, 3), range(5, 6), range(7, 8)), 5, 6);
  expect_near(select(range(1, 2) > range(3, 4), range(5, 6), range(7, 8)), 7, 8);
}

// Against a shader that rounds every operation to either side.
TEST(RangeBatch, EnclosesSumsOfProductsHoweverTheyAreRounded) {
  if (!has_batch()) return;
  std::mt19937_64 random(31);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto rounded = [&](double exact) {
    const float nearest = static_cast<float>(exact);
    const double other = static_cast<double>(nearest) > exact ? std::nextafter(nearest, -INFINITY) : std::nextafter(nearest, INFINITY);
    const double either = nearest == exact || unit(random) > 0 ? nearest : other;
    return std::abs(either) < smallest_normal<Highp> && unit(random) > 0 ? 0.0 : either;
  };
  for (int i = 0; i < 20000; ++i) {
    // Of all sizes; exact numbers, narrow ranges, and such as hold 0.
    RangeBatch of[6];
    double in[6];
    for (int k = 0; k < 6; ++k) {
      const double center = static_cast<float>(std::ldexp(unit(random), static_cast<int>(i % 3 == 0 ? 60 * unit(random) - 30 : 2)));
      const double radius = i % 2 == 0 ? 0 : std::abs(center) * std::exp2(8 * unit(random) - 8);
      const auto lower = static_cast<float>(center - radius);
      const auto upper = static_cast<float>(center + radius);
      of[k] = range(lower, upper);
      in[k] = unit(random) > 0 ? lower : upper;
    }
    const auto in_range = [](const RangeBatch& x, double value) {
      const auto held = x.bounds(0).lane(1).range();
      EXPECT_GE(value, held.lower);
      EXPECT_LE(value, held.upper);
    };
    in_range(sum_of_products(of[0], of[1], of[2], of[3], of[4], of[5]),
             rounded(rounded(rounded(in[0] * in[1]) + rounded(in[2] * in[3])) + rounded(in[4] * in[5])));
    in_range(difference_of_products(of[0], of[1], of[2], of[3]), rounded(rounded(in[0] * in[1]) - rounded(in[2] * in[3])));
    in_range(sum_of_squares(of[0], of[1], of[2]),
             rounded(rounded(rounded(in[0] * in[0]) + rounded(in[1] * in[1])) + rounded(in[2] * in[2])));
  }
}

TEST(RangeBatch, KeepsTheSignOfWhatIsRoundedCorrectly) {
  if (!has_batch()) return;
  const auto lower = [](const RangeBatch& x) { return x.bounds(0).lane(0).range().lower; };
  const auto upper = [](const RangeBatch& x) { return x.bounds(0).lane(0).range().upper; };
  EXPECT_EQ(lower(RangeBatch(0.0) * range(1, 2)), 0);
  EXPECT_EQ(lower(RangeBatch(0.0) + RangeBatch(0.0)), 0);
  EXPECT_EQ(upper(range(0x1p-63, 1) * -range(0x1p-63, 1)), 0) << "which may be flushed";
  EXPECT_LE(lower(range(-0x1p-80, 0) * range(0, 0x1p-80)), -0x1p-149) << "which float has as zero, of either sign";
  EXPECT_GE(upper(range(-0x1p-80, 0) * range(-0x1p-80, 0)), 0x1p-149);
  EXPECT_EQ(lower(range(-1, 1) * RangeBatch(0.5)), lower(RangeBatch(0.5) * range(-1, 1)));
  EXPECT_EQ(lower(RangeBatch(0.25)), 0.25);
  EXPECT_LT(lower(RangeBatch(0.1)), 0.1);
  EXPECT_GT(upper(RangeBatch(0.1)), 0.1);
}

TEST(RangeBatch, LosesWhatLeavesTheFormatAndKeepsItLost) {
  if (!has_batch()) return;
  EXPECT_TRUE(is_lost(range(0x1p126, 0x1.1p126) * range(2, 3)));
  const RangeBatch large = range(0x1p63, 0x1.8p63);
  EXPECT_TRUE(is_lost(sum_of_products(large, large, large, large, large, large)));
  EXPECT_TRUE(is_lost(difference_of_products(large, large, large, large)));
  EXPECT_TRUE(is_lost(sum_of_squares(large, large, large)));
  EXPECT_TRUE(is_lost(range(1, 2) / range(-1, 1)));
  EXPECT_TRUE(is_lost(range(1, 2) / RangeBatch(0.0)));
  EXPECT_TRUE(is_lost(sqrt(range(-1, 1))));
  EXPECT_TRUE(is_lost(inversesqrt(range(0, 1))));
  EXPECT_TRUE(is_lost(inversesqrt(range(0x1p-127, 1)))) << "which may be flushed";
  EXPECT_TRUE(is_lost(sqrt(range(0, 1)))) << "1 / inversesqrt(0)";
  EXPECT_TRUE(is_lost(log(range(-1, 1))));
  EXPECT_TRUE(is_lost(RangeBatch(1e39)));
  const Bounds unbounded(Single::unbounded(0.5));
  const RangeBatch lost(unbounded, unbounded);
  ASSERT_TRUE(is_lost(lost));
  for (const RangeBatch& other : {RangeBatch(0.0), RangeBatch(1.0), range(-1, 2), range(-3, -1)}) {
    for (const RangeBatch& of :
         {lost + other, other + lost, lost - other, other - lost, lost * other, other * lost, lost / other, other / lost, max(lost, other),
          max(other, lost), min(lost, other), min(other, lost), abs(lost), -lost, sqrt(lost)}) {
      EXPECT_TRUE(is_lost(of));
    }
    EXPECT_TRUE(is_lost(select(range(1, 3) < range(2, 4), lost, other)));
    EXPECT_TRUE(is_lost(select(range(1, 3) < range(2, 4), other, lost)));
    EXPECT_FALSE(is_lost(select(range(1, 2) < range(3, 4), other, lost))) << "a branch that is not taken";
    EXPECT_FALSE(is_lost(select(lost < other, other, other))) << "whichever is taken";
  }
  EXPECT_TRUE(is_lost(lost * lost));
  const RangeBatch one(1.0);
  EXPECT_TRUE(is_lost(sum_of_products(one, one, one, lost, one, one)));
  EXPECT_TRUE(is_lost(difference_of_products(one, one, one, lost)));
  EXPECT_TRUE(is_lost(sum_of_squares(one, lost, one)));
  Bounds mixed(Single::within(1, 0.1));
  mixed.set_lane(2, Single::unbounded(0));
  const RangeBatch lanes = RangeBatch(mixed, Bounds(1.0)) * range(1, 2);
  EXPECT_TRUE(lanes.is_lost().get(2));
  EXPECT_FALSE(lanes.is_lost().get(1));
  EXPECT_FALSE(lanes.is_lost().get(6));
}

}  // namespace
}  // namespace sheen::number
