#include "tools/scene_input.h"

#include <string>

#include <gtest/gtest.h>

#include "tools/errors.h"

namespace sheen::tools {
namespace {

TEST(ParseLight, PointsAgainstTheVectorTowardTheLight) {
  const scene::Light light = parse_light("directional:0,3,4:2.5");
  EXPECT_EQ(light.type, scene::LightType::Directional);
  EXPECT_EQ(light.intensity, 2.5);
  EXPECT_EQ(light.color, glm::dvec3(1.0));
  EXPECT_NEAR(light.direction.x, 0.0, 1e-15);
  EXPECT_NEAR(light.direction.y, -0.6, 1e-15);
  EXPECT_NEAR(light.direction.z, -0.8, 1e-15);
}

TEST(ParseLight, TakesEveryWayToWriteANumber) {
  EXPECT_EQ(parse_light("directional:+1,-1e-3,.5:1e2").intensity, 100.0);
  EXPECT_NEAR(parse_light("directional:1e200,0,0:1").direction.x, -1.0, 1e-15);
}

TEST(ParseLight, RefusesWhatItDoesNotUnderstand) {
  for (const char* text :
       {"", "directional", "directional:", "directional:0,1,0", "directional:0,1:1", "directional:0,1,0,0:1", "directional:a,1,0:1",
        "directional:0,1,0:", "directional:0,1,0:1x", "directional:0,0,0:1", "directional:nan,1,0:1", "directional:inf,1,0:1",
        "directional:0,1,0:-1", "directional:0,1,0:inf", "directional:0, 1,0:1", "point:0,1,0:1", "0,1,0:1"}) {
    EXPECT_THROW(parse_light(text), UsageError) << text;
  }
}

TEST(ParseTolerance, TakesTwoNumbersThatAreNotNegative) {
  const Tolerance tolerance = parse_tolerance("1e-3,2e-5");
  EXPECT_EQ(tolerance.relative, 1e-3);
  EXPECT_EQ(tolerance.absolute, 2e-5);
  for (const char* text : {"", "1", "1,", ",1", "1,2,3", "-1,1", "1,-1", "nan,1", "1,inf", "a,b"}) {
    EXPECT_THROW(parse_tolerance(text), UsageError) << text;
  }
}

TEST(LoadEnvironment, LightsADarkSceneFromEverywhereAndNoOther) {
  scene::Scene scene;
  scene.file = "dark.glb";
  SceneOptions options;
  const auto environment = load_environment(options, scene);
  ASSERT_TRUE(environment.has_value());
  EXPECT_EQ(environment->uniform, glm::dvec3(1.0));
  EXPECT_FALSE(environment->is_image());
  scene.lights.emplace_back();
  EXPECT_FALSE(load_environment(options, scene).has_value());
}

TEST(LoadEnvironment, TakesThreeNumbersThatAreNotNegative) {
  const scene::Scene scene;
  SceneOptions options;
  options.environment = "uniform:1,0.5,0";
  options.environment_rotation = 180.0;
  options.background = true;
  const auto environment = load_environment(options, scene);
  EXPECT_EQ(environment->uniform, glm::dvec3(1.0, 0.5, 0.0));
  EXPECT_NEAR(environment->rotation, 3.14159265, 1e-8);
  EXPECT_TRUE(environment->background);
  for (const char* text : {"uniform:", "uniform:1,2", "uniform:1,2,-3", "uniform:1,2,inf", "sky.png", "sky"}) {
    options.environment = text;
    EXPECT_THROW(load_environment(options, scene), UsageError) << text;
  }
}

TEST(LoadEnvironment, BackgroundNeedsAnEnvironment) {
  scene::Scene scene;
  scene.lights.emplace_back();
  SceneOptions options;
  options.background = true;
  EXPECT_THROW(load_environment(options, scene), UsageError);
}

TEST(LoadInput, TellsOfTheSceneBeforeTheEnvironment) {
  SceneOptions options;
  options.scene = "absent.glb";
  options.environment = "sky.png";
  EXPECT_THROW(load_input(options), scene::Error);
}

}  // namespace
}  // namespace sheen::tools
