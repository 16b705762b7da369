#include "conformance/environment_input.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string_view>

#include "conformance/parse_numbers.h"
#include "image/io.h"
#include "image/rgb_channels.h"
#include "scene/scene.h"

namespace sheen::conformance {
namespace {

scene::Environment read_equirect(const std::string& file) {
  const image::Image picture = image::read(file);
  std::array<int, 3> rgb{};
  try {
    rgb = image::rgb_channels(picture, "an environment");
  } catch (const image::Error& error) {
    std::string held;
    for (const std::string& name : picture.channels) {
      held += (held.empty() ? "" : ", ") + name;
    }
    throw image::Error(file + ": " + error.what() + "; it has " + held);
  }
  scene::Environment environment;
  environment.width = picture.width;
  environment.height = picture.height;
  environment.texels.reserve(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const glm::vec3 texel(picture.at(x, y, rgb[0]), picture.at(x, y, rgb[1]), picture.at(x, y, rgb[2]));
      for (int c = 0; c < 3; ++c) {
        if (!(texel[c] >= 0.0F) || !std::isfinite(texel[c])) {
          throw scene::Error(file, "pixel " + std::to_string(x) + ", " + std::to_string(y), "radiance must be finite and not negative");
        }
      }
      environment.texels.push_back(texel);
    }
  }
  return environment;
}

}  // namespace

scene::Environment read_environment(const std::string& text) {
  constexpr std::string_view kind = "uniform:";
  if (text.starts_with(kind)) {
    const auto rgb = parse_numbers<3>(std::string_view(text).substr(kind.size()));
    if (!rgb || (*rgb)[0] < 0.0 || (*rgb)[1] < 0.0 || (*rgb)[2] < 0.0) {
      throw std::invalid_argument("must be uniform:R,G,B with three finite numbers that are not negative");
    }
    scene::Environment environment;
    environment.uniform = {(*rgb)[0], (*rgb)[1], (*rgb)[2]};
    return environment;
  }
  std::string extension = std::filesystem::path(text).extension().string();
  for (char& c : extension) {
    c = static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  }
  if (extension != ".hdr" && extension != ".exr") {
    throw std::invalid_argument("must be uniform:R,G,B or an equirect .hdr or .exr");
  }
  return read_equirect(text);
}

}  // namespace sheen::conformance
