#include "albedo/table.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "albedo/directional_albedo.h"

namespace sheen::albedo {
namespace {

TEST(Table, ReadsWithinItsErrorForEveryCosineAndRoughness) {
  std::mt19937 generator(13);
  std::uniform_real_distribution<double> unit(0, 1);
  for (Visibility visibility : {Visibility::Charlie, Visibility::Ashikhmin, Visibility::Refined}) {
    const Table table = build_table(visibility);
    ASSERT_EQ(table.values.size(), static_cast<std::size_t>(Table::width * Table::height));
    for (float value : table.values) {
      ASSERT_TRUE(std::isfinite(value));
    }
    for (int i = 0; i < 1500; ++i) {
      const double mu = i % 2 == 0 ? std::max(min_n_dot_v, unit(generator)) : std::exp(std::log(min_n_dot_v) * unit(generator));
      const double r = i % 3 == 0 ? unit(generator) : std::exp(std::log(2e-6) * unit(generator));
      const double e = directional_albedo(visibility, mu, r);
      EXPECT_NEAR(lookup(table, mu, r), e, 2e-5 * std::max(e, 1.0)) << "n_dot_v " << mu << " sheen_roughness " << r;
    }
    EXPECT_NEAR(lookup(table, 1, 1), directional_albedo(visibility, 1, 1), 2e-6) << "the corner";
    EXPECT_EQ(lookup(table, 0.5, 0), 0);
  }
}

}  // namespace
}  // namespace sheen::albedo
