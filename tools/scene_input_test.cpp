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

TEST(RequireLight, AsksForALightWhenThereIsNone) {
  scene::Scene scene;
  scene.file = "dark.glb";
  try {
    require_light(scene);
    FAIL() << "a dark scene was taken";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("dark.glb"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("--light"), std::string::npos);
  }
  scene.lights.emplace_back();
  EXPECT_NO_THROW(require_light(scene));
}

}  // namespace
}  // namespace sheen::tools
