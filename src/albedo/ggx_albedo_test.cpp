#include "albedo/ggx_albedo.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include "albedo/ggx_interpolant.h"
#include "albedo/ggx_table.h"
#include "albedo/sheen_model.h"
#include "albedo/split_sum.h"
#include "albedo/turns.h"
#include "brdf/ggx.h"

namespace sheen::albedo {
namespace {

struct Point {
  double mu, alpha;
};

std::vector<Point> points(int count, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Point> made;
  for (int i = 0; i < count; ++i) {
    const double mu = i % 2 == 0 ? std::max(min_n_dot_v, unit(generator)) : std::exp(std::log(min_n_dot_v) * unit(generator));
    made.push_back({mu, i % 3 == 0 ? unit(generator) : std::exp(std::log(1.01 * mirror_alpha) * unit(generator))});
  }
  return made;
}

// At alpha = 1, D = 1/pi and Vis = 1 / (2 (N.L + N.V)), so E = 1 - mu ln((1 + mu) / mu).
TEST(GgxLoss, HasAClosedFormAtAlphaOne) {
  for (const double mu : {1e-4, 1e-3, 0.02, 0.3, 0.7, 0.99, 1.0}) {
    const double loss = mu * std::log((1 + mu) / mu);
    EXPECT_NEAR(ggx_loss(mu, 1.0), loss, 1e-9 * loss) << mu;
  }
}

TEST(GgxLoss, IsWhatTheSplitSumLeaves) {
  for (const auto& [mu, alpha] : points(600, 3)) {
    const SplitSum sum = ggx_split_sum(mu, std::sqrt(alpha));
    EXPECT_NEAR(ggx_loss(mu, alpha), 1 - sum.scale - sum.bias, 1e-6) << "n_dot_v " << mu << " alpha " << alpha;
  }
}

// The loss of a smooth lobe, where 1 - E has few digits: in long double, with the azimuth in closed form, the midpoint rule in
// logarithms of angles, and the formula of the loss as its definition reads.
double loss_by_midpoint(double n_dot_v, double alpha) {
  using Real = long double;
  const Real mu = n_dot_v, a2 = static_cast<Real>(alpha) * alpha, theta = std::acos(mu);
  const auto lambda = [a2](Real c) { return (std::sqrt(1 + a2 * (1 - c * c) / (c * c)) - 1) / 2; };
  const auto integrand = [&](Real delta) -> Real {
    const Real polar = theta + delta, c = std::cos(polar), sine = std::sin(polar);
    if (sine <= 0 || mu + c <= 0) {
      return 0;
    }
    // Q = |L + V|^2 = k + p - q cos(psi), D = a2 / pi (Q / (Q - k))^2
    const Real q = 2 * std::sin(theta) * sine, k = (1 - a2) * (mu + c) * (mu + c);
    const Real below = 4 * std::pow(std::cos(theta + delta / 2) * std::sin(delta / 2), 2) + a2 * (mu + c) * (mu + c);  // p - q
    const Real p = below + q, s = std::sqrt(below * (below + 2 * q));
    const Real ring = 2 * a2 * (1 + 2 * k / s + k * k * p / (s * s * s));
    const Real lost = c > 0 ? lambda(c) / (1 + lambda(mu) + lambda(c)) : 1;
    return ring * sine * lost / (4 * mu * (1 + lambda(mu)));
  };
  // From the mirror direction and from the horizon, near which the loss changes within alpha, either way.
  struct Segment {
    Real from, length;
  };
  const Real elevation = std::asin(mu);
  Real sum = 0;
  for (const auto& [from, length] : {Segment{0, -theta}, {0, elevation / 2}, {elevation, -elevation / 2}, {elevation, elevation}}) {
    const Real top = std::log(std::abs(length)), bottom = std::log(1e-7L * std::min({static_cast<Real>(alpha), mu, std::abs(length)}));
    const int steps = 12000;
    for (int i = 0; i < steps; ++i) {
      const Real size = std::exp(bottom + (top - bottom) * (i + Real(0.5)) / steps);
      sum += integrand(from + std::copysign(size, length)) * size * (top - bottom) / steps;
    }
  }
  return static_cast<double>(sum);
}

TEST(GgxLoss, KeepsItsDigitsWhereTheLobeIsSmooth) {
  for (const double alpha : {1e-6, 1e-4, 0.01, 0.2, 0.9}) {
    for (const double mu : {2e-4, 5e-3, 0.1, 0.6, 0.95}) {
      const double expected = loss_by_midpoint(mu, alpha);
      EXPECT_NEAR(ggx_loss(mu, alpha), expected, 3e-6 * expected) << "n_dot_v " << mu << " alpha " << alpha;
    }
  }
  EXPECT_EQ(ggx_loss(0.5, 0), 0);
  EXPECT_LT(ggx_loss(min_n_dot_v, mirror_alpha), 1e-8) << "what reading a mirror there leaves out";
}

// By parts: 2 integral of mu^2 ln((1 + mu) / mu) dmu = 2/3 ln 2 + 2/3 integral of mu^2 / (1 + mu) dmu = 2/3 ln 2 + 2/3 (ln 2 - 1/2).
TEST(GgxAverageAlbedo, HasAClosedFormAtAlphaOne) {
  const double loss = 4.0 / 3 * std::log(2.0) - 1.0 / 3;
  EXPECT_NEAR(ggx_average_albedo(1.0).loss, loss, 2e-8 * loss);
}

TEST(GgxAverageAlbedo, IsTheMeanOverTheHemisphere) {
  for (const double alpha : {1e-4, 0.01, 0.3, 1.0}) {
    GgxAlbedo sum{0, 0};
    const int steps = 2000;
    for (int i = 0; i < steps; ++i) {
      const double t = (i + 0.5) / steps, mu = t * t * t;  // crowds toward grazing
      sum.loss += 2 * mu * ggx_albedo(mu, alpha).loss * 3 * t * t / steps;
      sum.bias += 2 * mu * ggx_albedo(mu, alpha).bias * 3 * t * t / steps;
    }
    const GgxAlbedo average = ggx_average_albedo(alpha);
    EXPECT_NEAR(average.loss, sum.loss, 1e-4 * sum.loss) << alpha;
    EXPECT_NEAR(average.bias, sum.bias, 1e-6) << alpha;
  }
  EXPECT_NEAR(ggx_average_albedo(1e-7).bias, 1.0 / 21, 1e-6) << "Schlick's weight itself";
  EXPECT_EQ(ggx_average_albedo(0).loss, 0);
}

TEST(GgxInterpolant, MeetsQuadratureEverywhere) {
  const GgxInterpolant interpolant;
  for (const auto& [mu, alpha] : points(1500, 17)) {
    const GgxAlbedo exact = ggx_albedo(mu, alpha), ours = interpolant(mu, alpha);
    EXPECT_NEAR(ours.loss, exact.loss, 1e-6 * exact.loss) << "n_dot_v " << mu << " alpha " << alpha;
    EXPECT_NEAR(ours.bias, exact.bias, 1e-6) << "n_dot_v " << mu << " alpha " << alpha;
  }
  for (const auto& [mu, alpha] : points(60, 18)) {
    const GgxAlbedo exact = ggx_average_albedo(alpha), ours = interpolant.average(alpha);
    EXPECT_NEAR(ours.loss, exact.loss, 1e-6 * exact.loss) << alpha;
    EXPECT_NEAR(ours.bias, exact.bias, 1e-6) << alpha;
  }
}

TEST(GgxInterpolant, HoldsAtItsCornersAndTakesAMirrorForOne) {
  const GgxInterpolant interpolant;
  for (const double alpha : {1.0, 1.0001 * mirror_alpha}) {
    for (const double mu : {1.0, min_n_dot_v}) {
      EXPECT_NEAR(interpolant(mu, alpha).loss, ggx_loss(mu, alpha), 1e-6 * ggx_loss(mu, alpha)) << mu << ' ' << alpha;
    }
  }
  EXPECT_EQ(interpolant(0.5, 0).loss, 0);
  EXPECT_EQ(interpolant(0.5, 0).bias, std::pow(0.5, 5));
  EXPECT_EQ(interpolant(0, 0.5).loss, interpolant(min_n_dot_v, 0.5).loss) << "cosines are floored";
}

TEST(GgxInterpolant, GivesTheSameAtPlacesAskedForAgain) {
  const GgxInterpolant interpolant;
  for (const auto& [mu, alpha] : points(300, 19)) {
    GgxCosine cosine = GgxInterpolant::cosine(mu);
    // Of more rows of patches than a place keeps, and back.
    for (const double a : {alpha, 1.1 * alpha, 0.3 * alpha, 0.1 * alpha, 0.03 * alpha, 0.01 * alpha, alpha}) {
      const GgxAlbedo ours = interpolant(cosine, GgxInterpolant::alpha(a));
      EXPECT_EQ(ours.loss, interpolant(mu, a).loss) << "n_dot_v " << mu << " alpha " << a;
      EXPECT_EQ(ours.bias, interpolant(mu, a).bias) << "n_dot_v " << mu << " alpha " << a;
    }
  }
}

TEST(GgxInterpolant, GivesCurvesOfOneAlphaToRounding) {
  const GgxInterpolant interpolant;
  for (const double alpha : {0.0, 1e-8, 3e-5, 1e-3, 0.04, 0.5, 1.0, 1.5}) {
    const GgxCurve curve = interpolant.at_alpha(alpha);
    for (int i = -1; i <= 500; ++i) {
      const double mu = std::pow(10.0, -4.3 * i / 500);
      const GgxAlbedo exact = interpolant(mu, alpha);
      EXPECT_NEAR(curve(mu).loss, exact.loss, 1e-11 * exact.loss + 1e-15) << mu << ' ' << alpha;
      EXPECT_NEAR(curve(mu).bias, exact.bias, 1e-11) << mu << ' ' << alpha;
    }
  }
}

TEST(Turns, AreWhereAFunctionTurns) {
  const auto wave = [](double x) { return std::cos(std::log(x)); };
  const Turns turns = turns_of(wave, 1e-8);
  ASSERT_EQ(turns.count, 2U) << "at -pi and -2 pi of down to -9.2";
  for (std::size_t i = 0; i < 2; ++i) {
    const double place = std::exp(-brdf::pi * (i == 0 ? 2 : 1));
    EXPECT_LT(turns.turn[i].from, place);
    EXPECT_GT(turns.turn[i].to, place);
    EXPECT_LT(turns.turn[i].to, 1.1 * turns.turn[i].from);
    EXPECT_LE(turns.turn[i].lowest, wave(place));
    EXPECT_GE(turns.turn[i].highest, wave(place));
    EXPECT_LT(turns.turn[i].highest - turns.turn[i].lowest, 1e-3);
  }
  EXPECT_EQ(turns_of([](double x) { return x + 1e-10 * std::sin(50 * x); }, 1e-8).count, 0U);
  const Turns many = turns_of([](double x) { return std::cos(8 * std::log(x)); }, 1e-8);
  ASSERT_EQ(many.count, Turns::most);
  EXPECT_GT(many.turn[Turns::most - 1].to, 0.6);
  EXPECT_LE(many.turn[Turns::most - 1].lowest, -1.0);
  EXPECT_GE(many.turn[Turns::most - 1].highest, 1.0);
}

TEST(GgxInterpolant, MakesNoNumberOfWhatIsNone) {
  const GgxInterpolant interpolant;
  EXPECT_TRUE(std::isnan(interpolant(std::numeric_limits<double>::quiet_NaN(), 0.3).loss));
  EXPECT_TRUE(std::isnan(interpolant(std::numeric_limits<double>::quiet_NaN(), 0.3).bias));
}

TEST(GgxInterpolant, GivesEveryThreadTheSame) {
  const GgxInterpolant interpolant;
  std::vector<double> parallel(2000), serial(2000);
  const auto at = [&](std::size_t i) {
    const double alpha = 0.1 + 0.09 * static_cast<double>(i / 200);
    return interpolant(0.001 + 0.999 * static_cast<double>(i % 200) / 200, alpha).loss + interpolant.average(alpha).bias;
  };
  tbb::parallel_for(std::size_t{0}, parallel.size(), [&](std::size_t i) { parallel[i] = at(i); });
  for (std::size_t i = 0; i < serial.size(); ++i) {
    serial[i] = at(i);
  }
  EXPECT_EQ(parallel, serial);
}

void expect_near(const GgxAlbedo& ours, const GgxAlbedo& exact, const Point& at) {
  EXPECT_NEAR(ours.loss, exact.loss, ggx_table_error * exact.loss) << "n_dot_v " << at.mu << " alpha " << at.alpha;
  const double scale = 1 - exact.loss - exact.bias;
  EXPECT_NEAR(1 - ours.loss - ours.bias, scale, ggx_table_error * scale) << "n_dot_v " << at.mu << " alpha " << at.alpha;
}

TEST(GgxTable, ReadsWithinItsErrorForEveryCosineAndAlpha) {
  const GgxTable table = build_ggx_table();
  ASSERT_EQ(table.values.size(), static_cast<std::size_t>(2 * GgxTable::width * GgxTable::height));
  for (const float value : table.values) {
    ASSERT_TRUE(std::isfinite(value));
  }
  for (const Point& at : points(3000, 23)) {
    expect_near(lookup(table, at.mu, at.alpha), ggx_albedo(at.mu, at.alpha), at);
  }
  for (const Point& at : points(60, 24)) {
    expect_near(lookup_average(table, at.alpha), ggx_average_albedo(at.alpha), at);
  }
  EXPECT_EQ(lookup(table, 0.5, 0).loss, 0);
}

}  // namespace
}  // namespace sheen::albedo
