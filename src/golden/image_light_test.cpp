#include "golden/image_light.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "golden/environment_light.h"

namespace sheen::golden {
namespace {

scene::Environment rough_image(int width, int height) {
  scene::Environment e;
  e.width = width;
  e.height = height;
  e.rotation = 0.9;
  for (int i = 0; i < width * height; ++i) {
    const auto f = static_cast<float>(i);
    e.texels.emplace_back(std::abs(std::sin(f * 12.9F)), std::abs(std::sin(f * 7.3F)), 0.0F);
  }
  return e;
}

TEST(ImageLight, LooksUpWhatTheEnvironmentSays) {
  const scene::Environment e = rough_image(8, 4);
  const ImageLight light(e.width, e.height, e.texels, e.rotation);
  for (int i = 0; i < 2000; ++i) {
    const double y = 1.0 - 2.0 * (i + 0.5) / 2000;
    const double azimuth = 2.4 * i;
    const double sine = std::sqrt(1.0 - y * y);
    const Vec3<double> d{sine * std::cos(azimuth), y, sine * std::sin(azimuth)};
    const Arrived<double> arrived = look_up(light.texels(), ImagePlace<double>(light.texels(), d));
    const glm::dvec3 expected = e.radiance({d.x, d.y, d.z});
    ASSERT_NEAR(arrived.radiance.r, expected.x, 1e-9);
    ASSERT_NEAR(arrived.radiance.g, expected.y, 1e-9);
  }
}

TEST(ImageLight, SeesThePoles) {
  const scene::Environment e = rough_image(8, 4);
  const ImageLight light(e.width, e.height, e.texels, e.rotation);
  for (const double y : {-1.0, 1.0}) {
    const Arrived<double> arrived = look_up(light.texels(), ImagePlace<double>(light.texels(), {0.0, y, 0.0}));
    EXPECT_NEAR(arrived.radiance.r, e.radiance({0.0, y, 0.0}).x, 1e-9);
  }
}

// Shares of 12 x 24 cells, three to a texel's half: poles and seam included.
TEST(ImageLight, DrawsInProportionToItsDensity) {
  const scene::Environment e = rough_image(8, 4);
  const ImageLight light(e.width, e.height, e.texels, e.rotation);
  constexpr int rows = 12;
  constexpr int columns = 24;
  constexpr int n = 1000;
  std::vector<double> drawn(rows * columns);
  const auto cell = [&](const glm::dvec2& uv) {
    return static_cast<std::size_t>(std::min(static_cast<int>(uv.y * rows), rows - 1) * columns +
                                    std::min(static_cast<int>(uv.x * columns), columns - 1));
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const LightPoint p = light.sample((i + 0.5) / n, (j + 0.5) / n);
      drawn[cell(e.coordinates({p.x, p.y, p.z}))] += 1.0 / (n * n);
      ASSERT_GT(p.density, 0.0);
    }
  }
  std::vector<double> expected(rows * columns);
  constexpr int fine_rows = 600;
  constexpr int fine_columns = 1200;
  double total = 0.0;
  for (int i = 0; i < fine_rows; ++i) {
    for (int j = 0; j < fine_columns; ++j) {
      const glm::dvec2 uv((j + 0.5) / fine_columns, (i + 0.5) / fine_rows);
      const glm::dvec3 d = e.direction(uv);
      const Arrived<double> arrived = look_up(light.texels(), ImagePlace<double>(light.texels(), {d.x, d.y, d.z}));
      const double solid_angle = 2.0 * brdf::pi * brdf::pi * std::sin(brdf::pi * uv.y) / (1.0 * fine_rows * fine_columns);
      expected[cell(uv)] += arrived.density * solid_angle;
      total += arrived.density * solid_angle;
    }
  }
  EXPECT_NEAR(total, 1.0, 1e-5);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    EXPECT_NEAR(drawn[i], expected[i], 2e-4) << i;
  }
}

TEST(EnvironmentLight, ItsPartsAddUpToTheImage) {
  scene::Environment e = rough_image(64, 32);
  e.texels[9 * 64 + 37] = {1e5F, 9e4F, 8e4F};
  const EnvironmentLight light(e);
  ASSERT_FALSE(light.bright().dark());
  const ImageTexels& bright = light.bright().texels();
  EXPECT_EQ(bright.first_row, 9);
  EXPECT_EQ(bright.last_column, 37);
  for (const glm::dvec2 uv : {glm::dvec2(37.4 / 64, 9.7 / 32), {37.9 / 64, 8.7 / 32}, {0.1, 0.9}, {0.999, 0.001}}) {
    const glm::dvec3 d = e.direction(uv);
    const ImagePlace<double> place(bright, {d.x, d.y, d.z});
    const double sum = look_up(light.soft().texels(), place).radiance.g + look_up(bright, place).radiance.g;
    EXPECT_NEAR(sum, e.radiance(d).y, 1e-6 * sum);
  }
  const glm::dvec3 sun = e.direction({37.5 / 64, 9.5 / 32});
  EXPECT_TRUE(light.bright_below({-sun.x, -sun.y, -sun.z}));
  EXPECT_FALSE(light.bright_below({sun.x, sun.y, sun.z}));
}

TEST(EnvironmentLight, ALampAcrossTheSeamIsFound) {
  scene::Environment e = rough_image(64, 32);
  e.texels[16 * 64] = e.texels[16 * 64 + 63] = {5e4F, 5e4F, 5e4F};
  const EnvironmentLight light(e);
  const glm::dvec3 d = e.direction({0.0, 16.5 / 32});
  EXPECT_FALSE(light.bright_below({d.x, d.y, d.z}));
  EXPECT_TRUE(light.bright_below({-d.x, -d.y, -d.z}));
  const ImageTexels& bright = light.bright().texels();
  EXPECT_GT(look_up(bright, ImagePlace<double>(bright, {d.x, d.y, d.z})).radiance.r, 4e4);
}

}  // namespace
}  // namespace sheen::golden
