#include "brdf/printed.h"

#include <cmath>

#include <gtest/gtest.h>

#include "brdf/ashikhmin.h"
#include "brdf/fresnel.h"
#include "brdf/ggx.h"

namespace sheen::brdf {
namespace {

constexpr double shares[] = {0.02, 0.3, 0.5, 0.71, 0.96};

TEST(Printed, DistributionsAreTheStableOnesInExactArithmetic) {
  for (const double r : shares) {
    for (const double n_dot_h : shares) {
      const double sin2 = (1 - n_dot_h) * (1 + n_dot_h);
      const double sheen = charlie_distribution(r * r, n_dot_h, sin2);
      // The exponent 1 / (2 r^2), up to 1250 here, magnifies what "1 - cos2h" loses in double.
      EXPECT_NEAR(printed::sheen_distribution(r, n_dot_h), sheen, 1e-12 * sheen) << r << " " << n_dot_h;
      const double ggx = ggx_distribution(r, n_dot_h, sin2);
      EXPECT_NEAR(printed::ggx_distribution(r, n_dot_h), ggx, 1e-12 * ggx) << r << " " << n_dot_h;
    }
  }
}

TEST(Printed, VisibilitiesTimesTheCosineAreTheFoldedOnes) {
  for (const double n_dot_v : shares) {
    for (const double n_dot_l : shares) {
      const auto curve = charlie_lambda_curve(0.2);
      const double lambda_v = curve.lambda(n_dot_v);
      const double lambda_l = curve.lambda(n_dot_l);
      const double folded = charlie_visibility_times_n_dot_l(lambda_v, lambda_l, n_dot_v);
      EXPECT_NEAR(printed::sheen_visibility(lambda_v, lambda_l, n_dot_v, n_dot_l) * n_dot_l, folded, 1e-14 * folded);
      EXPECT_NEAR(printed::sheen_visibility_ashikhmin(n_dot_l, n_dot_v), ashikhmin_visibility(n_dot_l, n_dot_v), 1e-13);
      EXPECT_NEAR(printed::smith_visibility(0.2, n_dot_l, n_dot_v), smith_visibility(0.2, n_dot_l, n_dot_v), 1e-13);
    }
    EXPECT_NEAR(printed::schlick_weight(n_dot_v), schlick_weight(n_dot_v), 1e-15);
  }
}

TEST(Printed, FailsWhereTheStableFormHasALimit) {
  EXPECT_TRUE(std::isnan(printed::sheen_distribution(0.0, 0.5))) << "infinity times 0";
  EXPECT_EQ(charlie_distribution(0.0, 0.5, 0.75), 0);
  EXPECT_TRUE(std::isnan(printed::sheen_distribution(0.6, 1 + 1e-7))) << "a power of a negative number";
  EXPECT_TRUE(std::isnan(printed::sheen_visibility(1.0, 2.0, 0.5, 0.0) * 0)) << "infinity times 0";
  EXPECT_EQ(charlie_visibility_times_n_dot_l(1.0, 2.0, 0.5), 0.125);
}

}  // namespace
}  // namespace sheen::brdf
