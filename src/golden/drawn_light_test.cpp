// What our shaders may be off by where they integrate an environment from drawn directions.
#include "golden/drawn_light.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "albedo/interpolant.h"
#include "golden/bounded_albedo.h"
#include "golden/drawn_fixture_test.h"
#include "golden/ggx_range.h"
#include "golden/sheen_range.h"
#include "golden/test_scenes.h"
#include "number/bounded_functions.h"

namespace sheen::golden {
namespace {

using test::Random;

TEST(DrawnLight, AnglesAreThoseOfAnArcTangent) {
  EXPECT_EQ(angle_of(0.0, 0.0), 0);
  double worst = 0;
  for (int i = -20000; i <= 20000; ++i) {
    const double angle = brdf::pi * i / 20000.5;
    worst = std::max(worst, std::abs(angle_of(std::sin(angle), std::cos(angle)) - angle));
  }
  EXPECT_LT(worst, angle_error);
  EXPECT_GT(worst, 0.5 * angle_error);
}

scene::Environment lamps() {
  scene::Environment sky;
  sky.width = 16;
  sky.height = 8;
  std::mt19937 random(5);
  for (int i = 0; i < sky.width * sky.height; ++i) {
    sky.texels.emplace_back(std::uniform_real_distribution<float>(0.1F, 1.0F)(random) * (i % 17 == 0 ? 50.0F : 1.0F));
  }
  sky.rotation = 0.7;
  return sky;
}

TEST(DrawnLight, AnImageIsDrawnAsDenselyAsItIsToldAndSeenAsItIs) {
  const scene::Environment sky = lamps();
  const glm::dmat3 view_from_world(glm::rotate(glm::dmat4(1.0), 0.4, glm::normalize(glm::dvec3(1.0, 2.0, 3.0))));
  const DrawnImage image(sky, view_from_world);
  Random random;
  double sphere = 0;
  std::vector<double> off;
  constexpr int count = 40000;
  for (int i = 0; i < count; ++i) {
    const DrawnImage::Drawn drawn = image.draw(random.number(), random.number());
    sphere += 1 / drawn.density.center() / count;
    if (i % 20 != 0) {
      continue;
    }
    // Any other way finds the same density, and a direction that is a little off the same light but for its slope.
    const DrawnImage::Seen there = image.look_up(displaced(drawn.direction));
    EXPECT_NEAR(there.density.center(), drawn.density.center(), there.density.deviation() + drawn.density.deviation());
    const glm::dvec3 in_view(drawn.direction.x.center(), drawn.direction.y.center(), drawn.direction.z.center());
    const glm::dvec3 aside =
        glm::normalize(in_view + 2e-7 * glm::dvec3(random.number() - 0.5, random.number() - 0.5, random.number() - 0.5));
    const double radiance = sky.radiance(glm::transpose(view_from_world) * aside).x;
    EXPECT_NEAR(there.radiance.r.center(), radiance, there.radiance.r.deviation());
    off.push_back(there.radiance.r.deviation() / std::max(radiance, 1.0));
  }
  std::sort(off.begin(), off.end());
  EXPECT_LT(off[off.size() / 2], 1e-4);
  EXPECT_LT(off.back(), 0.1) << "near a pole";
  EXPECT_NEAR(sphere, 4 * brdf::pi, 0.1);
}

TEST(DrawnLight, ABoundGrowsByALittleAndOnlyWhereDirectionsAreDrawn) {
  scene::Environment white;
  white.uniform = glm::dvec3(1.0);
  const scene::Environment sky = lamps();
  scene::Scene s = test::scene_with(test::sphere(24, 12), test::cloth(0.4), test::orthographic_at(5.0, 1.1), {});
  golden::Settings settings = test::settings_for(12, 12, true);
  settings.sampling.error = 0.05;
  for (const scene::Environment* environment : {&std::as_const(white), &sky}) {
    settings.environment = environment;
    settings.drawn_directions = 0;
    const image::Image without = render(s, settings);
    settings.drawn_directions = 256;
    const image::Image with = render(s, settings);
    const int bound = with.channel("bound.R");
    std::vector<double> grown;
    for (int y = 0; y < 12; ++y) {
      for (int x = 0; x < 12; ++x) {
        EXPECT_EQ(with.at(x, y, 0), without.at(x, y, 0)) << "the golden is the same";
        if (with.at(x, y, 3) > 0 && with.at(x, y, with.channel("excluded")) == 0) {
          grown.push_back((with.at(x, y, bound) - without.at(x, y, bound)) / with.at(x, y, 0));
          EXPECT_GT(grown.back(), 256 * 0x1p-24) << "additions alone round as much";
        }
      }
    }
    ASSERT_GT(grown.size(), 60U);
    std::sort(grown.begin(), grown.end());
    EXPECT_LT(grown[grown.size() / 2], 1e-3);
    EXPECT_LT(grown[grown.size() * 9 / 10], 1e-2);
  }
}

class Open {
 public:
  Open() { white_.uniform = glm::dvec3(1.0); }

  template <class Lobe = Bound>
  double of(const Surface<double>& s, Layers layers, albedo::AlbedoScaling scaling = albedo::AlbedoScaling::Full, int drawn = 256) const {
    Lighting lighting;
    lighting.albedo.interpolant = &interpolant_;
    lighting.sheen.scaling = scaling;
    const DrawnImage image(white_, glm::dmat3(1.0));
    return DrawnLight::open<Lobe>(spread<Bound>(s), layers, lighting, image, drawn_counts(s, layers, false, 64), drawn, 5).off.x;
  }

 private:
  scene::Environment white_;
  albedo::Interpolant interpolant_{albedo::Visibility::Charlie};
};

TEST(DrawnLight, HoldsWhatReadingEOnceMisses) {
  const Open open;
  const Layers cloth{true, false, false};
  Surface<double> s = test::lacquered_cloth(1.2e-3, 0.05, 0.8);
  s.base.metallic = 1;
  const double both = open.of(s, cloth);
  EXPECT_GT(both, 3e-3) << "seen so flat E(N.V) is below E of most lights";
  EXPECT_LT(open.of(s, cloth, albedo::AlbedoScaling::View), 0.3 * both) << "one look-up is all there is";
  s = test::lacquered_cloth(0.2, 0.05, 0.8);
  s.base.metallic = 1;
  EXPECT_LT(open.of(s, cloth), 1e-3);
}

TEST(DrawnLight, EachDirectionThatIsAddedRoundsTheSum) {
  const Open open;
  Surface<double> white = test::lacquered_cloth(0.8, 0.5, 0.3);
  white.base = {{1, 1, 1}, 0, 0.5, {0.04, 0.04, 0.04}, 0};
  const auto of = [&](int drawn) { return open.of(white, {}, albedo::AlbedoScaling::Full, drawn); };
  // A white Lambertian shows 1, as 64 directions have it to some hundredths.
  EXPECT_NEAR(of(4096 + 1000) - of(4096), 1000 * epsilon, 0.1 * 1000 * epsilon);
}

TEST(DrawnLight, OneDirectionBringsItsShareAndTowardALampAllOfIt) {
  // Of a white Lambertian under white light each of n directions brings near 1 / n.
  scene::Environment sky;
  sky.uniform = glm::dvec3(1.0);
  Surface<double> white = test::lacquered_cloth(0.8, 0.5, 0.3);
  white.base = {{1, 1, 1}, 0, 0.5, {0.04, 0.04, 0.04}, 0};
  const Lighting lighting{};
  const auto largest = [&](bool has_image, int drawn) {
    const DrawnImage image(sky, glm::dmat3(1.0));
    return DrawnLight::open<Bound>(spread<Bound>(white), {}, lighting, image, drawn_counts(white, {}, has_image, 64), drawn, 5).largest.x;
  };
  EXPECT_GT(largest(false, 256), 1.0 / 256);
  EXPECT_LT(largest(false, 256), 1.5 / 256);
  EXPECT_NEAR(largest(false, 1024), 0.25 * largest(false, 256), 1e-12);
  // A lamp before the surface, and one of a hundred times its light behind: next to no direction meets the one that is all there is.
  sky.width = 64;
  sky.height = 32;
  sky.texels.assign(64 * 32, glm::vec3(0.0F));
  const auto at = [&sky](const glm::dvec3& d) -> glm::vec3& {
    const glm::dvec2 uv = sky.coordinates(glm::normalize(d));
    return sky.texels[static_cast<std::size_t>(uv.y * 32) * 64 + static_cast<std::size_t>(uv.x * 64)];
  };
  at({0.3, 0.3, 1.0}) = glm::vec3(1.0F);
  at({0.3, 0.3, -1.0}) = glm::vec3(100.0F);
  const double cosine = dot(white.normal, Vec3<double>{0.276, 0.276, 0.92});
  const double shown = cosine / brdf::pi * 2 * brdf::pi * brdf::pi / (64 * 32) * 0.96;  // of one texel's solid angle
  EXPECT_GT(largest(true, 256), 0.3 * shown) << "a hundredth of half of 256 directions";
  EXPECT_LT(largest(true, 256), 3 * shown);
}

// In a channel that a metal does not reflect, Schlick's weight is all, of half vectors at grazing angles, which hardly any direction has.
TEST(DrawnLight, FewDirectionsTellTheMostThatManyMayBring) {
  scene::Environment sky;
  sky.uniform = glm::dvec3(1.0);
  for (const double n_dot_v : {1.0, 0.8, 0.2}) {
    Surface<double> metal = test::lacquered_cloth(n_dot_v, 0.5, 0.3);
    metal.base = {{1, 1e-3, 0}, 1, 0.01, {0.04, 0.04, 0.04}, 1};
    const auto largest = [&](int told) {
      const DrawnImage image(sky, glm::dmat3(1.0));
      return DrawnLight::open<Bound>(spread<Bound>(metal), {}, {}, image, drawn_counts(metal, {}, false, told), 256, 5).largest;
    };
    const glm::dvec3 few = largest(64), many = largest(20000);
    for (int c = 0; c < 3; ++c) {
      EXPECT_GT(few[c], 0.5 * many[c]) << "N.V " << n_dot_v << " channel " << c;
    }
  }
}

TEST(DrawnLight, OcclusionDimsWhatItIsOffByToo) {
  const Open open;
  Surface<double> s = test::lacquered_cloth(0.8, 0.3, 0.4);
  const double whole = open.of(s, {true, true, false});
  s.occlusion = 0.25;
  EXPECT_NEAR(open.of(s, {true, true, false}), 0.25 * whole, 1e-6 * whole);
}

TEST(DrawnLight, LobesOfMediumpAreOffByMore) {
  const Open open;
  const Surface<double> s = test::lacquered_cloth(0.8, 0.3, 0.4);
  EXPECT_GT(open.of<number::Bounded<number::Mediump>>(s, {true, true, false}), 30 * open.of(s, {true, true, false}));
}

TEST(DrawnLight, TheEnvironmentItselfIsLookedUpWithAnError) {
  scene::Environment sky = lamps();
  sky.background = true;
  const scene::Scene s = test::scene_with(test::square(0.3), test::cloth(0.4), test::orthographic_at(5.0, 1.0), {});
  golden::Settings settings = test::settings_for(4, 4, true);
  settings.environment = &sky;
  settings.sampling.error = 0.05;
  const image::Image without = render(s, settings);
  settings.drawn_directions = 256;
  const image::Image with = render(s, settings);
  const int bound = with.channel("bound.G");
  EXPECT_LT(without.at(0, 0, bound), 1e-6F * without.at(0, 0, 1)) << "one direction of all rays";
  EXPECT_GT(with.at(0, 0, bound), 1e-6F * without.at(0, 0, 1));
  EXPECT_LT(with.at(0, 0, bound), 1e-3F * without.at(0, 0, 1));
}

TEST(DrawnLight, OfAMirrorIsWhatItsLookupRounds) {
  const scene::Environment sky = lamps();
  const DrawnImage image(sky, glm::dmat3(1.0));
  Surface<double> s = test::lacquered_cloth(0.8, 0.0, 0.3);
  s.base.metallic = 1;
  s.base.color = {1, 1, 1};
  const Lighting lighting{};
  const WayCounts counts = drawn_counts(s, {}, true, 64);
  const glm::dvec3 off = DrawnLight::open<Bound>(spread<Bound>(s), {}, lighting, image, counts, 256, 1).off;
  const Vec3<double> mirrored = s.normal * (2 * dot(s.normal, s.view)) - s.view;
  const double shown = sky.radiance({mirrored.x, mirrored.y, mirrored.z}).x;
  EXPECT_GT(off.x, 2e-6 * shown);
  EXPECT_LT(off.x, 2e-4 * shown);
}

}  // namespace
}  // namespace sheen::golden
