// Light from everywhere: both ways of the renderer, held to what can be computed by hand.

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numeric>
#include <random>
#include <utility>

#include "image/test_folder.h"
#include "renderer/environment_maps.h"
#include "renderer/environment_points.h"
#include "renderer/renderer_fixture.h"

namespace sheen::renderer {
namespace {

using test::lambert;
using test::pi;

scene::Environment uniform(double radiance) {
  scene::Environment made;
  made.uniform = glm::dvec3(radiance);
  return made;
}

scene::Environment image_of(int width, int height, const std::function<double(const glm::dvec3&)>& radiance) {
  scene::Environment made;
  made.width = width;
  made.height = height;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      made.texels.emplace_back(static_cast<float>(radiance(made.direction({(x + 0.5) / width, (y + 0.5) / height}))));
    }
  }
  return made;
}

/// The material on a square that faces +Z, lit by the environment alone.
scene::Scene dark_square(const scene::Material& material) {
  scene::Scene made = test::square_scene(material);
  made.lights.clear();
  return made;
}

scene::Material metal(double roughness) {
  scene::Material made;
  made.roughness_factor = roughness;
  return made;
}

class UnderAnEnvironment : public test::WithRenderer {
 protected:
  static double middle_under(const scene::Environment& environment, const scene::Scene& scene, int samples) {
    Settings settings;
    settings.environment = &environment;
    settings.environment_samples = samples;
    return middle(scene, settings);
  }
};

constexpr int prefiltered = 0;
constexpr int sampled = 4096;

TEST_F(UnderAnEnvironment, AWhiteLambertianShowsUniformLightAsItIs) {
  for (const int samples : {prefiltered, sampled}) {
    EXPECT_NEAR(middle_under(uniform(2.0), dark_square(lambert()), samples), 2.0, 2e-3) << samples;
    EXPECT_NEAR(middle_under(image_of(8, 4, [](const glm::dvec3&) { return 2.0; }), dark_square(lambert()), samples), 2.0, 6e-3) << samples;
  }
}

TEST_F(UnderAnEnvironment, ALambertianUnderAGradientShowsTwoThirdsOfItsSlope) {
  // The mean of 1 + g.L weighted by the cosine about N is 1 + 2/3 g.N.
  const auto along = [](const glm::dvec3& g) { return image_of(256, 128, [g](const glm::dvec3& d) { return 1.0 + glm::dot(g, d); }); };
  for (const int samples : {prefiltered, sampled}) {
    EXPECT_NEAR(middle_under(along({0.0, 0.0, 0.6}), dark_square(lambert()), samples), 1.4, 5e-3) << samples;
    EXPECT_NEAR(middle_under(along({0.0, 0.0, -0.6}), dark_square(lambert()), samples), 0.6, 5e-3) << samples;
    EXPECT_NEAR(middle_under(along({0.6, 0.6, 0.0}), dark_square(lambert()), samples), 1.0, 5e-3) << samples;
  }
}

TEST_F(UnderAnEnvironment, AMirrorShowsWhatItMeetsTurnedAsAsked) {
  // A quarter turn about +Y carries what stands at +X to -Z, and what stands at -X to +Z, where the square looks.
  scene::Environment sides = image_of(64, 32, [](const glm::dvec3& d) { return 2.0 + d.x; });
  for (const int samples : {prefiltered, 16}) {
    sides.rotation = 0.0;
    EXPECT_NEAR(middle_under(sides, dark_square(metal(0.0)), samples), 2.0, 2e-2);
    sides.rotation = 0.5 * pi;
    EXPECT_NEAR(middle_under(sides, dark_square(metal(0.0)), samples), 1.0, 2e-2);
    sides.rotation = -0.5 * pi;
    EXPECT_NEAR(middle_under(sides, dark_square(metal(0.0)), samples), 3.0, 2e-2);
  }
}

TEST_F(UnderAnEnvironment, BothWaysAgreeWhereTheViewIsAlongTheNormal) {
  const scene::Environment sky = image_of(256, 128, [](const glm::dvec3& d) { return std::exp(2.0 * d.z + d.x); });
  scene::Material cloth = metal(0.6);
  cloth.metallic_factor = 0.3;
  cloth.clearcoat.factor = 1.0;
  cloth.clearcoat.roughness_factor = 0.3;
  for (const scene::Material& material : {metal(0.25), metal(0.5), cloth}) {
    const double truth = middle_under(sky, dark_square(material), sampled);
    EXPECT_NEAR(middle_under(sky, dark_square(material), prefiltered), truth, 0.02 * truth) << "roughness " << material.roughness_factor;
  }
}

TEST_F(UnderAnEnvironment, ASmallSunIsFoundByBruteForce) {
  // One texel of 256 x 128 above the square, by far the brightest: a Lambertian shows albedo / pi of its irradiance.
  scene::Environment sun = image_of(256, 128, [](const glm::dvec3&) { return 0.0; });
  const int row = 40;
  const int column = 192;  // u = 0.75: +Z
  sun.texels[static_cast<std::size_t>(row * 256 + column)] = glm::vec3(1e5F);
  const glm::dvec3 toward = sun.direction({(column + 0.5) / 256, (row + 0.5) / 128});
  const double solid_angle = 2.0 * pi * pi * std::sin(pi * (row + 0.5) / 128) / (256.0 * 128.0);
  const double expected = 1e5 * solid_angle * toward.z / pi;
  EXPECT_NEAR(middle_under(sun, dark_square(lambert()), sampled), expected, 0.01 * expected);
}

TEST_F(UnderAnEnvironment, AllDirectionsAreDrawnWhereNeighboursDrawThemOtherwise) {
  // A Lambertian beside a rough metal, pixel by pixel: nearly all of the first's directions are drawn about N, nearly all of the other's
  // from GGX, and both pixels are drawn at once. The last directions count like the first.
  scene::Scene scene = dark_square(metal(0.5));
  std::vector<std::uint16_t> codes;
  for (int i = 0; i < 8 * 8; ++i) {
    codes.insert(codes.end(), {0, 255, static_cast<std::uint16_t>((i + i / 8) % 2 * 255), 255});
  }
  scene::Sampler nearest;
  nearest.min = nearest.mag = scene::Filter::Nearest;
  nearest.mip = scene::MipFilter::None;
  scene.materials[0].metallic_roughness_texture = test::add_texture(scene, test::picture(8, 8, codes), nearest);
  scene::Environment white = uniform(1.0);
  Settings settings;
  settings.environment = &white;
  settings.environment_samples = 5000;
  const image::Image few = render(scene, 8, settings);
  settings.environment_samples = most_environment_samples;
  const image::Image many = render(scene, 8, settings);
  EXPECT_GT(std::abs(few.at(3, 3, 0) - few.at(4, 3, 0)), 0.01F) << "they are not the same";
  for (int x = 2; x < 6; ++x) {
    EXPECT_NEAR(many.at(x, 3, 0), few.at(x, 3, 0), 5e-3F * few.at(x, 3, 0)) << x;
  }
}

TEST_F(UnderAnEnvironment, OcclusionDimsTheEnvironmentAndNothingElse) {
  scene::Scene scene = dark_square(lambert());
  scene.materials[0].occlusion_texture = test::add_texture(scene, test::picture(1, 1, {51, 255, 255, 255}));
  scene.materials[0].occlusion_strength = 0.5;
  const double left = 1.0 + 0.5 * (0.2 - 1.0);
  for (const int samples : {prefiltered, sampled}) {
    EXPECT_NEAR(middle_under(uniform(1.0), scene, samples), left, 2e-3);
  }
  scene.lights.emplace_back();
  const double punctual = middle(scene);
  EXPECT_NEAR(punctual, 1.0 / pi, 1e-6);
  EXPECT_NEAR(middle_under(uniform(1.0), scene, prefiltered), left + punctual, 2e-3);
}

TEST_F(UnderAnEnvironment, TheBackgroundIsShownOnlyWhenAskedForAndCounts) {
  scene::Environment up = image_of(64, 32, [](const glm::dvec3& d) { return 2.0 + d.y; });
  scene::Scene scene = dark_square(lambert());
  scene.instances[0].world_from_local = glm::translate(glm::dmat4(1.0), glm::dvec3(100.0, 0.0, 0.0));
  scene.cameras[0].perspective = true;
  scene.cameras[0].yfov = 0.5 * pi;
  Settings settings;
  settings.environment = &up;
  EXPECT_EQ(render(scene, 8, settings).at(4, 0, 3), 0.0F);
  up.background = true;
  const image::Image picture = render(scene, 8, settings);
  for (const int y : {0, 3, 7}) {
    const glm::dvec3 direction = glm::normalize(glm::dvec3((4.5 - 4.0) / 4.0, (4.0 - y - 0.5) / 4.0, -1.0));
    EXPECT_NEAR(picture.at(4, y, 0), 2.0 + direction.y, 5e-3) << y;
    EXPECT_EQ(picture.at(4, y, 3), 1.0F);
  }
}

TEST(EnvironmentMaps, WhatWasFilteredOnceIsReadTheNextTime) {
  const image::TestFolder folder;
  const scene::Environment sky = image_of(32, 16, [](const glm::dvec3& d) { return 1.5 + d.y; });
  const auto drawn = [&] {
    const auto context = gles::Context::create_any(gles::ContextKind::OsMesa);
    Renderer renderer(*context, folder.path());
    Settings settings;
    settings.environment = &sky;
    settings.view.width = settings.view.height = 8;
    return renderer.render(dark_square(metal(0.5)), settings);
  };
  const image::Image first = drawn();
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    ++files;
    EXPECT_EQ(entry.path().filename().string().find("sheen"), std::string::npos) << "the scene has none";
  }
  EXPECT_EQ(files, 3) << "diffuse, GGX and the split sums";
  EXPECT_EQ(drawn().data, first.data);
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    std::ofstream(entry.path()) << "damaged";
  }
  EXPECT_EQ(drawn().data, first.data) << "a damaged file is made anew";
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  EXPECT_EQ(drawn().data, first.data);
  std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_all);
}

/// Of all directions: density / sin(theta), bilinear, times sin(theta) 2 pi^2 / texels, at 8 x 8 places of each texel.
std::vector<double> shares_of_texels(const scene::Environment& sky, const ImageSampling& sampling) {
  scene::Environment densities = sky;
  std::transform(sampling.densities().begin(), sampling.densities().end(), densities.texels.begin(), [](float d) { return glm::vec3(d); });
  constexpr int places = 8;
  std::vector<double> shares(densities.texels.size(), 0.0);
  for (int y = 0; y < sky.height * places; ++y) {
    for (int x = 0; x < sky.width * places; ++x) {
      const glm::dvec2 at((x + 0.5) / (sky.width * places), (y + 0.5) / (sky.height * places));
      const double per_place = 2.0 * pi * pi / (static_cast<double>(shares.size()) * places * places);
      shares[static_cast<std::size_t>((y / places) * sky.width + x / places)] += densities.radiance(densities.direction(at)).x * per_place;
    }
  }
  return shares;
}

class ImageSamplingOf : public testing::TestWithParam<glm::ivec2> {};

TEST_P(ImageSamplingOf, DrawsInProportionToTheDensitiesItTells) {
  const auto [width, height] = std::pair(GetParam().x, GetParam().y);
  const int texels = width * height;
  scene::Environment sky = image_of(width, height, [](const glm::dvec3& d) { return 1.0 + d.y; });
  sky.texels[static_cast<std::size_t>(2 * texels / 3)] = glm::vec3(50.0F);
  const ImageSampling sampling(sky);
  // The densities integrate to one over the sphere, and directions fall into each texel as often as its density says.
  const std::vector<double> expected = shares_of_texels(sky, sampling);
  EXPECT_NEAR(std::accumulate(expected.begin(), expected.end(), 0.0), 1.0, 1e-3);
  constexpr int count = 100000;
  std::vector<int> drawn(expected.size(), 0);
  const PointRows rows = point_rows(count, 7, &sampling);
  for (int i = 0; i < count; ++i) {
    const auto at = static_cast<std::size_t>((2 * (i / rows.columns) + 1) * rows.columns + i % rows.columns);
    const glm::dvec2 uv = sky.coordinates(glm::normalize(glm::dvec3(rows.texels[at])));
    ++drawn[static_cast<std::size_t>(static_cast<int>(uv.y * height) * width + static_cast<int>(uv.x * width))];
  }
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    EXPECT_NEAR(drawn[i], count * expected[i], 0.02 * count * expected[i] + 30.0) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(ImageSampling, ImageSamplingOf,
                         testing::Values(glm::ivec2(16, 8), glm::ivec2(13, 7), glm::ivec2(5, 1), glm::ivec2(1, 3)),
                         [](const auto& tested) { return std::to_string(tested.param.x) + "x" + std::to_string(tested.param.y); });

TEST(PointRows, OfEachSeedAreMovedAsIfAtRandomAndStayInsideTheSquare) {
  constexpr int count = 64;
  constexpr std::uint64_t seeds = 4000;
  const PointRows unmoved = point_rows(count, 0, nullptr);
  EXPECT_EQ(unmoved.texels[0].x, 0.5F) << "Halton's first";
  double mean = 0.0;
  double square = 0.0;
  double product = 0.0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const PointRows rows = point_rows(count, seed, nullptr);
    for (int i = 0; i < count; ++i) {
      const glm::vec4& p = rows.texels[static_cast<std::size_t>(i)];
      ASSERT_GT(p.x, 0.0F);
      ASSERT_LT(p.x, 1.0F);
      ASSERT_NEAR(p.y * p.y + p.z * p.z, 1.0F, 1e-6F);
    }
    const double x = rows.texels[0].x - 0.5;
    mean += x / seeds;
    square += x * x / seeds;
    product += x * (point_rows(count, seed + 1, nullptr).texels[0].x - 0.5) / seeds;
  }
  // Four standard errors of numbers drawn evenly and independently.
  EXPECT_NEAR(mean, 0.0, 4.0 * std::sqrt(1.0 / 12.0 / seeds));
  EXPECT_NEAR(square, 1.0 / 12.0, 4.0 * std::sqrt(1.0 / 180.0 / seeds));
  EXPECT_NEAR(product, 0.0, 4.0 / 12.0 / std::sqrt(static_cast<double>(seeds))) << "neighbouring seeds have nothing to do with each other";
}

TEST(ImageSampling, NoLightAtAllIsDrawnFromEvenly) {
  const ImageSampling sampling(image_of(8, 4, [](const glm::dvec3&) { return 0.0; }));
  // Texel (5, 1), which stands for [5/8, 6/8) x [1/4, 2/4): the middle gives its centre. In the outer half of a row of its own it is the
  // place itself.
  const auto expect_at = [](const ImageSampling::Drawn& drawn, double u, double v) {
    const glm::dvec3 expected = scene::Environment().direction({u, v});
    EXPECT_NEAR(glm::distance(drawn.direction, expected), 0.0, 1e-9);
    EXPECT_NEAR(drawn.density, 1.0 / (2.0 * pi * pi * std::sin(pi * v)), 1e-5 * drawn.density);
  };
  expect_at(sampling.draw(5.5 / 8, 1.5 / 4), 5.5 / 8, 1.5 / 4);
  expect_at(sampling.draw(5.5 / 8, 0.2 / 4), 5.5 / 8, 0.2 / 4);
  expect_at(sampling.draw(5.125 / 8, 1.5 / 4), 5.0 / 8, 1.5 / 4);  // an eighth of a tent lies before its first half of a slope
}

TEST(ImageSampling, FindsEachPartOfTheLightNearlyInItsShare) {
  // Of 1,024 directions toward skies of lamps, how many fall into each of 8 x 4 parts: chi squared, by its degrees of freedom. Directions
  // at random give 1, and 0.26 where a row is chosen before a column.
  constexpr int count = 1024;
  constexpr int skies = 32;
  double sum = 0.0;
  std::mt19937_64 random(5);
  std::uniform_real_distribution<float> share(0.0F, 1.0F);
  for (int k = 0; k < skies; ++k) {
    const scene::Environment sky =
        image_of(64, 32, [&](const glm::dvec3&) { return share(random) < 0.02F ? 1000.0F * share(random) : share(random); });
    const ImageSampling sampling(sky);
    std::array<double, 32> found{};
    std::array<double, 32> expected{};
    const auto part = [](double u, double v) {
      return static_cast<std::size_t>(static_cast<int>(v * 4.0) * 8 + static_cast<int>(u * 8.0));
    };
    const std::vector<double> shares = shares_of_texels(sky, sampling);
    for (int y = 0; y < 32; ++y) {
      for (int x = 0; x < 64; ++x) {
        expected.at(part((x + 0.5) / 64, (y + 0.5) / 32)) += count * shares[static_cast<std::size_t>(y * 64 + x)];
      }
    }
    const PointRows rows = point_rows(count, 0, &sampling);
    for (int i = 0; i < count; ++i) {
      const glm::vec4& direction = rows.texels[static_cast<std::size_t>(rows.columns + i)];
      const glm::dvec2 uv = sky.coordinates(glm::normalize(glm::dvec3(direction)));
      found.at(part(uv.x, uv.y)) += 1.0;
    }
    for (std::size_t i = 0; i < found.size(); ++i) {
      sum += (found.at(i) - expected.at(i)) * (found.at(i) - expected.at(i)) / expected.at(i) / 31.0;
    }
  }
  EXPECT_LT(sum / skies, 0.2);
}

}  // namespace
}  // namespace sheen::renderer
