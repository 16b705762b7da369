#include "conformance/case_scene.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <string>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "conformance/glb.h"
#include "conformance/pictures.h"
#include "conformance/shapes.h"
#include "image/io.h"

namespace sheen::conformance {
namespace {

using nlohmann::json;

constexpr int array_buffer = 34962;
constexpr int element_array_buffer = 34963;
constexpr int gl_float = 5126;
constexpr int gl_unsigned_short = 5123;

glm::dvec3 vector_of(const json& numbers) {
  return {numbers[0].get<double>(), numbers[1].get<double>(), numbers[2].get<double>()};
}

/// The rotation that turns -Z to `forward`, up staying near +Y: how cameras and lights look in glTF.
json rotation_toward(const glm::dvec3& forward) {
  const glm::dvec3 back = -glm::normalize(forward);
  const glm::dvec3 up = std::abs(back.y) > 0.999 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
  const glm::dvec3 right = glm::normalize(glm::cross(up, back));
  const glm::dquat q = glm::normalize(glm::quat_cast(glm::dmat3(right, glm::cross(back, right), back)));
  return {q.x, q.y, q.z, q.w};
}

/// Which attributes the material's textures ask for.
struct Needs {
  std::set<int> texcoords;
  bool tangents = false;
};

/// Puts real texture indices for the names in a material, adding each texture, picture and sampler once, and notes the extensions used.
class TextureBinder {
 public:
  TextureBinder(GlbBuilder& builder, std::set<std::string>& extensions_used) : builder_(builder), extensions_used_(extensions_used) {}

  void bind(json& member, const std::string& key) {
    if (!member.is_object()) {
      return;
    }
    if (key.ends_with("Texture")) {
      bind_texture(member, key);
      return;
    }
    for (auto& [name, value] : member.items()) {
      if (key == "extensions") {
        extensions_used_.insert(name);
      }
      bind(value, name);
    }
  }
  const Needs& needs() const { return needs_; }

 private:
  void bind_texture(json& info, const std::string& key) {
    int texcoord = info.value("texCoord", 0);
    if (info.contains("extensions")) {
      for (const auto& [name, value] : info["extensions"].items()) {
        extensions_used_.insert(name);
        texcoord = value.value("texCoord", texcoord);
      }
    }
    needs_.texcoords.insert(texcoord);
    needs_.tangents = needs_.tangents || key == "normalTexture" || key == "clearcoatNormalTexture";
    info["index"] = texture(info["index"].get<std::string>());
  }

  int texture(const std::string& name) {
    const auto found = textures_.find(name);
    if (found != textures_.end()) {
      return found->second;
    }
    const TextureName parsed = parse_texture_name(name).value();
    json& root = builder_.json();
    const SamplerChoice sampler = make_sampler(parsed.sampler);
    root["samplers"].push_back(
        {{"magFilter", sampler.mag_filter}, {"minFilter", sampler.min_filter}, {"wrapS", sampler.wrap_s}, {"wrapT", sampler.wrap_t}});
    root["textures"].push_back({{"sampler", root["samplers"].size() - 1}, {"source", image(parsed.picture)}});
    const int index = static_cast<int>(root["textures"].size()) - 1;
    textures_[name] = index;
    return index;
  }

  int image(const std::string& name) {
    const auto found = images_.find(name);
    if (found != images_.end()) {
      return found->second;
    }
    const ProceduralPicture picture = make_picture(name);
    const std::vector<std::uint8_t> png =
        image::encode_png_codes(picture.width, picture.height, picture.channels, picture.bits, picture.codes);
    const int view = builder_.add_view(png.data(), png.size(), 0);
    json& root = builder_.json();
    root["images"].push_back({{"name", name}, {"mimeType", "image/png"}, {"bufferView", view}});
    const int index = static_cast<int>(root["images"].size()) - 1;
    images_[name] = index;
    return index;
  }

  GlbBuilder& builder_;
  std::set<std::string>& extensions_used_;
  std::map<std::string, int> textures_;
  std::map<std::string, int> images_;
  Needs needs_;
};

void add_mesh(GlbBuilder& builder, const json& description, const Needs& needs) {
  Shape shape = make_shape(description["shape"].get<std::string>());
  if (description.value("mirrored_texcoords", false)) {
    mirror_texcoords(shape);
  }
  json attributes;
  attributes["POSITION"] = builder.add_accessor(shape.positions, "VEC3", gl_float, array_buffer);
  std::array<float, 3> low = shape.positions.front();
  std::array<float, 3> high = low;
  for (const auto& position : shape.positions) {
    for (std::size_t i = 0; i < 3; ++i) {
      low.at(i) = std::min(low.at(i), position.at(i));
      high.at(i) = std::max(high.at(i), position.at(i));
    }
  }
  builder.json()["accessors"].back()["min"] = low;
  builder.json()["accessors"].back()["max"] = high;
  attributes["NORMAL"] = builder.add_accessor(shape.normals, "VEC3", gl_float, array_buffer);
  if (needs.tangents) {
    attributes["TANGENT"] = builder.add_accessor(shape.tangents, "VEC4", gl_float, array_buffer);
  }
  // A second set may not stand without the first (glTF 2.0, section 3.7.2.1: indices start with 0 and are consecutive).
  if (!needs.texcoords.empty()) {
    attributes["TEXCOORD_0"] = builder.add_accessor(shape.texcoord_0, "VEC2", gl_float, array_buffer);
  }
  if (needs.texcoords.contains(1)) {
    attributes["TEXCOORD_1"] = builder.add_accessor(shape.texcoord_1, "VEC2", gl_float, array_buffer);
  }
  if (description.value("vertex_colors", false)) {
    attributes["COLOR_0"] = builder.add_accessor(shape.colors, "VEC4", gl_float, array_buffer);
  }
  const int indices = builder.add_accessor(shape.indices, "SCALAR", gl_unsigned_short, element_array_buffer);
  builder.json()["meshes"] =
      json::array({{{"name", description["shape"]},
                    {"primitives", json::array({{{"attributes", attributes}, {"indices", indices}, {"material", 0}}})}}});
  json node = {{"name", description["shape"]}, {"mesh", 0}};
  if (description.contains("node")) {
    node.update(description["node"]);
  }
  builder.json()["nodes"].push_back(std::move(node));
}

void add_camera(GlbBuilder& builder, const json& camera, const Case& one) {
  json lens = {{"znear", camera["znear"]}};
  if (camera.contains("zfar")) {
    lens["zfar"] = camera["zfar"];
  }
  const double aspect = static_cast<double>(one.width) / one.height;
  const std::string type = camera["type"].get<std::string>();
  if (type == "perspective") {
    lens["yfov"] = camera["yfov"];
    lens["aspectRatio"] = aspect;
  } else {
    lens["ymag"] = camera["ymag"];
    lens["xmag"] = camera["ymag"].get<double>() * aspect;
  }
  builder.json()["cameras"] = json::array({{{"type", type}, {type, lens}}});
  const glm::dvec3 forward = vector_of(camera["target"]) - vector_of(camera["position"]);
  builder.json()["nodes"].push_back(
      {{"name", "camera"}, {"camera", 0}, {"translation", camera["position"]}, {"rotation", rotation_toward(forward)}});
}

void add_lights(GlbBuilder& builder, const json& lights, std::set<std::string>& extensions_used) {
  if (lights.empty()) {
    return;
  }
  extensions_used.insert("KHR_lights_punctual");
  json punctual = json::array();
  for (const json& light : lights) {
    const std::string type = light["type"].get<std::string>();
    json made = {{"type", type}};
    for (const char* key : {"color", "intensity", "range"}) {
      if (light.contains(key)) {
        made[key] = light[key];
      }
    }
    json node = {{"name", type + "_" + std::to_string(punctual.size())}};
    node["extensions"]["KHR_lights_punctual"]["light"] = punctual.size();
    if (light.contains("position")) {
      node["translation"] = light["position"];
    }
    if (type == "directional") {
      node["rotation"] = rotation_toward(-vector_of(light["toward"]));
    }
    if (type == "spot") {
      node["rotation"] = rotation_toward(vector_of(light["target"]) - vector_of(light["position"]));
      made["spot"] = json::object();
      for (const auto& [key, member] : {std::pair("inner_cone", "innerConeAngle"), std::pair("outer_cone", "outerConeAngle")}) {
        if (light.contains(key)) {
          made["spot"][member] = light[key];
        }
      }
    }
    punctual.push_back(std::move(made));
    builder.json()["nodes"].push_back(std::move(node));
  }
  builder.json()["extensions"]["KHR_lights_punctual"]["lights"] = std::move(punctual);
}

/// FNV-1a, 64 bits (Fowler, Noll and Vo; IETF draft-eastlake-fnv): names a file, guards nothing.
std::string hash_name(const std::vector<std::uint8_t>& bytes) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const std::uint8_t byte : bytes) {
    hash = (hash ^ byte) * 0x100000001b3ULL;
  }
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

}  // namespace

std::vector<std::uint8_t> make_glb(const Case& one) {
  GlbBuilder builder;
  std::set<std::string> extensions_used;
  json material = one.description["material"];
  TextureBinder binder(builder, extensions_used);
  binder.bind(material, "material");
  if (!material.contains("name")) {
    material["name"] = one.name;
  }
  builder.json()["materials"] = json::array({material});
  add_mesh(builder, one.description, binder.needs());
  add_camera(builder, one.description["camera"], one);
  add_lights(builder, one.description["lights"], extensions_used);
  json& root = builder.json();
  json nodes = json::array();
  for (std::size_t i = 0; i < root["nodes"].size(); ++i) {
    nodes.push_back(i);
  }
  root["scenes"] = json::array({{{"name", one.name}, {"nodes", nodes}}});
  root["scene"] = 0;
  if (!extensions_used.empty()) {
    root["extensionsUsed"] = extensions_used;
  }
  return builder.finish();
}

std::filesystem::path write_scene(const Case& one, const std::filesystem::path& folder) {
  const std::vector<std::uint8_t> bytes = make_glb(one);
  std::filesystem::create_directories(folder);
  const std::filesystem::path file = folder / (one.name + "-" + hash_name(bytes) + ".glb");
  std::error_code error;
  if (std::filesystem::file_size(file, error) != bytes.size() || error) {
    write_file(file, bytes.data(), bytes.size());
  }
  return file;
}

}  // namespace sheen::conformance
