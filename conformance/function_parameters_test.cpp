#include "conformance/function_parameters.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "number/precision.h"

namespace sheen::conformance {
namespace {

constexpr NumberFormat highp{number::Highp::fraction_bits, number::Highp::min_exponent};
constexpr NumberFormat mediump{number::Mediump::fraction_bits, number::Mediump::min_exponent};

TEST(NumberFormat, NearestIsANumberOfTheFormatAndNoSubnormal) {
  for (const double x : {0.1, 1.0 / 3, -0.7, 1e-30, 3.1e-5, 2e-4, 123.4}) {
    EXPECT_TRUE(number::is_representable<number::Highp>(highp.nearest(x))) << x;
    EXPECT_TRUE(number::is_representable<number::Mediump>(mediump.nearest(x))) << x;
    EXPECT_LE(std::abs(highp.nearest(x) - x), 0.5 * number::ulp<number::Highp>(1.01 * x)) << x;
  }
  EXPECT_EQ(highp.nearest(0.1), static_cast<double>(0.1F));
  EXPECT_EQ(mediump.nearest(1e-4), mediump.smallest_normal()) << "an argument is never flushed";
  EXPECT_EQ(mediump.nearest(3e-5), 0);
  EXPECT_EQ(mediump.nearest(1 + mediump.ulp_above_1()), 1 + mediump.ulp_above_1());
  EXPECT_NE(highp.nearest(1 - highp.ulp_below_1()), 1);
}

TEST(Parameters, ShareUndoesAt) {
  for (const Parameter& parameter :
       {roughness_parameter("r", highp), alpha_parameter("a", highp), cosine_parameter("c", highp), signed_cosine_parameter("d", highp),
        angle_parameter("t"), turn_parameter("p"), operand_parameter("x", -3, 5, {}), magnitude_parameter("m", 0x1p-20, 0x1p10, false, {}),
        magnitude_parameter("s", 0x1p-20, 0x1p10, true, {})}) {
    for (const double u : {0.0, 0.2, 0.51, 0.9, 1.0}) {
      EXPECT_NEAR(parameter.share(parameter.at(u)), u, 1e-9) << parameter.name;
    }
    EXPECT_GE(parameter.share(-1e9), 0) << parameter.name;
    EXPECT_LE(parameter.share(1e9), 1) << parameter.name;
  }
}

TEST(ChooseValues, DenseIsAGridWhoseFirstParameterRunsRightAndItsSecondUp) {
  const auto values =
      choose_values({cosine_parameter("x", highp), cosine_parameter("y", highp), cosine_parameter("z", highp)}, ArgumentSet::Dense, 5, 3);
  ASSERT_EQ(values.size(), 15U);
  EXPECT_EQ(values[0], (std::vector<double>{0, 1, 0.6}));
  EXPECT_EQ(values[4], (std::vector<double>{1, 1, 0.6}));
  EXPECT_EQ(values[12], (std::vector<double>{0.5, 0, 0.6}));
  const auto alone = choose_values({cosine_parameter("x", highp)}, ArgumentSet::Dense, 4, 4);
  EXPECT_EQ(alone[5][0], 5.0 / 15) << "one parameter alone has all samples along its axis";
}

TEST(ChooseValues, AdversarialHoldsEveryCombinationThatThereIsRoomFor) {
  const Parameter cosine = cosine_parameter("c", highp, 0, true);
  const Parameter roughness = roughness_parameter("r", highp);
  const auto values = choose_values({cosine, roughness}, ArgumentSet::Adversarial, 32, 32);
  const std::set<std::vector<double>> different(values.begin(), values.end());
  EXPECT_EQ(different.size(), cosine.special.size() * roughness.special.size());
  for (const double c : {0.0, 1e-7, 0.5, 1.0, 1 + highp.ulp_above_1()}) {
    EXPECT_TRUE(different.contains({c, 0.0})) << c;
  }
  const auto few = choose_values({cosine, roughness}, ArgumentSet::Adversarial, 8, 8);
  const std::set<std::vector<double>> drawn(few.begin(), few.end());
  EXPECT_GT(drawn.size(), 50U) << "too many combinations are drawn from";
  for (const auto& one : drawn) {
    EXPECT_TRUE(different.contains(one));
  }
}

TEST(ChooseValues, RandomIsTheSameEveryTimeAndKeepsToTheLeast) {
  const std::vector<Parameter> two{cosine_parameter("c", highp, 1e-4), roughness_parameter("r", highp)};
  const auto values = choose_values(two, ArgumentSet::Random, 16, 16);
  EXPECT_EQ(values, choose_values(two, ArgumentSet::Random, 16, 16));
  int small = 0;
  for (const auto& one : values) {
    EXPECT_GE(one[0], 1e-4);
    EXPECT_LE(one[0], 1);
    small += one[0] < 0.01 ? 1 : 0;
  }
  EXPECT_GT(small, 50) << "half of them lie toward the small end";
  EXPECT_LT(small, 150);
}

}  // namespace
}  // namespace sheen::conformance
