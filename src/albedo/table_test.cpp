#include "albedo/table.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "albedo/coordinates.h"
#include "albedo/directional_albedo.h"
#include "albedo/lookup_error.h"

namespace sheen::albedo {
namespace {

TEST(Table, ReadsWithinItsErrorForEveryCosineAndRoughness) {
  std::mt19937 generator(13);
  std::uniform_real_distribution<double> unit(0, 1);
  for (Visibility visibility : brdf::visibilities) {
    const Table table = build_table(visibility);
    ASSERT_EQ(table.values.size(), static_cast<std::size_t>(Table::width * Table::height));
    for (float value : table.values) {
      ASSERT_TRUE(std::isfinite(value));
    }
    for (int i = 0; i < 1500; ++i) {
      const double mu = i % 2 == 0 ? std::max(min_n_dot_v, unit(generator)) : std::exp(std::log(min_n_dot_v) * unit(generator));
      const double r = i % 3 == 0 ? unit(generator) : std::exp(std::log(2e-6) * unit(generator));
      const double e = directional_albedo(visibility, mu, r);
      EXPECT_NEAR(lookup(table, mu, r), e, interpolation_error * std::max(e, 1.0)) << "n_dot_v " << mu << " sheen_roughness " << r;
    }
    EXPECT_NEAR(lookup(table, 1, 1), directional_albedo(visibility, 1, 1), 2e-6) << "the corner";
    EXPECT_EQ(lookup(table, 0.5, 0), 0);
  }
}

// lookup_error() stands on these.
TEST(Table, HasNoSteepSteps) {
  for (Visibility visibility : brdf::visibilities) {
    const Table table = build_table(visibility);
    const auto at = [&table](int column, int row) { return table.values[static_cast<std::size_t>(row * Table::width + column)]; };
    for (double r = 1; r > Table::min_roughness; r *= 0.99) {
      const int row = static_cast<int>((Table::density * (1 - r) - std::log(r)) / Table::step_y);
      for (int column = 0; column < Table::width - 2; ++column) {
        if (log_peak_drop(std::exp(-column * Table::step_x), r) < 25) {
          EXPECT_LT(std::abs(at(column, row)), Table::largest_value) << column << ' ' << row;
          EXPECT_LT(std::abs(at(column + 1, row) - at(column, row)), Table::largest_column_step) << column << ' ' << row;
          EXPECT_LT(std::abs(at(column, row + 1) - at(column, row)), Table::largest_row_step) << column << ' ' << row;
        }
      }
    }
  }
}

// The shader's way in 32-bit floats, each operation rounded to nearest.
TEST(Table, ALookUpInFloatsStaysWithinLookupError) {
  std::mt19937 generator(29);
  std::uniform_real_distribution<float> unit(0, 1);
  const Table table = build_table(Visibility::Charlie);
  double closest = 0;
  for (int i = 0; i < 20000; ++i) {
    const float mu = i % 2 == 0 ? std::max(1e-4F, unit(generator)) : std::exp(std::log(1e-4F) * unit(generator));
    const float r = i % 3 == 0 ? unit(generator) : std::exp(std::log(2e-6F) * unit(generator));
    if (r <= static_cast<float>(Table::min_roughness)) {
      continue;
    }
    const float t = mu / (1 + std::sqrt((1 - mu) * (1 + mu)));
    const float drop = 0.5F / (r * r) * std::log1p(t * t);
    const double exact_drop = log_peak_drop(half_elevation_tangent(mu), r);
    const double e = std::exp(log_directional_albedo_fast(Visibility::Charlie, mu, r));
    const double h = std::log(lookup(table, mu, r)) + exact_drop;
    const double error = std::abs(static_cast<double>(std::exp(static_cast<float>(h) - drop)) - e);
    if (e > 1e-10) {
      EXPECT_LE(error, lookup_error<double>(e, mu, r)) << mu << ' ' << r;
      closest = std::max(closest, error / lookup_error<double>(e, mu, r));
    }
  }
  EXPECT_GT(closest, 0.1);
}

}  // namespace
}  // namespace sheen::albedo
