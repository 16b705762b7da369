// What the golden shows of surfaces: visibility, coverage, order, textures.

#include <cmath>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "golden/frame.h"
#include "golden/long_double_model.h"
#include "golden/test_scenes.h"

namespace sheen::golden {
namespace {

using test::rgb;

constexpr double pi = 3.14159265358979323846;

scene::Material glowing(glm::dvec3 emission, double alpha = 1.0, scene::AlphaMode mode = scene::AlphaMode::Opaque) {
  scene::Material m = test::lambertian({0.0, 0.0, 0.0, alpha});
  m.emissive_factor = emission;
  m.alpha_mode = mode;
  return m;
}

void expect_color(const image::Image& im, int x, int y, glm::dvec3 want, double tolerance = 1e-6) {
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(im.at(x, y, c), want[c], tolerance) << "channel " << c << " at " << x << ' ' << y;
  }
}

TEST(Render, LambertianSquareReflectsItsAlbedoOverPi) {
  const scene::Scene s = test::scene_with(test::square(1.0), test::lambertian({0.2, 0.4, 0.8, 1.0}), test::camera_at(10.0, 0.3),
                                          {test::directional({0.0, std::sin(0.5), std::cos(0.5)}, glm::dvec3(1.0), 3.0)});
  const image::Image im = render(s, test::settings_for(32, 16));
  expect_color(im, 16, 8, glm::dvec3(0.2, 0.4, 0.8) * (3.0 * std::cos(0.5) / pi));
  EXPECT_EQ(im.at(16, 8, 3), 1.0f);
  EXPECT_EQ(im.at(0, 8, 3), 0.0f) << "the picture is wider than the square";
  EXPECT_EQ(rgb(im, 0, 8), glm::dvec3(0.0));
}

TEST(Render, RowsRunFromTheTop) {
  scene::Scene s = test::scene_with(test::square(0.2), glowing({1.0, 0.0, 0.0}), test::orthographic_at(5.0, 1.0), {});
  s.instances[0].world_from_local = glm::translate(glm::dmat4(1.0), glm::dvec3(0.7, 0.7, 0.0));
  const image::Image im = render(s, test::settings_for(20, 20));
  EXPECT_EQ(im.at(17, 2, 3), 1.0f);
  EXPECT_EQ(im.at(2, 17, 3), 0.0f);
}

TEST(Render, BlendIsLaidBackToFrontWhateverTheOrderOfTheFile) {
  scene::Scene s =
      test::scene_with(test::square(1.0, 0.5), glowing({1.0, 0.0, 0.0}, 0.5, scene::AlphaMode::Blend), test::camera_at(5.0), {});
  test::add(s, test::square(3.0, -1.0), glowing({0.0, 0.0, 1.0}));
  test::add(s, test::square(1.0, 0.0), glowing({0.0, 1.0, 0.0}, 0.25, scene::AlphaMode::Blend));
  test::add(s, test::square(1.0, -2.0), glowing({9.0, 9.0, 9.0}, 0.5, scene::AlphaMode::Blend));
  const image::Image im = render(s, test::settings_for(9, 9, true));
  expect_color(im, 4, 3, glm::dvec3(0.5, 0.125, 0.375));
  EXPECT_EQ(im.at(4, 3, 3), 1.0f);
  s.instances.erase(s.instances.begin() + 1);
  s.instances.pop_back();
  const image::Image over_black = render(s, test::settings_for(9, 9));
  expect_color(over_black, 4, 3, glm::dvec3(0.5, 0.125, 0.0));
  EXPECT_NEAR(over_black.at(4, 3, 3), 0.625, 1e-7);
}

// The order is that of the triangles' centroids, even where it is not that of the depth met in a pixel.
TEST(Render, BlendOrderIsThatOfCentroids) {
  scene::Primitive slanted = test::square(1.0);
  for (glm::vec3& p : slanted.positions) {
    p.z = 2.0f * p.x;
  }  // near on the right; its centroids lie about z = 0
  scene::Scene s = test::scene_with(slanted, glowing({1.0, 0.0, 0.0}, 0.5, scene::AlphaMode::Blend), test::orthographic_at(9.0, 1.0), {});
  test::add(s, test::square(1.0, 0.9), glowing({0.0, 1.0, 0.0}, 0.5, scene::AlphaMode::Blend));
  const image::Image im = render(s, test::settings_for(16, 16));
  expect_color(im, 15, 4, glm::dvec3(0.25, 0.5, 0.0));
  expect_color(im, 1, 4, glm::dvec3(0.25, 0.5, 0.0));
}

TEST(Render, BackFacesShowOnlyOnDoubleSidedMaterialsAndAreLitFromTheirSide) {
  scene::Material m = test::lambertian({0.5, 0.5, 0.5, 1.0});
  scene::Scene s = test::scene_with(test::square(1.0), m, test::camera_at(5.0, 0.3), {test::directional({0.0, 0.0, 1.0})});
  s.instances[0].world_from_local = glm::rotate(glm::dmat4(1.0), pi, glm::dvec3(0.0, 1.0, 0.0));
  EXPECT_EQ(render(s, test::settings_for(7, 7)).at(3, 2, 3), 0.0f);
  s.materials[0].double_sided = true;
  expect_color(render(s, test::settings_for(7, 7)), 3, 2, glm::dvec3(0.5 / pi));
  s.lights = {test::directional({0.0, 0.0, -1.0})};
  expect_color(render(s, test::settings_for(7, 7)), 3, 2, glm::dvec3(0.0));
}

TEST(Render, MirroredInstancesFlipWhichFaceIsFront) {
  scene::Scene s = test::scene_with(test::square(1.0), test::lambertian({0.5, 0.5, 0.5, 1.0}), test::camera_at(5.0, 0.3),
                                    {test::directional({0.0, 0.0, 1.0})});
  s.instances[0].world_from_local = glm::scale(glm::dmat4(1.0), glm::dvec3(-1.0, 1.0, 1.0));
  expect_color(render(s, test::settings_for(7, 7)), 3, 2, glm::dvec3(0.5 / pi));
  s.instances[0].world_from_local = glm::scale(glm::dmat4(1.0), glm::dvec3(1.0, 1.0, -1.0));
  EXPECT_EQ(render(s, test::settings_for(7, 7)).at(3, 2, 3), 0.0f) << "its front looks away";
}

TEST(Render, SurfacesOutsideTheClipRangeAreNotSeen) {
  scene::Scene s = test::scene_with(test::square(2.0), glowing({1.0, 0.0, 0.0}), test::camera_at(5.0), {});
  test::add(s, test::square(2.0, 1.0), glowing({0.0, 1.0, 0.0}));
  const auto seen = [&](double znear, double zfar) {
    s.cameras[0].znear = znear;
    s.cameras[0].zfar = zfar;
    return rgb(render(s, test::settings_for(5, 5)), 2, 1);
  };
  EXPECT_EQ(seen(0.1, 100.0), glm::dvec3(0.0, 1.0, 0.0));
  EXPECT_EQ(seen(4.5, 100.0), glm::dvec3(1.0, 0.0, 0.0)) << "the nearer one is before the near plane";
  EXPECT_EQ(seen(0.1, 3.0), glm::dvec3(0.0));
}

TEST(Render, MaskKeepsWhereAlphaReachesTheCutoff) {
  scene::Scene s = test::scene_with(test::square(2.0), glowing({1.0, 0.0, 0.0}), test::camera_at(5.0), {});
  scene::Material mask = glowing({0.0, 1.0, 0.0}, 0.5, scene::AlphaMode::Mask);
  test::add(s, test::square(2.0, 1.0), mask);
  EXPECT_EQ(rgb(render(s, test::settings_for(5, 5)), 2, 1), glm::dvec3(0.0, 1.0, 0.0)) << "alpha = cutoff is kept";
  EXPECT_EQ(render(s, test::settings_for(5, 5)).at(2, 1, 3), 1.0f);
  s.materials[1].alpha_cutoff = 0.51;
  EXPECT_EQ(rgb(render(s, test::settings_for(5, 5)), 2, 1), glm::dvec3(1.0, 0.0, 0.0));
}

TEST(Render, VertexColoursTintTheBaseAlone) {
  scene::Primitive p = test::square(1.0);
  p.colors.assign(4, glm::vec4(0.5f, 0.25f, 1.0f, 0.5f));
  scene::Material m = test::lambertian({0.8, 0.8, 0.8, 0.5});
  m.emissive_factor = glm::dvec3(0.1);
  m.alpha_mode = scene::AlphaMode::Blend;
  const scene::Scene s = test::scene_with(p, m, test::camera_at(5.0, 0.3), {test::directional({0.0, 0.0, 1.0})});
  const image::Image im = render(s, test::settings_for(5, 5));
  expect_color(im, 2, 1, 0.25 * (glm::dvec3(0.4, 0.2, 0.8) / pi + 0.1));
  EXPECT_NEAR(im.at(2, 1, 3), 0.25, 1e-7);
}

TEST(Render, TexturesLieWithTheirFirstRowAtV0AndFollowTheirTransform) {
  scene::Scene s = test::scene_with(test::square(1.0), glowing(glm::dvec3(1.0)), test::orthographic_at(5.0, 1.0), {});
  scene::Sampler sampler;
  sampler.mag = sampler.min = scene::Filter::Nearest;
  sampler.mip = scene::MipFilter::None;
  const auto code = [](int x, int y) { return glm::ivec4(x == 0 && y == 0 ? 255 : 0, x == 1 && y == 0 ? 255 : 0, y == 1 ? 255 : 0, 255); };
  s.materials[0].emissive_texture = test::add_texture(s, test::picture(2, 2, code), sampler);
  const image::Image im = render(s, test::settings_for(8, 8));
  EXPECT_EQ(rgb(im, 1, 1), glm::dvec3(1.0, 0.0, 0.0));
  EXPECT_EQ(rgb(im, 6, 1), glm::dvec3(0.0, 1.0, 0.0));
  EXPECT_EQ(rgb(im, 6, 6), glm::dvec3(0.0, 0.0, 1.0));
  s.materials[0].emissive_texture.transform = glm::dmat3(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.5, 0.5, 1.0);
  const image::Image shifted = render(s, test::settings_for(8, 8));
  EXPECT_EQ(rgb(shifted, 6, 6), glm::dvec3(1.0, 0.0, 0.0));
  s.primitives[0].texcoords[1].assign(4, glm::vec2(0.75f, 0.25f));
  s.materials[0].emissive_texture.texcoord = 1;
  s.materials[0].emissive_texture.transform = glm::dmat3(1.0);
  EXPECT_EQ(rgb(render(s, test::settings_for(8, 8)), 6, 6), glm::dvec3(0.0, 1.0, 0.0));
}

// Each layer's texture channel, at a value that no other channel has.
TEST(Render, LayersReadTheirOwnChannels) {
  scene::Scene s = test::scene_with(test::square(1.0), {}, test::orthographic_at(5.0, 1.0), {test::directional({0.2, 0.1, 1.0})});
  const scene::TextureInfo info = test::add_texture(s, test::picture(1, 1, [](int, int) { return glm::ivec4(51, 102, 153, 204); }));
  scene::Material& m = s.materials[0];
  m.metallic_roughness_texture = info;
  m.sheen.color_factor = {1.0, 1.0, 0.5};
  m.sheen.color_texture = info;
  m.sheen.roughness_factor = 0.5;
  m.sheen.roughness_texture = info;
  m.clearcoat.factor = 0.5;
  m.clearcoat.factor_texture = info;
  m.clearcoat.roughness_factor = 1.0;
  m.clearcoat.roughness_texture = info;
  const Settings settings = test::settings_for(4, 4);
  const PixelTerms t = Probe(s, settings).terms(1, 1);
  ASSERT_TRUE(t.covered);
  EXPECT_NEAR(t.roughness, 0.4, 1e-7);
  EXPECT_NEAR(t.metallic, 0.6, 1e-7);
  EXPECT_NEAR(t.sheen_color.y, std::pow((0.4 + 0.055) / 1.055, 2.4), 1e-6);
  EXPECT_NEAR(t.sheen_color.z, 0.5 * std::pow((0.6 + 0.055) / 1.055, 2.4), 1e-6);
  EXPECT_NEAR(t.sheen_roughness, 0.4, 1e-7);
  EXPECT_NEAR(t.clearcoat, 0.1, 1e-7);
  EXPECT_NEAR(t.clearcoat_roughness, 0.4, 1e-7);
}

// One map bends N, another Nc; a light below N still shows in the coat.
TEST(Render, NormalMapsBendTheirOwnLayerAlone) {
  scene::Scene s = test::scene_with(test::square(1.0), {}, test::orthographic_at(5.0, 1.0), {});
  const auto map = [&](int r, int g, int b) {
    return test::add_texture(s, test::picture(1, 1, [=](int, int) { return glm::ivec4(r, g, b, 255); }));
  };
  const auto normal_of = [](double r, double g, double b, double scale, double w) {
    const glm::dvec3 t = glm::normalize(glm::dvec3((r / 255 * 2 - 1) * scale, (g / 255 * 2 - 1) * scale, b / 255 * 2 - 1));
    return test::vector(glm::dvec3(t.x, t.y * w, t.z));
  };
  scene::Material& m = s.materials[0];
  m.metallic_factor = 0.0;
  m.roughness_factor = 0.6;
  m.sheen.color_factor = {0.5, 0.6, 0.7};
  m.sheen.roughness_factor = 0.5;
  m.clearcoat.factor = 1.0;
  m.clearcoat.roughness_factor = 0.8;
  test::Point p;
  p.position = {0.0L, 0.0L, 0.0L};
  p.v = p.n = p.nc = {0.0L, 0.0L, 1.0L};
  const auto expect_model = [&](const char* what) {
    const test::Vector want = test::radiance(p, m, s.lights, {});
    const glm::dvec3 got = rgb(render(s, test::settings_for(4, 4)), 2, 1);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(got[c], static_cast<double>(want[static_cast<std::size_t>(c)]), 1e-6) << what;
    }
    return got;
  };
  s.lights = {test::directional({0.5, 0.7, 0.9})};
  m.normal_texture = map(200, 160, 220);
  m.normal_scale = 0.5;
  p.n = normal_of(200, 160, 220, 0.5, 1.0);
  expect_model("base normal map only");
  for (glm::vec4& t : s.primitives[0].tangents) {
    t.w = -1.0f;
  }
  p.n = normal_of(200, 160, 220, 0.5, -1.0);
  expect_model("handedness -1");
  m.clearcoat.normal_texture = map(255, 128, 180);
  m.clearcoat.normal_scale = 1.0;
  p.nc = normal_of(255, 128, 180, 1.0, -1.0);
  expect_model("both maps");
  m.normal_texture = {};
  p.n = {0.0L, 0.0L, 1.0L};
  s.lights = {test::directional({1.0, 0.0, -0.1})};
  EXPECT_GT(expect_model("a light below N").x, 1e-3);
}

TEST(Render, VectorsWithoutLengthFallBackToTheFace) {
  scene::Scene s = test::scene_with(test::square(1.0), test::lambertian({1.0, 1.0, 1.0, 1.0}), test::orthographic_at(5.0, 1.0),
                                    {test::directional({0.0, 0.0, 1.0})});
  s.materials[0].normal_texture = test::add_texture(s, test::picture(1, 1, [](int, int) { return glm::ivec4(200, 128, 200, 255); }));
  s.primitives[0].normals.assign(4, glm::vec3(0.0f));
  s.primitives[0].tangents.assign(4, glm::vec4(0.0f));
  expect_color(render(s, test::settings_for(4, 4)), 1, 1, glm::dvec3(1.0 / pi));
}

TEST(Render, NonUniformScaleBendsNormalsByTheInverseTranspose) {
  scene::Scene s = test::scene_with(test::square(1.0, 0.0, 0.0), test::lambertian({1.0, 1.0, 1.0, 1.0}), test::orthographic_at(9.0, 1.0),
                                    {test::directional({0.0, 0.0, 1.0})});
  for (glm::vec3& n : s.primitives[0].normals) {
    n = glm::vec3(0.6f, 0.0f, 0.8f);
  }
  s.instances[0].world_from_local = glm::scale(glm::dmat4(1.0), glm::dvec3(2.0, 2.0, 3.0));
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0.6 / 2.0, 0.0, 0.8 / 3.0));
  expect_color(render(s, test::settings_for(4, 4)), 1, 1, glm::dvec3(normal.z / pi));
}

TEST(Render, OrderOfLightsDoesNotMatter) {
  scene::Material m;
  m.sheen.color_factor = glm::dvec3(0.7);
  m.sheen.roughness_factor = 0.4;
  scene::Scene s =
      test::scene_with(test::sphere(24, 12), m, test::camera_at(4.0),
                       {test::directional({1.0, 0.0, 1.0}, {1.0, 0.0, 0.5}), test::directional({-1.0, 1.0, 0.2}, {0.1, 1.0, 0.0})});
  const image::Image one = render(s, test::settings_for(24, 24));
  std::swap(s.lights[0], s.lights[1]);
  const image::Image two = render(s, test::settings_for(24, 24));
  for (std::size_t i = 0; i < one.data.size(); ++i) {
    EXPECT_NEAR(one.data[i], two.data[i], 2e-7 * (1.0 + one.data[i]));
  }
}

// Also with blended and coplanar surfaces, whose hits are found in an order of Embree's own.
TEST(Render, ResultDoesNotDependOnTheNumberOfThreads) {
  scene::Material m;
  m.sheen.color_factor = glm::dvec3(0.7);
  m.sheen.roughness_factor = 0.4;
  m.clearcoat.factor = 0.5;
  scene::Scene s = test::scene_with(test::sphere(48, 24), m, test::camera_at(4.0), {test::directional({1.0, 0.5, 1.0})});
  s.materials[0].base_color_texture =
      test::add_texture(s, test::picture(16, 16, [](int x, int y) { return glm::ivec4(x * 16, y * 16, (x + y) % 2 * 255, 255); }));
  test::add(s, test::sphere(32, 16), glowing({0.1, 0.2, 0.3}, 0.3, scene::AlphaMode::Blend), glm::scale(glm::dmat4(1.0), glm::dvec3(1.2)));
  test::add(s, test::square(2.0, -1.0), glowing({1.0, 0.0, 0.0}));
  test::add(s, test::square(2.0, -1.0), glowing({0.0, 1.0, 0.0}));
  const Settings settings = test::settings_for(64, 48, true);
  const auto with_threads = [&](std::size_t count) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, count);
    return render(s, settings).data;
  };
  const std::vector<float> one = with_threads(1);
  EXPECT_EQ(one, with_threads(4));
  EXPECT_EQ(one, with_threads(2));
}

TEST(Render, TermsAddUpToThePixel) {
  scene::Material m;
  m.name = "cloth";
  m.metallic_factor = 0.3;
  m.sheen.color_factor = {0.7, 0.5, 0.3};
  m.sheen.roughness_factor = 0.4;
  m.clearcoat.factor = 0.5;
  m.clearcoat.roughness_factor = 0.5;
  m.emissive_factor = {0.0, 0.1, 0.2};
  const scene::Scene s = test::scene_with(test::sphere(48, 24), m, test::camera_at(4.0),
                                          {test::directional({1.0, 0.5, 1.0}), test::directional({-1.0, 0.5, 1.0})});
  const Settings settings = test::settings_for(32, 32);
  const image::Image im = render(s, settings);
  const PixelTerms t = Probe(s, settings).terms(14, 12);
  EXPECT_TRUE(t.covered);
  EXPECT_EQ(t.material, "cloth");
  ASSERT_EQ(t.lights.size(), 2u);
  glm::dvec3 sum = t.emission;
  for (const LightTerms& l : t.lights) {
    sum += l.sheen + l.base + l.coat;
  }
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(sum[c], t.radiance[c], 1e-12);
    EXPECT_NEAR(im.at(14, 12, c), t.radiance[c], 1e-6);
  }
  EXPECT_NEAR(t.lights[1].scale, std::min(1.0 - 0.7 * t.e_v, 1.0 - 0.7 * t.lights[1].e_l), 1e-12);
  EXPECT_FALSE(Probe(s, settings).terms(0, 0).covered);
}

TEST(Render, WrongScenesAndViewsAreErrors) {
  scene::Scene s = test::scene_with(test::square(1.0), {}, test::camera_at(5.0), {});
  Settings settings = test::settings_for(4, 4);
  settings.view.camera = 3;
  EXPECT_THROW(render(s, settings), scene::Error);
  settings = test::settings_for(0, 4);
  EXPECT_THROW(render(s, settings), scene::Error);
  s.primitives[0].indices[2] = 9;
  EXPECT_THROW(render(s, test::settings_for(4, 4)), scene::Error);
}

TEST(Render, SceneWithNothingInItIsBlack) {
  scene::Scene s;
  s.file = "test";
  s.cameras.push_back(test::camera_at(5.0));
  const image::Image im = render(s, test::settings_for(4, 4, true));
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      EXPECT_EQ(im.at(x, y, 3), 0.0f);
    }
  }
}

TEST(Render, TheBackgroundFillsThePictureAndLiesUnderWhatBlends) {
  scene::Environment sky;
  sky.width = 16;
  sky.height = 8;
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 16; ++x) {
      sky.texels.emplace_back(1.0f + 0.1f * static_cast<float>(y), 0.5f, 0.25f);
    }
  }
  scene::Material pane = test::lambertian({0.0, 0.0, 0.0, 0.25});
  pane.alpha_mode = scene::AlphaMode::Blend;
  const scene::Scene s = test::scene_with(test::square(0.4), pane, test::camera_at(3.0), {});
  Settings settings = test::settings_for(16, 16, true);
  settings.environment = &sky;
  const image::Image without = render(s, settings);
  EXPECT_EQ(without.at(0, 0, 3), 0.0f);
  sky.background = true;
  const image::Image im = render(s, settings);
  const Frame frame(s, settings);
  for (const glm::ivec2 at : {glm::ivec2(0, 0), glm::ivec2(9, 7), glm::ivec2(15, 15)}) {
    const glm::dvec3 behind = sky.radiance(-frame.rays.toward_camera(frame.rays.through(at.x + 0.5, at.y + 0.5)));
    const double share = at.x == 9 ? 0.75 : 1.0;  // the pane is in the middle
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(im.at(at.x, at.y, c), share * behind[c], 1e-6) << at.x << " " << c;
      EXPECT_GT(im.at(at.x, at.y, 4 + c), 0.0f);
    }
    EXPECT_EQ(im.at(at.x, at.y, 3), 1.0f);
  }
  // The sky brightens downward, so a moved sample sees more or less.
  const glm::dvec3 below = sky.radiance(-frame.rays.toward_camera(frame.rays.through(0.5, 0.5 + displacement(settings))));
  EXPECT_GE(im.at(0, 0, 4), std::abs(below.x - im.at(0, 0, 0)));
}

}  // namespace
}  // namespace sheen::golden
