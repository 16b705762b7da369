#include "golden/parts.h"

#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "albedo/interpolant.h"
#include "golden/bound_all.h"
#include "golden/bounded_samples.h"
#include "golden/shade.h"
#include "golden/uncertain_surfaces_test.h"
#include "number/cpu.h"

namespace sheen::golden {
namespace {

/// Surfaces that normal maps leave open, under a few lights, and their parts.
struct Parts {
  std::vector<Surface<Bound>> surfaces;
  std::vector<CoatSurface<Bound>> coats;
  std::vector<std::uint32_t> order;
  std::vector<PreparedLight> lights;
  std::mt19937 random{7};
  std::vector<CoatSum<Bound>> coat;
  std::vector<BelowSum<Bound>> below;

  Parts() {
    test::UncertainSurfaces make;
    for (int i = 0; i < 203; ++i) {
      Surface<Bound> s = make.next();
      for (Bound* axis : {&s.normal.x, &s.normal.y, &s.normal.z, &s.coat_normal.x, &s.coat_normal.y, &s.coat_normal.z}) {
        *axis = Bound::within(axis->center(), std::uniform_real_distribution<double>(0.002, 0.08)(random));
      }
      s.sheen_roughness = Bound(0.3);
      surfaces.push_back(s);
    }
    surfaces[11].normal.x = Bound::unbounded(0.3);
    surfaces[12].coat_normal.y = Bound::unbounded(0.3);
    for (const Surface<Bound>& s : surfaces) {
      coats.push_back({s.position, s.view, s.coat_normal, s.clearcoat, s.coat_alpha});
    }
    order.resize(surfaces.size());
    std::iota(order.rbegin(), order.rend(), 0u);
    lights = test::few_lights();
  }

  void shade_parts(const Lighting& lighting, Layers layers, Precision lobes, bool batch) {
    coat.assign(surfaces.size(), {});
    below.assign(surfaces.size(), {});
    std::vector<BelowSurface<Bound>> at;
    if (layers.clearcoat) {
      (batch ? bound_coats_batch : bound_coats_scalar)({coats.data(), order.data(), order.size(), lobes}, lighting, coat.data());
    }
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      at.push_back({surfaces[i].normal, layers.clearcoat ? coat[i].weight : Bound(0.0)});
    }
    // Whatever the surfaces' own normals are.
    std::vector<Surface<Bound>> others = surfaces;
    for (Surface<Bound>& s : others) {
      s.normal = s.view;
    }
    const std::vector<std::uint32_t> own = [this] {
      std::vector<std::uint32_t> all(surfaces.size());
      std::iota(all.begin(), all.end(), 0u);
      return all;
    }();
    (batch ? bound_below_batch : bound_below_scalar)({others.data(), at.data(), own.data(), order.data(), order.size(), layers, lobes},
                                                     lighting, below.data());
  }
};

/// Adds the sizes of what lights add below the coat.
struct Sizes {
  static constexpr bool wants_e_l = false;
  double below = 0;
  double least = 0;
  void view(const ViewPart<double>& part) { below += part.emission.g; }
  void light(std::size_t, const LightPart<double>& part) {
    below += std::abs(part.sheen.g) + std::abs(part.base.g);
    least = std::min(least, part.base.g);
  }
};

struct Case {
  const char* name;
  albedo::Visibility visibility;
  albedo::AlbedoScaling scaling;
  Layers layers;
  bool around, physical;
  Precision lobes;
};

TEST(Parts, AddUpToAllThatSurfacesMayShow) {
  using albedo::AlbedoScaling;
  using albedo::Visibility;
  const std::vector<Case> cases{
      {"lacquered cloth", Visibility::Charlie, AlbedoScaling::Full, {true, true}, true, false, Precision::Highp},
      {"of any roughness", Visibility::Ashikhmin, AlbedoScaling::View, {true, true}, false, false, Precision::Highp},
      {"cloth", Visibility::Refined, AlbedoScaling::Full, {true, false}, true, false, Precision::Highp},
      {"unclamped", Visibility::Ashikhmin, AlbedoScaling::Literal, {true, true}, true, false, Precision::Highp},
      {"lacquer", Visibility::Charlie, AlbedoScaling::Full, {false, true}, false, false, Precision::Highp},
      {"physical", Visibility::Charlie, AlbedoScaling::Full, {false, true}, false, true, Precision::Highp},
      {"physical of one alpha", Visibility::Charlie, AlbedoScaling::Full, {false, true}, true, true, Precision::Highp},
      {"mediump", Visibility::Charlie, AlbedoScaling::Full, {true, true}, true, false, Precision::Mediump},
  };
  const albedo::GgxInterpolant ggx;
  const Bound alpha = Bound(0.4) * Bound(0.4);
  const GgxAround ggx_about = ggx_around(ggx, alpha);
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    const albedo::Interpolant e(c.visibility);
    const AlbedoAround around(e, Bound(0.3));
    Parts p;
    for (std::size_t i = 0; c.scaling == AlbedoScaling::Literal && i < p.surfaces.size(); ++i) {
      // Where E passes 1: white cloth seen at a grazing angle.
      p.surfaces[i].sheen_color = {Bound(1.0), Bound(1.0), Bound(1.0)};
      p.surfaces[i].sheen_roughness = Bound(0.3);
    }
    Lighting lighting;
    lighting.lights = p.lights.data();
    lighting.light_count = p.lights.size();
    lighting.sheen = {c.visibility, c.scaling};
    lighting.albedo.interpolant = &e;
    lighting.albedo.around = c.around ? &around : nullptr;
    if (c.physical) {
      lighting.base_albedo = {&ggx, c.around ? &ggx_about : nullptr};
    }
    for (Surface<Bound>& s : p.surfaces) {
      s.base.alpha = c.physical && c.around ? alpha : s.base.alpha;
    }
    std::vector<BelowSum<Bound>> one;
    std::vector<CoatSum<Bound>> one_coat;
    for (const bool batch : {false, true}) {
      if (batch && !number::has_batch()) {
        continue;
      }
      p.shade_parts(lighting, c.layers, c.lobes, batch);
      int bounded = 0;
      double least = 0;
      for (std::size_t i = 0; i < p.surfaces.size(); ++i) {
        const Bound& below = p.below[i].radiance.g;
        const Bound coat = c.layers.clearcoat ? p.coat[i].radiance.g : Bound(0.0);
        if (!below.is_bounded() || !coat.is_bounded()) {
          continue;
        }
        ++bounded;
        for (int k = 0; k < 30; ++k) {
          const Surface<double> surface = test::held(p.surfaces[i], p.random);
          Sizes sizes;
          const auto shaded = shade(surface, c.layers, lighting, sizes);
          least = std::min(least, sizes.least);
          const double room = 1e-9 * sizes.below;
          ASSERT_GE(shaded.radiance.g, below.range().lower + coat.range().lower - room) << i;
          ASSERT_LE(shaded.radiance.g, below.range().upper + coat.range().upper + room) << i;
          ASSERT_LE(sizes.below, p.below[i].size.g.range().upper + room) << i;
          if (c.layers.clearcoat) {
            const double k_there = CoatLayer<double>(surface, lighting).weight();
            ASSERT_LE(std::abs(k_there - p.coat[i].weight.center()), p.coat[i].weight.deviation()) << i;
          }
        }
        if (batch && c.lobes == Precision::Highp) {
          EXPECT_TRUE(one[i].radiance.g.is_bounded());
          // One at a time keeps forms too.
          EXPECT_LE(below.range().upper - below.range().lower, 4.0 * (one[i].radiance.g.range().upper - one[i].radiance.g.range().lower))
              << i;
        }
      }
      EXPECT_FALSE(p.below[11].radiance.g.is_bounded());
      EXPECT_FALSE(c.layers.clearcoat && p.coat[12].radiance.g.is_bounded());
      EXPECT_GT(bounded, c.lobes == Precision::Highp ? 100 : 20);
      EXPECT_EQ(least < 0, c.scaling == AlbedoScaling::Literal);
      if (batch) {
        for (std::size_t i = 0; i < p.surfaces.size(); ++i) {
          EXPECT_EQ(one[i].radiance.g.is_bounded(), p.below[i].radiance.g.is_bounded()) << "what ranges lose is done with more care: " << i;
        }
      }
      one = p.below;
      one_coat = p.coat;
    }
  }
}

// White cloth whose E passes 1 takes more from its base than there is, unclamped.
TEST(Parts, CountTheSizesOfTermsOfEitherSign) {
  const albedo::Interpolant e(albedo::Visibility::Ashikhmin);
  scene::Light grazing;
  grazing.direction = glm::normalize(glm::dvec3(-1.0, 0.0, -0.02));
  const std::vector<PreparedLight> lights = prepare_lights({grazing, scene::Light{}});
  Lighting lighting;
  lighting.lights = lights.data();
  lighting.light_count = lights.size();
  lighting.sheen = {albedo::Visibility::Ashikhmin, albedo::AlbedoScaling::Literal};
  lighting.albedo.interpolant = &e;
  Surface<double> s{};
  s.view = {std::sqrt(1.0 - 0.01), 0.0, 0.1};
  s.normal = {0.0, 0.0, 1.0};
  s.base = {{1.0, 1.0, 1.0}, 0.0, 0.5, {0.04, 0.04, 0.04}, 1.0};
  s.sheen_color = {1.0, 1.0, 1.0};
  s.sheen_roughness = 0.3;
  Sizes sizes;
  shade(s, {true, false}, lighting, sizes);
  ASSERT_LT(sizes.least, 0.0);
  const std::uint32_t zero = 0;
  const auto exact = spread<Bound>(s);
  const BelowSurface<Bound> at{exact.normal, Bound(0.0)};
  BelowSum<Bound> sum;
  bound_below({&exact, &at, &zero, &zero, 1, {true, false}, Precision::Highp}, lighting, &sum);
  EXPECT_NEAR(sum.size.g.center(), sizes.below, 1e-4 * sizes.below);
}

// The terms of a coat and of what lies below it, each added up exactly, and by a shader one by one with roundings to either side.
TEST(Parts, TogetherHoldWhatAShaderAddsUpLightByLight) {
  std::mt19937 random(13);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  double farthest = 0;
  for (int i = 0; i < 300; ++i) {
    const auto lights = static_cast<std::size_t>(1 + i % 100);
    const bool has_signs = i % 3 == 0;
    const double smallest = i % 5 == 0 ? 1e-37 : 1e-3;  // of a term, where a sum may be flushed
    double coat = 0;
    double below = 0;
    double size = 0;
    double sum = 0;
    const auto add = [&](double term) {
      const double exact = sum + term;
      const auto nearest = static_cast<float>(exact);
      const float towards = unit(random) < 0.9 ? INFINITY : -INFINITY;  // most one way, as they may be
      sum = static_cast<double>(nearest) == exact ? exact : std::nextafter(nearest, towards);
      sum = std::abs(sum) < number::smallest_normal<number::Highp> ? 0.0 : sum;
    };
    for (std::size_t light = 0; light < lights; ++light) {
      for (int part = 0; part < 3; ++part) {
        const auto term = static_cast<float>(smallest * std::pow(10.0, 3 * unit(random)) * (has_signs && part == 1 ? -1 : 1));
        (part == 2 ? coat : below) += term;
        size += part == 2 ? 0 : std::abs(term);
        add(term);
      }
    }
    const number::Range together = BoundedSamples::together({coat, coat}, {below, below}, size, lights);
    EXPECT_GE(sum, together.lower);
    EXPECT_LE(sum, together.upper);
    farthest = std::max(farthest, std::abs(sum - coat - below) / (together.upper - coat - below));
  }
  EXPECT_GT(farthest, 0.1);
  const number::Range too_many = BoundedSamples::together({0, 1}, {0, 1}, 1, 10'000'000);
  EXPECT_EQ(too_many.upper, INFINITY);
}

TEST(BendRanges, HoldsWhatAnyReadingOfAMapMakes) {
  test::UncertainSurfaces make;
  std::mt19937 random(5);
  std::vector<MappedNormal<Bound>> maps;
  for (int i = 0; i < 101; ++i) {
    maps.push_back(make.map());
    for (Bound* code : {&maps.back().code.x, &maps.back().code.y, &maps.back().code.z}) {
      *code = i % 9 == 0 ? *code : Bound::within(code->center(), 0.01);
    }
  }
  std::vector<Vec3<Bound>> one(maps.size());
  std::vector<Vec3<Bound>> many(maps.size());
  bend_all_scalar(maps.data(), maps.size(), one.data());
  bend_ranges(maps.data(), maps.size(), many.data());
  int bounded = 0;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    EXPECT_EQ(one[i].x.is_bounded(), many[i].x.is_bounded());
    if (!many[i].x.is_bounded()) {
      continue;
    }
    ++bounded;
    EXPECT_LE(many[i].z.deviation(), 1.5 * one[i].z.deviation() + 1e-5);
    for (int k = 0; k < 100; ++k) {
      const MappedNormal<double> map = test::held(maps[i], random);
      const auto vector = [](const Vec3<double>& v) { return glm::dvec3(v.x, v.y, v.z); };
      const glm::dvec3 code = (vector(map.code) * 2.0 - 1.0) * glm::dvec3(map.scale, map.scale, 1.0);
      const glm::dvec3 tangent = glm::normalize(vector(map.tangent));
      const glm::dvec3 direction = glm::length(code) > 1e-12 ? glm::normalize(code) : glm::dvec3(0.0, 0.0, 1.0);
      const glm::dvec3 bitangent = glm::cross(vector(map.normal), tangent) * map.handedness;
      const glm::dvec3 normal =
          glm::normalize(tangent * direction.x + bitangent * direction.y + vector(map.normal) * direction.z) * map.side;
      EXPECT_LE(std::abs(normal.x - many[i].x.center()), many[i].x.deviation()) << i;
      EXPECT_LE(std::abs(normal.y - many[i].y.center()), many[i].y.deviation()) << i;
      EXPECT_LE(std::abs(normal.z - many[i].z.center()), many[i].z.deviation()) << i;
    }
  }
  EXPECT_GT(bounded, 80);
}

}  // namespace
}  // namespace sheen::golden
