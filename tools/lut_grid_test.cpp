#include "tools/lut_grid.h"

#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

namespace sheen::tools {
namespace {

using albedo::Visibility;

TEST(LutGrid, PlainTableSamplesTexelCentresWithTheCosineAlongTheRow) {
  const LutGrid grid = lut_grid(Visibility::Ashikhmin, LutLayout::Plain, 4);
  ASSERT_EQ(grid.directional_albedo.size(), 16U);
  EXPECT_EQ(grid.n_dot_v[0], 0.125);
  EXPECT_EQ(grid.n_dot_v[3], 0.875);
  EXPECT_EQ(grid.n_dot_v[4], 0.125);
  EXPECT_EQ(grid.sheen_roughness[3], 0.125);
  EXPECT_EQ(grid.sheen_roughness[15], 0.875);
}

TEST(LutGrid, WarpedNodesSatisfyTheirEquationAndReachTheCorners) {
  const int size = 9;
  const LutGrid grid = lut_grid(Visibility::Ashikhmin, LutLayout::Warped, size);
  for (int row = 0; row < size; ++row) {
    for (int column = 0; column < size; ++column) {
      const auto i = static_cast<std::size_t>(row * size + column);
      const double r = grid.sheen_roughness[i];
      const double mu = grid.n_dot_v[i];
      EXPECT_NEAR(r, 0.02 + 0.98 * row / 8.0, 1e-15);
      if (column == 0) {
        EXPECT_EQ(mu, albedo::min_n_dot_v);
      } else {
        EXPECT_NEAR(mu * (1.0 + r) / (mu + r), column / 8.0, 1e-14);
      }
    }
  }
  EXPECT_EQ(grid.n_dot_v[80], 1.0);
  EXPECT_EQ(grid.sheen_roughness[80], 1.0);
}

TEST(LutGrid, AshikhminAtNormalIncidenceMeetsItsClosedForm) {
  const int size = 5;
  const LutGrid grid = lut_grid(Visibility::Ashikhmin, LutLayout::Warped, size);
  for (std::size_t i = 4; i < 25; i += 5) {
    const double p = 0.5 / (grid.sheen_roughness[i] * grid.sheen_roughness[i]);
    EXPECT_NEAR(grid.directional_albedo[i], std::exp2(-(p + 1.0)) / (p + 2.0), 1e-9) << grid.sheen_roughness[i];
  }
}

TEST(LutGrid, WarpedTableStoresAlbedoTimesRoughness) {
  const LutGrid grid = lut_grid(Visibility::Charlie, LutLayout::Warped, 3);
  const std::vector<double> stored = stored_values(LutLayout::Warped, grid);
  EXPECT_DOUBLE_EQ(stored[4], grid.directional_albedo[4] * grid.sheen_roughness[4]);
  EXPECT_EQ(stored_values(LutLayout::Plain, grid), grid.directional_albedo);
}

}  // namespace
}  // namespace sheen::tools
