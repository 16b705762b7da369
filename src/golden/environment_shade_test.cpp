// Light from an image: what is drawn, how densely, and what it sums to.

#include "golden/environment_shade.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "golden/lobe_sampling.h"
#include "golden/uniform_light.h"

namespace sheen::golden {
namespace {

using Color = brdf::Rgb<double>;

template <class F>
scene::Environment image_of(int width, int height, const F& texel) {
  scene::Environment e;
  e.width = width;
  e.height = height;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      e.texels.push_back(texel(x, y));
    }
  }
  return e;
}

scene::Environment sky_with_sun() {
  scene::Environment e = image_of(64, 32, [](int x, int y) {
    const float sky = y < 16 ? 1.0f : 0.2f;
    return x == 37 && y == 9 ? glm::vec3(1e5f) : glm::vec3(0.4f * sky, 0.6f * sky, sky);
  });
  e.rotation = 0.7;
  return e;
}

Surface<double> cloth_under_lacquer(double n_dot_v) {
  Surface<double> s{};
  s.normal = {0.0, 1.0, 0.0};
  s.coat_normal = {0.2, std::sqrt(1.0 - 0.04 - 0.01), 0.1};
  s.view = {std::sqrt(1.0 - n_dot_v * n_dot_v), n_dot_v, 0.0};
  s.base.color = {0.5, 0.3, 0.2};
  s.base.metallic = 0.3;
  s.base.alpha = 0.09;
  s.base.dielectric_f0 = {0.04, 0.04, 0.04};
  s.base.specular = 1.0;
  s.sheen_color = {0.8, 0.6, 0.9};
  s.sheen_roughness = 0.4;
  s.clearcoat = 0.7;
  s.coat_alpha = 0.04;
  s.occlusion = 1.0;
  return s;
}

Lighting lighting_with(const albedo::Interpolant& interpolant) {
  Lighting lighting;
  lighting.albedo = &interpolant;
  return lighting;
}

// The sum over all directions of a density is 1, and of the share a strategy draws in each region, that region's.
TEST(LobeSampling, DrawsInProportionToItsDensity) {
  const scene::Environment environment = sky_with_sun();
  const EnvironmentLight light(environment);
  const Surface<double> surface = cloth_under_lacquer(0.6);
  const LobeSampling sampling(surface, {true, true}, light);
  ASSERT_EQ(sampling.strategies(), 5U);
  // Histogram over 8 x 16 cells of equal solid angle, all strategies together.
  constexpr int rows = 8;
  constexpr int columns = 16;
  constexpr int n = 1 << 9;
  std::vector<double> drawn(rows * columns);
  const auto cell = [](const glm::dvec3& d) {
    const int row = std::min(static_cast<int>(0.5 * (1.0 - d.y) * rows), rows - 1);
    const double turn = std::atan2(d.z, d.x) / (2.0 * brdf::pi) + 0.5;
    return row * columns + std::min(static_cast<int>(turn * columns), columns - 1);
  };
  for (std::size_t s = 0; s < sampling.strategies(); ++s) {
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const glm::dvec3 d = sampling.sample(s, (i + 0.5) / n, (j + 0.5) / n);
        ASSERT_NEAR(glm::length(d), 1.0, 1e-9);
        drawn[static_cast<std::size_t>(cell(d))] += 1.0 / (n * n * 5.0);
      }
    }
  }
  std::vector<double> expected(rows * columns);
  constexpr int fine = 2000;
  for (int i = 0; i < fine; ++i) {
    for (int j = 0; j < 2 * fine; ++j) {
      const double y = 1.0 - 2.0 * (i + 0.5) / fine;
      const double azimuth = 2.0 * brdf::pi * ((j + 0.5) / (2 * fine) - 0.5);
      const double sine = std::sqrt(1.0 - y * y);
      const glm::dvec3 d(sine * std::cos(azimuth), y, sine * std::sin(azimuth));
      expected[static_cast<std::size_t>(cell(d))] += sampling.mean_pdf(d) * 4.0 * brdf::pi / (2.0 * fine * fine);
    }
  }
  double total = 0.0;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    EXPECT_NEAR(drawn[i], expected[i], 2e-3) << i;
    total += expected[i];
  }
  EXPECT_NEAR(total, 1.0, 2e-3);
}

TEST(EnvironmentShade, AWhiteImageIsUniformLight) {
  const scene::Environment environment = image_of(8, 4, [](int, int) { return glm::vec3(2.0f, 1.0f, 0.5f); });
  const EnvironmentLight light(environment);
  const albedo::Interpolant interpolant(albedo::Visibility::Charlie);
  for (const double mu : {0.9, 0.4, 0.1}) {
    const Surface<double> surface = cloth_under_lacquer(mu);
    const Estimate ours = shade_environment(surface, {true, true}, lighting_with(interpolant), light, {0.0005, 1u << 20, 1});
    const Color exact = shade_uniform(surface, {true, true}, lighting_with(interpolant), {2.0, 1.0, 0.5}).radiance;
    EXPECT_NEAR(ours.mean.r, exact.r, 4.0 * ours.standard_error.r + 1e-6) << mu;
    EXPECT_NEAR(ours.mean.b, exact.b, 4.0 * ours.standard_error.b + 1e-6) << mu;
    EXPECT_LT(ours.standard_error.r, 0.001 * ours.mean.r);
  }
}

TEST(EnvironmentShade, AMirrorSeesTheImageItself) {
  const scene::Environment environment = sky_with_sun();
  const EnvironmentLight light(environment);
  Surface<double> surface = cloth_under_lacquer(0.6);
  surface.base = {{1.0, 1.0, 1.0}, 1.0, 0.0, {0.04, 0.04, 0.04}, 1.0};
  const Estimate ours = shade_environment(surface, {false, false}, {}, light, {});
  const glm::dvec3 seen = environment.radiance({-0.8, 0.6, 0.0});
  EXPECT_NEAR(ours.mean.r, seen.x, 1e-9);
  EXPECT_NEAR(ours.mean.b, seen.z, 1e-9);
}

TEST(EnvironmentShade, TwoSeedsAgreeWithinTheirStandardErrors) {
  const scene::Environment environment = sky_with_sun();
  const EnvironmentLight light(environment);
  const albedo::Interpolant interpolant(albedo::Visibility::Charlie);
  int outside = 0;
  int all = 0;
  for (int i = 0; i < 60; ++i) {
    Surface<double> surface = cloth_under_lacquer(0.02 + 0.016 * i);
    surface.sheen_roughness = 0.1 + 0.015 * i;
    const SamplingGoal goal{0.01, 1u << 18, static_cast<std::uint64_t>(i)};
    const Estimate a = shade_environment(surface, {true, true}, lighting_with(interpolant), light, goal);
    const Estimate b =
        shade_environment(surface, {true, true}, lighting_with(interpolant), light, {0.01, 1u << 18, 1000u + static_cast<unsigned>(i)});
    const Estimate again = shade_environment(surface, {true, true}, lighting_with(interpolant), light, goal);
    EXPECT_EQ(a.mean.g, again.mean.g);
    ++all;
    outside += std::abs(a.mean.g - b.mean.g) > 3.0 * std::hypot(a.standard_error.g, b.standard_error.g) ? 1 : 0;
    EXPECT_LE(a.standard_error.g, 0.0101 * std::max({a.mean.r, a.mean.g, a.mean.b})) << i;
  }
  EXPECT_LE(outside, 2) << "of " << all;
}

}  // namespace
}  // namespace sheen::golden
