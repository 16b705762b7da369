#include "brdf/base.h"

#include <cmath>

#include <gtest/gtest.h>

#include "brdf/physical_base.h"

namespace sheen::brdf {
namespace {

TEST(Ggx, MeetsThePrintedFormWhereThatIsWellConditioned) {
  for (double alpha : {0.1, 0.5, 1.0}) {
    for (double n_dot_h : {0.1, 0.6, 0.95}) {
      const double t = n_dot_h * n_dot_h * (alpha * alpha - 1) + 1;
      const double expected = alpha * alpha / (pi * t * t);
      EXPECT_NEAR(ggx_distribution(alpha, n_dot_h, 1 - n_dot_h * n_dot_h), expected, 1e-12 * expected);
    }
  }
}

TEST(Ggx, ProjectsToUnitArea) {
  for (double alpha : {0.05, 0.3, 1.0}) {
    const int steps = 400000;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
      const double s = (i + 0.5) / steps;
      sum += ggx_distribution(alpha, std::sqrt(1 - s), s) * pi / steps;
    }
    EXPECT_NEAR(sum, 1, 1e-4) << "alpha " << alpha;
  }
}

TEST(Ggx, GivesAMirrorNoHighlightFromAPunctualLight) {
  EXPECT_EQ(ggx_distribution(0.0, 1.0, 0.0), 0) << "0/0 as printed";
  EXPECT_EQ(ggx_distribution(0.0, 0.9, 0.19), 0);
}

TEST(Smith, IsReciprocalAndTendsToNoShadowingAtNormalIncidence) {
  EXPECT_DOUBLE_EQ(smith_visibility(0.3, 0.2, 0.7), smith_visibility(0.3, 0.7, 0.2));
  EXPECT_DOUBLE_EQ(smith_visibility(0.3, 1.0, 1.0), 0.25);
}

TEST(Smith, HeightCorrelationMeetsHeitzEquation99) {
  // G = 1 / (1 + Lambda_v + Lambda_l), Lambda = (sqrt(1 + alpha^2 tan^2) - 1) / 2.
  const double alpha = 0.4, l = 0.35, v = 0.8;
  const auto lambda = [alpha](double mu) { return (std::sqrt(1 + alpha * alpha * (1 - mu * mu) / (mu * mu)) - 1) / 2; };
  EXPECT_NEAR(smith_visibility(alpha, l, v), 1 / (1 + lambda(v) + lambda(l)) / (4 * l * v), 1e-13);
}

TEST(Schlick, WeighsACosineAnUlpAboveOneAsOne) {
  EXPECT_EQ(schlick_weight(std::nextafter(1.0, 2.0)), 0);
}

TEST(F0, OfIorOneAndAHalfIsFourPercentAndOfZeroIsOne) {
  EXPECT_NEAR(f0_from_ior(1.5), 0.04, 1e-16);
  EXPECT_EQ(f0_from_ior(0.0), 1);
}

Base<double> base_of(double metallic) {
  return {{0.8, 0.4, 0.1}, metallic, 0.25, dielectric_f0(1.5, Rgb<double>{1, 1, 1}), 1.0};
}

TEST(Base, MixesTwoBrdfsAndNotTwoF0) {
  const double l = 0.6, v = 0.7, h = 0.9, vh = 0.75;
  const auto at = [&](double metallic) { return base_brdf(base_of(metallic), l, v, h, 1 - h * h, vh); };
  const auto dielectric = at(0), metal = at(1), mixed = at(0.3);
  EXPECT_NEAR(mixed.r, 0.7 * dielectric.r + 0.3 * metal.r, 1e-15);
  EXPECT_NEAR(mixed.b, 0.7 * dielectric.b + 0.3 * metal.b, 1e-15);
}

TEST(Base, DielectricSplitsLightBetweenDiffuseAndSpecular) {
  const double l = 0.6, v = 0.7, h = 0.9, vh = 0.75;
  const double w = std::pow(1 - vh, 5), fresnel = 0.04 + 0.96 * w;
  const double lobe = ggx_distribution(0.25, h, 1 - h * h) * smith_visibility(0.25, l, v);
  const auto value = base_brdf(base_of(0), l, v, h, 1 - h * h, vh);
  EXPECT_NEAR(value.g, (1 - fresnel) * 0.4 / pi + fresnel * lobe, 1e-14);
  const auto metal = base_brdf(base_of(1), l, v, h, 1 - h * h, vh);
  EXPECT_NEAR(metal.g, (0.4 + 0.6 * w) * lobe, 1e-14);
}

TEST(Base, TakesTheCosineIntoEachTermOrAfterwards) {
  const double l = 0.6, v = 0.7, h = 0.9, vh = 0.75;
  for (const double metallic : {0.0, 0.3, 1.0}) {
    const BaseLayer<double> layer(base_of(metallic), v);
    const auto apart = layer.brdf(l, h, 1 - h * h, vh) * l;
    const auto within = layer.brdf_times_n_dot_l(l, h, 1 - h * h, vh);
    EXPECT_NEAR(within.r, apart.r, 1e-15);
    EXPECT_NEAR(within.b, apart.b, 1e-15);
    const LobeAlbedo<double> light{0.1, 0.03}, view{0.08, 0.02}, average{0.09, 0.025};
    const PhysicalBase<double> physical(base_of(metallic), view, average);
    const auto physical_apart = physical.brdf(light, l, v, h, 1 - h * h, vh) * l;
    const auto physical_within = physical.brdf_times_n_dot_l(light, l, v, h, 1 - h * h, vh);
    EXPECT_NEAR(physical_within.r, physical_apart.r, 1e-15);
    EXPECT_NEAR(physical_within.b, physical_apart.b, 1e-15);
  }
}

TEST(Base, WithoutSpecularIsLambertian) {
  Base<double> base = base_of(0);
  base.specular = 0;
  const auto value = base_brdf(base, 0.6, 0.7, 0.9, 0.19, 0.75);
  EXPECT_DOUBLE_EQ(value.r, 0.8 / pi);
  EXPECT_DOUBLE_EQ(value.b, 0.1 / pi);
}

TEST(Base, DiffuseGivesWayToTheLargestSpecularChannel) {
  Base<double> base = base_of(0);
  base.dielectric_f0 = dielectric_f0(1.5, Rgb<double>{1, 10, 100});
  EXPECT_EQ(base.dielectric_f0.b, 1) << "f0 is capped at 1";
  base.alpha = 0;
  const auto value = base_brdf(base, 0.6, 0.7, 0.9, 0.19, 0.75);
  EXPECT_NEAR(value.r, 0, 1e-16) << "1 - max3(fr) leaves nothing";
}

}  // namespace
}  // namespace sheen::brdf
