// What a conforming driver and shader may draw stays inside a pixel's bound: samples anywhere within the step, every operation off by what
// GLSL ES grants it.

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "golden/bounded_samples.h"
#include "golden/perturbed_shading_test.h"
#include "golden/shade.h"
#include "golden/test_scenes.h"

namespace sheen::golden {
namespace {

using Highp = number::test::Perturbed<number::Highp>;
using Mediump = number::test::Perturbed<number::Mediump>;
constexpr double distance = 4.0;

Vec3<Highp> unit(const Vec3<Highp>& v) {
  return v * inversesqrt(dot(v, v));
}

/// The surface as a shader holds it, in the view space of a camera that looks along -Z from (0, 0, distance).
Surface<Highp> held(const Surface<double>& s) {
  const auto vector = [](const Vec3<double>& v) { return Vec3<Highp>{Highp(v.x), Highp(v.y), Highp(v.z)}; };
  const auto color = [](const brdf::Rgb<double>& c) { return brdf::Rgb<Highp>{Highp(c.r), Highp(c.g), Highp(c.b)}; };
  Surface<Highp> out{};
  out.position = vector({s.position.x, s.position.y, s.position.z - distance});
  out.view = unit({-out.position.x, -out.position.y, -out.position.z});
  out.normal = unit(vector(s.normal));
  out.coat_normal = unit(vector(s.coat_normal));
  out.base.color = color(s.base.color);
  out.base.metallic = Highp(s.base.metallic);
  const Highp roughness(std::sqrt(s.base.alpha));
  out.base.alpha = roughness * roughness;
  out.base.dielectric_f0 = color(s.base.dielectric_f0);
  out.base.specular = Highp(s.base.specular);
  out.sheen_color = color(s.sheen_color);
  out.sheen_roughness = Highp(s.sheen_roughness);
  out.clearcoat = Highp(s.clearcoat);
  const Highp coat_roughness(std::sqrt(s.coat_alpha));
  out.coat_alpha = coat_roughness * coat_roughness;
  out.emission = color(s.emission);
  out.occlusion = Highp(1);
  return out;
}

scene::Scene lacquered_cloth() {
  scene::Material m = test::cloth(0.35);
  m.clearcoat.factor = 0.6;
  m.clearcoat.roughness_factor = 0.25;
  m.emissive_factor = {0.02, 0.01, 0.0};
  scene::Light spot;
  spot.type = scene::LightType::Spot;
  spot.position = {1.0, 1.5, 2.0};
  spot.direction = glm::normalize(glm::dvec3(-0.8, -1.3, -1.6));
  spot.intensity = 12.0;
  spot.inner_cone = 0.2;
  spot.outer_cone = 0.45;
  return test::scene_with(test::sphere(48, 24), m, test::camera_at(distance), {test::directional({0.6, 0.4, 1.0}), spot});
}

/// Pixels, each held against random drivers: how far the worst of them goes, as a share of the bound.
/// @param read  the surface that a driver sees at a hit
template <class Lobe, class Read>
std::vector<double> shares(const scene::Scene& s, Settings settings, int tries, const Read& read) {
  const Frame frame(s, settings);
  const PixelBound bound(frame);
  std::vector<PreparedLight> lights = frame.lights;
  for (PreparedLight& light : lights) {
    light.position.z -= distance;
  }
  Lighting lighting = frame.lighting();
  lighting.lights = lights.data();
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> within(-1.0, 1.0);
  number::test::Decisions::current().seed(5);
  std::vector<double> reached;
  for (int y = 1; y < settings.view.height; y += 3) {
    for (int x = 1; x < settings.view.width; x += 3) {
      const Ray ray = frame.rays.through(x + 0.5, y + 0.5);
      Seen seen;
      frame.tracer.trace(ray, false, seen);
      if (!seen.nearest) {
        continue;
      }
      const double step = bound.step(seen);
      BoundedSamples samples(bound);
      samples.begin(ray, step);
      samples.add(seen);
      samples.shade();
      const Enclosed enclosed = samples.at(0);
      if (!std::isfinite(enclosed.deviation.x)) {
        continue;
      }
      double worst = 0.0;
      for (int i = 0; i < tries; ++i) {
        number::test::Decisions::current().start_anew(i % 3 == 0 ? 0.0 : 0.9);
        const Ray moved = frame.rays.through(ray.x + step * within(random), ray.y + step * within(random));
        const Hit hit = frame.geometry.meet(seen.nearest->triangle, moved).value();
        const Surface<Highp> surface = held(read(frame.reader, hit, moved));
        const auto radiance = shade_with<Lobe>(surface, frame.reader.layers(0), lighting, NoListener{}).radiance;
        const double values[3] = {radiance.r.value(), radiance.g.value(), radiance.b.value()};
        for (int c = 0; c < 3; ++c) {
          worst = std::max(worst, std::abs(values[c] - enclosed.value[c]) / enclosed.deviation[c]);
          EXPECT_LE(std::abs(values[c] - enclosed.value[c]), enclosed.deviation[c]) << x << ' ' << y << " channel " << c;
        }
      }
      reached.push_back(worst);
    }
  }
  std::sort(reached.begin(), reached.end());
  return reached;
}

Surface<double> ideal(const SurfaceReader& reader, const Hit& hit, const Ray& ray) {
  return reader.surface(hit, ray);
}

TEST(PixelBound, HoldsEveryConformingShaderWhereverTheSampleGoes) {
  const std::vector<double> reached = shares<Highp>(lacquered_cloth(), test::settings_for(40, 40, true), 60, ideal);
  ASSERT_GT(reached.size(), 40u);
  EXPECT_GT(reached[reached.size() / 2], 0.2) << "and is not much wider than what they do";
}

TEST(PixelBound, HoldsThemOnACoarseGrid) {
  Settings settings = test::settings_for(40, 40, true);
  settings.subpixel_bits = 4;
  const std::vector<double> reached = shares<Highp>(lacquered_cloth(), settings, 60, ideal);
  EXPECT_GT(reached[reached.size() / 2], 0.2);
}

TEST(PixelBound, HoldsLobesInMediumPrecision) {
  Settings settings = test::settings_for(40, 40, true);
  settings.precision = Precision::Mediump;
  const std::vector<double> reached = shares<Mediump>(lacquered_cloth(), settings, 40, ideal);
  EXPECT_GT(reached.size(), 30u) << "of most pixels the rules promise something";
}

// What lies below a coat and the coat are enclosed apart, each for all that its map may make of its normal; a shader adds their terms light
// by light, and where the scale is not clamped some are negative.
TEST(PixelBound, HoldsThemWhicheverLevelsOfTwoNormalMapsTheyRead) {
  for (const auto scaling : {albedo::AlbedoScaling::Full, albedo::AlbedoScaling::Literal}) {
    scene::Scene s = lacquered_cloth();
    std::mt19937 generator(11);
    std::uniform_int_distribution<int> code(90, 165);
    const auto bumps = [&] {
      scene::TextureInfo map =
          test::add_texture(s, test::picture(64, 64, [&](int, int) { return glm::ivec4(code(generator), code(generator), 230, 255); }));
      map.transform = glm::dmat3(3.0, 0.0, 0.0, 0.0, 3.0, 0.0, 0.0, 0.0, 1.0);
      return map;
    };
    s.materials[0].normal_texture = bumps();
    s.materials[0].clearcoat.normal_texture = bumps();
    for (int i = 0; i < 12; ++i) {
      s.lights.push_back(test::directional({std::cos(0.5 * i), std::sin(0.5 * i), 0.3 + 0.1 * i}));
    }
    Settings settings = test::settings_for(24, 24, true);
    settings.sheen.scaling = scaling;
    std::mt19937 random(4);
    const auto any_level = [&random](const SurfaceReader& reader, const Hit& hit, const Ray& ray) {
      const auto at_level_of = [&](std::size_t slot) {
        const LodInterval range = reader.lod_interval(hit, ray, slot).value();
        return reader.surface(hit, ray, {std::uniform_real_distribution<double>(range.low, range.high)(random), slot});
      };
      Surface<double> surface = at_level_of(SurfaceReader::normal_slot);
      surface.coat_normal = at_level_of(SurfaceReader::clearcoat_normal_slot).coat_normal;
      return surface;
    };
    EXPECT_GT(shares<Highp>(s, settings, 60, any_level).size(), 20u);
    settings.precision = Precision::Mediump;
    shares<Mediump>(s, settings, 10, any_level);
  }
}

TEST(PixelBound, IsUnboundedWhereANormalMayHaveNoDirection) {
  scene::Primitive turning = test::square(1.0);
  for (glm::vec3& n : turning.normals) {
    n = {0.0F, 0.0F, 0.0F};
  }
  turning.normals[0] = {0.0F, 0.0F, 3e-15F};  // long enough for floats at the corner, too short farther off
  turning.normals[1] = {0.0F, 0.0F, 4e-16F};
  const scene::Scene s =
      test::scene_with(turning, test::lambertian(glm::dvec4(1.0)), test::camera_at(distance), {test::directional({0.0, 0.0, 1.0})});
  Settings settings = test::settings_for(64, 64, true);
  settings.subpixel_bits = 4;
  const image::Image golden = render(s, settings);
  const int excluded = golden.channel("excluded");
  bool unpromised = false;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      unpromised = unpromised || golden.at(x, y, excluded) == 4.0F;
      EXPECT_TRUE(std::isfinite(golden.at(x, y, 4)));
    }
  }
  EXPECT_TRUE(unpromised);
}

}  // namespace
}  // namespace sheen::golden
