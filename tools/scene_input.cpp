#include "tools/scene_input.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <iostream>
#include <optional>
#include <string_view>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "image/io.h"
#include "scene/gltf.h"
#include "tools/errors.h"
#include "tools/files.h"

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

namespace {

scene::Environment read_equirect(const std::string& file) {
  const image::Image picture = image::read(file);
  scene::Environment environment;
  environment.width = picture.width;
  environment.height = picture.height;
  environment.texels.reserve(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const glm::vec3 texel(picture.at(x, y, 0), picture.at(x, y, 1), picture.at(x, y, 2));
      for (int c = 0; c < 3; ++c) {
        if (!(texel[c] >= 0.0F) || !std::isfinite(texel[c])) {
          throw InputError(file + ": pixel " + std::to_string(x) + ", " + std::to_string(y) + ": radiance must be finite and not negative");
        }
      }
      environment.texels.push_back(texel);
    }
  }
  return environment;
}

}  // namespace

std::optional<scene::Environment> load_environment(const SceneOptions& options) {
  if (options.environment.empty()) {
    return std::nullopt;
  }
  constexpr std::string_view kind = "uniform:";
  scene::Environment environment;
  if (options.environment.starts_with(kind)) {
    const auto rgb = parse_numbers<3>(std::string_view(options.environment).substr(kind.size()));
    if (!rgb || (*rgb)[0] < 0.0 || (*rgb)[1] < 0.0 || (*rgb)[2] < 0.0) {
      throw UsageError("--environment " + options.environment + ": must be uniform:R,G,B with three finite numbers that are not negative");
    }
    environment.uniform = {(*rgb)[0], (*rgb)[1], (*rgb)[2]};
  } else {
    const std::string extension = extension_of(options.environment);
    if (extension != ".hdr" && extension != ".exr") {
      throw UsageError("--environment " + options.environment + ": must be uniform:R,G,B or an equirect .hdr or .exr");
    }
    environment = read_equirect(options.environment);
  }
  environment.rotation = glm::radians(options.environment_rotation);
  return environment;
}

void require_light(const scene::Scene& scene, const std::optional<scene::Environment>& environment) {
  if (scene.lights.empty() && !environment) {
    throw InputError(scene.file + ": lights: nothing lights this scene; give --light directional:X,Y,Z:LUX");
  }
}

}  // namespace sheen::tools
