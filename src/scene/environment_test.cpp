#include "scene/environment.h"

#include <cmath>

#include <gtest/gtest.h>

namespace sheen::scene {
namespace {

constexpr double pi = 3.14159265358979323846;

/// Red tells the column, green the row.
Environment ramp(int width, int height) {
  Environment e;
  e.width = width;
  e.height = height;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      e.texels.emplace_back(x, y, 1.0f);
    }
  }
  return e;
}

/// The centre of a texel, by the convention: u = 0.5 + atan2(z, x) / (2 pi), v = acos(y) / pi.
glm::dvec3 centre_of(const Environment& e, int column, int row) {
  const double azimuth = 2.0 * pi * ((column + 0.5) / e.width - 0.5);
  const double theta = pi * (row + 0.5) / e.height;
  return {std::sin(theta) * std::cos(azimuth), std::cos(theta), std::sin(theta) * std::sin(azimuth)};
}

TEST(Environment, GivesEachTexelAtItsCentre) {
  const Environment e = ramp(16, 8);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 16; ++x) {
      const glm::dvec3 radiance = e.radiance(centre_of(e, x, y));
      EXPECT_NEAR(radiance.x, x, 1e-9);
      EXPECT_NEAR(radiance.y, y, 1e-9);
    }
  }
}

TEST(Environment, PlusXIsTheMiddleAndPlusYTheTop) {
  const Environment e = ramp(16, 8);
  EXPECT_NEAR(e.radiance({1, 0, 0}).x, 7.5, 1e-9);
  EXPECT_NEAR(e.radiance({0, 0, 1}).x, 11.5, 1e-9) << "+Z a quarter further right";
  EXPECT_NEAR(e.radiance({0, 1, 0}).y, 0.0, 1e-9);
  EXPECT_NEAR(e.radiance({0, -1, 0}).y, 7.0, 1e-9);
}

TEST(Environment, IsContinuousAcrossItsSeam) {
  const Environment e = ramp(16, 8);
  const double tiny = 1e-9;
  EXPECT_NEAR(e.radiance({-1, 0, tiny}).x, 7.5, 1e-6) << "half way between the last column and the first";
  EXPECT_NEAR(e.radiance({-1, 0, -tiny}).x, 7.5, 1e-6);
}

TEST(Environment, RotationTurnsItCounterClockwiseAboutY) {
  Environment e = ramp(16, 8);
  const glm::dvec3 before = e.radiance({1, 0, 0});
  e.rotation = pi / 2.0;
  // Seen from above (+Y toward the eye, +X right, +Z down) counter-clockwise takes +X to -Z.
  EXPECT_NEAR(e.radiance({0, 0, -1}).x, before.x, 1e-9);
}

TEST(Environment, WithoutAnImageItIsUniform) {
  Environment e;
  e.uniform = {1.0, 2.0, 3.0};
  EXPECT_EQ(e.radiance({0.6, 0.0, 0.8}), glm::dvec3(1.0, 2.0, 3.0));
}

}  // namespace
}  // namespace sheen::scene
