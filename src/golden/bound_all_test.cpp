#include "golden/bound_all.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "albedo/interpolant.h"
#include "golden/uncertain_surfaces_test.h"
#include "number/bounded_functions.h"
#include "number/cpu.h"

namespace sheen::golden {
namespace {

void expect_same(const Bound& one, const Bound& four) {
  ASSERT_EQ(one.is_bounded(), four.is_bounded());
  if (one.is_bounded()) {
    // The elementary functions of either side differ by ulps of double.
    const double room = 1e-12 * (std::abs(one.center()) + one.deviation());
    EXPECT_NEAR(one.center(), four.center(), room);
    EXPECT_NEAR(one.shift_x(), four.shift_x(), room);
    EXPECT_NEAR(one.shift_y(), four.shift_y(), room);
    EXPECT_NEAR(one.radius(), four.radius(), room);
    EXPECT_NEAR(one.range().lower, four.range().lower, room);
    EXPECT_NEAR(one.range().upper, four.range().upper, room);
  }
}

/// Many at a time, highp is shaded in float, and without ranges where that holds all: then all that one alone encloses lies inside, and
/// hardly more.
void expect_alike(const Bound& one, const Bound& many) {
  ASSERT_EQ(one.is_bounded(), many.is_bounded());
  if (one.is_bounded()) {
    // A form reaches as far to one side as to the other.
    const bool is_wide = one.deviation() > 5e-3 * std::abs(one.center());
    const double apart = std::abs(one.center() - many.center());
    EXPECT_LE(apart, 2e-6 * std::abs(one.center()) + 0.1 * one.deviation());
    EXPECT_GE(many.deviation(), (1.0 - 1e-9) * one.deviation() - apart);
    EXPECT_LE(many.deviation(), (is_wide ? 2.0 : 1.2) * one.deviation());
  }
}

struct Comparison {
  std::vector<Surface<Bound>> surfaces;
  std::vector<PreparedLight> lights;
  int bounded = 0;

  Comparison() {
    test::UncertainSurfaces make;
    for (int i = 0; i < 203; ++i) {
      surfaces.push_back(make.next());
    }
    lights = test::few_lights();
  }

  Lighting under_lights(albedo::Visibility visibility, const albedo::Interpolant& e) const {
    Lighting lighting;
    lighting.lights = lights.data();
    lighting.light_count = lights.size();
    lighting.sheen = {visibility, albedo::AlbedoScaling::Full};
    lighting.albedo.interpolant = &e;
    return lighting;
  }

  void compare(const Lighting& lighting, Precision lobes, Layers layers = {true, true}) {
    std::vector<std::uint32_t> order(surfaces.size());
    std::iota(order.rbegin(), order.rend(), 0u);
    std::vector<brdf::Rgb<Bound>> one(surfaces.size());
    std::vector<brdf::Rgb<Bound>> four(surfaces.size());
    const BoundJob job{surfaces.data(), order.data(), order.size(), layers, lobes};
    bound_all_scalar(job, lighting, one.data());
    bound_all_batch(job, lighting, four.data());
    const auto expect = lobes == Precision::Mediump ? expect_same : expect_alike;
    for (std::size_t i = 0; i < one.size(); ++i) {
      expect(one[i].r, four[i].r);
      expect(one[i].g, four[i].g);
      expect(one[i].b, four[i].b);
      bounded += one[i].r.is_bounded() ? 1 : 0;
      if (::testing::Test::HasFailure()) {
        FAIL() << "surface " << i;
      }
    }
  }
};

TEST(BoundAll, BatchesAgreeWithOneAtATime) {
  if (!number::has_batch()) {
    return;  // there is only one way on such a machine
  }
  Comparison c;
  for (const auto visibility : {albedo::Visibility::Charlie, albedo::Visibility::Ashikhmin, albedo::Visibility::Refined}) {
    const albedo::Interpolant e(visibility);
    const Lighting lighting = c.under_lights(visibility, e);
    c.compare(lighting, Precision::Highp);
    c.compare(lighting, Precision::Mediump);
  }
  EXPECT_GT(c.bounded, 400);
}

TEST(BoundAll, BatchesOfThePhysicalModelAgreeWithOneAtATime) {
  if (!number::has_batch()) {
    return;
  }
  Comparison c;
  const albedo::GgxInterpolant ggx;
  Lighting lighting;
  lighting.lights = c.lights.data();
  lighting.light_count = c.lights.size();
  lighting.base_albedo.interpolant = &ggx;
  c.compare(lighting, Precision::Highp, {false, false});
  EXPECT_GT(c.bounded, 50);
  const Bound alpha = Bound(0.4) * Bound(0.4);
  for (Surface<Bound>& s : c.surfaces) {
    s.base.alpha = alpha;
  }
  const GgxAround around = ggx_around(ggx, alpha);
  lighting.base_albedo.around = &around;
  c.bounded = 0;
  c.compare(lighting, Precision::Highp, {false, false});
  c.compare(lighting, Precision::Mediump, {false, false});
  EXPECT_GT(c.bounded, 50);
}

TEST(BoundAll, ACoatOfTheBasesNormalIsShadedAsOneOfItsOwn) {
  Comparison c;
  for (Surface<Bound>& s : c.surfaces) {
    s.coat_normal = s.normal;
  }
  std::vector<std::uint32_t> order(c.surfaces.size());
  std::iota(order.begin(), order.end(), 0u);
  const albedo::Interpolant e(albedo::Visibility::Charlie);
  Lighting lighting;
  lighting.lights = c.lights.data();
  lighting.light_count = c.lights.size();
  lighting.albedo.interpolant = &e;
  std::vector<brdf::Rgb<Bound>> two(c.surfaces.size());
  std::vector<brdf::Rgb<Bound>> one(c.surfaces.size());
  int bounded = 0;
  for (const auto& shade_all : {bound_all_scalar, bound_all}) {
    shade_all({c.surfaces.data(), order.data(), order.size(), {true, true, false}, Precision::Highp}, lighting, two.data());
    shade_all({c.surfaces.data(), order.data(), order.size(), {true, true, true}, Precision::Highp}, lighting, one.data());
    for (std::size_t i = 0; i < one.size(); ++i) {
      ASSERT_EQ(one[i].g.is_bounded(), two[i].g.is_bounded());
      if (one[i].g.is_bounded()) {
        EXPECT_EQ(one[i].g.center(), two[i].g.center());
        EXPECT_EQ(one[i].g.deviation(), two[i].g.deviation());
        ++bounded;
      }
    }
  }
  EXPECT_GT(bounded, 200);
}

TEST(BoundAll, CurvesAboutOneRoughnessAgreeWithTheInterpolant) {
  Comparison c;
  const albedo::Interpolant e(albedo::Visibility::Charlie);
  const Bound roughness(0.3);
  const AlbedoAround around(e, roughness);
  std::vector<std::uint32_t> order;
  for (std::size_t i = 0; i < c.surfaces.size(); ++i) {
    if (!c.surfaces[i].sheen_roughness.is_exact()) {
      order.push_back(static_cast<std::uint32_t>(i));
    }
  }
  Lighting lighting;
  lighting.lights = c.lights.data();
  lighting.light_count = c.lights.size();
  lighting.albedo.interpolant = &e;
  std::vector<brdf::Rgb<Bound>> slow(c.surfaces.size());
  std::vector<brdf::Rgb<Bound>> fast(c.surfaces.size());
  const BoundJob job{c.surfaces.data(), order.data(), order.size(), {true, false}, Precision::Highp};
  std::vector<brdf::Rgb<Bound>> four(c.surfaces.size());
  bound_all_scalar(job, lighting, slow.data());
  lighting.albedo.around = &around;
  bound_all_scalar(job, lighting, fast.data());
  bound_all(job, lighting, four.data());
  for (const std::uint32_t i : order) {
    expect_alike(fast[i].g, four[i].g);
    EXPECT_EQ(slow[i].g.is_bounded(), fast[i].g.is_bounded());
    if (slow[i].g.is_bounded()) {
      EXPECT_NEAR(slow[i].g.center(), fast[i].g.center(), 1e-9 * (1.0 + slow[i].g.center()));
      EXPECT_NEAR(slow[i].g.deviation(), fast[i].g.deviation(), 1e-9 + 1e-4 * slow[i].g.deviation());
    }
  }
}

/// That all a surface may be shaded to is within what a batch finds, and that it loses none that one alone does not. The eleventh is lost.
/// Returns the median share of the batch's deviation in that of one alone.
double expect_held(Comparison& c, std::mt19937& random) {
  std::vector<std::uint32_t> order(c.surfaces.size());
  std::iota(order.begin(), order.end(), 0u);
  const albedo::Interpolant e(albedo::Visibility::Charlie);
  const albedo::GgxInterpolant ggx;
  const AlbedoAround around(e, Bound(0.3));
  for (Surface<Bound>& s : c.surfaces) {
    s.sheen_roughness = Bound(0.3);
  }
  std::vector<double> shares;
  for (const int kind : {0, 1, 2, 3}) {
    const bool physical = kind == 2;
    for (std::size_t i = 0; kind == 3 && i < c.surfaces.size(); ++i) {  // each of its own roughness, hardly open to half
      const double center = std::uniform_real_distribution<double>(0.2, 0.9)(random);
      c.surfaces[i].sheen_roughness = Bound::within(center, 0.005 * std::pow(100.0, static_cast<double>(i) / 203) * center);
    }
    Lighting lighting;
    lighting.lights = c.lights.data();
    lighting.light_count = c.lights.size();
    lighting.albedo.interpolant = &e;
    lighting.albedo.around = kind == 1 ? &around : nullptr;
    lighting.base_albedo.interpolant = physical ? &ggx : nullptr;
    const Layers layers{!physical, !physical};
    std::vector<brdf::Rgb<Bound>> one(c.surfaces.size());
    bound_all_scalar({c.surfaces.data(), order.data(), order.size(), layers, Precision::Highp}, lighting, one.data());
    std::vector<brdf::Rgb<Bound>> many(c.surfaces.size());
    bound_all_batch({c.surfaces.data(), order.data(), order.size(), layers, Precision::Highp}, lighting, many.data());
    int bounded = 0;
    int missed = 0;
    for (std::size_t i = 0; i < many.size(); ++i) {
      missed += one[i].g.is_bounded() && !many[i].g.is_bounded() ? 1 : 0;
      bounded += many[i].g.is_bounded() ? 1 : 0;
      if (many[i].g.is_bounded() && one[i].g.deviation() > 0.0) {
        shares.push_back(many[i].g.deviation() / one[i].g.deviation());
      }
      for (int k = 0; k < 30 && many[i].g.is_bounded(); ++k) {
        const double there = shade(test::held(c.surfaces[i], random), layers, lighting, NoListener{}).radiance.g;
        EXPECT_LE(std::abs(there - many[i].g.center()), many[i].g.deviation()) << "surface " << i;
      }
    }
    EXPECT_FALSE(many[11].g.is_bounded());
    EXPECT_GT(bounded, 60);
    EXPECT_EQ(missed, 0) << "what is lost by ranges is done with more care";
  }
  std::nth_element(shares.begin(), shares.begin() + static_cast<std::ptrdiff_t>(shares.size() / 2), shares.end());
  return shares[shares.size() / 2];
}

// Normals that a map leaves open, which are done by ranges where they are narrower.
TEST(BoundAll, BatchesHoldSurfacesOfOpenNormals) {
  if (!number::has_batch()) {
    return;
  }
  std::mt19937 random(7);
  Comparison c;
  for (Surface<Bound>& s : c.surfaces) {
    for (Bound* axis : {&s.normal.x, &s.normal.y, &s.normal.z, &s.coat_normal.x, &s.coat_normal.y, &s.coat_normal.z}) {
      *axis = Bound::within(axis->center(), std::uniform_real_distribution<double>(0.002, 0.08)(random));
    }
  }
  // Seen from where E turns, whatever the normal.
  for (std::size_t i = 0; i < c.surfaces.size(); i += 3) {
    Surface<Bound>& s = c.surfaces[i];
    const glm::dvec3 n(s.normal.x.center(), s.normal.y.center(), s.normal.z.center());
    const glm::dvec3 across = glm::normalize(glm::cross(n, glm::dvec3(0.3, 1.0, 0.2)) + 0.03 * n);
    s.view = {Bound(across.x), Bound(across.y), Bound(across.z)};
  }
  c.surfaces[11].normal.x = Bound::unbounded(0.3);
  expect_held(c, random);
}

// Roughnesses and colours that a minified texture leaves open, likewise.
TEST(BoundAll, BatchesHoldSurfacesOfVagueRoughnessAndColour) {
  if (!number::has_batch()) {
    return;
  }
  std::mt19937 random(12);
  Comparison c;
  const auto vague = [&random](double least, double most) {
    const double center = std::uniform_real_distribution<double>(0.3, 0.7)(random);
    return Bound::within(center, std::uniform_real_distribution<double>(least, most)(random) * center);
  };
  for (std::size_t i = 0; i < c.surfaces.size(); ++i) {
    Surface<Bound>& s = c.surfaces[i];
    if (i < 104 || i % 2 == 0) {  // the first so vague that no form holds any of a batch
      s.base.alpha = i < 104 ? vague(0.8, 0.95) : vague(0.05, 0.8);
      s.coat_alpha = vague(0.05, 0.9);
    }
    if (i % 3 != 0) {
      s.base.color = {vague(0.05, 0.9), vague(0.05, 0.9), vague(0.05, 0.9)};
      s.sheen_color = {vague(0.05, 0.9), vague(0.05, 0.9), vague(0.05, 0.9)};
    }
  }
  c.surfaces[11].normal.x = Bound::unbounded(0.3);
  EXPECT_LT(expect_held(c, random), 1.1);
  // In the last binade of floats, which ranges in float do without.
  c.lights[0].intensity = glm::dvec3(2.5e38);
  expect_held(c, random);
}

// Along the normal, where Lambda(N.V) is found by ranges: of smooth cloth its form is lost.
TEST(BoundAll, BatchesHoldClothSeenAlongItsNormal) {
  if (!number::has_batch()) {
    return;
  }
  std::mt19937 random(17);
  Comparison c;
  for (std::size_t i = 0; i < c.surfaces.size(); ++i) {
    Surface<Bound>& s = c.surfaces[i];
    const auto about = [](const Bound& x) { return Bound::within(x.center(), 5e-6); };
    s.view = {about(s.normal.x), about(s.normal.y), about(s.normal.z)};
    const std::array<double, 5> roughnesses{1e-38, 1e-4, 0.01, 0.05, 0.5};
    s.sheen_roughness = Bound(roughnesses.at(i % roughnesses.size()));
  }
  for (const auto visibility : {albedo::Visibility::Charlie, albedo::Visibility::Refined}) {
    const albedo::Interpolant e(visibility);
    const Lighting lighting = c.under_lights(visibility, e);
    std::vector<std::uint32_t> order(c.surfaces.size());
    std::iota(order.begin(), order.end(), 0u);
    std::vector<brdf::Rgb<Bound>> one(order.size());
    std::vector<brdf::Rgb<Bound>> many(order.size());
    const BoundJob job{c.surfaces.data(), order.data(), order.size(), {true, true}, Precision::Highp};
    bound_all_scalar(job, lighting, one.data());
    bound_all_batch(job, lighting, many.data());
    for (std::size_t i = 0; i < many.size(); ++i) {
      ASSERT_EQ(many[i].g.is_bounded(), one[i].g.is_bounded()) << "surface " << i;
      EXPECT_LE(many[i].g.deviation(), 2.0 * one[i].g.deviation()) << "surface " << i;
      for (int k = 0; k < 30 && many[i].g.is_bounded(); ++k) {
        const double there = shade(test::held(c.surfaces[i], random), Layers{true, true}, lighting, NoListener{}).radiance.g;
        EXPECT_LE(std::abs(there - many[i].g.center()), many[i].g.deviation()) << "surface " << i;
      }
    }
  }
}

TEST(BendAll, BatchesAgreeWithOneAtATime) {
  if (!number::has_batch()) {
    return;
  }
  test::UncertainSurfaces make;
  std::vector<MappedNormal<Bound>> maps;
  for (int i = 0; i < 101; ++i) {
    maps.push_back(make.map());
  }
  std::vector<Vec3<Bound>> one(maps.size());
  std::vector<Vec3<Bound>> four(maps.size());
  bend_all_scalar(maps.data(), maps.size(), one.data());
  bend_all_batch(maps.data(), maps.size(), four.data());
  for (std::size_t i = 0; i < maps.size(); ++i) {
    expect_same(one[i].x, four[i].x);
    expect_same(one[i].y, four[i].y);
    expect_same(one[i].z, four[i].z);
  }
}

}  // namespace
}  // namespace sheen::golden
