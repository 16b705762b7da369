#include "renderer/renderer.h"

#include <algorithm>

#include "renderer/geometry.h"
#include "renderer/renderer_fixture.h"

namespace sheen::renderer {
namespace {

using test::lambert;
using test::pi;
using test::square_scene;

class Rendering : public test::WithRenderer {};

TEST_F(Rendering, ALambertianSquareReflectsBaseColorOverPiTimesLuxTimesCosine) {
  scene::Scene scene = square_scene();
  scene.materials[0].base_color_factor = {0.5, 0.25, 0.75, 0.3};
  scene.lights[0].intensity = 3.0;
  scene.lights[0].color = {1.0, 0.5, 0.25};
  scene.lights[0].direction = {std::sin(pi / 3), 0.0, -std::cos(pi / 3)};
  const image::Image picture = render(scene);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      EXPECT_NEAR(picture.at(x, y, 0), 0.5 / pi * 3.0 * 0.5, 1e-6);
      EXPECT_NEAR(picture.at(x, y, 1), 0.25 / pi * 1.5 * 0.5, 1e-6);
      EXPECT_NEAR(picture.at(x, y, 2), 0.75 / pi * 0.75 * 0.5, 1e-6);
      EXPECT_EQ(picture.at(x, y, 3), 1.0f) << "OPAQUE ignores alpha";
    }
  }
}

TEST_F(Rendering, WhatNothingCoversIsTransparentBlack) {
  scene::Scene scene = square_scene();
  scene.cameras[0].ymag = 2.0;
  const image::Image picture = render(scene);
  for (int c = 0; c < 4; ++c) {
    EXPECT_EQ(picture.at(0, 0, c), 0.0f);
  }
  EXPECT_EQ(picture.at(4, 4, 3), 1.0f);
}

TEST_F(Rendering, ABackFaceIsDrawnOnlyDoubleSidedAndThenFacesTheViewer) {
  scene::Scene scene = square_scene();
  scene.instances[0].world_from_local = glm::rotate(glm::dmat4(1.0), pi, glm::dvec3(0, 1, 0));
  EXPECT_EQ(render(scene).at(4, 4, 3), 0.0f);
  scene.materials[0].double_sided = true;
  EXPECT_NEAR(middle(scene), 1.0 / pi, 1e-6);
}

TEST_F(Rendering, AMirroredInstanceKeepsItsFrontFace) {
  scene::Scene scene = square_scene();
  scene.instances[0].world_from_local = glm::scale(glm::dmat4(1.0), glm::dvec3(-1, 1, 1));
  EXPECT_NEAR(middle(scene), 1.0 / pi, 1e-6);
  scene.instances[0].world_from_local = glm::rotate(scene.instances[0].world_from_local, pi, glm::dvec3(0, 1, 0));
  EXPECT_EQ(render(scene).at(4, 4, 3), 0.0f) << "and its back face stays a back face";
}

TEST_F(Rendering, TheNearerSurfaceIsSeenWhateverTheOrder) {
  scene::Scene scene = square_scene();
  scene.materials.push_back(lambert());
  scene.materials[1].base_color_factor = {0, 0, 0, 1};
  scene.primitives.push_back(test::square());
  scene.primitives[1].material = 1;
  scene.instances.push_back({1, glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, -0.001))});
  EXPECT_NEAR(middle(scene), 1.0 / pi, 1e-6);
  std::swap(scene.instances[0], scene.instances[1]);
  EXPECT_NEAR(middle(scene), 1.0 / pi, 1e-6);
}

TEST_F(Rendering, WhatLiesBeforeTheNearPlaneOrBehindTheFarPlaneIsNotSeen) {
  scene::Scene scene = square_scene();
  scene.cameras[0].znear = 2.01;
  EXPECT_EQ(render(scene).at(4, 4, 3), 0.0f);
  scene.cameras[0].znear = 0.1;
  scene.cameras[0].zfar = 1.99;
  EXPECT_EQ(render(scene).at(4, 4, 3), 0.0f);
  scene.cameras[0].zfar = 2.01;
  EXPECT_EQ(render(scene).at(4, 4, 3), 1.0f);
}

TEST_F(Rendering, BlendLaysTheWholeShadedColourOverWhatIsBehindFarthestFirst) {
  scene::Scene scene = square_scene();
  for (const double gray : {0.25, 1.0}) {
    scene::Material glass = lambert();
    glass.base_color_factor = {gray, gray, gray, 0.5};
    glass.alpha_mode = scene::AlphaMode::Blend;
    scene.materials.push_back(glass);
    scene.primitives.push_back(test::square());
    scene.primitives.back().material = static_cast<int>(scene.materials.size()) - 1;
  }
  // The nearer square stands first in the file.
  scene.instances.push_back({1, glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, 0.2))});
  scene.instances.push_back({2, glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, 0.1))});
  scene.materials[0].base_color_factor = {0, 0, 0, 1};
  EXPECT_NEAR(middle(scene), (0.5 * 0.25 + 0.5 * (0.5 * 1.0)) / pi, 1e-6);
  scene.instances.erase(scene.instances.begin());
  const image::Image picture = render(scene);
  EXPECT_NEAR(picture.at(4, 4, 3), 0.75, 1e-6) << "coverage over nothing";
  EXPECT_NEAR(picture.at(4, 4, 0), (0.5 * 0.25 + 0.5 * (0.5 * 1.0)) / pi, 1e-6);
}

TEST_F(Rendering, MaskDropsWhatIsBelowItsCutoffAndKeepsTheRestWhole) {
  scene::Scene scene = square_scene();
  scene.materials[0].alpha_mode = scene::AlphaMode::Mask;
  scene.materials[0].base_color_factor.a = 0.4;
  EXPECT_EQ(render(scene).at(4, 4, 3), 0.0f);
  scene.materials[0].alpha_cutoff = 0.3;
  EXPECT_EQ(render(scene).at(4, 4, 3), 1.0f);
  EXPECT_NEAR(middle(scene), 1.0 / pi, 1e-6);
}

TEST_F(Rendering, VertexColorsTintTheBaseColorAlone) {
  scene::Scene scene = square_scene();
  scene.primitives[0].colors.assign(4, {0.5f, 1, 1, 1});
  scene.materials[0].emissive_factor = glm::dvec3(2.0);
  EXPECT_NEAR(middle(scene), 0.5 / pi + 2.0, 1e-6);
}

TEST_F(Rendering, APointLightFallsWithTheSquareOfTheDistanceWithinItsRange) {
  scene::Scene scene = square_scene();
  scene.lights[0].type = scene::LightType::Point;
  scene.lights[0].position = {0, 0, 2};
  scene.lights[0].intensity = 8.0;
  EXPECT_NEAR(middle(scene), 8.0 / 4.0 / pi, 1e-6);
  scene.lights[0].range = 4.0;
  EXPECT_NEAR(middle(scene), 8.0 / 4.0 * (1.0 - 1.0 / 16.0) / pi, 1e-6);
  scene.lights[0].range = 1.9;
  EXPECT_EQ(middle(scene), 0.0);
}

TEST_F(Rendering, ASpotLightFadesBetweenItsCones) {
  scene::Scene scene = square_scene();
  scene::Light& light = scene.lights[0];
  light.type = scene::LightType::Spot;
  light.position = {0, 0, 1};
  light.inner_cone = 0.2;
  light.outer_cone = 0.6;
  const auto at_angle = [&](double angle) {
    light.direction = {std::sin(angle), 0, -std::cos(angle)};
    return middle(scene);
  };
  EXPECT_NEAR(at_angle(0.1), 1.0 / pi, 1e-6);
  EXPECT_EQ(at_angle(0.61), 0.0);
  const double share = (std::cos(0.4) - std::cos(0.6)) / (std::cos(0.2) - std::cos(0.6));
  EXPECT_NEAR(at_angle(0.4), share * share / pi, 1e-6);
}

TEST_F(Rendering, AnyNumberOfLightsAddsUp) {
  for (const std::size_t count : {std::size_t{2}, std::size_t{16}, std::size_t{17}, std::size_t{300}}) {
    scene::Scene scene = square_scene();
    scene.lights.assign(count, scene.lights[0]);
    for (std::size_t i = 0; i < count; ++i) {
      scene.lights[i].intensity = 1.0 / static_cast<double>(count);
      if (i % 3 == 1) {
        scene.lights[i].type = scene::LightType::Point;
        scene.lights[i].position = {0, 0, 1};
      }
    }
    EXPECT_NEAR(middle(scene), 1.0 / pi, 1e-5) << count << " lights";
  }
}

TEST_F(Rendering, GeometryFarFromTheOriginKeepsItsDigits) {
  scene::Scene scene = square_scene();
  scene.lights[0].type = scene::LightType::Point;
  scene.lights[0].position = {0.5, 0.25, 1};
  const image::Image here = render(scene);
  const glm::dvec3 far_away(4096.0, -8192.0, 1024.0);
  for (glm::vec3& position : scene.primitives[0].positions) {
    position += glm::vec3(far_away);
  }
  scene.lights[0].position += far_away;
  scene.cameras[0].world_from_camera = glm::translate(glm::dmat4(1.0), far_away) * scene.cameras[0].world_from_camera;
  const image::Image there = render(scene);
  for (std::size_t i = 0; i < here.data.size(); ++i) {
    ASSERT_NEAR(there.data[i], here.data[i], 1e-6f) << "value " << i;
  }
}

TEST_F(Rendering, AZeroNormalFallsBackToTheTrianglesOwn) {
  scene::Scene scene = square_scene();
  scene.primitives[0].normals.assign(4, {0, 0, 0});
  EXPECT_NEAR(middle(scene), 1.0 / pi, 1e-6);
}

TEST_F(Rendering, ATurnedCameraShadesAsATurnedScene) {
  scene::Scene scene = square_scene();
  scene.lights[0].type = scene::LightType::Spot;
  scene.lights[0].position = {0.3, 0.2, 1};
  scene.lights[0].direction = glm::normalize(glm::dvec3(-0.1, 0.1, -1));
  scene.cameras[0].perspective = true;
  const image::Image straight = render(scene);
  const glm::dmat4 turn = glm::rotate(glm::translate(glm::dmat4(1.0), glm::dvec3(3, -2, 1)), 0.7, glm::normalize(glm::dvec3(1, 2, 3)));
  scene.instances[0].world_from_local = turn;
  scene.cameras[0].world_from_camera = turn * scene.cameras[0].world_from_camera;
  scene.lights[0].position = glm::dvec3(turn * glm::dvec4(scene.lights[0].position, 1));
  scene.lights[0].direction = glm::dmat3(turn) * scene.lights[0].direction;
  const image::Image turned = render(scene);
  for (std::size_t i = 0; i < straight.data.size(); ++i) {
    ASSERT_NEAR(turned.data[i], straight.data[i], 2e-6f) << "value " << i;
  }
}

TEST_F(Rendering, APictureTheDriverCannotHoldIsAnErrorThatSaysItsLimit) {
  Settings settings;
  settings.view.width = 1 << 20;
  settings.view.height = 8;
  const auto context = gles::Context::create_any(gles::ContextKind::OsMesa);
  Renderer renderer(*context);
  EXPECT_THROW(renderer.render(square_scene(), settings), gles::Error);
}

TEST_F(Rendering, AnIndexOutOfRangeIsAnErrorBeforeTheDriverSeesIt) {
  scene::Scene scene = square_scene();
  scene.primitives[0].indices[4] = 4;
  EXPECT_THROW(render(scene), scene::Error);
}

TEST_F(Rendering, ATextStandsInForAShaderFile) {
  const std::map<std::string, std::string> files = {
      {"main.frag", "layout(location = 0) out vec4 out_color;\nvoid main() { out_color = vec4(0.25, 0.5, 0.75, 1.0); }\n"}};
  Settings settings;
  settings.shader_files = &files;
  const image::Image picture = render(square_scene(), 8, settings);
  EXPECT_EQ(picture.at(4, 4, 0), 0.25f);
  EXPECT_EQ(picture.at(4, 4, 2), 0.75f);
  EXPECT_NEAR(middle(square_scene()), 1.0 / pi, 1e-6) << "and only where it is asked for";
}

TEST_F(Rendering, OsMesaAndEglAgreeBitForBit) {
  scene::Scene scene = square_scene({});
  scene::Material& material = scene.materials[0];
  material.base_color_factor = {0.8, 0.5, 0.2, 0.6};
  material.metallic_factor = 0.4;
  material.roughness_factor = 0.3;
  material.sheen.color_factor = {0.9, 0.8, 0.7};
  material.sheen.roughness_factor = 0.4;
  material.clearcoat.factor = 0.7;
  material.clearcoat.roughness_factor = 0.1;
  material.alpha_mode = scene::AlphaMode::Blend;
  material.base_color_texture = test::add_texture(scene, test::picture(2, 2, {255, 0, 9, 99, 1, 200, 3, 4, 5, 6, 255, 8, 70, 80, 90, 100}));
  material.normal_texture = test::add_texture(scene, test::picture(2, 1, {140, 120, 250, 255, 100, 130, 240, 255}));
  scene.cameras[0].perspective = true;
  scene.lights[0].direction = glm::normalize(glm::dvec3(-1, -2, -1));
  Settings settings;
  settings.view.width = 64;
  settings.view.height = 48;
  const auto osmesa = gles::Context::create(gles::ContextKind::OsMesa);
  const auto egl = gles::Context::create(gles::ContextKind::Egl);
  if (osmesa->info().renderer != egl->info().renderer) {
    GTEST_SUCCEED() << "two drivers need not agree";
    return;
  }
  Renderer first(*osmesa);
  Renderer second(*egl);
  const image::Image a = first.render(scene, settings);
  const image::Image b = second.render(scene, settings);
  EXPECT_TRUE(std::any_of(a.data.begin(), a.data.end(), [](float value) { return value > 0.0f; }));
  EXPECT_EQ(a.data, b.data);
}

TEST(NormalMatrix, KeepsNormalsPerpendicularThroughMirrorsAndSkews) {
  const glm::dmat4 matrix(glm::dvec4(-2, 0.5, 0, 0), glm::dvec4(0.3, 1, 0.2, 0), glm::dvec4(0, 0.1, 3, 0), glm::dvec4(5, 6, 7, 1));
  const glm::dmat3 linear(matrix);
  const glm::dvec3 normal = normal_matrix(matrix) * glm::dvec3(0, 0, 1);
  EXPECT_NEAR(glm::dot(normal, linear * glm::dvec3(1, 0, 0)), 0.0, 1e-12);
  EXPECT_NEAR(glm::dot(normal, linear * glm::dvec3(0, 1, 0)), 0.0, 1e-12);
  EXPECT_GT(glm::dot(normal, linear * glm::dvec3(0, 0, 1)), 0.0) << "and on their own side";
}

TEST(DepthRange, OnlyEverShrinksAndHoldsTheWholeBox) {
  scene::Camera camera;
  const std::vector<Box> boxes{{glm::dvec3(-1), glm::dvec3(1)}};
  const std::vector<glm::dmat4> matrices{glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, -10))};
  const scene::Camera tight = tighten_depth_range(camera, boxes, matrices);
  EXPECT_GT(tight.znear, 8.9);
  EXPECT_LT(tight.znear, 9.0);
  EXPECT_GT(tight.zfar, 11.0);
  EXPECT_LT(tight.zfar, 11.1);
  camera.znear = 9.5;
  camera.zfar = 10.5;
  EXPECT_EQ(tighten_depth_range(camera, boxes, matrices).znear, 9.5);
  EXPECT_EQ(tighten_depth_range(camera, boxes, matrices).zfar, 10.5);
}

}  // namespace
}  // namespace sheen::renderer
