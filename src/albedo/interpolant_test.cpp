#include "albedo/interpolant.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include "albedo/directional_albedo.h"

namespace sheen::albedo {
namespace {

TEST(Interpolant, MeetsQuadratureEverywhere) {
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> unit(0, 1);
  for (Visibility visibility : brdf::visibilities) {
    const Interpolant interpolant(visibility);
    for (int i = 0; i < 1500; ++i) {
      const double mu = i % 2 == 0 ? std::max(min_n_dot_v, unit(generator)) : std::exp(std::log(min_n_dot_v) * unit(generator));
      const double r = i % 3 == 0 ? unit(generator) : std::exp(std::log(1e-6) * unit(generator));
      const double e = directional_albedo(visibility, mu, r);
      EXPECT_NEAR(interpolant(mu, r), e, 6e-7 * std::max(e, 1.0)) << "n_dot_v " << mu << " sheen_roughness " << r;
    }
  }
}

// Where E is small it is still right to its own size: a furnace of the sheen lobe alone shows nothing else.
TEST(Interpolant, HoldsRelativelyAboutNormalIncidence) {
  std::mt19937 generator(12);
  std::uniform_real_distribution<double> unit(0, 1);
  for (Visibility visibility : brdf::visibilities) {
    const Interpolant interpolant(visibility);
    for (int i = 0; i < 600; ++i) {
      const double mu = i % 20 == 0 ? 1.0 : 1.0 - 0.5 * unit(generator);
      const double r = 0.17 + 0.5 * unit(generator);
      const double e = directional_albedo(visibility, mu, r);
      EXPECT_NEAR(interpolant(mu, r) / e, 1.0, 2e-6) << "n_dot_v " << mu << " sheen_roughness " << r;
    }
  }
  const Interpolant ashikhmin(Visibility::Ashikhmin);
  for (const double r : {0.2, 0.3, 0.5, 1.0}) {
    const double p = 0.5 / (r * r);
    EXPECT_NEAR(ashikhmin(1.0, r) * std::exp2(p + 1) * (p + 2), 1.0, 1e-6) << r;
  }
}

TEST(Interpolant, HoldsAtItsCorners) {
  const Interpolant interpolant(Visibility::Charlie);
  EXPECT_NEAR(interpolant(1, 1), directional_albedo(Visibility::Charlie, 1, 1), 3e-7);
  EXPECT_NEAR(interpolant(min_n_dot_v, 1), directional_albedo(Visibility::Charlie, min_n_dot_v, 1), 1e-6);
  EXPECT_NEAR(interpolant(0.5, 0.5), directional_albedo(Visibility::Charlie, 0.5, 0.5), 3e-7) << "where Lambda changes branch";
  EXPECT_EQ(interpolant(0.5, 0), 0);
  EXPECT_EQ(interpolant(0, 0.5), interpolant(min_n_dot_v, 0.5)) << "cosines are floored";
}

// Close together, across the borders of patches, beyond the ranges, and where there is nothing.
TEST(Interpolant, GivesTheSameAtPlacesAskedForAgain) {
  std::mt19937 generator(13);
  std::uniform_real_distribution<double> unit(0, 1);
  for (Visibility visibility : brdf::visibilities) {
    const Interpolant interpolant(visibility);
    for (int i = 0; i < 600; ++i) {
      const double step = i % 3 == 0 ? 0.1 : 1e-6;
      const double mu = i % 2 == 0 ? 1.02 * unit(generator) : std::exp(std::log(min_n_dot_v) * unit(generator));
      const double r = i % 7 == 0 ? 0.0 : i % 5 == 0 ? std::exp(std::log(1e-6) * unit(generator)) : 1.02 * unit(generator);
      for (const double n_dot_v : {mu - step, mu, mu + step}) {
        SheenCosine cosine = Interpolant::cosine(n_dot_v);
        // Of more rows of patches than a place keeps, and back.
        for (const double sheen_roughness : {r, r * (1 + step), 0.3 * r, 0.1 * r, 0.03 * r, r * (1 - step), r}) {
          EXPECT_EQ(interpolant(cosine, Interpolant::roughness(sheen_roughness)), interpolant(n_dot_v, sheen_roughness))
              << "n_dot_v " << n_dot_v << " sheen_roughness " << sheen_roughness;
        }
      }
    }
  }
}

TEST(Interpolant, GivesEveryThreadTheSame) {
  const Interpolant interpolant(Visibility::Ashikhmin);
  std::vector<double> parallel(4000), serial(4000);
  const auto at = [&](std::size_t i) {
    return interpolant(0.001 + 0.999 * static_cast<double>(i % 400) / 400, 0.1 + 0.09 * static_cast<double>(i / 400));
  };
  tbb::parallel_for(std::size_t{0}, parallel.size(), [&](std::size_t i) { parallel[i] = at(i); });
  for (std::size_t i = 0; i < serial.size(); ++i) {
    serial[i] = at(i);
  }
  EXPECT_EQ(parallel, serial);
}

TEST(Curve, IsTheInterpolantAtOneRoughness) {
  for (Visibility visibility : brdf::visibilities) {
    const Interpolant interpolant(visibility);
    for (double r : {0.0, 0.002, 0.05, 0.1, 0.37, 0.4966, 0.8, 1.0}) {
      const Curve curve = interpolant.at_roughness(r);
      for (int i = 0; i <= 300; ++i) {
        const double mu = i % 2 == 0 ? i / 300.0 : std::exp(-0.03 * i);
        const double e = interpolant(mu, r);
        EXPECT_NEAR(curve(mu), e, 1e-9 * std::max(e, 1.0)) << "n_dot_v " << mu << " sheen_roughness " << r;
      }
    }
  }
}

// Each thread comes upon patches that no other has asked for, and upon some that another is making.
TEST(Curve, GivesEveryThreadTheSame) {
  const Interpolant interpolant(Visibility::Charlie);
  const auto cosine = [](std::size_t i) { return std::exp(-0.0025 * static_cast<double>((i * 397) % 4000)); };
  for (const double r : {0.25, 0.26, 0.9}) {
    const Curve shared = interpolant.at_roughness(r);
    std::vector<double> parallel(4000), serial(4000);
    tbb::parallel_for(std::size_t{0}, parallel.size(), [&](std::size_t i) { parallel[i] = shared(cosine(i)); });
    const Curve alone = interpolant.at_roughness(r);
    for (std::size_t i = serial.size(); i-- > 0;) {
      serial[i] = alone(cosine(i));
    }
    EXPECT_EQ(parallel, serial) << "sheen_roughness " << r;
  }
}

}  // namespace
}  // namespace sheen::albedo
