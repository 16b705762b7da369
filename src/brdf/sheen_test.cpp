#include "brdf/sheen.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "brdf/albedo_scaling.h"

namespace sheen::brdf {
namespace {

// Half vector of two unit vectors with the given cosines to N and azimuth between them.
struct Half {
  double n_dot_h, sin2_theta_h;
  Half(double n_dot_v, double n_dot_l, double azimuth) {
    const double sin_v = std::sqrt(1 - n_dot_v * n_dot_v), sin_l = std::sqrt(1 - n_dot_l * n_dot_l);
    const double x = sin_v + sin_l * std::cos(azimuth), y = sin_l * std::sin(azimuth), z = n_dot_v + n_dot_l;
    const double length2 = x * x + y * y + z * z;
    n_dot_h = z / std::sqrt(length2);
    sin2_theta_h = (x * x + y * y) / length2;
  }
};

double lobe(Visibility visibility, double r, double n_dot_v, double n_dot_l, double azimuth) {
  const Half h(n_dot_v, n_dot_l, azimuth);
  return SheenLobe<double>(visibility, r, n_dot_v).value_times_n_dot_l(n_dot_l, h.n_dot_h, h.sin2_theta_h);
}

// The specification's printed shader code, in long double, letter by letter: the truth the stable form must meet.
long double printed(double r, double n_dot_v, double n_dot_l, double n_dot_h) {
  const long double alpha_g = static_cast<long double>(r) * r;
  const auto l = [alpha_g](long double x) {
    const long double one_minus_alpha_sq = (1.0L - alpha_g) * (1.0L - alpha_g);
    const auto mix = [one_minus_alpha_sq](long double p, long double q) { return p * (1 - one_minus_alpha_sq) + q * one_minus_alpha_sq; };
    const long double a = mix(21.5473L, 25.3245L), b = mix(3.82987L, 3.32435L), c = mix(0.19823L, 0.16801L);
    const long double d = mix(-1.97760L, -1.27393L), e = mix(-4.32054L, -4.85967L);
    return a / (1.0L + b * std::pow(x, c)) + d * x + e;
  };
  const auto lambda = [&l](long double x) { return std::fabs(x) < 0.5L ? std::exp(l(x)) : std::exp(2.0L * l(0.5L) - l(1.0L - x)); };
  const long double sin2h = 1 - static_cast<long double>(n_dot_h) * n_dot_h;
  const long double pi_l = std::acos(-1.0L);
  const long double distribution = (2 + 1 / alpha_g) * std::pow(sin2h, 0.5L / alpha_g) / (2 * pi_l);
  const long double visibility = 1 / ((1 + lambda(n_dot_v) + lambda(n_dot_l)) * (4.0L * n_dot_v * n_dot_l));
  return distribution * visibility * n_dot_l;
}

TEST(SheenLobe, MeetsTheIndependentlyComputedValue) {
  // Long double, computed apart; a wrong power of r, a missing square in Lambda or the other visibility change it by 16 to 78 %.
  EXPECT_NEAR(lobe(Visibility::Charlie, 0.5, 0.5, 0.6, 0.5), 0.06618617242, 5e-12);
}

TEST(SheenLobe, CharlieMeetsThePrintedCodeWhereThatIsWellConditioned) {
  for (double r : {0.05, 0.2, 0.5, 0.8, 1.0}) {
    for (double n_dot_v : {0.05, 0.3, 0.49, 0.51, 0.9}) {
      for (double n_dot_l : {0.02, 0.45, 0.55, 0.95}) {
        for (double azimuth : {0.0, 1.0, 3.0}) {
          const double expected = static_cast<double>(printed(r, n_dot_v, n_dot_l, Half(n_dot_v, n_dot_l, azimuth).n_dot_h));
          EXPECT_NEAR(lobe(Visibility::Charlie, r, n_dot_v, n_dot_l, azimuth), expected, 1e-11 * expected)
              << "sheen_roughness " << r << " n_dot_v " << n_dot_v << " n_dot_l " << n_dot_l << " azimuth " << azimuth;
        }
      }
    }
  }
}

TEST(SheenLobe, IsReciprocal) {
  for (Visibility visibility : visibilities) {
    const double forth = lobe(visibility, 0.4, 0.3, 0.8, 0.7) / 0.8, back = lobe(visibility, 0.4, 0.8, 0.3, 0.7) / 0.3;
    EXPECT_NEAR(forth, back, 1e-14 * forth);
  }
}

TEST(SheenLobe, IsFiniteWhereTheLightGrazes) {
  for (Visibility visibility : visibilities) {
    const double value = lobe(visibility, 0.5, 0.4, 0.0, 0.3);
    EXPECT_TRUE(std::isfinite(value));
    EXPECT_GE(value, 0);
  }
}

TEST(SheenLobe, VanishesAtItsDefaultRoughness) {
  for (Visibility visibility : visibilities) {
    EXPECT_EQ(lobe(visibility, 0.0, 0.5, 0.6, 0.5), 0) << "the printed code gives NaN here";
    EXPECT_EQ(lobe(visibility, 1e-200, 0.5, 0.6, 0.5), 0) << "alpha_g underflows";
  }
}

TEST(CharlieDistribution, ProjectsToUnitArea) {
  // The integral of D(H) (N.H) over the hemisphere is 1: substituting s = sin^2, it is (1 + p) times the integral of s^p ds.
  for (double alpha_g : {0.01, 0.25, 1.0}) {
    const int steps = 200000;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
      const double s = (i + 0.5) / steps;
      sum += charlie_distribution(alpha_g, std::sqrt(1 - s), s) * pi / steps;  // d omega (N.H) = pi ds
    }
    EXPECT_NEAR(sum, 1, 1e-6) << "alpha_g " << alpha_g;
  }
}

TEST(CharlieDistribution, KeepsItsDigitsAtGrazingHalfVectorsAndTinyRoughness) {
  // ln D = p log1p(-cos^2): for cos = 1e-5, r = 1e-3 the sine is 1 - 5e-11 and the exponent 5e5.
  const double expected = (1 + 5e5) / pi * std::exp(5e5 * std::log1p(-1e-10));
  EXPECT_NEAR(charlie_distribution(1e-6, 1e-5, 1 - 1e-10), expected, 1e-13 * expected);
}

TEST(LambdaCurve, MeetsItselfWhereTheBranchesJoin) {
  for (double alpha_g : {0.0, 0.25, 1.0}) {
    for (const auto& curve : {charlie_lambda_curve(alpha_g), refined_lambda_curve(alpha_g)}) {
      const double below = curve.lambda(std::nextafter(0.5, 0.0)), above = curve.lambda(0.5);
      EXPECT_NEAR(below, above, 1e-13 * above) << "alpha_g " << alpha_g;
    }
  }
}

TEST(LambdaCurve, MirrorsItsLogarithmAboutOneHalf) {
  // ln Lambda(x) + ln Lambda(1 - x) = 2 l(0.5): a Lambda of one branch only breaks this by up to 29 %.
  const auto curve = charlie_lambda_curve(0.25);
  EXPECT_NEAR(std::log(curve.lambda(0.1)) + std::log(curve.lambda(0.9)), 2 * curve.l(0.5), 1e-12);
}

TEST(AshikhminVisibility, IsOneQuarterWhereEitherDirectionIsTheNormal) {
  EXPECT_DOUBLE_EQ(ashikhmin_visibility(1.0, 0.3), 0.25);
  EXPECT_DOUBLE_EQ(ashikhmin_visibility(0.3, 1.0), 0.25);
}

TEST(AlbedoScale, TakesTheLessOfTheTwoDirections) {
  EXPECT_DOUBLE_EQ(albedo_scale(AlbedoScaling::Full, 0.5, 0.2, 0.6), 0.7);
  EXPECT_DOUBLE_EQ(albedo_scale(AlbedoScaling::Full, 0.5, 0.6, 0.2), 0.7);
  EXPECT_DOUBLE_EQ(albedo_scale(AlbedoScaling::View, 0.5, 0.2, 0.6), 0.9);
  EXPECT_EQ(albedo_scale(AlbedoScaling::None, 0.5, 0.2, 0.6), 1);
}

TEST(AlbedoScale, IsClampedUnlessLiteral) {
  EXPECT_EQ(albedo_scale(AlbedoScaling::Full, 1.0, 3.0, 0.1), 0);
  EXPECT_EQ(albedo_scale(AlbedoScaling::View, 1.0, 3.0, 0.1), 0);
  EXPECT_DOUBLE_EQ(albedo_scale(AlbedoScaling::Literal, 1.0, 3.0, 0.1), -2);
}

TEST(AlbedoScale, OfTwoLookupsIsBitwiseThatOfTheLargerOne) {
  // Rounding is monotone, so min(1 - c A, 1 - c B) and 1 - c max(A, B) are the same number: one lookup may serve for two.
  for (int i = 0; i < 1000; ++i) {
    const float c = 0.001f * static_cast<float>(i), a = 0.37f + 0.0007f * static_cast<float>(i % 91), b = 0.4f;
    EXPECT_EQ(std::min(1 - c * a, 1 - c * b), 1 - c * std::max(a, b));
  }
}

}  // namespace
}  // namespace sheen::brdf
