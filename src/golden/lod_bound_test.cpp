// The freedom in the level of detail: whatever levels a driver picks for the textures of a surface, its value must stay inside the bound.

#include <algorithm>
#include <array>
#include <cstring>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "golden/frame.h"
#include "golden/test_scenes.h"
#include "golden/uniform_light.h"

namespace sheen::golden {
namespace {

constexpr int image_size = 32;

/// A square tilted away from the camera, so that textures shrink more along one axis than the other.
scene::Scene tilted_cloth() {
  const scene::Material m = test::cloth(0.3);
  scene::Scene s = test::scene_with(test::square(3.0), m, test::camera_at(3.0), {test::directional({0.0, 1.0, 1.0})});
  s.instances[0].world_from_local = glm::rotate(glm::dmat4(1.0), -1.2, glm::dvec3(1.0, 0.0, 0.0));
  return s;
}

scene::TextureInfo add_noise(scene::Scene& s, unsigned seed, int low, int high, int blue) {
  std::mt19937 generator(seed);
  std::uniform_int_distribution<int> code(low, high);
  return test::add_texture(s, test::picture(64, 64, [&](int, int) { return glm::ivec4(code(generator), code(generator), blue, 255); }));
}

/// In all four channels.
scene::TextureInfo add_noise_everywhere(scene::Scene& s, unsigned seed, int low) {
  std::mt19937 generator(seed);
  const auto code = [&] { return std::uniform_int_distribution<int>(low, 255)(generator); };
  return test::add_texture(s, test::picture(64, 64, [&](int, int) { return glm::ivec4(code(), code(), code(), code()); }));
}

/// Holds every pixel of the golden against forty drivers: vary() gives the surface such a driver sees, with level_in(slot) for the level it
/// picks, at random, among those allowed.
template <class Vary>
void hold_against_bound(const scene::Scene& s, const Vary& vary) {
  const Settings settings = test::settings_for(image_size, image_size, true);
  const image::Image golden = render(s, settings);
  const Frame frame(s, settings);
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Seen seen;
  int held = 0;
  for (int y = 0; y < image_size; ++y) {
    for (int x = 0; x < image_size; ++x) {
      const Ray ray = frame.rays.through(x + 0.5, y + 0.5);
      frame.tracer.trace(ray, false, seen);
      if (!seen.nearest) {
        continue;
      }
      ++held;
      for (int i = 0; i < 40; ++i) {
        const auto level_in = [&](std::size_t slot) {
          const std::optional<LodInterval> range = frame.reader.lod_interval(*seen.nearest, ray, slot);
          return LodChoice{range ? range->low + unit(generator) * (range->high - range->low) : 0.0, slot};
        };
        const Surface<double> surface = vary(frame.reader, *seen.nearest, ray, level_in);
        const Layers layers = frame.reader.layers(frame.geometry.placed(seen.nearest->triangle).material_index);
        const auto radiance = shade(surface, layers, frame.lighting(), NoListener{}).radiance;
        const double value[3] = {radiance.r, radiance.g, radiance.b};
        for (int c = 0; c < 3; ++c) {
          ASSERT_LE(std::abs(value[c] - golden.at(x, y, c)), golden.at(x, y, 4 + c)) << x << " " << y << " channel " << c;
        }
      }
    }
  }
  EXPECT_GT(held, image_size * image_size / 3);
}

constexpr std::size_t base_color_slot = 0, normal_slot = 2, sheen_color_slot = 6, clearcoat_normal_slot = 10;  // SurfaceReader's order

TEST(LodBound, HoldsEveryLevelOfANormalMapThatBendsFarAndOften) {
  scene::Scene s = tilted_cloth();
  s.materials[0].normal_texture = add_noise(s, 1, 60, 200, 200);
  hold_against_bound(s, [](const SurfaceReader& reader, const Hit& hit, const Ray& ray, const auto& level_in) {
    return reader.surface(hit, ray, level_in(normal_slot));
  });
}

TEST(LodBound, HoldsWhenADriverPicksAnotherLevelForEachTexture) {
  scene::Scene s = tilted_cloth();
  s.materials[0].base_color_texture = add_noise(s, 2, 0, 255, 128);
  s.materials[0].sheen.color_texture = s.materials[0].base_color_texture;
  s.materials[0].sheen.color_texture.transform = glm::dmat3(4.0, 0.0, 0.0, 0.0, 4.0, 0.0, 0.0, 0.0, 1.0);
  hold_against_bound(s, [](const SurfaceReader& reader, const Hit& hit, const Ray& ray, const auto& level_in) {
    Surface<double> surface = reader.surface(hit, ray, level_in(base_color_slot));
    surface.sheen_color = reader.surface(hit, ray, level_in(sheen_color_slot)).sheen_color;
    return surface;
  });
}

// A normal map's level turns the lobes that the levels of the other textures weigh.
TEST(LodBound, HoldsWhenANormalMapAndWhatItBendsArePickedTogether) {
  scene::Scene s = tilted_cloth();
  s.materials[0].normal_texture = add_noise(s, 3, 60, 200, 200);
  s.materials[0].sheen.color_texture = add_noise(s, 4, 0, 255, 128);
  s.materials[0].base_color_texture = add_noise(s, 5, 0, 255, 128);
  hold_against_bound(s, [](const SurfaceReader& reader, const Hit& hit, const Ray& ray, const auto& level_in) {
    Surface<double> surface = reader.surface(hit, ray, level_in(base_color_slot));
    surface.normal = reader.surface(hit, ray, level_in(normal_slot)).normal;
    surface.sheen_color = reader.surface(hit, ray, level_in(sheen_color_slot)).sheen_color;
    return surface;
  });
}

// Over black the coat's lobe is all there is; over white, far from its highlight, what its weight leaves of the base.
TEST(LodBound, HoldsEveryLevelOfACoatsMapAlone) {
  for (const double base : {0.0, 1.0}) {
    scene::Scene s = tilted_cloth();
    s.materials[0] = test::lambertian(glm::dvec4(base, base, base, 1.0));
    s.materials[0].clearcoat.factor = 1.0;
    s.materials[0].clearcoat.roughness_factor = base > 0.0 ? 0.02 : 0.3;
    s.materials[0].clearcoat.normal_texture = add_noise(s, 8, 60, 200, 200);
    if (base > 0.0) {
      s.lights = {test::directional({1.0, 0.2, 0.1})};
    }
    hold_against_bound(s, [](const SurfaceReader& reader, const Hit& hit, const Ray& ray, const auto& level_in) {
      return reader.surface(hit, ray, level_in(clearcoat_normal_slot));
    });
  }
}

// Two normal maps, each at a level of its own.
TEST(LodBound, HoldsWhenTheCoatsMapAndTheBasesArePickedTogether) {
  scene::Scene s = tilted_cloth();
  s.materials[0].normal_texture = add_noise(s, 6, 60, 200, 200);
  s.materials[0].clearcoat.factor = 1.0;
  s.materials[0].clearcoat.roughness_factor = 0.4;
  s.materials[0].clearcoat.normal_texture = add_noise(s, 7, 60, 200, 200);
  hold_against_bound(s, [](const SurfaceReader& reader, const Hit& hit, const Ray& ray, const auto& level_in) {
    Surface<double> surface = reader.surface(hit, ray, level_in(normal_slot));
    surface.coat_normal = reader.surface(hit, ray, level_in(clearcoat_normal_slot)).coat_normal;
    return surface;
  });
}

/// Two cloths, one seen through the other, each with textures of its own colour and its sheen's.
scene::Scene cloth_over_cloth() {
  scene::Scene s = tilted_cloth();
  s.materials[0].base_color_texture = add_noise_everywhere(s, 9, 0);
  s.materials[0].sheen.color_texture = add_noise(s, 10, 0, 255, 128);
  s.materials[0].alpha_mode = scene::AlphaMode::Blend;
  s.materials[0].base_color_factor.a = 0.6;
  s.instances.push_back(s.instances[0]);
  s.instances[1].world_from_local = glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, -0.3)) * s.instances[0].world_from_local;
  return s;
}

// Of each layer one texture at another level, under light from everywhere.
TEST(LodBound, HoldsTheLevelsOfEachLayerUnderAnEnvironment) {
  const scene::Scene s = cloth_over_cloth();
  scene::Environment environment;
  environment.uniform = glm::dvec3(1.0);
  Settings settings = test::settings_for(image_size, image_size, true);
  settings.environment = &environment;
  const image::Image golden = render(s, settings);
  const Frame frame(s, settings);
  UniformLight light(frame.lighting(), {1.0, 1.0, 1.0});
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  double largest[2] = {0.0, 0.0};
  Seen seen;
  for (int y = 0; y < image_size; ++y) {
    for (int x = 0; x < image_size; ++x) {
      const Ray ray = frame.rays.through(x + 0.5, y + 0.5);
      frame.tracer.trace(ray, false, seen);
      if (seen.blended.size() != 2 || golden.at(x, y, golden.channel("excluded")) != 0.0F) {
        continue;
      }
      for (std::size_t i = 0; i < 20; ++i) {
        const std::size_t varied = i % 2;
        double value = 0.0;
        for (std::size_t layer = 0; layer < 2; ++layer) {
          const Hit& hit = seen.blended[layer];
          const std::size_t slot = i % 4 < 2 ? base_color_slot : sheen_color_slot;
          const std::optional<LodInterval> range = frame.reader.lod_interval(hit, ray, slot);
          const LodChoice lod =
              layer == varied && range ? LodChoice{range->low + unit(generator) * (range->high - range->low), slot} : LodChoice{};
          const Surface<double> surface = frame.reader.surface(hit, ray, lod);
          const double a = frame.reader.opacity(hit, ray, lod);
          const double direct = shade(surface, {true, false}, frame.lighting(), NoListener{}).radiance.g;
          value = (light.shade(surface, {true, false}).g + direct) * a + value * (1.0 - a);
        }
        const double bound = golden.at(x, y, golden.channel("bound.G"));
        const double off = std::abs(value - golden.at(x, y, 1));
        ASSERT_LE(off, bound) << x << " " << y << " layer " << varied;
        largest[varied] = std::max(largest[varied], off / bound);
      }
    }
  }
  EXPECT_GT(largest[0], 0.2);
  EXPECT_GT(largest[1], 0.2);
}

// An image's light is drawn, that of a white one is uniform light.
TEST(LodBound, UnderAWhiteImageIsNearlyThatUnderUniformLight) {
  scene::Scene s = cloth_over_cloth();
  s.lights.clear();
  scene::Environment uniform;
  uniform.uniform = glm::dvec3(1.0);
  scene::Environment image;
  image.width = 8;
  image.height = 4;
  image.texels.assign(32, glm::vec3(1.0F));
  const auto golden_under = [&](const scene::Environment& environment) {
    Settings settings = test::settings_for(image_size, image_size, true);
    settings.environment = &environment;
    return render(s, settings);
  };
  const image::Image by_nodes = golden_under(uniform);
  const image::Image drawn = golden_under(image);
  const int g = drawn.channel("bound.G");
  std::vector<double> ratios;
  for (int y = 0; y < image_size; ++y) {
    for (int x = 0; x < image_size; ++x) {
      if (drawn.at(x, y, 3) > 0.0F && drawn.at(x, y, drawn.channel("excluded")) == 0.0F) {
        ratios.push_back(drawn.at(x, y, g) / by_nodes.at(x, y, g));
      }
    }
  }
  ASSERT_GT(ratios.size(), 100U);
  std::sort(ratios.begin(), ratios.end());
  EXPECT_GT(ratios[ratios.size() / 20], 0.9) << "it has its standard error beside";
}

TEST(LodBound, VaryingOneTextureIsReadingAllWithThatLevel) {
  scene::Scene s = tilted_cloth();
  scene::Material& m = s.materials[0];
  m.clearcoat.factor = 1.0;
  m.clearcoat.roughness_factor = 0.7;
  m.emissive_factor = glm::dvec3(0.3);
  unsigned seed = 20;
  for (scene::TextureInfo* texture :
       {&m.base_color_texture, &m.metallic_roughness_texture, &m.normal_texture, &m.emissive_texture, &m.specular.factor_texture,
        &m.specular.color_texture, &m.sheen.color_texture, &m.sheen.roughness_texture, &m.clearcoat.factor_texture,
        &m.clearcoat.roughness_texture, &m.clearcoat.normal_texture, &m.occlusion_texture}) {
    const scene::TextureInfo noise = add_noise_everywhere(s, ++seed, 20);
    *texture = noise;
  }
  scene::Environment environment;
  environment.uniform = glm::dvec3(1.0);
  Settings settings = test::settings_for(image_size, image_size);
  settings.environment = &environment;
  for (const auto model : {albedo::Model::Ratified, albedo::Model::Draft2019}) {
    settings.sheen.model = model;
    const Frame frame(s, settings);
    const Ray ray = frame.rays.through(0.5 * image_size, 0.4 * image_size);
    Seen seen;
    frame.tracer.trace(ray, false, seen);
    ASSERT_TRUE(seen.nearest);
    const auto numbers = [](const Surface<double>& surface) {
      std::array<double, sizeof(Surface<double>) / sizeof(double)> all;
      std::memcpy(all.data(), &surface, sizeof(surface));
      return all;
    };
    const Surface<double> usual = frame.reader.surface(*seen.nearest, ray);
    for (std::size_t slot = 0; slot < SurfaceReader::slot_count; ++slot) {
      const LodChoice choice{4.3, slot};
      const auto varied = numbers(frame.reader.varied(usual, *seen.nearest, ray, choice));
      EXPECT_EQ(varied, numbers(frame.reader.surface(*seen.nearest, ray, choice))) << "slot " << slot;
      EXPECT_TRUE(varied != numbers(usual) || model != albedo::Model::Ratified) << "slot " << slot;  // the draft leaves one unread
    }
  }
}

// What a punctual light, emission and coverage may be off is counted once, beside what the environment may.
TEST(LodBound, OfAnEnvironmentAndALightAddUp) {
  scene::Scene lit = cloth_over_cloth();
  lit.materials[0].emissive_factor = glm::dvec3(0.2);
  lit.materials[0].emissive_texture = add_noise(lit, 12, 0, 255, 128);
  scene::Scene dark = lit;
  dark.lights.clear();
  scene::Environment environment;
  environment.uniform = glm::dvec3(0.5);
  const auto bound_of = [](const scene::Scene& s, const scene::Environment* around) {
    Settings settings = test::settings_for(image_size, image_size, true);
    settings.environment = around;
    return render(s, settings);
  };
  const image::Image light_alone = bound_of(lit, nullptr);
  const image::Image both = bound_of(lit, &environment);
  const image::Image environment_alone = bound_of(dark, &environment);
  const image::Image emission_alone = bound_of(dark, nullptr);
  const int g = both.channel("bound.G");
  const int a = both.channel("bound.A");
  int compared = 0;
  for (int y = 0; y < image_size; ++y) {
    for (int x = 0; x < image_size; ++x) {
      if (both.at(x, y, 3) > 0.0F && both.at(x, y, both.channel("excluded")) == 0.0F) {
        ++compared;
        const double of_environment = static_cast<double>(environment_alone.at(x, y, g)) - emission_alone.at(x, y, g);
        const double sum = light_alone.at(x, y, g) + of_environment;
        EXPECT_NEAR(both.at(x, y, g), sum, 1e-4 * sum) << x << " " << y;
        EXPECT_GT(of_environment, 0.0);
        EXPECT_EQ(both.at(x, y, a), light_alone.at(x, y, a));
      }
    }
  }
  EXPECT_GT(compared, 100);
}

}  // namespace
}  // namespace sheen::golden
