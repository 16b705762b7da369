#include "golden/shade.h"

#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "golden/shade_all.h"
#include "number/cpu.h"

namespace sheen::golden {
namespace {

Vec3<double> vec(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}

Surface<double> plain_surface() {
  Surface<double> s{};
  s.normal = s.coat_normal = s.view = {0.0, 0.0, 1.0};
  s.base = {{0.5, 0.5, 0.5}, 0.0, 0.25, {0.04, 0.04, 0.04}, 1.0};
  return s;
}

std::vector<PreparedLight> one_light(glm::dvec3 toward, double lux = 1.0) {
  scene::Light light;
  light.direction = -toward;
  light.intensity = lux;
  return prepare_lights({light});
}

struct Keep {
  static constexpr bool wants_e_l = true;
  std::vector<LightPart<double>>& parts;
  void view(const ViewPart<double>&) {}
  void light(std::size_t, const LightPart<double>& p) { parts.push_back(p); }
};

// Computed apart in long double: r = .5, N.V = .5, N.L = .6, azimuth between V and L .5 rad.
TEST(Shade, SheenTermsMeetTheNumberComputedIndependently) {
  const glm::dvec3 v(std::sqrt(0.75), 0.0, 0.5);
  const glm::dvec3 l(0.8 * std::cos(0.5), 0.8 * std::sin(0.5), 0.6);
  Surface<double> s = plain_surface();
  s.view = vec(v);
  s.sheen_color = {1.0, 0.5, 0.25};
  s.sheen_roughness = 0.5;
  const albedo::Interpolant e(albedo::Visibility::Charlie);
  const std::vector<PreparedLight> lights = one_light(l);
  Lighting lighting{lights.data(), lights.size(), {}, {&e}, {}};
  std::vector<LightPart<double>> parts;
  shade(s, {true, false}, lighting, Keep{parts});
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_NEAR(parts[0].d * parts[0].v, 0.06618617242, 1e-11);
  EXPECT_NEAR(parts[0].sheen.r, 0.06618617242, 1e-11);
  EXPECT_NEAR(parts[0].sheen.b, 0.25 * 0.06618617242, 1e-11);
}

// A unit vector's square may be an ulp above 1, and Lambda takes the root of 1 - N.L.
TEST(Shade, ALightAlongTheNormalIsFinite) {
  const albedo::Interpolant e(albedo::Visibility::Charlie);
  int above_one = 0;
  for (int i = 0; i < 200; ++i) {
    const glm::dvec3 n = glm::normalize(glm::dvec3(std::sin(i * 1.7), std::cos(i * 2.3), std::sin(i * 0.9 + 1.0)));
    Surface<double> s = plain_surface();
    s.normal = s.coat_normal = vec(n);
    s.view = vec(glm::normalize(n + glm::dvec3(0.3, 0.2, 0.1)));
    s.sheen_color = {0.8, 0.8, 0.8};
    s.sheen_roughness = 0.5;
    s.clearcoat = 1.0;
    s.coat_alpha = 0.1;
    const std::vector<PreparedLight> lights = one_light(n);
    above_one += dot(s.normal, vec(-lights[0].axis)) > 1.0 ? 1 : 0;
    EXPECT_TRUE(std::isfinite(shade(s, {true, true}, {lights.data(), lights.size(), {}, {&e}, {}}, NoListener{}).radiance.g)) << i;
  }
  EXPECT_GT(above_one, 0) << "the case was met";
}

TEST(Shade, FactorsChangeTheTermTheyName) {
  Surface<double> s = plain_surface();
  s.view = vec(glm::normalize(glm::dvec3(0.4, 0.1, 0.6)));
  s.sheen_color = {0.8, 0.8, 0.8};
  s.sheen_roughness = 0.5;
  s.clearcoat = 1.0;
  s.coat_alpha = 0.2;
  s.emission = {1.0, 2.0, 3.0};
  const albedo::Interpolant e(albedo::Visibility::Charlie);
  const std::vector<PreparedLight> lights = one_light(glm::normalize(glm::dvec3(0.5, 0.2, 0.7)));
  const auto evaluate = [&](const TermFactors& factors, std::vector<LightPart<double>>& parts) {
    return shade(s, {true, true}, {lights.data(), lights.size(), {}, {&e}, factors}, Keep{parts}).radiance;
  };
  std::vector<LightPart<double>> plain;
  const auto before = evaluate({}, plain);
  const auto changed = [&](const TermFactors& factors) {
    std::vector<LightPart<double>> parts;
    const auto after = evaluate(factors, parts);
    return std::array<double, 4>{parts[0].sheen.r / plain[0].sheen.r, parts[0].base.r / plain[0].base.r, parts[0].coat.r / plain[0].coat.r,
                                 (after.r - parts[0].sheen.r - parts[0].base.r - parts[0].coat.r) /
                                     (before.r - plain[0].sheen.r - plain[0].base.r - plain[0].coat.r)};
  };
  const auto expect = [&](const TermFactors& factors, const std::array<double, 4>& want) {
    const auto got = changed(factors);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_NEAR(got[i], want[i], 1e-12) << "sheen, base, coat, emission: " << i;
    }
  };
  TermFactors f;
  f.distribution = 2.0;
  expect(f, {2.0, 1.0, 1.0, 1.0});
  f = {};
  f.visibility = 3.0;
  expect(f, {3.0, 1.0, 1.0, 1.0});
  f = {};
  f.scale = 0.5;
  expect(f, {1.0, 0.5, 1.0, 1.0});
  f = {};
  f.base = 0.25;
  expect(f, {1.0, 0.25, 1.0, 1.0});
  f = {};
  f.coat_lobe = 4.0;
  expect(f, {1.0, 1.0, 4.0, 1.0});
  f = {};
  f.emission = 5.0;
  expect(f, {1.0, 1.0, 1.0, 5.0});
  f = {};
  f.coat_weight = 0.0;
  const double below = 1.0 / (1.0 - brdf::clearcoat_weight(1.0, s.view.z));
  expect(f, {below, below, 0.0, below});
}

// One lookup is exact but for Charlie below .008.
TEST(Shade, SingleLookupDiffersOnlyWhereCharlieTurns) {
  const albedo::Interpolant e(albedo::Visibility::Charlie);
  const auto difference = [&](double n_dot_v, double n_dot_l) {
    Surface<double> s = plain_surface();
    s.view = {std::sqrt(1.0 - n_dot_v * n_dot_v), 0.0, n_dot_v};
    s.sheen_color = {1.0, 1.0, 1.0};
    s.sheen_roughness = 0.3;
    const std::vector<PreparedLight> lights = one_light({0.0, std::sqrt(1.0 - n_dot_l * n_dot_l), n_dot_l});
    return shade(s, {true, false}, {lights.data(), lights.size(), {}, {&e}, {}}, NoListener{}).lookup.r;
  };
  EXPECT_EQ(difference(0.3, 0.7), 0.0);
  EXPECT_EQ(difference(0.7, 0.01), 0.0);
  double worst = 0.0;
  for (const double mu : {2e-4, 1e-3, 3e-3, 6e-3}) {
    worst = std::max(worst, std::max(difference(mu, 8e-3), difference(8e-3, mu)));
  }
  EXPECT_GT(worst, 0.0);
}

TEST(Shade, BatchesAgreeWithOneAtATime) {
  if (!number::has_batch()) {
    return;
  }  // there is only one way on such a machine
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  const auto direction = [&] { return glm::normalize(glm::dvec3(u(random) - 0.5, u(random) - 0.5, u(random) - 0.3)); };
  std::vector<Surface<double>> surfaces;
  for (int i = 0; i < 61; ++i) {
    Surface<double> s = plain_surface();
    s.position = {u(random), u(random), u(random)};
    s.normal = vec(direction());
    s.coat_normal = vec(direction());
    s.view = vec(direction());
    s.base = {{u(random), u(random), u(random)}, u(random), u(random), {0.04, 0.1, 1.0}, u(random)};
    s.sheen_color = {u(random), u(random), u(random)};
    s.sheen_roughness = i % 5 == 0 ? 0.0 : u(random);
    s.clearcoat = u(random);
    s.coat_alpha = i % 7 == 0 ? 0.0 : u(random);
    s.emission = {u(random), 0.0, u(random)};
    surfaces.push_back(s);
  }
  scene::Light point;
  point.type = scene::LightType::Spot;
  point.position = {0.0, 1.0, 3.0};
  point.range = 5.0;
  std::vector<scene::Light> lights(2, point);
  lights[1] = scene::Light{};
  const std::vector<PreparedLight> prepared = prepare_lights(lights);
  std::vector<std::uint32_t> order(surfaces.size());
  std::iota(order.rbegin(), order.rend(), 0u);
  for (const auto visibility : {albedo::Visibility::Charlie, albedo::Visibility::Ashikhmin, albedo::Visibility::Refined}) {
    const albedo::Interpolant e(visibility);
    const Lighting lighting{prepared.data(), prepared.size(), {visibility, albedo::AlbedoScaling::Full}, {&e}, {}};
    std::vector<Shaded<double>> one(surfaces.size());
    std::vector<Shaded<double>> four(surfaces.size());
    shade_all_scalar(surfaces.data(), order.data(), order.size(), {true, true}, lighting, one.data());
    shade_all_batch(surfaces.data(), order.data(), order.size(), {true, true}, lighting, four.data());
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_TRUE(std::isfinite(one[i].radiance.r));
      EXPECT_NEAR(one[i].radiance.r, four[i].radiance.r, 1e-11 * (1.0 + std::abs(one[i].radiance.r))) << i;
      EXPECT_NEAR(one[i].radiance.b, four[i].radiance.b, 1e-11 * (1.0 + std::abs(one[i].radiance.b))) << i;
      EXPECT_NEAR(one[i].lookup.g, four[i].lookup.g, 1e-11 * (1.0 + one[i].lookup.g)) << i;
      EXPECT_EQ(one[i].mirrored, four[i].mirrored) << i;
    }
  }
}

// KHR_lights_punctual: inverse square, window of the range, cone.
TEST(Lights, AttenuateAsTheExtensionSays) {
  scene::Light light;
  light.type = scene::LightType::Point;
  light.position = {0.0, 0.0, 2.0};
  light.intensity = 12.0;
  light.color = {1.0, 0.5, 0.0};
  const auto at = [&](glm::dvec3 p) { return arriving(prepare_lights({light})[0], vec(p)); };
  EXPECT_DOUBLE_EQ(at({0.0, 0.0, 0.0}).irradiance.r, 3.0);
  EXPECT_DOUBLE_EQ(at({0.0, 0.0, 0.0}).irradiance.g, 1.5);
  EXPECT_EQ(at({0.0, 0.0, 2.0}).irradiance.r, 0.0) << "no direction, so no light";
  light.range = 4.0;
  EXPECT_DOUBLE_EQ(at({0.0, 0.0, 0.0}).irradiance.r, 3.0 * (1.0 - 1.0 / 16.0));
  EXPECT_EQ(at({0.0, 0.0, -2.5}).irradiance.r, 0.0);
  light.range = std::numeric_limits<double>::infinity();
  light.type = scene::LightType::Spot;
  light.inner_cone = 0.2;
  light.outer_cone = 0.6;
  const double angle = 0.4;
  const glm::dvec3 below(2.0 * std::tan(angle), 0.0, 0.0);
  const double cone = (std::cos(angle) - std::cos(0.6)) / (std::cos(0.2) - std::cos(0.6));
  EXPECT_NEAR(at(below).irradiance.r, 12.0 * cone * cone / glm::dot(below - light.position, below - light.position), 1e-12);
  EXPECT_DOUBLE_EQ(at({0.1, 0.0, 0.0}).irradiance.r, 12.0 / 4.01);
  EXPECT_EQ(at({3.0, 0.0, 0.0}).irradiance.r, 0.0);
}

}  // namespace
}  // namespace sheen::golden
