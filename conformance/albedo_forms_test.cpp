#include "conformance/albedo_forms.h"

#include <cmath>

#include <gtest/gtest.h>

namespace sheen::conformance::forms {
namespace {

using brdf::Visibility;
using H = number::Bounded<number::Highp>;

TEST(AlbedoForms, TheLookupIsTheTablesOwnWithAnErrorBelowItsInterpolations) {
  const albedo::Table& table = shared_table<Visibility::Charlie>();
  for (const double r : {0.03125, 0.25, 0.5, 0.9375, 1.0}) {
    for (const double mu : {0.001953125, 0.0625, 0.4375, 0.5, 0.5625, 0.9375, 1.0}) {
      const H read = table_lookup(table, mu, r);
      ASSERT_TRUE(read.is_bounded()) << mu << " " << r;
      const double exact = albedo::lookup(table, mu, r);
      // The shader's series leaves out 2e-9 of an exponent of at most ln(2) / (2 r^2).
      EXPECT_NEAR(read.center(), exact, 2e-9 * exact * (1 + 0.35 / (r * r))) << mu << " " << r;
      EXPECT_LT(read.deviation(), 4e-5 * std::max(exact, 1.0)) << mu << " " << r;
      EXPECT_GT(read.deviation(), 0);
    }
  }
}

TEST(AlbedoForms, ErrorsAreGrantedAboutTheTruth) {
  const TableAlbedo read = table_albedo(shared_table<Visibility::Charlie>(), 0.5, 0.5);
  EXPECT_NEAR(read.truth, 0.187853931, 1e-6);
  EXPECT_GT(read.error, table_error);
  EXPECT_LT(read.error, 2 * table_error);
  EXPECT_EQ(table_albedo(shared_table<Visibility::Charlie>(), 0.5, 0).truth, 0);
  EXPECT_EQ(table_albedo(shared_table<Visibility::Charlie>(), 1e-9, 0.5).truth,
            table_albedo(shared_table<Visibility::Charlie>(), 1e-4, 0.5).truth);
}

/// The fit's error over a grid, in exact arithmetic.
double largest_fit_error(Visibility visibility, const std::vector<std::pair<double, double>>& worst) {
  double largest = 0;
  const auto look = [&](double mu, double r) {
    const double truth = std::min(albedo::directional_albedo(visibility, mu, r), 1.0);
    largest = std::max(largest, std::abs(fitted_albedo(visibility, mu, r).center() - truth));
  };
  for (int j = 0; j <= 24; ++j) {
    for (int i = 0; i <= 24; ++i) {
      look(0.005 * std::pow(200, i / 24.0), 0.1 * std::pow(10, j / 24.0));
    }
  }
  for (const auto& [mu, r] : worst) {
    look(mu, r);
  }
  return largest;
}

TEST(AlbedoForms, TheFitsErrorIsWhatItsShaderStates) {
  const double charlie = largest_fit_error(Visibility::Charlie, {{1.0, 1.0}});
  EXPECT_LE(charlie, charlie_fit_error);
  EXPECT_GT(charlie, 0.99 * charlie_fit_error);
  const double ashikhmin = largest_fit_error(Visibility::Ashikhmin, {{0.00527, 0.4331}});
  EXPECT_LE(ashikhmin, ashikhmin_fit_error);
  EXPECT_GT(ashikhmin, 0.99 * ashikhmin_fit_error);
  EXPECT_LT(fitted_albedo(Visibility::Charlie, 0.5, 0.5).deviation(), 1e-4) << "roundings are far below the fit's own error";
}

TEST(AlbedoForms, AScaleOfOneLookupIsPromisedOnBothSidesOfWhereEFalls) {
  const albedo::Table& table = shared_table<Visibility::Charlie>();
  const auto e = [&](double mu) { return table_albedo(table, mu, 0.25).truth; };
  // From a cosine of 0.008 up E falls with it, and one look-up at the smaller cosine is the larger E.
  const H falling = read_albedo_scale(brdf::AlbedoScaling::Full, table, 0.5, 0.25, H(0.0625), H(0.5));
  EXPECT_NEAR(falling.center(), 1 - 0.5 * e(0.0625), 1e-12);
  EXPECT_LT(falling.deviation(), 3e-5);
  // Where it does not, the smaller cosine has the smaller E: the truth and what one look-up gives are both within.
  const double low = 1.5e-4;
  const double high = 0.004;
  ASSERT_GT(e(high), e(low));
  const H rising = read_albedo_scale(brdf::AlbedoScaling::Full, table, 0.5, 0.25, H(low), H(high));
  EXPECT_NEAR(rising.center(), 1 - 0.5 * e(high), 1e-12);
  EXPECT_GE(rising.range().upper, 1 - 0.5 * e(low));
  const H view = read_albedo_scale(brdf::AlbedoScaling::View, table, 0.5, 0.25, H(low), H(0.5));
  EXPECT_NEAR(view.center(), 1 - 0.5 * e(0.5), 1e-12);
}

}  // namespace
}  // namespace sheen::conformance::forms
