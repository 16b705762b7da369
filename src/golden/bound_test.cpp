// The bound and the excluded pixels: what a sample moved within the step shows must stay inside.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <vector>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "golden/frame.h"
#include "golden/test_scenes.h"
#include "golden/uniform_light.h"

namespace sheen::golden {
namespace {

constexpr int side = 48;
constexpr double ymag = 1.1;

scene::Scene cloth_over_floor() {
  const scene::Material m = test::cloth(0.4);
  scene::Scene s = test::scene_with(test::sphere(40, 20), m, test::orthographic_at(5.0, ymag), {test::directional({0.5, 0.6, 1.0})});
  test::add(s, test::square(0.9, -1.5), test::lambertian({0.9, 0.1, 0.1, 1.0}));
  scene::Material pane = test::lambertian({0.1, 0.9, 0.2, 0.4});
  pane.alpha_mode = scene::AlphaMode::Blend;
  test::add(s, test::square(0.5, 1.5), pane, glm::rotate(glm::dmat4(1.0), 0.3, glm::dvec3(0.0, 0.0, 1.0)));
  return s;
}

// For an orthographic camera a moved sample is a moved camera.
image::Image rendered_with_shift(scene::Scene s, double dx, double dy) {
  const double pixel = 2.0 * ymag / side;
  s.cameras[0].world_from_camera = glm::translate(s.cameras[0].world_from_camera, glm::dvec3(dx * pixel, -dy * pixel, 0.0));
  return render(s, test::settings_for(side, side));
}

TEST(Bound, HoldsWhatAnySampleWithinTheStepShows) {
  scene::Scene s = cloth_over_floor();
  for (const int bits : {4, 8}) {
    Settings settings = test::settings_for(side, side, true);
    settings.subpixel_bits = bits;
    const image::Image golden = render(s, settings);
    const double step = displacement(settings);
    int excluded = 0;
    int covered = 0;
    for (const glm::dvec2 shift : {glm::dvec2(1, 1), glm::dvec2(-1, 1), glm::dvec2(0.5, -0.9), glm::dvec2(-0.3, -0.3), glm::dvec2(1, 0)}) {
      const image::Image moved = rendered_with_shift(s, shift.x * step, shift.y * step);
      excluded = covered = 0;
      for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
          const bool out = golden.at(x, y, golden.channel("excluded")) > 0.0f;
          excluded += out ? 1 : 0;
          covered += golden.at(x, y, 3) > 0.0f ? 1 : 0;
          if (!out) {
            EXPECT_NEAR(golden.at(x, y, 3), moved.at(x, y, 3), 1e-6) << "coverage changes at " << x << ' ' << y;
          }
          for (int c = 0; c < 3 && !out; ++c) {
            EXPECT_LE(std::abs(golden.at(x, y, c) - moved.at(x, y, c)), golden.at(x, y, 4 + c) * (1.0 + 1e-6))
                << "bits " << bits << " at " << x << ' ' << y;
          }
        }
      }
    }
    EXPECT_GT(excluded, 0) << "silhouettes of the sphere, the floor and the pane cross some pixel centres";
    EXPECT_LT(excluded, 0.6 * 400.0 * 4.0 * step * side) << "only pixels whose centre is within the step of an edge: bits " << bits;
    EXPECT_GT(covered, side * side / 2);
  }
}

TEST(Bound, InteriorOfASmoothSurfaceIsNeverExcludedAndTight) {
  scene::Scene s = test::scene_with(test::sphere(64, 32), test::lambertian({0.5, 0.5, 0.5, 1.0}), test::orthographic_at(5.0, 0.5),
                                    {test::directional({0.2, 0.1, 1.0})});
  const image::Image golden = render(s, test::settings_for(side, side, true));
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      EXPECT_EQ(golden.at(x, y, 7), 0.0f) << x << ' ' << y;
      const double value = golden.at(x, y, 0);
      EXPECT_GE(golden.at(x, y, 4), 4.0 * 0x1p-23 * value) << "a few roundings";
      EXPECT_LE(golden.at(x, y, 4), 2e-4 * value) << "a pixel's step is 1/22 of the radius, of which the sample moves by 1/512";
    }
  }
}

TEST(Bound, OcclusionEdgesAreExcludedThoughCoverageStays) {
  scene::Scene s = test::scene_with(test::square(5.0, -1.0), test::lambertian({0.2, 0.2, 0.2, 1.0}), test::orthographic_at(5.0, 1.0),
                                    {test::directional({0.0, 0.0, 1.0})});
  test::add(s, test::square(1.0), test::lambertian({0.9, 0.9, 0.9, 1.0}),
            glm::translate(glm::dmat4(1.0), glm::dvec3(1.0 + 1.0 / 16.0 + 1e-4, 0.0, 0.0)));  // its edge runs beside pixel centres
  const image::Image golden = render(s, test::settings_for(16, 16, true));
  for (int x = 0; x < 16; ++x) {
    EXPECT_EQ(golden.at(x, 5, 7), x == 8 ? 1.0f : 0.0f) << x;
  }
  EXPECT_LT(golden.at(8, 5, 4), 1e-6) << "there is no bound";
}

TEST(Bound, EdgesBetweenFacesOfOneSurfaceAreNotExcluded) {
  scene::Primitive roof;  // two faces that meet at x = 1/16, beside pixel centres, with a hard edge
  const float ridge = 1.0f / 16.0f + 1e-4f;
  roof.positions = {{-2, -2, -1}, {ridge, -2, 0}, {ridge, 2, 0}, {-2, 2, -1}, {ridge, -2, 0}, {2, -2, -3}, {2, 2, -3}, {ridge, 2, 0}};
  const glm::vec3 left = glm::normalize(glm::vec3(-1.0f, 0.0f, 2.0f + ridge));
  const glm::vec3 right = glm::normalize(glm::vec3(3.0f, 0.0f, 2.0f - ridge));
  roof.normals = {left, left, left, left, right, right, right, right};
  roof.indices = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
  const scene::Scene s =
      test::scene_with(roof, test::lambertian({0.9, 0.9, 0.9, 1.0}), test::orthographic_at(5.0, 1.0), {test::directional({0.0, 0.0, 1.0})});
  const image::Image golden = render(s, test::settings_for(16, 16, true));
  for (int x = 0; x < 16; ++x) {
    EXPECT_EQ(golden.at(x, 5, 7), 0.0f) << x;
  }
  const double difference = 0.9 / 3.14159265358979 * (left.z - right.z);
  EXPECT_GT(golden.at(8, 5, 4), difference) << "either face may be shown";
  EXPECT_LT(golden.at(6, 5, 4), 0.01 * difference);
}

TEST(Bound, HoldsATriangleCarriedOnBeyondItsEdge) {
  // A driver whose grid moves an edge may shade a pixel with a triangle that ends beside it, at attributes beyond its own. Here that
  // triangle is a strip narrower than the step: samples moved by the step meet its flat neighbours, and only the strip carried on shows
  // what may come.
  scene::Primitive fold;
  const float left = 1.0f / 16.0f - 0.00375f;  // a pixel's centre lies at 1/16
  const float right = 1.0f / 16.0f + 0.00375f;
  fold.positions = {{-2, -2, 0},   {left, -2, 0}, {left, 2, 0},   {-2, 2, 0}, {left, -2, 0}, {right, -2, 0},
                    {right, 2, 0}, {left, 2, 0},  {right, -2, 0}, {2, -2, 0}, {2, 2, 0},     {right, 2, 0}};
  const glm::vec3 up(0.0f, 0.0f, 1.0f);
  const glm::vec3 one(-0.5f, 0.0f, 1.0f);
  const glm::vec3 other(0.5f, 0.0f, 1.0f);
  fold.normals = {up, up, up, up, one, other, other, one, up, up, up, up};
  fold.indices = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7, 8, 9, 10, 8, 10, 11};
  const scene::Scene s =
      test::scene_with(fold, test::lambertian({0.9, 0.9, 0.9, 1.0}), test::orthographic_at(5.0, 1.0), {test::directional({1.0, 0.0, 1.0})});
  Settings settings = test::settings_for(16, 16, true);
  settings.subpixel_bits = 4;
  const image::Image golden = render(s, settings);
  const Frame frame(s, settings);
  Seen seen;
  const Ray centre = frame.rays.through(8.5, 5.5);
  frame.tracer.trace(centre, false, seen);
  const std::optional<Hit> there = frame.geometry.meet(seen.nearest->triangle, frame.rays.through(8.5 + 1.0 / 16, 5.5 + 1.0 / 16));
  ASSERT_LT(std::min({there->weights.x, there->weights.y, there->weights.z}), 0.0) << "the shifted sample lies beyond this triangle";
  const auto radiance = shade(frame.reader.surface(*there, centre), {}, frame.lighting(), NoListener{}).radiance;
  EXPECT_GT(std::abs(radiance.r - golden.at(8, 5, 0)), 0.1 * golden.at(8, 5, 0)) << "far more than the rest of the bound";
  EXPECT_LE(std::abs(radiance.r - golden.at(8, 5, 0)), golden.at(8, 5, 4));
}

TEST(Bound, HoldsTheTriangleBesideTheEdgeAtTheSampleItself) {
  // The right face's emission runs steeply along the edge: a driver that gives the centre to it shows its value there, not at the corners.
  scene::Primitive left = test::square(2.0);
  scene::Primitive right = test::square(2.0);
  const float edge = 1.0f / 16.0f + 1e-4f;  // a pixel's centre lies at 1/16
  for (glm::vec3& p : left.positions) {
    p.x = p.x < 0.0f ? -4.0f : edge;
  }
  for (glm::vec3& p : right.positions) {
    p.x = p.x < 0.0f ? edge : 4.0f;
  }
  // A row of texels is as high as the step: bright at every centre, dark at the corners. The left face shows one dark row.
  scene::Primitive faces = left;
  faces.texcoords[0].assign(4, glm::dvec2(0.0, 1.0 / 512));
  faces.positions.insert(faces.positions.end(), right.positions.begin(), right.positions.end());
  faces.normals.insert(faces.normals.end(), right.normals.begin(), right.normals.end());
  faces.tangents.insert(faces.tangents.end(), right.tangents.begin(), right.tangents.end());
  faces.texcoords[0].insert(faces.texcoords[0].end(), right.texcoords[0].begin(), right.texcoords[0].end());
  std::transform(right.indices.begin(), right.indices.end(), std::back_inserter(faces.indices), [](std::uint32_t i) { return i + 4; });
  scene::Material ridged = test::lambertian({0.0, 0.0, 0.0, 1.0});
  ridged.emissive_factor = glm::dvec3(1.0);
  scene::Scene s = test::scene_with(faces, ridged, test::orthographic_at(5.0, 1.0), {});
  s.materials[0].emissive_texture =
      test::add_texture(s, test::picture(2, 512, [](int, int y) { return glm::ivec4(glm::ivec3((y + 1) % 2 * 255), 255); }));
  s.materials[0].emissive_texture.transform[2][1] = 0.5 / 512.0;
  s.textures[0].sampler.mip = scene::MipFilter::None;
  Settings settings = test::settings_for(16, 16, true);
  settings.subpixel_bits = 4;
  const image::Image golden = render(s, settings);
  const Frame frame(s, settings);
  int steeper = 0;
  for (int y = 2; y < 14; ++y) {
    Seen seen;
    const Ray corner = frame.rays.through(8.5 + 1.0 / 16, y + 0.5);
    frame.tracer.trace(corner, false, seen);
    const Ray centre = frame.rays.through(8.5, y + 0.5);
    const std::optional<Hit> there = frame.geometry.meet(seen.nearest->triangle, centre);
    const auto value = shade(frame.reader.surface(*there, centre), {}, frame.lighting(), NoListener{}).radiance.r;
    EXPECT_EQ(golden.at(8, y, 7), 0.0f) << y;
    EXPECT_LE(std::abs(value - golden.at(8, y, 0)), golden.at(8, y, 4)) << y;
    double at_corners = 0.0;
    for (const double dy : {-1.0 / 16, 1.0 / 16}) {
      const Ray ray = frame.rays.through(8.5 + 1.0 / 16, y + 0.5 + dy);
      const auto moved =
          shade(frame.reader.surface(*frame.geometry.meet(seen.nearest->triangle, ray), ray), {}, frame.lighting(), NoListener{});
      at_corners = std::max(at_corners, std::abs(moved.radiance.r - golden.at(8, y, 0)));
    }
    steeper += std::abs(value - golden.at(8, y, 0)) > 1.1 * at_corners + 2e-3 ? 1 : 0;
  }
  EXPECT_GT(steeper, 0) << "at some pixels only the sample itself shows it";
}

TEST(Bound, HoldsTheCoverageOfABlendedTexture) {
  scene::Material m = test::lambertian({1.0, 1.0, 1.0, 1.0});
  m.alpha_mode = scene::AlphaMode::Blend;
  scene::Scene s = test::scene_with(test::square(0.9), m, test::orthographic_at(5.0, 1.0), {test::directional({0.0, 0.0, 1.0})});
  s.materials[0].base_color_texture =
      test::add_texture(s, test::picture(64, 64, [](int x, int y) { return glm::ivec4(255, 255, 255, (x * 37 + y * 91) % 256); }));
  s.textures[0].sampler.mip = scene::MipFilter::None;
  Settings settings = test::settings_for(side, side, true);
  settings.subpixel_bits = 4;
  const image::Image golden = render(s, settings);
  const int bound = golden.channel("bound.A");
  ASSERT_GE(bound, 0);
  const double step = 2.0 / side * displacement(settings);
  for (const glm::dvec2 shift : {glm::dvec2(1, 1), glm::dvec2(-1, 1), glm::dvec2(1, -1)}) {
    scene::Scene moved = s;
    moved.cameras[0].world_from_camera = glm::translate(s.cameras[0].world_from_camera, glm::dvec3(shift.x, -shift.y, 0.0) * step);
    const image::Image other = render(moved, test::settings_for(side, side));
    double largest = 0.0;
    for (int y = 4; y < side - 4; ++y) {
      for (int x = 4; x < side - 4; ++x) {
        const double change = std::abs(other.at(x, y, 3) - golden.at(x, y, 3));
        EXPECT_LE(change, golden.at(x, y, bound)) << x << ' ' << y;
        largest = std::max(largest, change);
      }
    }
    EXPECT_GT(largest, 0.01);
  }
  EXPECT_EQ(golden.at(0, 0, bound), 0.0f) << "no surface covers nothing, exactly";
}

// A square under 64 x 64 texels of noise, seen from so far that a moved sample may meet any of them: without mipmaps the bound holds all
// that they may show, under an environment, whose light is found at a few of them, the pixel is left out.
TEST(Bound, HoldsEveryTexelThatAMovedSampleMayMeet) {
  scene::Environment uniform;
  uniform.uniform = glm::dvec3(1.0);
  for (const auto mip : {scene::MipFilter::None, scene::MipFilter::Linear}) {
    for (const double tiles : {1.0, 3000.0}) {  // 8 and 24,000 texels a pixel, of which the step is 1/512
      scene::Scene s = test::scene_with(test::square(0.9), test::lambertian(glm::dvec4(1.0)), test::orthographic_at(5.0, 1.0),
                                        {test::directional({0.0, 0.0, 1.0})});
      auto& texture = s.materials[0].base_color_texture;
      texture = test::add_texture(s, test::picture(64, 64, [](int x, int y) { return glm::ivec4((x * 37 + y * 91) % 256); }));
      texture.transform = glm::dmat3(tiles, 0.0, 0.0, 0.0, tiles, 0.0, 0.0, 0.0, 1.0);
      s.textures[0].sampler.mip = mip;
      Settings settings = test::settings_for(8, 8, true);
      const image::Image golden = render(s, settings);
      const bool too_far = mip == scene::MipFilter::None && tiles > 1.0;
      EXPECT_EQ(golden.at(4, 4, golden.channel("excluded")), 0.0F) << tiles;
      const double value = golden.at(4, 4, 0);
      const double bound = golden.at(4, 4, golden.channel("bound.R"));
      EXPECT_EQ(value + bound >= 1.0 / brdf::pi && value - bound <= 0.0, too_far) << tiles;
      settings.environment = &uniform;
      const image::Image lit = render(s, settings);
      EXPECT_EQ(lit.at(4, 4, lit.channel("excluded")), too_far ? 3.0F : 0.0F) << tiles;
    }
  }
}

// At grazing angles our shader's one look-up of E is not the larger of two, under light from everywhere either.
TEST(Bound, HoldsWhatASingleLookupMissesUnderAnEnvironment) {
  scene::Primitive leaning = test::square(0.9);
  for (glm::vec3& normal : leaning.normals) {
    normal = glm::normalize(glm::vec3(1.0F, 0.0F, 0.001F));
  }
  scene::Material cloth = test::cloth(0.8);
  cloth.sheen.color_factor = glm::dvec3(0.9);
  cloth.metallic_factor = 1.0;
  cloth.roughness_factor = 0.05;
  const scene::Scene s = test::scene_with(leaning, cloth, test::orthographic_at(5.0, 1.0), {});
  scene::Environment uniform;
  uniform.uniform = glm::dvec3(1.0);
  Settings settings = test::settings_for(8, 8, true);
  settings.environment = &uniform;
  const Frame frame(s, settings);
  const Ray ray = frame.rays.through(4.5, 4.5);
  Seen seen;
  frame.tracer.trace(ray, false, seen);
  ASSERT_TRUE(seen.nearest);
  const double missed = UniformLight(frame.lighting(), {1.0, 1.0, 1.0}).lookup(frame.reader.surface(*seen.nearest, ray), {true, false}).g;
  EXPECT_GT(missed, 0.02);
  const image::Image golden = render(s, settings);
  EXPECT_EQ(golden.at(4, 4, golden.channel("excluded")), 0.0F);
  EXPECT_GE(golden.at(4, 4, golden.channel("bound.G")), missed);
  EXPECT_LT(golden.at(4, 4, golden.channel("bound.G")), missed + 0.02);
}

TEST(Bound, HoldsTheRoundingOfLargeTextureCoordinates) {
  // Columns of black and white 16 pixels wide, so that the step moves next to nothing; the offset of 20,000 costs 2^-9 of a column.
  scene::Scene s = test::scene_with(test::square(1.0), test::lambertian(glm::dvec4(1.0)), test::orthographic_at(5.0, 1.0),
                                    {test::directional({0.0, 0.0, 1.0})});
  auto& texture = s.materials[0].base_color_texture;
  texture =
      test::add_texture(s, test::picture(4, 4, [](int x, int) { return glm::ivec4(glm::ivec3(255 * (x % 2)), 255); }),
                        {scene::Wrap::Repeat, scene::Wrap::Repeat, scene::Filter::Nearest, scene::Filter::Nearest, scene::MipFilter::None});
  for (const double offset : {0.0, 20000.0}) {
    // The border between two columns lies 0.002 of a column beside a pixel's centre.
    texture.transform = glm::dmat3(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, offset + (0.5 + 0.032) / 64.0, 0.0, 1.0);
    const image::Image golden = render(s, test::settings_for(64, 64, true));
    const float bound = golden.at(31, 20, golden.channel("bound.R"));
    EXPECT_EQ(golden.at(31, 20, golden.channel("excluded")), 0.0f);
    if (offset > 0.0) {
      EXPECT_GT(bound, 0.3) << "either column may be read";
    } else {
      EXPECT_LT(bound, 1e-3);
    }
  }
}

TEST(Bound, WidensAtTheRimOfANarrowCone) {
  scene::Light spot;
  spot.type = scene::LightType::Spot;
  spot.position = {0.0, 0.0, 10.0};
  spot.direction = {0.0, 0.0, -1.0};
  spot.intensity = 100.0;
  spot.inner_cone = 0.0499;
  spot.outer_cone = 0.05;
  const scene::Scene s = test::scene_with(test::square(1.0), test::lambertian(glm::dvec4(1.0)), test::orthographic_at(12.0, 0.6), {spot});
  const image::Image golden = render(s, test::settings_for(301, 301, true));
  double widest = 0.0;
  for (int x = 150; x < 301; ++x) {
    const double value = golden.at(x, 150, 0);
    if (value > 1e-3) {
      widest = std::max(widest, (golden.at(x, 150, golden.channel("bound.R")) - 2e-5) / value);
    }
  }
  EXPECT_GT(widest, 5e-3);
  EXPECT_LT(golden.at(150, 150, golden.channel("bound.R")) / golden.at(150, 150, 0), 2.2e-3) << "the middle knows little of it";
}

TEST(Bound, SurfacesAtOneDepthAreExcludedAndTheFirstInTheFileIsShown) {
  scene::Scene s = test::scene_with(test::square(2.0), test::lambertian({0.2, 0.2, 0.2, 1.0}), test::camera_at(5.0),
                                    {test::directional({0.0, 0.0, 1.0})});
  test::add(s, test::square(2.0), test::lambertian({0.9, 0.9, 0.9, 1.0}));
  const image::Image golden = render(s, test::settings_for(16, 15, true));
  const double one = 0.2 / 3.14159265358979;
  for (int x = 0; x < 16; ++x) {
    EXPECT_EQ(golden.at(x, 4, 7), 1.0f) << x;
    EXPECT_NEAR(golden.at(x, 4, 0), one, 1e-6);
  }
  s.instances[1].world_from_local = glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, -0.1));
  EXPECT_EQ(render(s, test::settings_for(16, 15, true)).at(5, 4, 7), 0.0f);
}

TEST(Bound, HoldsTheFreedomInTheLevelOfDetail) {
  scene::Material m = test::lambertian({0.0, 0.0, 0.0, 1.0});
  m.emissive_factor = glm::dvec3(1.0);
  scene::Scene s = test::scene_with(test::square(1.0), m, test::orthographic_at(5.0, 1.0), {});
  const auto checks = [](int x, int y) { return glm::ivec4(glm::ivec3((x / 4 + y / 4) % 2 * 255), 255); };
  s.materials[0].emissive_texture = test::add_texture(s, test::picture(64, 64, checks));
  s.materials[0].emissive_texture.transform = glm::dmat3(0.8, 0.6, 0.0, -0.6, 0.8, 0.0, 0.0, 0.0, 1.0);
  const auto largest_bound = [&] {
    const image::Image im = render(s, test::settings_for(32, 32, true));
    double largest = 0.0;
    for (int x = 4; x < 28; ++x) {
      largest = std::max<double>(largest, im.at(x, 9, 4));
    }
    return largest;
  };
  const double mipmapped = largest_bound();
  s.textures[0].sampler.mip = scene::MipFilter::None;
  EXPECT_GT(mipmapped, 2.0 * largest_bound()) << "two texels a pixel leave half a level of freedom";
}

TEST(Bound, OfAFaintLightHoldsWhatMayBeFlushed) {
  for (const double lux : {0x1p-110, 0x1p-125, 0x1p-140}) {
    const scene::Scene s = test::scene_with(test::sphere(40, 20), test::lambertian({0.5, 0.5, 0.5, 1.0}), test::orthographic_at(5.0, ymag),
                                            {test::directional({0.0, 0.0, 1.0}, glm::dvec3(1.0), lux)});
    const image::Image golden = render(s, test::settings_for(side, side, true));
    for (int c = 0; c < 3; ++c) {
      EXPECT_GE(golden.at(side / 2, side / 2, 4 + c), 0x1p-126F) << "of " << lux << " lux";
    }
  }
}

// Half floats, which mediump may be, are multiples of 2^-24 near 0: a shader that multiplies N.L into the BRDF before it stores it rounds
// what is less to either.
TEST(Bound, OfMediumpHoldsWhatASmallProductWithTheCosineLoses) {
  constexpr double n_dot_l = 1e-3, share = 0.3, lux = 1e4;
  const double color = share * 0x1p-24 / n_dot_l * glm::pi<double>();
  const scene::Scene s = test::scene_with(test::square(2.0), test::lambertian(glm::dvec4(color, color, color, 1.0)),
                                          test::orthographic_at(5.0, ymag), {test::directional({1.0, 0.0, n_dot_l}, glm::dvec3(1.0), lux)});
  Settings settings = test::settings_for(side, side, true);
  settings.precision = Precision::Mediump;
  for (const albedo::Model model : {albedo::Model::Ratified, albedo::Model::Physical}) {
    settings.sheen.model = model;
    const image::Image golden = render(s, settings);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(golden.at(side / 2, side / 2, c), share * 0x1p-24 * lux, 1e-2 * share * 0x1p-24 * lux);
      EXPECT_GE(golden.at(side / 2, side / 2, 4 + c), (1 - share) * 0x1p-24 * lux) << "rounded up";
    }
  }
}

}  // namespace
}  // namespace sheen::golden
