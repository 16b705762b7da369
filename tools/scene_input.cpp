#include "tools/scene_input.h"

#include <cmath>
#include <functional>
#include <future>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "conformance/environment_input.h"
#include "conformance/parse_numbers.h"
#include "scene/gltf.h"
#include "tools/errors.h"

namespace sheen::tools {
scene::Light parse_light(const std::string& text) {
  constexpr std::string_view kind = "directional:";
  const auto complaint = [&text](const std::string& rule) { return UsageError("--light " + text + ": " + rule); };
  const std::size_t colon = text.rfind(':');
  if (!text.starts_with(kind) || colon < kind.size()) {
    throw complaint("must be directional:X,Y,Z:LUX");
  }
  const std::string_view view = text;
  const auto toward = conformance::parse_numbers<3>(view.substr(kind.size(), colon - kind.size()));
  const auto lux = conformance::parse_numbers<1>(view.substr(colon + 1));
  if (!toward || !lux) {
    throw complaint("must be directional:X,Y,Z:LUX with four finite numbers");
  }
  if ((*lux)[0] < 0.0) {
    throw complaint("LUX must not be negative");
  }
  const glm::dvec3 direction((*toward)[0], (*toward)[1], (*toward)[2]);
  const double length = std::hypot(direction.x, direction.y, direction.z);
  if (!(length > 0.0) || !std::isfinite(length)) {
    throw complaint("X,Y,Z must point somewhere");
  }
  scene::Light light;
  light.type = scene::LightType::Directional;
  light.intensity = (*lux)[0];
  light.direction = glm::normalize(-direction / length);
  return light;
}

Tolerance parse_tolerance(const std::string& text) {
  const auto numbers = conformance::parse_numbers<2>(text);
  if (!numbers || (*numbers)[0] < 0.0 || (*numbers)[1] < 0.0) {
    throw UsageError("--tolerance " + text + ": must be REL,ABS, two finite numbers that are not negative");
  }
  return {(*numbers)[0], (*numbers)[1]};
}

namespace {

/// --model physical is the base layer alone: says of which materials a layer is not drawn.
void note_left_out(const scene::Scene& scene) {
  for (const scene::Material& material : scene.materials) {
    const bool sheen = material.sheen.enabled();
    const bool clearcoat = material.clearcoat.enabled();
    if (sheen || clearcoat) {
      std::cerr << "note: material '" << scene::legible(material.name) << "': --model physical leaves out its "
                << (sheen ? clearcoat ? "sheen and clearcoat" : "sheen" : "clearcoat") << '\n';
    }
  }
}

/// What --environment names, if it is given.
std::optional<scene::Environment> named_environment(const SceneOptions& options) {
  if (options.environment.empty()) {
    return {};
  }
  try {
    return conformance::read_environment(options.environment);
  } catch (const std::invalid_argument& error) {
    throw UsageError("--environment " + options.environment + ": " + error.what());
  }
}

std::optional<scene::Environment> complete(std::optional<scene::Environment> named, const SceneOptions& options,
                                           const scene::Scene& scene) {
  if (!named && scene.lights.empty()) {
    std::cerr << "note: " << scene.file << " has no light: lit by --environment uniform:1,1,1\n";
    named.emplace().uniform = glm::dvec3(1.0);
  }
  if (named) {
    named->rotation = glm::radians(options.environment_rotation);
    named->background = options.background;
  } else if (options.background) {
    throw UsageError("--background: needs --environment");
  }
  return named;
}

}  // namespace

scene::Scene load_scene(const SceneOptions& options) {
  scene::Scene scene = scene::load_gltf(options.scene);
  for (const std::string& warning : scene.warnings) {
    std::cerr << "warning: " << warning << '\n';
  }
  if (!options.lights.empty()) {
    scene.lights = options.lights;
  }
  if (options.sheen.model == albedo::Model::Physical) {
    note_left_out(scene);
  }
  return scene;
}

std::optional<scene::Environment> load_environment(const SceneOptions& options, const scene::Scene& scene) {
  return complete(named_environment(options), options, scene);
}

Input load_input(const SceneOptions& options) {
  std::future<std::optional<scene::Environment>> named = std::async(std::launch::async, named_environment, std::cref(options));
  Input input;
  input.scene = load_scene(options);
  input.environment = complete(named.get(), options, input.scene);
  return input;
}

}  // namespace sheen::tools
