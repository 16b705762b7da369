#include "albedo/directional_albedo.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "albedo/interpolant.h"
#include "albedo/peak.h"
#include "albedo/quadrature.h"
#include "number/cpu.h"

namespace sheen::albedo {
namespace {

// At normal incidence and at grazing the integral has a closed form, so quadrature and formula check each other.
TEST(DirectionalAlbedo, AshikhminAtNormalIncidenceMeetsItsClosedForm) {
  for (double r : {0.05, 0.1, 0.25, 0.5, 1.0}) {
    const double p = 0.5 / (r * r);
    const double expected = std::exp2(-(p + 1)) / (p + 2);
    EXPECT_NEAR(directional_albedo(Visibility::Ashikhmin, 1.0, r), expected, 1e-8 * expected) << "sheen_roughness " << r;
  }
}

TEST(DirectionalAlbedo, AshikhminTendsToItsClosedFormAtGrazing) {
  for (double r : {0.1, 0.25, 0.5, 1.0}) {
    const double p = 0.5 / (r * r);
    const double expected = std::exp(std::lgamma(p + 1.5) - std::lgamma(p + 1)) / std::sqrt(brdf::pi);
    EXPECT_NEAR(directional_albedo(Visibility::Ashikhmin, 1e-7, r), expected, 2e-5 * expected) << "sheen_roughness " << r;
  }
}

TEST(DirectionalAlbedo, MeetsIndependentlyComputedValues) {
  // Long double, two methods agreeing to 1e-12.
  EXPECT_NEAR(directional_albedo(Visibility::Charlie, 0.5, 0.5), 0.187853931, 1e-8);
  EXPECT_NEAR(directional_albedo(Visibility::Ashikhmin, 0.5, 0.5), 0.229552784, 1e-8);
}

// The definition itself, over the sphere in (theta_l, phi) by the midpoint rule: no substitution, no splitting, no shared code but the
// lobe.
double by_midpoint(Visibility visibility, double mu, double r, int steps) {
  const brdf::SheenLobe<double> lobe(visibility, r, mu);
  const double sin_v = std::sqrt(1 - mu * mu);
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double theta = (i + 0.5) * brdf::pi / 2 / steps;
    const double n_dot_l = std::cos(theta), sin_l = std::sin(theta);
    for (int j = 0; j < steps; ++j) {
      const double phi = (j + 0.5) * brdf::pi / steps;
      const double x = sin_v + sin_l * std::cos(phi), y = sin_l * std::sin(phi), z = mu + n_dot_l;
      const double length2 = x * x + y * y + z * z;
      sum += lobe.value_times_n_dot_l(n_dot_l, z / std::sqrt(length2), (x * x + y * y) / length2) * sin_l;
    }
  }
  return sum * 2 * (brdf::pi / steps) * (brdf::pi / 2 / steps);
}

TEST(DirectionalAlbedo, MeetsTheDefinitionSummedOverTheSphere) {
  for (Visibility visibility : brdf::visibilities) {
    for (double r : {0.2, 0.5, 0.9}) {
      for (double mu : {0.15, 0.5, 0.8}) {
        // The rule's error falls with the square of the step: Richardson's extrapolation removes it.
        const double expected = (4 * by_midpoint(visibility, mu, r, 800) - by_midpoint(visibility, mu, r, 400)) / 3;
        EXPECT_NEAR(directional_albedo(visibility, mu, r), expected, 1e-6 * std::max(expected, 0.1))
            << static_cast<int>(visibility) << " n_dot_v " << mu << " sheen_roughness " << r;
      }
    }
  }
}

TEST(DirectionalAlbedo, IsZeroAtRoughnessZero) {
  for (Visibility visibility : brdf::visibilities) {
    EXPECT_EQ(directional_albedo(visibility, 0.5, 0.0), 0);
    EXPECT_EQ(directional_albedo(visibility, 1e-4, 0.0), 0);
    EXPECT_EQ(directional_albedo(visibility, 0.5, 1e-170), 0);
  }
}

// Where E falls with the cosine, the larger of E(N.V) and E(N.L) is E(min(N.V, N.L)), and the shader needs one lookup.
TEST(DirectionalAlbedo, FallsWithTheCosineWhereOneLookupIsExact) {
  for (double r : {0.05, 0.2, 0.26, 0.5, 0.75, 1.0}) {
    double charlie = 1e300, ashikhmin = 1e300;
    for (double mu = 0.008; mu <= 1; mu *= 1.05) {
      const double c = directional_albedo(Visibility::Charlie, mu, r), a = directional_albedo(Visibility::Ashikhmin, mu, r);
      EXPECT_LE(c, charlie * (1 + 1e-6)) << "Charlie, n_dot_v " << mu << " sheen_roughness " << r;
      EXPECT_LE(a, ashikhmin * (1 + 1e-6)) << "Ashikhmin, n_dot_v " << mu << " sheen_roughness " << r;
      charlie = c;
      ashikhmin = a;
    }
  }
}

// What bounds of E over a range of cosines build on.
TEST(DirectionalAlbedo, RisesToOnePeakAndFallsFromThere) {
  for (const Visibility visibility : brdf::visibilities) {
    const Interpolant interpolant(visibility);
    for (const double r : {0.02, 0.07, 0.2, 0.45, 0.8, 1.0}) {
      const auto e = [&](double mu) { return interpolant(mu, r); };
      const Peak peak = peak_of(e, 16);
      const Peak rough = peak_of(e, 8);
      EXPECT_LE(rough.from, peak.to);
      EXPECT_GE(rough.to, peak.from);
      EXPECT_LE(peak.to, 1.1 * decreasing_from * (1 + 1e-12));
      EXPECT_LE(peak.e, 1.001 * e(peak.from)) << "and no more than it needs";
      EXPECT_LE(rough.e, 1.002 * peak.e);
      double before = 0;
      for (double mu = min_n_dot_v; mu <= 1; mu *= 1.003) {
        const double here = e(mu);
        if (mu < peak.from) {
          EXPECT_GE(here, before * (1 - 1e-9)) << "n_dot_v " << mu << " sheen_roughness " << r;
        } else if (mu > 1.003 * peak.to) {
          EXPECT_LE(here, before * (1 + 1e-9)) << "n_dot_v " << mu << " sheen_roughness " << r;
        }
        const bool only_falls = rough.from <= min_n_dot_v * (1 + 1e-9);
        if (!only_falls || mu >= rough.to) {
          EXPECT_LE(here, rough.e);
          EXPECT_LE(here, peak.e);
        }
        before = here;
      }
    }
  }
}

TEST(DirectionalAlbedo, OneLookupIsOffByAtMostSeventeenHundredthsBelow) {
  // Clamped E: what the scale sees with sheenColor 1.
  double worst = 0;
  for (double r = 0.05; r <= 1; r += 0.05) {
    double larger_ahead = 0;  // largest E at any cosine above mu
    for (double mu = 1; mu >= min_n_dot_v; mu /= 1.2) {
      const double e = std::min(1.0, directional_albedo(Visibility::Charlie, mu, r));
      worst = std::max(worst, larger_ahead - e);
      larger_ahead = std::max(larger_ahead, e);
    }
  }
  EXPECT_GT(worst, 0.1) << "the identity is not exact below 0.008, and the bound must know";
  EXPECT_LE(worst, 0.1701);
}

TEST(Quadrature, FastAndFullMeetTheirErrors) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 1500; ++i) {
    const Visibility visibility = brdf::visibilities[i % 3];
    const double mu = std::exp(std::log(min_n_dot_v) * unit(generator)), r = std::exp(std::log(0.003) * unit(generator));
    // Twice the nodes of Full in both directions, in scalar arithmetic.
    const double fast = log_directional_albedo_fast(visibility, mu, r), full = log_directional_albedo(visibility, mu, r);
    const Integral in = prepare(visibility, mu, r, Effort::Full);
    const double reference = std::log(scaled_integral_scalar(in, make_rule(96, 3.7, 72))) + in.p * in.log_peak;
    if (reference < -20) {
      continue;
    }
    EXPECT_NEAR(full, reference, 3e-7) << "n_dot_v " << mu << " sheen_roughness " << r;
    EXPECT_NEAR(fast, reference, mu >= 0.004 ? 4e-7 : 1e-6) << "n_dot_v " << mu << " sheen_roughness " << r;
  }
}

TEST(Quadrature, GivesTheSameInBatchesAndOneByOne) {
  if (!number::has_batch()) {
    return;
  }
  for (double r : {0.1, 0.6}) {
    const Integral in = prepare(Visibility::Charlie, 0.3, r, Effort::Full);
    const double one = scaled_integral_scalar(in, rule_for(in.p, Effort::Full));
    EXPECT_NEAR(scaled_integral_batch(in, rule_for(in.p, Effort::Full)), one, 1e-13 * one);
  }
}

TEST(EvaluateGrid, RunsOverCosinesFirst) {
  const auto grid = evaluate_grid(Visibility::Ashikhmin, {0.2, 0.9}, {0.3, 0.5, 1.0});
  ASSERT_EQ(grid.size(), 6U);
  EXPECT_NEAR(grid[1], directional_albedo(Visibility::Ashikhmin, 0.9, 0.3), 1e-6 * grid[1]);
  EXPECT_NEAR(grid[4], directional_albedo(Visibility::Ashikhmin, 0.2, 1.0), 1e-6 * grid[4]);
}

}  // namespace
}  // namespace sheen::albedo
