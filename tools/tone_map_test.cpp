#include "tools/tone_map.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace sheen::tools {
namespace {

image::Image pixel(float r, float g, float b, float a) {
  image::Image image(1, 1, {"R", "G", "B", "A"});
  image.data = {r, g, b, a};
  return image;
}

TEST(KhronosPbrNeutral, BelowCompressionOnlyTheFresnelOffsetIsTaken) {
  const auto c = khronos_pbr_neutral({0.5, 0.3, 0.2});
  EXPECT_NEAR(c[0], 0.46, 1e-15);
  EXPECT_NEAR(c[1], 0.26, 1e-15);
  EXPECT_NEAR(c[2], 0.16, 1e-15);
}

TEST(KhronosPbrNeutral, DarkColoursLoseLessThanTheirSmallestChannel) {
  const auto c = khronos_pbr_neutral({0.04, 0.04, 0.04});
  EXPECT_NEAR(c[0], 6.25 * 0.04 * 0.04, 1e-15) << "x - (x - 6.25 x^2)";
  EXPECT_EQ(khronos_pbr_neutral({0.0, 0.0, 0.0})[1], 0.0);
}

TEST(KhronosPbrNeutral, IsContinuousRisesAndStaysBelowOne) {
  double before = -1.0;
  for (double x = 0.0; x < 50.0; x += 0.001) {
    const double y = khronos_pbr_neutral({x, x, x})[0];
    EXPECT_GT(y, before) << x;
    EXPECT_LT(y - before, x == 0.0 ? 2.0 : 0.0011) << "a jump at " << x;
    EXPECT_LT(y, 1.0);
    before = y;
  }
}

TEST(KhronosPbrNeutral, VeryBrightColoursTurnWhite) {
  const auto c = khronos_pbr_neutral({1e6, 1e3, 1e3});
  EXPECT_GT(c[1], 0.99);
  EXPECT_LE(c[0], 1.0);
}

TEST(ApplyDisplay, ExposureDoublesRadianceByStop) {
  image::Image image = pixel(0.1f, 0.2f, 0.3f, 1.0f);
  apply_display(image, ToneMap::None, 2.0);
  EXPECT_NEAR(image.data[0], 0.4f, 1e-7);
  EXPECT_NEAR(image.data[2], 1.2f, 1e-6);
  EXPECT_EQ(image.data[3], 1.0f);
}

TEST(ApplyDisplay, AnEdgeKeepsTheColourOfItsSurface) {
  image::Image whole = pixel(3.0f, 2.0f, 1.0f, 1.0f);
  image::Image half = pixel(1.5f, 1.0f, 0.5f, 0.5f);
  apply_display(whole, ToneMap::KhronosPbrNeutral, 0.0);
  apply_display(half, ToneMap::KhronosPbrNeutral, 0.0);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(half.at(0, 0, i), 0.5f * whole.at(0, 0, i), 1e-6);
  }
  EXPECT_EQ(half.at(0, 0, 3), 0.5f);
}

}  // namespace
}  // namespace sheen::tools
