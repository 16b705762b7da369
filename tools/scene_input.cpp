#include "tools/scene_input.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <optional>
#include <string_view>

#include <glm/geometric.hpp>

#include "scene/gltf.h"
#include "tools/errors.h"

namespace sheen::tools {
namespace {

/// The numbers between the commas, or nothing unless there are exactly N and each is finite.
template <std::size_t N>
std::optional<std::array<double, N>> parse_numbers(std::string_view text) {
  std::array<double, N> numbers{};
  for (std::size_t i = 0; i < N; ++i) {
    const std::size_t comma = text.find(',');
    if ((comma == std::string_view::npos) != (i + 1 == N)) {
      return std::nullopt;
    }
    std::string_view field = text.substr(0, comma);
    if (field.starts_with('+')) {
      field.remove_prefix(1);
    }
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), numbers[i]);
    if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(numbers[i])) {
      return std::nullopt;
    }
    if (comma != std::string_view::npos) {
      text.remove_prefix(comma + 1);
    }
  }
  return numbers;
}

}  // namespace

scene::Light parse_light(const std::string& text) {
  constexpr std::string_view kind = "directional:";
  const auto complaint = [&text](const std::string& rule) { return UsageError("--light " + text + ": " + rule); };
  const std::size_t colon = text.rfind(':');
  if (!text.starts_with(kind) || colon < kind.size()) {
    throw complaint("must be directional:X,Y,Z:LUX");
  }
  const std::string_view view = text;
  const auto toward = parse_numbers<3>(view.substr(kind.size(), colon - kind.size()));
  const auto lux = parse_numbers<1>(view.substr(colon + 1));
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
  const auto numbers = parse_numbers<2>(text);
  if (!numbers || (*numbers)[0] < 0.0 || (*numbers)[1] < 0.0) {
    throw UsageError("--tolerance " + text + ": must be REL,ABS, two finite numbers that are not negative");
  }
  return {(*numbers)[0], (*numbers)[1]};
}

scene::Scene load_scene(const SceneOptions& options) {
  scene::Scene scene = scene::load_gltf(options.scene);
  for (const std::string& warning : scene.warnings) {
    std::cerr << "warning: " << warning << '\n';
  }
  if (!options.lights.empty()) {
    scene.lights = options.lights;
  }
  return scene;
}

void require_light(const scene::Scene& scene) {
  if (scene.lights.empty()) {
    throw InputError(scene.file + ": lights: nothing lights this scene; give --light directional:X,Y,Z:LUX");
  }
}

}  // namespace sheen::tools
