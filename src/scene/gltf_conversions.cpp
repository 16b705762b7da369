#include "scene/gltf_conversions.h"

#include <algorithm>
#include <iterator>

namespace sheen::scene {
namespace {

struct Conversion {
  std::string_view extension;
  std::string_view command;
};

// `copy` decodes what it reads and does not encode again; `png` takes only the format named.
constexpr Conversion conversions[] = {
    {"EXT_meshopt_compression", "copy IN OUT"},
    {"EXT_texture_avif", "png IN OUT --formats avif"},
    {"EXT_texture_webp", "png IN OUT --formats webp"},
    {"KHR_draco_mesh_compression", "copy IN OUT"},
    {"KHR_texture_basisu", "ktxdecompress IN OUT (it needs KTX-Software)"},
};

}  // namespace

std::string conversion_advice(std::string_view extension) {
  const auto* known =
      std::find_if(std::begin(conversions), std::end(conversions), [&](const Conversion& c) { return c.extension == extension; });
  return known == std::end(conversions) ? "" : "; convert the file with: gltf-transform " + std::string(known->command);
}

}  // namespace sheen::scene
