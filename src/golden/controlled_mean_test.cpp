#include "golden/controlled_mean.h"

#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace sheen::golden {
namespace {

using Pair = ControlledMean::Pair;

TEST(ControlledMean, AControlThatTellsAllLeavesNoError) {
  const std::array<Pair, 4> replicas{{{5.0, 1.0}, {7.0, 2.0}, {9.0, 3.0}, {13.0, 5.0}}};  // 3 + 2 x
  const ControlledMean mean(replicas, 10.0);
  EXPECT_NEAR(mean.value, 23.0, 1e-12);
  EXPECT_NEAR(mean.standard_error, 0.0, 1e-6);
}

TEST(ControlledMean, AControlThatNeverVariesChangesNothing) {
  const std::array<Pair, 4> replicas{{{1.0, 2.0}, {2.0, 2.0}, {3.0, 2.0}, {6.0, 2.0}}};
  const ControlledMean mean(replicas, 100.0);
  EXPECT_EQ(mean.value, 3.0);
  EXPECT_NEAR(mean.standard_error, std::sqrt(14.0 / 2.0 / 4.0), 1e-12);
}

// The mean of y is 2 x + noise of deviation 1; what the control explains is 80 % of its variance. Student's limits of 14 degrees of freedom
// hold the truth as often as they say.
TEST(ControlledMean, ItsErrorHoldsTheTruthAsOftenAsStudentSays) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  constexpr int runs = 20000;
  constexpr double quantile_95 = 2.145;
  int held = 0;
  double squares = 0.0;
  for (int run = 0; run < runs; ++run) {
    std::array<Pair, 16> replicas;
    for (Pair& p : replicas) {
      p.control = normal(random) + 4.0;
      p.value = 10.0 + 2.0 * (p.control - 4.0) + normal(random);
    }
    const ControlledMean mean(replicas, 4.0);
    held += std::abs(mean.value - 10.0) < quantile_95 * mean.standard_error ? 1 : 0;
    squares += (mean.value - 10.0) * (mean.value - 10.0) / runs;
  }
  EXPECT_NEAR(held / (1.0 * runs), 0.95, 4.0 * std::sqrt(0.95 * 0.05 / runs));
  // Without the control: 5/16. With it: 1/16 and what finding the slope costs.
  EXPECT_NEAR(squares, (1.0 / 16.0) * (1.0 + 1.0 / 13.0), 0.003);
}

}  // namespace
}  // namespace sheen::golden
