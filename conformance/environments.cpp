#include "conformance/environments.h"

#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <mutex>
#include <stdexcept>
#include <system_error>

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "image/io.h"

namespace sheen::conformance {
namespace {

constexpr std::array all_environments = {"white", "sky", "sun"};

const glm::dvec3 toward_sun = glm::normalize(glm::dvec3(0.6, 0.55, 0.7));

// Ground and sky meet in a hazy horizon; all of it infinitely often differentiable, so that what a viewer's filter loses is its own.
glm::dvec3 sky(const glm::dvec3& d) {
  const glm::dvec3 ground(0.22, 0.17, 0.12);
  const glm::dvec3 horizon(0.9, 0.85, 0.78);
  const glm::dvec3 zenith(0.18, 0.34, 0.85);
  const double above = 0.5 + 0.5 * std::tanh(8.0 * d.y);
  const double haze = std::exp(-9.0 * d.y * d.y);
  return ground * (1.0 - above) + zenith * above + horizon * haze;
}

glm::dvec3 hazy_sun(const glm::dvec3& d) {
  return glm::dvec3(6.0, 5.0, 3.6) * std::exp(12.0 * (glm::dot(d, toward_sun) - 1.0));
}

// A disc 1.2 degrees across: between the real one and what a texel of 0.7 degrees can show.
glm::dvec3 small_sun(const glm::dvec3& d) {
  return glm::dot(d, toward_sun) > std::cos(0.0105) ? glm::dvec3(1e5, 9e4, 7e4) : glm::dvec3(0.0);
}

scene::Environment image_of(int width, int height, const std::function<glm::dvec3(const glm::dvec3&)>& radiance) {
  scene::Environment environment;
  environment.width = width;
  environment.height = height;
  environment.texels.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      environment.texels.emplace_back(radiance(environment.direction({(x + 0.5) / width, (y + 0.5) / height})));
    }
  }
  return environment;
}

scene::Environment make_image(const std::string& name) {
  if (name == "white") {
    return image_of(8, 4, [](const glm::dvec3&) { return glm::dvec3(1.0); });
  }
  if (name == "sky") {
    return image_of(256, 128, [](const glm::dvec3& d) { return sky(d) + hazy_sun(d); });
  }
  if (name == "sun") {
    return image_of(512, 256, [](const glm::dvec3& d) { return sky(d) + small_sun(d); });
  }
  throw std::invalid_argument("no environment is named '" + name + "'; there are " + environment_names());
}

}  // namespace

bool is_environment(const std::string& name) {
  for (const char* known : all_environments) {
    if (name == known) {
      return true;
    }
  }
  return false;
}

std::string environment_names() {
  std::string list;
  for (const char* name : all_environments) {
    list += (list.empty() ? "" : ", ") + std::string(name);
  }
  return list;
}

scene::Environment make_environment(const std::string& name) {
  if (name == "white") {
    scene::Environment environment;
    environment.uniform = glm::dvec3(1.0);
    return environment;
  }
  return make_image(name);
}

const scene::Environment& kept_environment(const std::string& name) {
  static std::mutex mutex;
  static std::map<std::string, scene::Environment> kept;
  const std::lock_guard lock(mutex);
  const auto found = kept.find(name);
  return found != kept.end() ? found->second : kept.emplace(name, make_environment(name)).first->second;
}

std::filesystem::path write_environment(const std::string& name, const std::filesystem::path& folder) {
  const scene::Environment environment = make_image(name);
  const std::filesystem::path file = folder / (name + "-" + scene::content_hash(environment) + ".exr");
  std::error_code error;
  if (std::filesystem::is_regular_file(file, error)) {
    return file;
  }
  image::Image picture(environment.width, environment.height, {"R", "G", "B"});
  for (std::size_t i = 0; i < environment.texels.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      picture.data[3 * i + static_cast<std::size_t>(c)] = environment.texels[i][c];
    }
  }
  std::filesystem::create_directories(folder, error);
  image::write(file, picture);
  return file;
}

std::filesystem::path environment_for_viewer(const std::string& name, bool ours, const std::filesystem::path& cache) {
  const scene::Environment& environment = kept_environment(name);
  if (!ours || environment.is_image()) {
    return write_environment(name, cache / "environments");
  }
  const nlohmann::json radiance = {environment.uniform.x, environment.uniform.y, environment.uniform.z};
  const std::string numbers = radiance.dump();
  return "uniform:" + numbers.substr(1, numbers.size() - 2);
}

}  // namespace sheen::conformance
