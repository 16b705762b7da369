#include "albedo/split_sum.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "brdf/ggx.h"

namespace sheen::albedo {
namespace {

// scale + bias by another way: over the azimuth the square of Q / (Q - K) has a closed form, which leaves one integral over N.L.
// Q = a + b cos(phi), so with u = a - K:  integral of (1 + K / (u + b cos))^2 = 2 pi (1 + 2 K / s + K^2 u / s^3), s = sqrt(u^2 - b^2).
long double ring(long double alpha, long double mu, long double lambda) {
  const long double b = 2 * std::sqrt((1 - mu * mu) * (1 - lambda * lambda));
  const long double k = (1 - alpha * alpha) * (mu + lambda) * (mu + lambda);
  const long double u = 2 + 2 * mu * lambda - k;
  const long double s = std::sqrt((u - b) * (u + b));
  const long double visibility = 0.5L / (lambda * std::sqrt(alpha * alpha + (1 - alpha * alpha) * mu * mu) +
                                         mu * std::sqrt(alpha * alpha + (1 - alpha * alpha) * lambda * lambda));
  return 2 * alpha * alpha * (1 + 2 * k / s + k * k * u / (s * s * s)) * visibility * lambda;
}

long double simpson(long double alpha, long double mu, long double a, long double b, long double fa, long double fm, long double fb,
                    int depth) {
  const long double m = (a + b) / 2;
  const long double fl = ring(alpha, mu, (a + m) / 2), fr = ring(alpha, mu, (m + b) / 2);
  const long double coarse = (b - a) / 6 * (fa + 4 * fm + fb);
  const long double fine = (b - a) / 12 * (fa + 4 * fl + 2 * fm + 4 * fr + fb);
  if (depth == 0 || (depth < 40 && std::abs(fine - coarse) < 1e-12L * (b - a) + 1e-13L)) {
    return fine + (fine - coarse) / 15;
  }
  return simpson(alpha, mu, a, m, fa, fl, fm, depth - 1) + simpson(alpha, mu, m, b, fm, fr, fb, depth - 1);
}

double albedo_at_unit_f0(double mu, double roughness) {
  const long double alpha = static_cast<long double>(roughness) * roughness;
  const auto over = [&](long double a, long double b) {
    return b > a ? simpson(alpha, mu, a, b, ring(alpha, mu, a), ring(alpha, mu, (a + b) / 2), ring(alpha, mu, b), 46) : 0.0L;
  };
  return static_cast<double>(over(0, mu) + over(mu, 1));
}

TEST(SplitSum, ScalePlusBiasIsTheAlbedoAtUnitReflectance) {
  for (double roughness : {0.05, 0.1, 0.3, 0.6, 0.9, 1.0}) {
    for (double mu : {0.002, 0.02, 0.1, 0.37, 0.5, 0.8, 0.99, 1.0}) {
      const SplitSum sum = ggx_split_sum(mu, roughness);
      EXPECT_NEAR(sum.scale + sum.bias, albedo_at_unit_f0(mu, roughness), 2e-7) << "n_dot_v " << mu << " roughness " << roughness;
    }
  }
}

// The definition itself, by the midpoint rule over the sphere with the formulas of brdf/, in which nothing is substituted.
SplitSum by_midpoint(double mu, double roughness, int steps) {
  const double alpha = roughness * roughness, sin_v = std::sqrt(1 - mu * mu);
  SplitSum sum{0, 0};
  for (int i = 0; i < steps; ++i) {
    const double theta = (i + 0.5) * brdf::pi / 2 / steps;
    const double n_dot_l = std::cos(theta), sin_l = std::sin(theta);
    for (int j = 0; j < steps; ++j) {
      const double phi = (j + 0.5) * brdf::pi / steps;
      const double x = sin_v + sin_l * std::cos(phi), y = sin_l * std::sin(phi), z = mu + n_dot_l;
      const double length2 = x * x + y * y + z * z;
      const double lobe = brdf::ggx_distribution(alpha, z / std::sqrt(length2), (x * x + y * y) / length2) *
                          brdf::smith_visibility(alpha, n_dot_l, mu) * n_dot_l * sin_l;
      const double w = std::pow(1 - std::sqrt(length2) / 2, 5);
      sum.scale += lobe * (1 - w);
      sum.bias += lobe * w;
    }
  }
  const double area = 2 * (brdf::pi / steps) * (brdf::pi / 2 / steps);
  return {sum.scale * area, sum.bias * area};
}

TEST(SplitSum, MeetsTheDefinitionSummedOverTheSphere) {
  for (double roughness : {0.5, 0.75, 1.0}) {
    for (double mu : {0.2, 0.5, 0.9}) {
      // The rule's error falls with the square of the step: Richardson's extrapolation removes it.
      const SplitSum coarse = by_midpoint(mu, roughness, 400), fine = by_midpoint(mu, roughness, 800);
      const SplitSum sum = ggx_split_sum(mu, roughness);
      EXPECT_NEAR(sum.scale, (4 * fine.scale - coarse.scale) / 3, 1e-6) << "n_dot_v " << mu << " roughness " << roughness;
      EXPECT_NEAR(sum.bias, (4 * fine.bias - coarse.bias) / 3, 1e-6) << "n_dot_v " << mu << " roughness " << roughness;
    }
  }
}

// At roughness 1 and normal incidence D = 1/pi, Vis = 1 / (2 (1 + N.L)), V.H = sqrt((1 + N.L) / 2): with h = V.H,
// integral of (2 h^2 - 1) / h^2 F 2 h dh over [sqrt(1/2), 1], F = 1 giving 1 - ln 2.
TEST(SplitSum, HasAClosedFormAtRoughnessOneAndNormalIncidence) {
  const SplitSum sum = ggx_split_sum(1, 1);
  EXPECT_NEAR(sum.scale + sum.bias, 1 - std::log(2.0), 1e-7);
  // The first term is that of 4 h (1-h)^5, the second that of 2 (1-h)^5 / h.
  const auto antiderivative = [](double h) {
    return 2 * (std::pow(1 - h, 7) * 2 / 7 - std::pow(1 - h, 6) / 3) -
           2 * (std::log(h) - 5 * h + 5 * h * h - 10 * h * h * h / 3 + 5 * h * h * h * h / 4 - h * h * h * h * h / 5);
  };
  EXPECT_NEAR(sum.bias, antiderivative(1) - antiderivative(std::sqrt(0.5)), 1e-7);
}

TEST(SplitSum, TendsToAMirror) {
  for (double mu : {0.05, 0.3, 0.8, 1.0}) {
    const SplitSum mirror = ggx_split_sum(mu, 0), smooth = ggx_split_sum(mu, 0.0101);
    EXPECT_NEAR(mirror.scale + mirror.bias, 1, 1e-15);
    EXPECT_NEAR(mirror.bias, std::pow(1 - mu, 5), 1e-15);
    EXPECT_NEAR(smooth.scale, mirror.scale, 1e-5) << "n_dot_v " << mu;
    EXPECT_NEAR(smooth.bias, mirror.bias, 1e-5) << "n_dot_v " << mu;
    EXPECT_NEAR(ggx_split_sum(mu, 1.0001e-4).bias, mirror.bias, 1e-7) << "just above where a mirror is taken";
  }
}

TEST(SplitSum, IsSmoothInBothArguments) {
  // A rule too coarse for some corner shows as a ripple: fourth differences of a smooth function fall with the step.
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 400; ++i) {
    const double mu = std::exp(std::log(1e-4) * unit(generator)) * 0.98, roughness = std::exp(std::log(0.003) * unit(generator)) * 0.98;
    double bias = 0, all = 0;
    const double binomial[] = {1, -4, 6, -4, 1};
    for (int k = -2; k <= 2; ++k) {
      const SplitSum sum = ggx_split_sum(mu * (1 + 0.004 * k), roughness * (1 + 0.003 * k));
      bias += binomial[k + 2] * sum.bias;
      all += binomial[k + 2] * (sum.scale + sum.bias);
    }
    EXPECT_NEAR(bias, 0, 1e-6) << "n_dot_v " << mu << " roughness " << roughness;
    EXPECT_NEAR(all, 0, 1e-6) << "n_dot_v " << mu << " roughness " << roughness;
  }
}

TEST(SplitSumGrid, RunsOverCosinesFirst) {
  const auto grid = evaluate_split_sum_grid({0.2, 0.9}, {0.3, 0.5, 1.0});
  ASSERT_EQ(grid.size(), 6U);
  EXPECT_EQ(grid[1].scale, ggx_split_sum(0.9, 0.3).scale);
  EXPECT_EQ(grid[4].bias, ggx_split_sum(0.2, 1.0).bias);
}

TEST(DiffuseFresnel, MeetsTheDefinitionSummedOverTheSphere) {
  for (const double mu : {0.0, 0.05, 0.3, 0.7, 1.0}) {
    constexpr int steps = 1500;
    const double sin_v = std::sqrt(1 - mu * mu);
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
      const double cosine = std::sqrt((i + 0.5) / steps);  // equal shares of the cosine-weighted hemisphere
      for (int j = 0; j < steps / 10; ++j) {
        const double phi = 2 * brdf::pi * (j + 0.5) / (steps / 10);
        const double v_dot_l = mu * cosine + sin_v * std::sqrt(1 - cosine * cosine) * std::cos(phi);
        sum += std::pow(1 - std::sqrt((1 + v_dot_l) / 2), 5);
      }
    }
    EXPECT_NEAR(diffuse_fresnel(mu), sum / steps / (steps / 10), 2e-6) << "n_dot_v " << mu;
  }
}

}  // namespace
}  // namespace sheen::albedo
