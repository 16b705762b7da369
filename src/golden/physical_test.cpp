// The physical model: positive, reciprocal, conserving energy, and what it is said to be.

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "albedo/split_sum.h"
#include "golden/environment_shade.h"
#include "golden/long_double_model.h"
#include "golden/refined_estimate_test.h"
#include "golden/shade_all.h"
#include "golden/test_scenes.h"
#include "golden/uniform_light.h"
#include "number/cpu.h"

namespace sheen::golden {
namespace {

using Color = brdf::Rgb<double>;

const albedo::GgxInterpolant& ggx() {
  static const albedo::GgxInterpolant interpolant;
  return interpolant;
}

Lighting physical(const PreparedLight* lights = nullptr, std::size_t count = 0) {
  Lighting lighting;
  lighting.lights = lights;
  lighting.light_count = count;
  lighting.sheen.model = albedo::Model::Physical;
  lighting.base_albedo.interpolant = &ggx();
  return lighting;
}

glm::dvec3 from_normal(double cosine, double azimuth) {
  const double sine = std::sqrt((1.0 - cosine) * (1.0 + cosine));
  return {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
}

Surface<double> surface(double n_dot_v, double roughness, double metallic, Color color = {1.0, 1.0, 1.0}) {
  Surface<double> s{};
  const glm::dvec3 v = from_normal(n_dot_v, 0.0);
  s.normal = s.coat_normal = {0.0, 0.0, 1.0};
  s.view = {v.x, v.y, v.z};
  s.base = {color, metallic, roughness * roughness, {0.04, 0.04, 0.04}, 1.0};
  s.occlusion = 1.0;
  return s;
}

Color furnace(const Surface<double>& s) {
  return UniformLight(physical(), {1.0, 1.0, 1.0}).shade(s, {});
}

/// The base's BRDF times N.L: a light of 1 lux.
Color reflected(Surface<double> s, const glm::dvec3& v, const glm::dvec3& l) {
  PreparedLight light;
  light.axis = -l;
  light.intensity = glm::dvec3(1.0);
  s.view = {v.x, v.y, v.z};
  return shade(s, {}, physical(&light, 1), NoListener{}).radiance;
}

constexpr double roughnesses[] = {0.0, 0.01, 0.05, 0.1, 0.25, 0.5, 0.75, 1.0};
constexpr double cosines[] = {1e-4, 1e-3, 0.01, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0};

// Two quadratures meet here: that of D Vis (golden/uniform_light.cpp) and that of what it loses (albedo/ggx_albedo.cpp).
TEST(Physical, AWhiteMetalReflectsAllOfUniformLight) {
  for (const double roughness : roughnesses) {
    for (const double mu : cosines) {
      EXPECT_NEAR(furnace(surface(mu, roughness, 1.0)).g, 1.0, 5e-6) << "roughness " << roughness << " n_dot_v " << mu;
    }
  }
  const Surface<double> rough = surface(0.9, 1.0, 1.0);
  EXPECT_LT(UniformLight({}, {1.0, 1.0, 1.0}).shade(rough, {}).g, 0.5) << "of which the ratified text loses more than half";
}

TEST(Physical, AWhiteDielectricAndEveryWhiteMixReflectAllToo) {
  for (const double roughness : roughnesses) {
    for (const double mu : cosines) {
      for (const double metallic : {0.0, 0.4}) {
        EXPECT_NEAR(furnace(surface(mu, roughness, metallic)).g, 1.0, 5e-6) << "roughness " << roughness << " n_dot_v " << mu;
      }
    }
  }
}

Surface<double> any_surface(std::mt19937& random) {
  std::uniform_real_distribution<double> u(0.0, 1.0);
  const double roughness = u(random) < 0.2 ? 0.03 * u(random) : u(random);
  Surface<double> s = surface(std::max(u(random) * u(random), 1e-4), roughness, u(random), {u(random), u(random), 1.0});
  s.base.dielectric_f0 = {u(random), u(random) * u(random), u(random) < 0.2 ? 1.0 : u(random)};
  s.base.specular = u(random) < 0.3 ? 1.0 : u(random);
  return s;
}

TEST(Physical, NothingReflectsMoreThanItReceives) {
  std::mt19937 random(21);
  for (int i = 0; i < 1500; ++i) {
    const Surface<double> s = any_surface(random);
    const Color out = furnace(s);
    for (const double channel : {out.r, out.g, out.b}) {
      EXPECT_LE(channel, 1.0 + 5e-6) << i;
      EXPECT_GE(channel, 0.0) << i;
    }
  }
}

TEST(Physical, SwappingLightAndViewerChangesNothingAndNothingIsNegative) {
  std::mt19937 random(22);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  for (int i = 0; i < 4000; ++i) {
    const Surface<double> s = any_surface(random);
    const auto cosine = [&] { return i % 3 == 0 ? std::exp(-9.0 * u(random)) : std::max(u(random), 1e-4); };
    const glm::dvec3 v = from_normal(cosine(), 0.0);
    const glm::dvec3 l = from_normal(cosine(), 2.0 * brdf::pi * u(random));
    const Color there = reflected(s, v, l) * (1.0 / l.z);
    const Color back = reflected(s, l, v) * (1.0 / v.z);
    EXPECT_NEAR(there.r, back.r, 1e-9 * (1.0 + there.r)) << i;
    EXPECT_NEAR(there.b, back.b, 1e-9 * (1.0 + there.b)) << i;
    EXPECT_GE(std::min({there.r, there.g, there.b}), 0.0) << i;
  }
}

// The sum of the BRDF as it is drawn, light by light, over the hemisphere: what uniform light takes to be so.
Color summed_over_lights(const Surface<double>& s, int rows, int columns) {
  std::vector<PreparedLight> lights;
  for (int i = 0; i < rows; ++i) {
    // Nodes gather at N.L = 0 and 1.
    const double t = (i + 0.5) / rows;
    const double lambda = t * t * (3.0 - 2.0 * t);
    const double solid_angle = 6.0 * t * (1.0 - t) / rows * 2.0 * brdf::pi / columns;
    for (int j = 0; j < columns; ++j) {
      PreparedLight light;
      light.axis = -from_normal(lambda, brdf::pi * (j + 0.5) / columns);
      light.intensity = glm::dvec3(solid_angle);
      lights.push_back(light);
    }
  }
  return shade(s, {}, physical(lights.data(), lights.size()), NoListener{}).radiance;
}

TEST(Physical, UniformLightIsTheSumOverItsDirections) {
  for (const double roughness : {1.0, 0.6, 0.4}) {
    for (const double mu : {0.9, 0.5, 0.25}) {
      for (const double metallic : {0.0, 1.0}) {
        const Surface<double> s = surface(mu, roughness, metallic, {1.0, 0.7, 0.2});
        const Color sum = summed_over_lights(s, 900, 160);
        const Color uniform = furnace(s);
        EXPECT_NEAR(sum.r, 1.0, 2e-5) << "white, roughness " << roughness << " n_dot_v " << mu << " metallic " << metallic;
        EXPECT_NEAR(sum.g, uniform.g, 2e-5) << "roughness " << roughness << " n_dot_v " << mu << " metallic " << metallic;
        EXPECT_NEAR(sum.b, uniform.b, 2e-5) << "roughness " << roughness << " n_dot_v " << mu << " metallic " << metallic;
      }
    }
  }
}

// A second evaluation, from the printed formulas: E and its averages by the split sum, the averages by the midpoint rule.
struct Second {
  double alpha, roughness;
  double e_average = 0, bias_average = 0;

  explicit Second(double r) : alpha(r * r), roughness(r) {
    const int n = 400;
    for (int i = 0; i < n; ++i) {
      const double t = (i + 0.5) / n, mu = t * t * (3.0 - 2.0 * t), weight = 2.0 * mu * 6.0 * t * (1.0 - t) / n;
      const albedo::SplitSum sum = albedo::ggx_split_sum(mu, r);
      e_average += weight * (sum.scale + sum.bias);
      bias_average += weight * sum.bias;
    }
  }

  // F_ms and, in the place of f_ms, (1 - E(l)) (1 - E(v)) / (pi (1 - E_avg)).
  double ms(double f_average) const { return f_average * f_average * e_average / (1 - f_average * (1 - e_average)); }
  double lobe(double l, double v) const {
    const albedo::SplitSum at_l = albedo::ggx_split_sum(l, roughness), at_v = albedo::ggx_split_sum(v, roughness);
    return (1 - at_l.scale - at_l.bias) * (1 - at_v.scale - at_v.bias) / (brdf::pi * (1 - e_average));
  }
  double specular_albedo(double mu, double f0, double strength) const {
    const albedo::SplitSum sum = albedo::ggx_split_sum(mu, roughness);
    return strength * (f0 * sum.scale + sum.bias) + (1 - sum.scale - sum.bias) * ms(strength * (1 + 20 * f0) / 21);
  }
};

TEST(Physical, MeetsASecondEvaluationFromThePrintedFormulas) {
  for (const double roughness : {0.35, 0.7, 1.0}) {
    const Second second(roughness);
    for (const double v : {0.95, 0.4, 0.08}) {
      for (const double l : {0.8, 0.2}) {
        Surface<double> s = surface(v, roughness, 0.3, {0.9, 0.5, 0.2});
        s.base.dielectric_f0 = {0.3, 0.1, 0.05};
        s.base.specular = 0.8;
        const glm::dvec3 view = from_normal(v, 0.0), light = from_normal(l, 2.1);
        const glm::dvec3 h = glm::normalize(view + light);
        const double lobe = static_cast<double>(test::ggx(second.alpha, l, v, h.z)), w = std::pow(1.0 - glm::dot(view, h), 5.0);
        const double f0 = 0.3, strength = 0.8;
        const double average = strength * (f0 * (second.e_average - second.bias_average) + second.bias_average) +
                               (1 - second.e_average) * second.ms(strength * (1 + 20 * f0) / 21);
        const double diffuse =
            (1 - second.specular_albedo(l, f0, strength)) * (1 - second.specular_albedo(v, f0, strength)) / (1 - average);
        const auto expected = [&](double color, double dielectric_f0) {
          const double dielectric = color / brdf::pi * diffuse + strength * (dielectric_f0 + (1 - dielectric_f0) * w) * lobe +
                                    second.ms(strength * (1 + 20 * dielectric_f0) / 21) * second.lobe(l, v);
          const double metal = (color + (1 - color) * w) * lobe + second.ms((1 + 20 * color) / 21) * second.lobe(l, v);
          return l * (0.7 * dielectric + 0.3 * metal);
        };
        const Color ours = reflected(s, view, light);
        EXPECT_NEAR(ours.r, expected(0.9, 0.3), 2e-5 * ours.r) << roughness << ' ' << v << ' ' << l;
        EXPECT_NEAR(ours.g, expected(0.5, 0.1), 2e-5 * ours.g) << roughness << ' ' << v << ' ' << l;
        EXPECT_NEAR(ours.b, expected(0.2, 0.05), 2e-5 * ours.b) << roughness << ' ' << v << ' ' << l;
      }
    }
  }
}

TEST(Physical, AMirrorShowsAPunctualLightNothingButItsDiffusePart) {
  EXPECT_EQ(reflected(surface(0.5, 0.0, 1.0), from_normal(0.5, 0.0), from_normal(0.5, brdf::pi)).g, 0.0);
  const double seen = reflected(surface(0.5, 0.0, 0.0), from_normal(0.5, 0.0), from_normal(0.7, 1.0)).g;
  const auto through = [](double mu) { return 0.96 * (1.0 - std::pow(1.0 - mu, 5.0)); };
  EXPECT_NEAR(seen, 0.7 / brdf::pi * through(0.5) * through(0.7) / (0.96 * 20.0 / 21.0), 1e-12);
  Surface<double> opaque = surface(0.5, 0.3, 0.0);
  opaque.base.dielectric_f0 = {1.0, 1.0, 1.0};  // ior 0: nothing is let through
  const Surface<double> metal = surface(0.5, 0.3, 1.0);
  EXPECT_NEAR(reflected(opaque, from_normal(0.5, 0.0), from_normal(0.7, 1.0)).g,
              reflected(metal, from_normal(0.5, 0.0), from_normal(0.7, 1.0)).g, 1e-12);
}

TEST(Physical, BatchesAgreeWithOneAtATime) {
  if (!number::has_batch()) {
    return;
  }  // there is only one way on such a machine
  std::mt19937 random(23);
  std::vector<Surface<double>> surfaces;
  for (int i = 0; i < 41; ++i) {
    surfaces.push_back(any_surface(random));
    if (i % 6 == 0) {
      surfaces.back().base.alpha = 0.0;
    }
  }
  const std::vector<PreparedLight> lights =
      prepare_lights({test::directional({0.3, 0.4, 1.0}), test::directional({-1.0, 0.1, 0.2}), test::directional({0.0, 0.0, -1.0})});
  std::vector<std::uint32_t> order(surfaces.size());
  std::iota(order.begin(), order.end(), 0u);
  std::vector<Shaded<double>> one(surfaces.size());
  std::vector<Shaded<double>> four(surfaces.size());
  shade_all_scalar(surfaces.data(), order.data(), order.size(), {}, physical(lights.data(), lights.size()), one.data());
  shade_all_batch(surfaces.data(), order.data(), order.size(), {}, physical(lights.data(), lights.size()), four.data());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_TRUE(std::isfinite(one[i].radiance.r));
    EXPECT_NEAR(one[i].radiance.r, four[i].radiance.r, 1e-11 * (1.0 + one[i].radiance.r)) << i;
    EXPECT_NEAR(one[i].radiance.b, four[i].radiance.b, 1e-11 * (1.0 + one[i].radiance.b)) << i;
  }
}

scene::Scene white_metal_sphere(double roughness) {
  scene::Material m;
  m.roughness_factor = roughness;
  return test::scene_with(test::sphere(48, 24), m, test::orthographic_at(5.0, 1.1), {});
}

TEST(Physical, AWhiteMetalSphereVanishesInAFurnace) {
  scene::Environment white;
  white.uniform = {1.0, 1.0, 1.0};
  for (const double roughness : {0.0, 0.2, 0.6, 1.0}) {
    Settings settings = test::settings_for(24, 24);
    settings.environment = &white;
    settings.sheen.model = albedo::Model::Physical;
    const scene::Scene s = white_metal_sphere(roughness);
    const image::Image im = render(s, settings);
    int covered = 0;
    for (int y = 0; y < 24; ++y) {
      for (int x = 0; x < 24; ++x) {
        if (im.at(x, y, 3) == 1.0f) {
          ++covered;
          EXPECT_NEAR(im.at(x, y, 1), 1.0f, 1e-5f) << roughness << ' ' << x << ' ' << y;
        }
      }
    }
    EXPECT_GT(covered, 200);
  }
}

// An image is sampled direction by direction: the same furnace by another way.
TEST(Physical, UnderAWhiteImageSamplingFindsTheFurnace) {
  scene::Environment image;
  image.width = 8;
  image.height = 4;
  image.texels.assign(32, glm::vec3(1.0f));
  const EnvironmentLight light(image);
  const SamplingGoal goal{0.0005, 1u << 20, 3};
  const DirectionPool pool(light, goal.seed);
  for (const double roughness : {0.0, 0.2, 0.7, 1.0}) {
    for (const double mu : {0.9, 0.2}) {
      for (const double metallic : {0.0, 1.0}) {
        const Surface<double> s = surface(mu, roughness, metallic, {1.0, 1.0, 0.5});
        const Estimate ours = test::refined_estimate(s, {}, {physical(), &light, &pool}, goal, 0);
        EXPECT_NEAR(ours.mean.r, 1.0, 4.0 * ours.standard_error.r + 1e-5) << roughness << ' ' << mu;
        EXPECT_NEAR(ours.mean.b, furnace(s).b, 4.0 * ours.standard_error.b + 1e-5) << roughness << ' ' << mu;
        EXPECT_LT(ours.standard_error.r, 0.002);
      }
    }
  }
}

TEST(Physical, SheenAndClearcoatAreLeftOut) {
  scene::Material plain = test::cloth(0.4);
  plain.sheen = {};
  plain.emissive_factor = {0.1, 0.2, 0.3};
  scene::Material layered = plain;
  layered.sheen = test::cloth(0.4).sheen;
  layered.clearcoat.factor = 1.0;
  layered.clearcoat.roughness_factor = 0.2;
  Settings settings = test::settings_for(10, 10, true);
  settings.sheen.model = albedo::Model::Physical;
  const auto drawn = [&](const scene::Material& m) {
    return render(test::scene_with(test::square(2.0, 0.0, 1.0), m, test::camera_at(2.0), {test::directional({0.4, 0.3, 1.0})}), settings);
  };
  EXPECT_EQ(drawn(plain).data, drawn(layered).data);
}

}  // namespace
}  // namespace sheen::golden
