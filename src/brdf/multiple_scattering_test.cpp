#include "brdf/multiple_scattering.h"

#include <cmath>

#include <gtest/gtest.h>

#include "brdf/draft_sheen.h"
#include "brdf/fresnel.h"

namespace sheen::brdf {
namespace {

TEST(AverageFresnel, IsSchlicksTermOverTheHemisphere) {
  for (const double f0 : {0.0, 0.04, 0.6, 1.0}) {
    const int steps = 2000;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
      const double mu = (i + 0.5) / steps;
      sum += 2 * mu * (f0 + (1 - f0) * schlick_weight(mu)) / steps;
    }
    EXPECT_NEAR(average_fresnel(f0), sum, 1e-6) << f0;
  }
}

// F_avg E_avg leaves after one bounce; each further one reflects F_avg of what stays, 1 - E_avg, and lets E_avg of it out.
TEST(MultipleScattering, FresnelFactorSumsTheBouncesFromTheSecondOn) {
  for (const double fresnel : {0.2, 0.7, 0.95}) {
    for (const double loss : {0.01, 0.3, 0.59}) {
      double sum = 0;
      double inside = fresnel * loss;
      for (int bounce = 2; bounce < 400; ++bounce) {
        sum += inside * fresnel * (1 - loss);
        inside *= fresnel * loss;
      }
      EXPECT_NEAR(multiple_scattering_fresnel(fresnel, loss), sum / loss, 1e-12) << fresnel << ' ' << loss;
    }
  }
  EXPECT_EQ(multiple_scattering_fresnel(1.0, 0.3), 1) << "a white metal keeps nothing";
  EXPECT_EQ(multiple_scattering_fresnel(1.7, 0.59), 1) << "nor does one that is whiter than white";
}

TEST(MultipleScattering, LobeIsReciprocalAndNothingOfAMirror) {
  EXPECT_EQ(multiple_scattering_lobe(0.3, 0.1, 0.2), multiple_scattering_lobe(0.1, 0.3, 0.2));
  EXPECT_EQ(multiple_scattering_lobe(0.0, 0.0, 0.0), 0);
}

TEST(DraftSheen, IsPiTimesWhatTheBaseDoesNotReflectOfTheColor) {
  const Rgb<double> sheen{0.5, 1.0, 0.25}, base{0.2, 0.8, 0.4};
  EXPECT_NEAR(draft_sheen_color(sheen, base, 0.0).g, 0.96 * pi, 1e-15);
  EXPECT_NEAR(draft_sheen_color(sheen, base, 1.0).r, 0.5 * 0.2 * pi, 1e-15);
  EXPECT_NEAR(draft_sheen_color(sheen, base, 0.5).b, 0.25 * 0.58 * pi, 1e-15);
  EXPECT_EQ(draft_sheen_color(sheen, {1.5, 0.0, 0.0}, 1.0).g, 0) << "no sheen over more than all";
}

}  // namespace
}  // namespace sheen::brdf
