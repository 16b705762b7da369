#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "number/bounded_functions.h"

namespace sheen::number {
namespace {

using High = Bounded<Highp>;
using Medium = Bounded<Mediump>;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The deviation of a value is this, but for double's own roundings.
template <class Precision>
void expect_deviation(const Bounded<Precision>& x, double expected, const std::string& what) {
  EXPECT_TRUE(x.is_bounded()) << what;
  EXPECT_NEAR(x.deviation(), expected, 1e-6 * expected) << what;
}

template <class Precision>
void expect_unbounded(const Bounded<Precision>& x, const std::string& what) {
  EXPECT_FALSE(x.is_bounded()) << what;
  EXPECT_EQ(x.radius(), infinity) << what;
  EXPECT_EQ(x.deviation(), infinity) << what;
  EXPECT_EQ(x.range().lower, -infinity) << what;
  EXPECT_EQ(x.range().upper, infinity) << what;
}

TEST(Ulp, IsTheSmallerDistanceAtAPowerOfTwo) {
  EXPECT_EQ(ulp<Highp>(1.0), 0x1p-24);
  EXPECT_EQ(ulp<Highp>(std::nextafter(1.0, 2.0)), 0x1p-23);
  EXPECT_EQ(ulp<Highp>(std::nextafter(2.0, 1.0)), 0x1p-23);
  EXPECT_EQ(ulp<Highp>(-8.0), 0x1p-21);
  EXPECT_EQ(ulp<Mediump>(1.0), 0x1p-10);
  EXPECT_EQ(ulp<Mediump>(1.5), 0x1p-9);
}

TEST(Ulp, IsTheStepOfTheSubnormalsBelowTheSmallestNormal) {
  EXPECT_EQ(ulp<Highp>(0.0), 0x1p-149);
  EXPECT_EQ(ulp<Highp>(0x1p-126), 0x1p-149);
  EXPECT_EQ(ulp<Highp>(0x1p-140), 0x1p-149);
  EXPECT_EQ(ulp<Mediump>(0x1p-20), 0x1p-22);
}

TEST(Format, KnowsItsNumbers) {
  EXPECT_EQ(largest_finite<Highp>, static_cast<double>(std::numeric_limits<float>::max()));
  EXPECT_EQ(smallest_normal<Highp>, static_cast<double>(std::numeric_limits<float>::min()));
  EXPECT_EQ(largest_finite<Mediump>, 16368);
  for (const double x : {0.1, 1 / 3.0, 1e-40, 5e-46, 1e30, 4e38, 1 + 0x1p-24}) {
    EXPECT_EQ(is_representable<Highp>(x), static_cast<double>(static_cast<float>(x)) == x && std::isfinite(static_cast<float>(x))) << x;
    const float f = static_cast<float>(x);
    EXPECT_EQ(is_representable<Highp>(f), std::isfinite(f)) << x;
  }
  EXPECT_TRUE(is_representable<Mediump>(1 + 0x1p-9));
  EXPECT_FALSE(is_representable<Mediump>(1 + 0x1p-10));
  EXPECT_FALSE(is_representable<Highp>(std::nan("")));
}

TEST(Constant, IsExactOrRoundedToEitherNeighbour) {
  EXPECT_TRUE(High(0.25).is_exact());
  EXPECT_TRUE(High().is_exact());
  expect_deviation(High(0.1), 0x1p-27, "0.1 lies in [2^-4, 2^-3)");
  expect_deviation(Medium(0.1), 0x1p-13, "the same in mediump");
  expect_unbounded(High(1e39), "beyond the largest number");
  expect_unbounded(High(std::nan("")), "not a number");
}

TEST(Addition, IsExactWhereItsResultIsANumberElseErrsByAnUlp) {
  EXPECT_TRUE((High(1) - High(0.25)).is_exact());
  EXPECT_TRUE((Medium(1) - Medium(0.25)).is_exact());
  expect_deviation(High(1) + High(0x1p-30), 0x1p-23, "just above 1");
  expect_deviation(High(1) - High(0x1p-30), 0x1p-24, "just below 1");
  expect_deviation(High(1) + High(0x1p-80), 0x1p-23, "the sum is 1 in double alone");
  expect_deviation(Medium(1) + Medium(0x1p-10), 0x1p-9, "mediump");
  const High x = High::within(3, 1e-3);
  EXPECT_EQ((x + High(0)).radius(), x.radius()) << "nothing is rounded";
  expect_deviation(Medium::within(3, 1e-3) + Medium(0), 1e-3 + 0x1p-8, "a variable of more digits loses them");
}

TEST(Multiplication, ErrsByAnUlpButNotByPowersOfTwo) {
  const double x = 1 + 0x1p-23;
  expect_deviation(High(x) * High(x), 0x1p-23, "just above 1");
  expect_deviation(High(x) * High(2 - 0x1p-23), 0x1p-22, "just above 2");
  EXPECT_TRUE((High(3) * High(5)).is_exact());
  const High y = High::within(3, 1e-3);
  EXPECT_EQ((y * High(0.25)).radius(), y.radius() / 4);
  EXPECT_EQ((High(-2) * y).radius(), y.radius() * 2);
  EXPECT_TRUE((y * High(0)).is_exact());
  expect_deviation(Medium::within(3, 1e-3) * Medium(2), 2e-3 + 0x1p-7, "a variable of more digits loses them");
}

TEST(Division, ErrsByTwoAndAHalfUlp) {
  expect_deviation(High(1) / High(3), 2.5 * 0x1p-25, "1/3");
  expect_deviation(High(1) / High(2), 2.5 * 0x1p-25, "1/2, a power of two");
  expect_deviation(High(3) / High(5), 2.5 * 0x1p-24, "3/5");
  expect_deviation(Medium(1) / Medium(3), 2.5 * 0x1p-11, "mediump");
}

TEST(Division, OverARangeErrsMostBeyondAPowerOfTwo) {
  // Just above 1 an ulp is twice that of 1 itself, so the least result is not that of the range's lower end.
  const High x = High::within(2, 1) / High(1);
  EXPECT_LE(x.range().lower, 1 + 0x1p-23 - 2.5 * 0x1p-23);
  EXPECT_GE(x.range().lower, 1 - 2.5001 * 0x1p-23);
  EXPECT_GE((-x).range().upper, -1 - 0x1p-23 + 2.5 * 0x1p-23);
  EXPECT_GE((High::within(-2, 1) / High(1)).range().upper, -1 - 0x1p-23 + 2.5 * 0x1p-23);
}

TEST(Division, IsUnboundedOutsideTheDivisorsRange) {
  EXPECT_TRUE((High(1) / High(0x1p126)).is_bounded());
  expect_unbounded(High(1) / High(0x1.8p126), "above 2^126");
  EXPECT_TRUE((High(0x1p-20) / High(0x1p-126)).is_bounded());
  expect_unbounded(High(0x1p-140) / High(0x1p-127), "below 2^-126");
  expect_unbounded(High(1) / High(0), "by zero");
  expect_unbounded(High(0) / High(0), "0/0 has a NaN for its centre");
  expect_unbounded(High(1) / High::within(0.5, 0.6), "by a range around zero");
  expect_unbounded(High(1) / High::within(-0.5, 0.5), "by a range that touches zero");
  EXPECT_TRUE((Medium(1) / Medium(0x1p12)).is_bounded());
  expect_unbounded(Medium(1) / Medium(0x1.8p12), "mediump, above 2^12");
  EXPECT_TRUE((Medium(1) / Medium(-0x1p-12)).is_bounded());
  expect_unbounded(Medium(0x1p-10) / Medium::within(0x1p-13, 0x1p-20), "mediump, below 2^-13");
}

TEST(Exponential, ErrsByTheMoreUlpTheLargerItsArgument) {
  expect_deviation(exp(High(0)), 4 * 0x1p-24, "e^0 = 1, a power of two");
  expect_deviation(exp(High(1)), 6 * 0x1p-22, "e");
  expect_deviation(exp(High(-1)), 6 * 0x1p-25, "1/e");
  expect_deviation(exp(High(-50)), 104 * ulp<Highp>(std::exp(-50.0)), "e^-50");
  expect_deviation(exp2(High(3)), 10 * 0x1p-21, "2^3, a power of two");
  expect_deviation(exp2(High(0.5)), 5 * 0x1p-23, "2^0.5");
  expect_deviation(exp(Medium(1)), 5 * 0x1p-8, "mediump");
  expect_unbounded(exp(High(89)), "overflow");
  EXPECT_LT(exp(High(-1000)).deviation(), 1e-41) << "underflow";
}

TEST(Logarithm, ErrsAbsolutelyNearOneAndByUlpElsewhere) {
  expect_deviation(log(High(4)), 4 * 0x1p-23, "outside");
  expect_deviation(log(High(0.25)), 4 * 0x1p-23, "outside");
  for (const double x : {0.5, 0.75, 1.0, 1.875, 2.0}) {
    expect_deviation(log(High(x)), 0x1p-21, "inside, ends included");
    expect_deviation(log2(High(x)), 0x1p-21, "inside, ends included");
    expect_deviation(log(Medium(std::min(x, 1.75))), 0x1p-7, "mediump, inside");
  }
  expect_deviation(log2(High(8)), 4 * 0x1p-22, "log2 8 = 3");
  expect_deviation(log2(High(0x1p16)), 4 * 0x1p-20, "log2 2^16 = 16, a power of two");
  expect_deviation(log(Medium(4)), 2 * 0x1p-9, "mediump, outside");
  expect_deviation(log(High::within(0.5, 1e-30)), 0x1p-21, "across the end of the range");
  const double near = 2.0000002384185791;  // the number after 2
  expect_deviation(log(High(near)), 4 * 0x1p-24, "outside again");
}

TEST(Logarithm, IsUnboundedWhereItsArgumentMayVanish) {
  expect_unbounded(log(High(0)), "0");
  expect_unbounded(log2(High(-1)), "negative");
  expect_unbounded(log(High(1e-40)), "a subnormal, which may be flushed");
  expect_unbounded(log(High::within(0.5, 0.5)), "down to 0");
  EXPECT_TRUE(log(High(0x1p-126)).is_bounded());
  expect_unbounded(log(Medium::within(0x1p-13, 0x1p-20)), "subnormal in mediump");
}

TEST(Roots, InheritFromInverseSqrt) {
  expect_deviation(inversesqrt(High(4)), 2 * 0x1p-25, "1/2, a power of two");
  expect_deviation(inversesqrt(High(3)), 2 * 0x1p-24, "1/sqrt 3");
  // 1/2 errs by 2^-24, a relative 2^-23, and its inverse above 2 by 2.5 ulp of 2^-22.
  expect_deviation(sqrt(High(4)), 2 * 0x1p-23 + 2.5 * 0x1p-22, "2");
  expect_deviation(sqrt(High(3)), 3 * 2 * 0x1p-24 + 2.5 * 0x1p-23, "sqrt 3");
  expect_unbounded(sqrt(High(0)), "1 / inversesqrt(0)");
  expect_unbounded(inversesqrt(High(0)), "1/0");
  expect_unbounded(sqrt(High::within(1e-3, 2e-3)), "negative in part");
  const High wide = sqrt(High::within(0.5, 0.5 - 1e-12));
  EXPECT_LT(wide.range().upper, 1 + 1e-6) << "a wide range keeps a relative error";
}

TEST(Power, IsDerivedFromExp2AndLog2) {
  // log2 4 = 2 errs by 4 ulp of 2^-23, half of that is the exponent's error, and 2^1 errs by 6 ulp.
  const double expected = 2 * std::log(2.0) * 2 * 0x1p-23 + 6 * 0x1p-22;
  EXPECT_NEAR(pow(High(4), High(0.5)).deviation(), expected, 1e-4 * expected);
  const double tenth = 0.10000000149011612;
  const double log_error = std::abs(tenth) * 4 * ulp<Highp>(std::log2(3.0)) + ulp<Highp>(tenth * std::log2(3.0));
  const double value = std::pow(3.0, tenth);
  const double third = value * std::log(2.0) * log_error + (4 + 2 * tenth * std::log2(3.0)) * ulp<Highp>(value);
  EXPECT_NEAR(pow(High(3), High(tenth)).deviation(), third, 1e-4 * third);
  expect_unbounded(pow(High(0), High(0.2)), "0^y");
  EXPECT_EQ(pow(High(0), High(0.2)).center(), 0);
}

TEST(Log1p, IsBoundedAsTheShadersComputeIt) {
  expect_deviation(log1p(High(-0.125)), 5.25 * 0x1p-23 * -std::log1p(-0.125), "relative");
  expect_deviation(log1p(High(-0x1p-20)), 5.25 * 0x1p-23 * 0x1p-20, "relative for small arguments too");
  EXPECT_LT(log1p(High(0)).deviation(), 1e-37);
  expect_unbounded(log1p(High(-0.26)), "outside the series' range");
  expect_unbounded(log1p(High(0.1)), "outside the series' range");
  EXPECT_NEAR(log1p(Medium(-0.125)).deviation(), 0x1p-12, 1e-2 * 0x1p-12) << "a highp function, stored in mediump";
}

TEST(Comparison, IsCertainOnlyWhereTheRangesAreApart) {
  const High a = High::within(1, 0.1);
  EXPECT_TRUE((a < High(1.2)).is_true());
  EXPECT_TRUE((a > High(1.2)).is_false());
  EXPECT_TRUE((a < High(1.05)).is_either());
  EXPECT_TRUE((a < High(1.05)).at_center());
  EXPECT_TRUE((a > High(1.05)).is_either());
  EXPECT_FALSE((a > High(1.05)).at_center());
  EXPECT_TRUE((High(1) < High(1)).is_false());
  EXPECT_TRUE((High(1) <= High(1)).is_true());
  EXPECT_TRUE((High(1) >= High(1)).is_true());
  EXPECT_TRUE((High(1e-40) > High(0)).is_either()) << "a subnormal may be flushed";
  EXPECT_TRUE((High(1) / High(0) > High(0)).is_either());
  EXPECT_TRUE((High(0) < High(1) / High(0)).is_either());
  EXPECT_TRUE((High(1e39) > High(0)).is_either()) << "an overflow may be anything";
  EXPECT_TRUE((High(0) > -High(1e39)).is_either());
}

TEST(Comparison, KnowsThatBothMoveWithTheSample) {
  const High x = High::at_sample(1, 0.5, 0, 1, 1e-7);
  const High y = High::at_sample(1.001, 0.5, 0, 1, 1e-7);
  EXPECT_TRUE((x < y).is_true());
  EXPECT_TRUE((x > y).is_false());
  EXPECT_TRUE((x < High(1.001)).is_either());
}

TEST(Select, JoinsBothBranchesWhereTheConditionIsOpen) {
  const High a = High::within(1, 0.1), b = High::within(3, 0.2), broken = High(1) / High(0);
  const High either = select(High::within(0, 1) > High(0.5), a, b);
  EXPECT_EQ(either.center(), 3);
  EXPECT_NEAR(either.range().lower, 0.9, 1e-12);
  EXPECT_NEAR(either.range().upper, 3.2, 1e-12);
  EXPECT_NEAR(either.deviation(), 2.1, 1e-12);
  EXPECT_EQ(select(High(1) > High(0), a, broken).range().upper, a.range().upper) << "the branch not taken does not count";
  expect_unbounded(select(High::within(0, 1) > High(0.5), a, broken), "a branch that may be taken does");
}

TEST(Extrema, RoundNothingAndKeepTheirBounds) {
  const High a = High::within(0.1, 0.3);
  const High positive = max(a, High(0.0625));
  EXPECT_EQ(positive.range().lower, 0.0625);
  EXPECT_NEAR(positive.range().upper, 0.4, 1e-12);
  EXPECT_TRUE(log(positive).is_bounded());
  EXPECT_EQ(min(a, High(0.25)).range().upper, 0.25);
  EXPECT_NEAR(min(a, High(0.25)).range().lower, -0.2, 1e-12);
  EXPECT_EQ(max(a, High(2)).center(), 2);
  EXPECT_TRUE(max(a, High(2)).is_exact());
  const High b = abs(High::within(-0.1, 0.3));
  EXPECT_EQ(b.center(), 0.1);
  EXPECT_GE(b.range().lower, 0);
  EXPECT_NEAR(b.range().upper, 0.4, 1e-12);
  EXPECT_EQ(abs(High(-3)).range().lower, 3);
  expect_unbounded(min(max(High(0) / High(0), High(0)), High(1)), "what may be NaN cannot be clamped");
}

TEST(Square, OfOneVariableIsNotNegative) {
  const High x = High::within(0.1, 0.3);
  EXPECT_GE((x * x).range().lower, 0);
  const High y = High::within(0.1, 0.3);
  EXPECT_LT((x * y).range().lower, -0.07) << "another variable may have the other sign";
}

TEST(Contraction, OfASumOfProductsStaysInside) {
  const float a = 1.1F, b = 1.3F;
  const float product = a * b;
  const High difference = High(a) * High(b) - High(product);
  const float fused = std::fma(a, b, -product);
  EXPECT_NE(fused, 0) << "what the product's rounding cut off";
  for (const double computed : {static_cast<double>(fused), 0.0}) {
    EXPECT_LE(difference.range().lower, computed);
    EXPECT_GE(difference.range().upper, computed);
  }
}

TEST(Overflow, IsUnbounded) {
  expect_unbounded(High(3e38) * High(2), "product");
  expect_unbounded(High(3e38) + High(3e38), "sum");
  expect_unbounded(Medium(128) * Medium(128), "2^14 in mediump");
  EXPECT_TRUE((Medium(127) * Medium(128)).is_bounded());
  expect_unbounded((High(3e38) * High(2)) * High(0), "what was unbounded stays so");
  expect_unbounded(High(3e38) * High(2) - High(3e38) * High(2), "infinity less infinity is no NaN");
}

TEST(CorrectRounding, NeverPassesZero) {
  const High x = max(High::within(0.5, 1), High(0));
  const High y = High::within(3, 1);
  EXPECT_GE((x * y).range().lower, 0);
  EXPECT_GE((x + x * y).range().lower, 0);
  EXPECT_LE((-x * y).range().upper, 0);
}

TEST(Underflow, MayFlushToZero) {
  const High x = High(0x1p-100) * High(0x1p-30);
  EXPECT_LE(x.range().lower, 0);
  EXPECT_GE(x.range().upper, 0x1p-130);
  expect_deviation(x, 0x1p-130, "flushed");
  const Medium y = Medium(0x1.8p-7) * Medium(0x1p-7);
  EXPECT_LE(y.range().lower, 0);
  EXPECT_GE(y.range().upper, 0x1.8p-14);
  EXPECT_GE(y.deviation(), 0x1.8p-14);
  EXPECT_TRUE((High(0x1.8p-7) * High(0x1p-7)).is_exact()) << "highp has no need to";
  const High half = High::within(0x1.8p-126, 0x1p-140) * High(0.5);
  EXPECT_LE(half.range().lower, 0) << "no multiplication by a power of two is exact down there";
  const High z = High(0x1p-126 * 1.5) - High(0x1p-126);
  EXPECT_LE(z.range().lower, 0) << "a difference of normal numbers";
  const High just_normal = High(0x1p-126 * (1 + 0x1p-23)) / High(1);
  EXPECT_LE(just_normal.range().lower, 0) << "2.5 ulp may carry a result below the smallest normal number";
}

TEST(Conversion, RoundsDownwardAndIsExactUpward) {
  expect_deviation(converted<Mediump>(High(1 + 0x1p-23)), 0x1p-9, "to mediump");
  EXPECT_TRUE(converted<Mediump>(High(1.5)).is_exact() || converted<Mediump>(High(1.5)).deviation() < 1e-12);
  const Medium x(0.1);
  EXPECT_NEAR(converted<Highp>(x).deviation(), x.deviation(), 1e-12);
  expect_unbounded(converted<Mediump>(High(1e5)), "out of mediump's range");
  expect_unbounded(converted<Highp>(Medium(1) / Medium(0)), "stays unbounded");
}

TEST(Displacement, CancelsWhereBothOperandsMoveAlike) {
  const High x = High::at_sample(0.7, 3, -2, 0.01, 0);
  EXPECT_NEAR(x.displacement(), 0.05, 1e-15);
  EXPECT_LT((x - x).deviation(), 1e-14);
  EXPECT_EQ((x - x).displacement(), 0);
  EXPECT_LT((x / x).displacement(), 1e-15);
  const High y = High::at_sample(0.7, -3, 2, 0.01, 0);
  EXPECT_EQ((x + y).displacement(), 0);
  EXPECT_NEAR((x - y).displacement(), 0.1, 1e-15);
}

TEST(Displacement, LeavesTheSquaresOfSineAndCosineOnlyTheSecondOrder) {
  const double angle = 0.6;
  const double turn = 1e-3;  // radian a step
  const double curvature = 0.5 * turn * turn;
  const High s = High::at_sample(std::sin(angle), std::cos(angle), 0, turn, curvature);
  const High c = High::at_sample(std::cos(angle), -std::sin(angle), 0, turn, curvature);
  const High one = s * s + c * c;
  EXPECT_LT(one.displacement(), 1e-15);
  EXPECT_LT(one.deviation(), 5 * turn * turn + 4 * 0x1p-24);
  EXPECT_GT((s * s).displacement(), 0.9e-3);
}

TEST(Displacement, FollowsTheDerivativeOfEveryFunction) {
  const double x = 0.3, step = 1e-4;
  const High moved = High::at_sample(x, 1, -2, step, 0);
  const High fixed(0.625);
  const auto expect_slope = [&](const High& f, double slope, const char* what) {
    EXPECT_NEAR(f.shift_x(), slope * step, 1e-12 * std::abs(slope)) << what;
    EXPECT_NEAR(f.shift_y(), -2 * slope * step, 1e-12 * std::abs(slope)) << what;
    EXPECT_LT(f.radius(), 1000 * step * step) << what;
  };
  expect_slope(moved + fixed, 1, "x + a");
  EXPECT_NEAR((moved + fixed).radius(), 0x1p-24, 1e-6 * 0x1p-24) << "one rounding, whatever the displacement";
  expect_slope(fixed - moved, -1, "a - x");
  expect_slope(moved * fixed, 0.625, "a x");
  expect_slope(moved * moved, 2 * x, "x x");
  expect_slope(moved / fixed, 1.6, "x / a");
  expect_slope(fixed / moved, -0.625 / (x * x), "a / x");
  expect_slope(exp(moved), std::exp(x), "e^x");
  expect_slope(exp2(moved), std::log(2) * std::exp2(x), "2^x");
  expect_slope(log(moved), 1 / x, "ln x");
  expect_slope(log2(moved), 1 / (x * std::log(2)), "log2 x");
  expect_slope(sqrt(moved), 0.5 / std::sqrt(x), "sqrt x");
  expect_slope(inversesqrt(moved), -0.5 / (x * std::sqrt(x)), "1/sqrt x");
  expect_slope(pow(moved, fixed), 0.625 * std::pow(x, 0.625 - 1), "x^a");
  expect_slope(pow(fixed, moved), std::log(0.625) * std::pow(0.625, x), "a^x");
  expect_slope(log1p(moved - High(0.5)), 1 / (0.5 + x), "ln(1 + x)");
  expect_slope(abs(-moved), 1, "|x|");
  expect_slope(max(moved, High(0)), 1, "max(x, 0)");
}

TEST(Operations, OverWideRangesKeepTheirEnds) {
  // Each function over [1/4, 4], whose centre in the middle says little of the lower end.
  const High x = High::within(2.125, 1.875);
  const auto expect_ends = [](const High& f, double lower, double upper, const char* what) {
    EXPECT_NEAR(f.range().lower, lower, 1e-5 * (1 + std::abs(lower))) << what;
    EXPECT_NEAR(f.range().upper, upper, 1e-5 * (1 + std::abs(upper))) << what;
  };
  expect_ends(exp(x), std::exp(0.25), std::exp(4), "exp");
  expect_ends(exp2(x), std::exp2(0.25), 16, "exp2");
  expect_ends(log(x), -std::log(4), std::log(4), "log");
  expect_ends(log2(x), -2, 2, "log2");
  expect_ends(sqrt(x), 0.5, 2, "sqrt");
  expect_ends(inversesqrt(x), 0.5, 2, "inversesqrt");
  expect_ends(pow(x, High(0.5)), 0.5, 2, "pow");
  expect_ends(High(1) / x, 0.25, 4, "division");
  expect_ends(x * x, 0.0625, 16, "square");
  expect_ends(x + x, 0.5, 8, "sum");
}

}  // namespace
}  // namespace sheen::number
