#include "scene/gltf_lights.h"

#include <numbers>
#include <optional>
#include <string>

namespace sheen::scene {
namespace {

// pi / 2 as a file may hold it: rounded up to float it is 4.4e-8 more.
constexpr double right_angle = std::numbers::pi / 2 + 1e-7;
constexpr Range inner_range{.low = 0.0, .high = right_angle, .high_excluded = true};
constexpr Range outer_range{.low = 0.0, .high = right_angle, .low_excluded = true};

Light read_light(const Element& element) {
  Light light;
  const auto color = element.numbers<3>("color", {1.0, 1.0, 1.0}, unit_interval);
  light.color = {color[0], color[1], color[2]};
  light.intensity = element.number("intensity", 1.0, non_negative);
  light.range = element.number("range", light.range, positive);
  const std::string type = element.required_string("type");
  if (type == "directional") {
    light.type = LightType::Directional;
    light.range = Light{}.range;
  } else if (type == "point") {
    light.type = LightType::Point;
  } else if (type == "spot") {
    light.type = LightType::Spot;
    const Element spot = element.required_child("spot");
    light.inner_cone = spot.number("innerConeAngle", light.inner_cone, inner_range);
    light.outer_cone = spot.number("outerConeAngle", light.outer_cone, outer_range);
    if (light.inner_cone >= light.outer_cone) {
      spot.fail("innerConeAngle", "must be less than outerConeAngle");
    }
  } else {
    element.fail("type", "is '" + type + "', must be directional, point or spot");
  }
  return light;
}

}  // namespace

std::vector<Light> read_lights(const Element& root) {
  std::vector<Light> lights;
  if (const std::optional<Element> extension = root.extension("KHR_lights_punctual")) {
    for (const Element& element : extension->children("lights")) {
      lights.push_back(read_light(element));
    }
  }
  return lights;
}

}  // namespace sheen::scene
