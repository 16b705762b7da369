// Light from an image: what is drawn, how densely, and what it sums to.

#include "golden/environment_shade.h"

#include <array>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "golden/image_sum.h"
#include "golden/refined_estimate_test.h"
#include "golden/test_scenes.h"
#include "golden/uniform_light.h"
#include "number/cpu.h"

namespace sheen::golden {
namespace {

using Color = brdf::Rgb<double>;
using test::cloth_under_lacquer;

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

Lighting lighting_with(const albedo::Interpolant& interpolant) {
  Lighting lighting;
  lighting.albedo.interpolant = &interpolant;
  return lighting;
}

Estimate estimate(const Surface<double>& surface, Layers layers, const Lighting& lighting, const EnvironmentLight& light,
                  const SamplingGoal& goal, std::uint64_t stream = 0) {
  const DirectionPool pool(light, goal.seed);
  return test::refined_estimate(surface, layers, {lighting, &light, &pool}, goal, stream);
}

// The sum over all directions of a density is 1, and of the share a strategy draws in each region, that region's.
TEST(LobeSampling, DrawsInProportionToItsDensity) {
  const Surface<double> surface = cloth_under_lacquer(0.6);
  const LobeSampling sampling = lobe_sampling(surface, {true, true}, false, false);
  const LobeSampler<double> sampler(sampling);
  // Histogram over 8 x 16 cells of equal solid angle, all strategies together.
  constexpr int rows = 8;
  constexpr int columns = 16;
  constexpr int n = 1 << 9;
  std::vector<double> drawn(rows * columns);
  const auto cell = [](const Vec3<double>& d) {
    const int row = std::min(static_cast<int>(0.5 * (1.0 - d.y) * rows), rows - 1);
    const double turn = std::atan2(d.z, d.x) / (2.0 * brdf::pi) + 0.5;
    return static_cast<std::size_t>(row * columns + std::min(static_cast<int>(turn * columns), columns - 1));
  };
  for (std::size_t k = first_lobe; k < strategy_count; ++k) {
    ASSERT_GT(sampling.weights[k], 0U);
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const double angle = 2.0 * brdf::pi * (j + 0.5) / n;
        const Vec3<double> d = sampler.draw(static_cast<Strategy>(k), (i + 0.5) / n, std::cos(angle), std::sin(angle));
        ASSERT_NEAR(dot(d, d), 1.0, 1e-9);
        drawn[cell(d)] += sampling.weights[k] / (1.0 * n * n * sampling.total_weight());
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
      const Vec3<double> d{sine * std::cos(azimuth), y, sine * std::sin(azimuth)};
      expected[cell(d)] += sampler.weighted_density(d) / sampling.total_weight() * 4.0 * brdf::pi / (2.0 * fine * fine);
    }
  }
  double total = 0.0;
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    EXPECT_NEAR(drawn[i], expected[i], 2e-3) << i;
    total += expected[i];
  }
  EXPECT_NEAR(total, 1.0, 2e-3);
}

TEST(ImageSum, BatchesEqualOneAtATime) {
  if (!number::has_batch()) {
    return;  // this processor runs the other alone
  }
  const scene::Environment environment = sky_with_sun();
  const EnvironmentLight light(environment);
  const DirectionPool pool(light, 5);
  const albedo::Interpolant interpolant(albedo::Visibility::Charlie);
  for (std::size_t count = 8; count < 24; ++count) {  // few of them a multiple of a batch, before or after what lies below is left out
    Surface<double> surface = cloth_under_lacquer(count % 2 == 0 ? 0.9 : 0.1);
    surface.normal = {0.6, 0.8, 0.0};  // not the pole, where directions that fill a batch would count for nothing anyway
    const LobeSampling sampling = lobe_sampling(surface, {true, true}, true, true);
    ImageSumTask task{&surface, {true, true}, lighting_with(interpolant), &sampling, light.soft().texels(), light.bright().texels()};
    CurveCache curves;
    task.lighting.albedo.curve = curves.at(&interpolant, surface.sheen_roughness);
    DirectionPool::LightBlock light_block;
    DirectionPool::LobeBlock lobe_block;
    StrategyPoints points;
    for (std::uint32_t k = 0; k < strategy_count; ++k) {
      points.count[k] = count;
      if (k < first_lobe) {
        points.light[k] = k == 0 ? pool.soft(k, 0, light_block) : pool.bright(k, 0, light_block);
      } else {
        points.lobe[k] = pool.lobe(k, 0, lobe_block);
      }
    }
    const ControlVariate control = control_variate(surface, task.layers, task.lighting);
    task.control = &control;
    const ImageSums one = image_sum_scalar(task, points);
    const ImageSums four = image_sum_batch(task, points);
    for (Color ImageSums::*sum : {&ImageSums::radiance, &ImageSums::control}) {
      EXPECT_GT((one.*sum).g, 0.0);
      EXPECT_NEAR((four.*sum).r, (one.*sum).r, 1e-9 * (one.*sum).r);
      EXPECT_NEAR((four.*sum).g, (one.*sum).g, 1e-9 * (one.*sum).g);
      EXPECT_NEAR((four.*sum).b, (one.*sum).b, 1e-9 * (one.*sum).b);
    }
  }
}

TEST(EnvironmentShade, AWhiteImageIsUniformLight) {
  const scene::Environment environment = image_of(8, 4, [](int, int) { return glm::vec3(2.0f, 1.0f, 0.5f); });
  const EnvironmentLight light(environment);
  const albedo::Interpolant interpolant(albedo::Visibility::Charlie);
  for (const double mu : {0.9, 0.4, 0.1}) {
    const Surface<double> surface = cloth_under_lacquer(mu);
    const Estimate ours = estimate(surface, {true, true}, lighting_with(interpolant), light, {0.0005, 1u << 22, 1});
    const Color exact = UniformLight(lighting_with(interpolant), {2.0, 1.0, 0.5}).shade(surface, {true, true});
    EXPECT_NEAR(ours.mean.r, exact.r, 4.0 * ours.standard_error.r + 1e-6) << mu;
    EXPECT_NEAR(ours.mean.b, exact.b, 4.0 * ours.standard_error.b + 1e-6) << mu;
    EXPECT_LT(ours.standard_error.r, 0.001 * ours.mean.r);
  }
}

// The sum over a fine grid of the image, each node a distant light: no directions are drawn, no densities divided by. The lamp is as wide
// as the coat's lobe, so every strategy has a share in it, and it is seen in the coat.
TEST(EnvironmentShade, MeetsASumOverTheWholeImage) {
  const scene::Environment environment = image_of(16, 8, [](int x, int y) {
    return x == 11 && y == 2 ? glm::vec3(900.0f, 700.0f, 500.0f) : glm::vec3(0.3f + 0.1f * static_cast<float>(x % 3), 0.5f, 1.0f);
  });
  const EnvironmentLight light(environment);
  ASSERT_FALSE(light.bright().dark());
  const albedo::Interpolant interpolant(albedo::Visibility::Charlie);
  Surface<double> surface = cloth_under_lacquer(0.6);
  surface.coat_alpha = 0.08;
  const glm::dvec3 lamp = environment.direction({11.5 / 16, 2.5 / 8});
  const glm::dvec3 half = glm::normalize(lamp + glm::dvec3(surface.view.x, surface.view.y, surface.view.z));
  surface.coat_normal = {half.x, half.y, half.z};

  constexpr int rows = 600;
  constexpr int columns = 1200;
  std::array<std::vector<double>, 6> lights;
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      const glm::dvec2 uv((j + 0.5) / columns, (i + 0.5) / rows);
      const glm::dvec3 d = environment.direction(uv);
      const glm::dvec3 sent = environment.radiance(d) * (2.0 * brdf::pi * brdf::pi * std::sin(brdf::pi * uv.y) / (1.0 * rows * columns));
      for (int c = 0; c < 3; ++c) {
        lights[static_cast<std::size_t>(c)].push_back(d[c]);
        lights[static_cast<std::size_t>(c) + 3].push_back(sent[c]);
      }
    }
  }
  const DistantLights all{lights[0].data(), lights[1].data(), lights[2].data(), lights[3].data(), lights[4].data(), lights[5].data()};
  CurveCache curves;
  Lighting lighting = lighting_with(interpolant);
  lighting.albedo.curve = curves.at(&interpolant, surface.sheen_roughness);
  lighting.distant = &all;
  lighting.light_count = lights[0].size();
  const Color exact = shade(surface, {true, true}, lighting, NoListener{}).radiance;

  const Estimate ours = estimate(surface, {true, true}, lighting_with(interpolant), light, {0.001, 1u << 22, 1});
  EXPECT_LT(ours.standard_error.g, 0.001 * exact.g);
  EXPECT_NEAR(ours.mean.r, exact.r, 3.0 * ours.standard_error.r + 2e-4 * exact.r);
  EXPECT_NEAR(ours.mean.g, exact.g, 3.0 * ours.standard_error.g + 2e-4 * exact.g);
  EXPECT_NEAR(ours.mean.b, exact.b, 3.0 * ours.standard_error.b + 2e-4 * exact.b);
}

TEST(EnvironmentShade, AMirrorSeesTheImageItself) {
  const scene::Environment environment = sky_with_sun();
  const EnvironmentLight light(environment);
  Surface<double> surface = cloth_under_lacquer(0.6);
  surface.base = {{1.0, 1.0, 1.0}, 1.0, 0.0, {0.04, 0.04, 0.04}, 1.0};
  const Estimate ours = estimate(surface, {false, false}, {}, light, {});
  const glm::dvec3 seen = environment.radiance({-0.8, 0.6, 0.0});
  EXPECT_NEAR(ours.mean.r, seen.x, 1e-9);
  EXPECT_NEAR(ours.mean.b, seen.z, 1e-9);
}

// Three standard errors hold all channels of 99 % of the estimates, with room for what stopping early adds. Every seed is held to the mean
// of them all.
TEST(EnvironmentShade, TheStandardErrorHoldsTheTruth) {
  const scene::Environment environment = sky_with_sun();
  const EnvironmentLight light(environment);
  const albedo::Interpolant interpolant(albedo::Visibility::Charlie);
  constexpr int seeds = 100;
  int outside = 0;
  int all = 0;
  double spread = 0.0;
  for (int i = 0; i < 12; ++i) {
    Surface<double> surface = cloth_under_lacquer(0.02 + 0.08 * i);
    surface.sheen_roughness = 0.1 + 0.07 * i;
    surface.coat_alpha = i % 3 == 0 ? 0.002 : 0.04;
    std::vector<Estimate> runs;
    Color mean{0, 0, 0};
    for (int seed = 0; seed < seeds; ++seed) {
      runs.push_back(
          estimate(surface, {true, true}, lighting_with(interpolant), light, {0.02, 1u << 18, static_cast<std::uint64_t>(seed)}));
      mean = mean + runs.back().mean * (1.0 / seeds);
    }
    for (const Estimate& run : runs) {
      const double off =
          std::max({std::abs(run.mean.r - mean.r) / run.standard_error.r, std::abs(run.mean.g - mean.g) / run.standard_error.g,
                    std::abs(run.mean.b - mean.b) / run.standard_error.b});
      outside += off > 3.0 ? 1 : 0;
      spread += off * off;
      ++all;
      EXPECT_LE(run.standard_error.g, 0.02 * run.mean.g) << i;
    }
  }
  EXPECT_LE(outside, all / 100);
  EXPECT_GT(spread / all, 0.3) << "the standard error is not far too large either";
}

// Every orientation, grazing and from behind.
TEST(EnvironmentShade, IsFiniteEverywhere) {
  const scene::Environment environment = sky_with_sun();
  const EnvironmentLight light(environment);
  const albedo::Interpolant interpolant(albedo::Visibility::Charlie);
  const DirectionPool pool(light, 1);
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 n = glm::normalize(glm::dvec3(std::sin(i * 1.7), std::cos(i * 2.3), std::sin(i * 0.9 + 1.0)));
    const glm::dvec3 t = glm::normalize(glm::cross(n, glm::dvec3(0.6, 0.7, 0.4)));
    const double mu = 0.3 * std::sin(0.37 * i) * std::sin(0.11 * i);
    const glm::dvec3 v = mu * n + std::sqrt(1.0 - mu * mu) * t;
    Surface<double> surface = cloth_under_lacquer(0.5);
    surface.normal = surface.coat_normal = {n.x, n.y, n.z};
    surface.view = {v.x, v.y, v.z};
    const Estimate e = test::refined_estimate(surface, {i % 3 != 0, i % 2 != 0}, {lighting_with(interpolant), &light, &pool},
                                              {1.0, 2000, 1}, static_cast<std::uint64_t>(i));
    ASSERT_TRUE(e.mean.g > 0.0 && std::isfinite(e.mean.g) && std::isfinite(e.standard_error.g)) << i;
  }
}

// No direction is drawn by the lobe of a mirror, and what it mirrors is no matter of chance.
TEST(EnvironmentShade, TheSmoothestAreMirrors) {
  const scene::Environment environment = sky_with_sun();
  const EnvironmentLight light(environment);
  const albedo::Interpolant interpolant(albedo::Visibility::Charlie);
  Surface<double> surface = cloth_under_lacquer(0.5);
  surface.base = {{0.9, 0.8, 0.7}, 1.0, 0.0, {0.04, 0.04, 0.04}, 1.0};
  const auto with = [&](double alpha) {
    surface.base.alpha = surface.coat_alpha = alpha;
    return estimate(surface, {false, true}, lighting_with(interpolant), light, {0.01, 1u << 12, 3}).mean;
  };
  const Color mirror = with(0);
  EXPECT_GT(mirror.r, 0.1);
  for (const double alpha : {1e-76, 1e-14, brdf::mirror_alpha}) {
    EXPECT_EQ(with(alpha).r, mirror.r) << alpha;
    EXPECT_EQ(with(alpha).b, mirror.b) << alpha;
  }
}

TEST(EnvironmentShade, ASeedGivesOneResult) {
  const scene::Environment environment = sky_with_sun();
  const EnvironmentLight light(environment);
  const albedo::Interpolant interpolant(albedo::Visibility::Charlie);
  const Surface<double> surface = cloth_under_lacquer(0.5);
  const SamplingGoal goal{0.01, 1u << 18, 3};
  const Estimate a = estimate(surface, {true, true}, lighting_with(interpolant), light, goal);
  EXPECT_EQ(a.mean.g, estimate(surface, {true, true}, lighting_with(interpolant), light, goal).mean.g);
  EXPECT_NE(a.mean.g, estimate(surface, {true, true}, lighting_with(interpolant), light, goal, 1).mean.g) << "another stream";
  EXPECT_NE(a.mean.g, estimate(surface, {true, true}, lighting_with(interpolant), light, {0.01, 1u << 18, 4}).mean.g) << "another seed";
}

TEST(EnvironmentShade, DrawsNoMoreDirectionsThanAsked) {
  const scene::Environment environment = sky_with_sun();
  const EnvironmentLight light(environment);
  const DirectionPool pool(light, 0);
  const albedo::Interpolant interpolant(albedo::Visibility::Charlie);
  const ImageLighting lighting{lighting_with(interpolant), &light, &pool};
  const Surface<double> surface = cloth_under_lacquer(0.5);
  CurveCache curves;
  for (const std::uint32_t most : {least_samples, 1000u, 5000u, 100000u}) {
    EnvironmentEstimate e(surface, {true, true}, lighting, 1);
    while (e.refine(surface, curves, most)) {
    }
    EXPECT_LE(e.directions(), most);
    EXPECT_GT(e.directions(), most / 3);
  }
}

TEST(EnvironmentEstimate, ALampThatMostDirectionsMissIsFoundOrCountedAsMissed) {
  // Before the surface a lamp, behind it one of a hundred times its light, toward which nearly all of the image's directions go.
  scene::Environment lamps = image_of(64, 32, [](int, int) { return glm::vec3(0.0F); });
  const auto at = [&lamps](const glm::dvec3& d) -> glm::vec3& {
    const glm::dvec2 uv = lamps.coordinates(glm::normalize(d));
    return lamps.texels[static_cast<std::size_t>(uv.y * 32) * 64 + static_cast<std::size_t>(uv.x * 64)];
  };
  at({0.5, 0.8, 0.3}) = glm::vec3(100.0F);
  at({-0.5, -0.8, -0.3}) = glm::vec3(1.0F);
  const EnvironmentLight light(lamps);
  Surface<double> surface{};
  surface.normal = surface.coat_normal = surface.view = {-0.5, -0.8, -0.33};
  const double length = std::sqrt(dot(surface.normal, surface.normal));
  surface.normal = surface.coat_normal = surface.view = surface.normal * (1 / length);
  surface.base = {{0.5, 0.5, 0.5}, 0, 0.5, {0.04, 0.04, 0.04}, 0};
  surface.occlusion = 1;
  const Estimate truth = estimate(surface, {}, {}, light, {0.001, 1u << 22, 1});
  ASSERT_GT(truth.mean.g, 0.0);
  int missed = 0;
  for (std::uint64_t stream = 1; stream <= 300; ++stream) {
    const Estimate few = estimate(surface, {}, {}, light, {1.0, 700, 1}, stream);
    EXPECT_LE(std::abs(few.mean.g - truth.mean.g), standard_errors * few.standard_error.g + missed_directions * few.largest.g);
    missed += few.mean.g < 0.01 * truth.mean.g ? 1 : 0;
  }
  EXPECT_GT(missed, 3) << "of 300 some meet none of its light, and show no error";
}

}  // namespace
}  // namespace sheen::golden
