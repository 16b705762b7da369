#include "scene/gltf.h"

#include <algorithm>
#include <future>
#include <iterator>
#include <string_view>

#include <nlohmann/json.hpp>

#include "scene/gltf_accessors.h"
#include "scene/gltf_cameras.h"
#include "scene/gltf_container.h"
#include "scene/gltf_conversions.h"
#include "scene/gltf_lights.h"
#include "scene/gltf_materials.h"
#include "scene/gltf_meshes.h"
#include "scene/gltf_nodes.h"
#include "scene/gltf_resources.h"
#include "scene/gltf_textures.h"
#include "scene/json_parse.h"

namespace sheen::scene {
namespace {

constexpr std::string_view known_extensions[] = {
    "KHR_lights_punctual", "KHR_materials_clearcoat", "KHR_materials_emissive_strength", "KHR_materials_ior",
    "KHR_materials_sheen", "KHR_materials_specular",  "KHR_mesh_quantization",           "KHR_texture_transform",
};

bool is_known(const std::string& extension) {
  return std::find(std::begin(known_extensions), std::end(known_extensions), extension) != std::end(known_extensions);
}

// glTF 2.0, section 3.2: a later minor version may be read unless minVersion asks for more.
void check_version(const Element& root) {
  const Element asset = root.required_child("asset");
  const std::string version = asset.required_string("version");
  if (!version.starts_with("2.")) {
    asset.fail("version", "is '" + version + "', must be 2.0 (section 3.2)");
  }
  const std::string least = asset.string("minVersion", "2.0");
  if (least != "2.0") {
    asset.fail("minVersion", "is '" + least + "': only 2.0 is read (section 3.2)");
  }
}

void check_extensions(const Element& root, std::vector<std::string>& warnings) {
  for (const std::string& name : root.strings("extensionsRequired")) {
    if (!is_known(name)) {
      root.fail("extensionsRequired", "holds " + name + ", which is not supported (section 3.12)" + conversion_advice(name));
    }
  }
  for (const std::string& name : root.strings("extensionsUsed")) {
    if (!is_known(name)) {
      warnings.push_back("extension " + name + " is ignored");
    }
  }
}

}  // namespace

Scene load_gltf(const std::filesystem::path& file) {
  Scene scene;
  scene.file = file.string();
  const Container container = read_container(file, scene.file);
  const nlohmann::json document = parse_json(container.json, scene.file);
  const Element root(scene.file, document);
  check_version(root);
  check_extensions(root, scene.warnings);

  Textures textures(root);
  scene.materials = read_materials(root, textures, scene.warnings);
  scene.textures = textures.textures();
  const Resources resources = load_resources(root, container, file.parent_path(), textures.images());
  const std::vector<int> images = share_images(root, resources, textures.images(), scene.textures);
  const Accessors accessors(root, resources);
  Placeables placeables;
  placeables.cameras = read_cameras(root);
  placeables.lights = read_lights(root);
  std::future<std::vector<Picture>> pictures = std::async(std::launch::async, [&] { return decode_images(root, resources, images); });
  placeables.meshes = read_meshes(root, accessors, scene);
  place_nodes(root, placeables, scene);
  scene.pictures = pictures.get();
  return scene;
}

}  // namespace sheen::scene
