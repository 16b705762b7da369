#include "brdf/clearcoat.h"

#include <cmath>

#include <gtest/gtest.h>

namespace sheen::brdf {
namespace {

TEST(Clearcoat, WeighsFourPercentAtNormalIncidenceAndItsFactorAtGrazing) {
  EXPECT_DOUBLE_EQ(clearcoat_weight(0.5, 1.0), 0.02);
  EXPECT_DOUBLE_EQ(clearcoat_weight(0.5, 0.0), 0.5);
  EXPECT_DOUBLE_EQ(clearcoat_weight(1.0, std::nextafter(1.0, 2.0)), 0.04) << "an ulp above 1 is 1";
}

TEST(Clearcoat, FresnelIsSchlickOfTheViewAngle) {
  EXPECT_NEAR(clearcoat_weight(1.0, 0.3), 0.04 + 0.96 * std::pow(0.7, 5), 1e-15);
}

TEST(Clearcoat, LobeIsGgxWithSmithVisibility) {
  const double lobe = ClearcoatLobe<double>(0.09, 0.7).value(0.6, 0.9, 0.19);
  EXPECT_DOUBLE_EQ(lobe, ggx_distribution(0.09, 0.9, 0.19) * smith_visibility(0.09, 0.6, 0.7));
  EXPECT_EQ(ClearcoatLobe<double>(0.0, 0.7).value(0.6, 1.0, 0.0), 0) << "roughness 0, the default, gives punctual lights no highlight";
}

}  // namespace
}  // namespace sheen::brdf
