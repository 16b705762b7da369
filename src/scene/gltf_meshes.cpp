#include "scene/gltf_meshes.h"

#include <algorithm>
#include <cstring>
#include <initializer_list>
#include <optional>
#include <string_view>
#include <utility>

#include <glm/common.hpp>

#include "scene/attributes.h"

namespace sheen::scene {
namespace {

constexpr std::uint64_t triangles = 4;
constexpr std::uint64_t triangle_strip = 5;
constexpr std::uint64_t triangle_fan = 6;

// What the readers of one primitive share.
struct Context {
  const Element& element;  ///< the primitive
  Element attributes;      ///< its attributes
  const Accessors& accessors;
  bool quantized;  ///< the file names KHR_mesh_quantization: more component types are allowed
  std::size_t vertices = 0;
};

struct Allowed {
  ComponentType component;
  bool normalized;
};

// Component types of section 3.7.2.1, table "attribute semantics".
constexpr Allowed real{ComponentType::Float, false};
constexpr Allowed unorm8{ComponentType::UnsignedByte, true};
constexpr Allowed unorm16{ComponentType::UnsignedShort, true};

constexpr std::string_view quantization = "KHR_mesh_quantization";

// KHR_mesh_quantization, table "Extending Mesh Attributes": every byte and short for positions and texture coordinates, the signed and
// normalized ones for normals and tangents.
bool quantized_type(std::string_view name, ComponentType component, bool normalized) {
  const bool is_signed = component == ComponentType::Byte || component == ComponentType::Short;
  if (name == "NORMAL" || name == "TANGENT") {
    return is_signed && normalized;
  }
  return component != ComponentType::UnsignedInt && component != ComponentType::Float && !name.starts_with("COLOR");
}

// The accessor of an attribute, checked; -1 where the primitive has none.
int find_attribute(const Context& context, const char* name, std::initializer_list<std::string_view> types,
                   std::initializer_list<Allowed> allowed) {
  const Accessors& accessors = context.accessors;
  const int index = context.attributes.index(name, accessors.size(), "accessors");
  if (index < 0) {
    return -1;
  }
  if (std::find(types.begin(), types.end(), accessors.type(index)) == types.end()) {
    context.attributes.fail(name, "refers to accessors[" + std::to_string(index) + "] of type " + accessors.type(index) +
                                      ", which it must not have (section 3.7.2.1)");
  }
  const ComponentType component = accessors.component_type(index);
  const bool normalized = accessors.normalized(index);
  const bool fits =
      std::any_of(allowed.begin(), allowed.end(), [&](const Allowed& a) { return a.component == component && a.normalized == normalized; });
  const bool by_extension = quantized_type(name, component, normalized);
  if (!fits && !(context.quantized && by_extension)) {
    std::string rule = ", which it must not have (section 3.7.2.1)";
    if (by_extension) {
      rule = ", which only " + std::string(quantization) + " allows, and extensionsRequired does not name it (section 3.7.2.1)";
    } else if (context.quantized) {
      rule = ", which " + std::string(quantization) + " does not allow either (section 3.7.2.1)";
    }
    context.attributes.fail(name, "refers to accessors[" + std::to_string(index) + "] of component type " +
                                      std::to_string(static_cast<int>(component)) + (normalized ? " normalized" : "") + rule);
  }
  return index;
}

// Copies floats into vectors of N components each.
template <class Vector>
std::vector<Vector> vectors(const std::vector<float>& floats) {
  static_assert(std::is_trivially_copyable_v<Vector> && alignof(Vector) == alignof(float));
  std::vector<Vector> result(floats.size() * sizeof(float) / sizeof(Vector));
  std::memcpy(static_cast<void*>(result.data()), floats.data(), result.size() * sizeof(Vector));
  return result;
}

template <class Vector>
std::vector<Vector> read_attribute(const Context& context, const char* name, const char* type, std::initializer_list<Allowed> allowed) {
  const int index = find_attribute(context, name, {type}, allowed);
  if (index < 0) {
    return {};
  }
  if (context.accessors.count(index) != context.vertices) {
    context.attributes.fail(name, "has " + std::to_string(context.accessors.count(index)) + " elements but POSITION has " +
                                      std::to_string(context.vertices) + " (section 3.7.2.1)");
  }
  return vectors<Vector>(context.accessors.floats(index));
}

std::vector<glm::vec4> read_colors(const Context& context) {
  const int index = find_attribute(context, "COLOR_0", {"VEC3", "VEC4"}, {real, unorm8, unorm16});
  if (index < 0) {
    return {};
  }
  std::vector<glm::vec4> colors;
  if (context.accessors.type(index) == "VEC4") {
    colors = read_attribute<glm::vec4>(context, "COLOR_0", "VEC4", {real, unorm8, unorm16});
  } else {
    for (const glm::vec3& c : read_attribute<glm::vec3>(context, "COLOR_0", "VEC3", {real, unorm8, unorm16})) {
      colors.emplace_back(c, 1.0f);
    }
  }
  for (std::size_t i = 0; i < colors.size(); ++i) {
    if (glm::clamp(colors[i], 0.0f, 1.0f) != colors[i]) {
      context.attributes.fail("COLOR_0", "of vertex " + std::to_string(i) + " lies outside [0, 1] (section 3.7.2.1)");
    }
  }
  return colors;
}

// Indices of the primitive's vertices in drawing order, before strips and fans are taken apart.
std::vector<std::uint32_t> drawing_order(const Context& context) {
  const int index = context.element.index("indices", context.accessors.size(), "accessors");
  if (index >= 0) {
    return context.accessors.indices(index, context.vertices);
  }
  std::vector<std::uint32_t> order(context.vertices);
  for (std::size_t i = 0; i < order.size(); ++i) {
    order[i] = static_cast<std::uint32_t>(i);
  }
  return order;
}

// Section 3.7.2.1: p_i of a strip is (v_i, v_{i+(1+i%2)}, v_{i+(2-i%2)}), of a fan (v_{i+1}, v_{i+2}, v_0).
std::vector<std::uint32_t> as_triangles(const Element& element, std::uint64_t mode, std::vector<std::uint32_t> order) {
  if (order.size() < 3 || (mode == triangles && order.size() % 3 != 0)) {
    element.fail("mode", "is " + std::to_string(mode) + ", which " + std::to_string(order.size()) +
                             " vertices do not fit: triangles take a multiple of 3, strips and fans at least 3 (section 3.7.2.1)");
  }
  if (mode == triangles) {
    return order;
  }
  std::vector<std::uint32_t> result;
  result.reserve((order.size() - 2) * 3);
  for (std::size_t i = 0; i + 2 < order.size(); ++i) {
    if (mode == triangle_strip) {
      result.insert(result.end(), {order[i], order[i + 1 + i % 2], order[i + 2 - i % 2]});
    } else {
      result.insert(result.end(), {order[i + 1], order[i + 2], order[0]});
    }
  }
  return result;
}

void check_texcoords(const Element& element, const Material& material, const Primitive& primitive) {
  const std::pair<const char*, const TextureInfo*> uses[] = {
      {"baseColorTexture", &material.base_color_texture},
      {"metallicRoughnessTexture", &material.metallic_roughness_texture},
      {"normalTexture", &material.normal_texture},
      {"occlusionTexture", &material.occlusion_texture},
      {"emissiveTexture", &material.emissive_texture},
      {"specularTexture", &material.specular.factor_texture},
      {"specularColorTexture", &material.specular.color_texture},
      {"sheenColorTexture", &material.sheen.color_texture},
      {"sheenRoughnessTexture", &material.sheen.roughness_texture},
      {"clearcoatTexture", &material.clearcoat.factor_texture},
      {"clearcoatRoughnessTexture", &material.clearcoat.roughness_texture},
      {"clearcoatNormalTexture", &material.clearcoat.normal_texture},
  };
  for (const auto& [name, info] : uses) {
    if (info->present() && primitive.texcoords[static_cast<std::size_t>(info->texcoord)].empty()) {
      const std::string set = "TEXCOORD_" + std::to_string(info->texcoord);
      element.fail(nullptr, "has no " + set + ", which " + name + " of material '" + material.name + "' needs (section 3.9.2)");
    }
  }
}

void complete_frames(const Element& element, const Material& material, Primitive& primitive, std::vector<std::string>& warnings) {
  if (primitive.normals.empty()) {
    make_flat_normals(primitive);
  }
  const std::size_t repaired = repair_frames(primitive);
  if (repaired > 0) {
    warnings.push_back(element.name() + ": " + std::to_string(repaired) + " normals or tangents of length zero were replaced");
  }
  const TextureInfo& map = material.normal_texture.present() ? material.normal_texture : material.clearcoat.normal_texture;
  if (primitive.tangents.empty() && map.present()) {
    make_tangents(primitive, map);
  }
}

int material_of(const Element& element, std::size_t file_materials, Scene& scene) {
  const int index = element.index("material", file_materials, "materials");
  if (index >= 0) {
    return index;
  }
  // The default material follows those of the file.
  if (scene.materials.size() == file_materials) {
    scene.materials.emplace_back();
  }
  return static_cast<int>(file_materials);
}

std::optional<Primitive> read_primitive(const Element& element, const Accessors& accessors, bool quantized, int material, Scene& scene) {
  const std::uint64_t mode = element.count("mode", triangles);
  if (mode > triangle_fan) {
    element.fail("mode", "is " + std::to_string(mode) + ", must be at most 6 (section 5.24)");
  }
  Context context{.element = element, .attributes = element.required_child("attributes"), .accessors = accessors, .quantized = quantized};
  for (const std::string& name : context.attributes.keys()) {
    context.attributes.required_index(name.c_str(), accessors.size(), "accessors");
  }
  const int positions = find_attribute(context, "POSITION", {"VEC3"}, {real});
  if (mode < triangles || positions < 0) {
    scene.warnings.push_back(element.name() + ": a primitive of " + (positions < 0 ? "no positions" : "points or lines") + " is not drawn");
    return std::nullopt;
  }
  if (element.has("targets")) {
    scene.warnings.push_back(element.name() + ": morph targets are not applied");
  }
  context.vertices = accessors.count(positions);
  Primitive primitive;
  primitive.positions = read_attribute<glm::vec3>(context, "POSITION", "VEC3", {real});
  primitive.normals = read_attribute<glm::vec3>(context, "NORMAL", "VEC3", {real});
  primitive.tangents = read_attribute<glm::vec4>(context, "TANGENT", "VEC4", {real});
  primitive.texcoords[0] = read_attribute<glm::vec2>(context, "TEXCOORD_0", "VEC2", {real, unorm8, unorm16});
  primitive.texcoords[1] = read_attribute<glm::vec2>(context, "TEXCOORD_1", "VEC2", {real, unorm8, unorm16});
  primitive.colors = read_colors(context);
  primitive.indices = as_triangles(element, mode, drawing_order(context));
  primitive.material = material;
  const Material& used = scene.materials[static_cast<std::size_t>(material)];
  check_texcoords(element, used, primitive);
  complete_frames(element, used, primitive, scene.warnings);
  return primitive;
}

}  // namespace

std::vector<std::vector<int>> read_meshes(const Element& root, const Accessors& accessors, Scene& scene) {
  const std::size_t file_materials = scene.materials.size();
  const auto listed = [&](const char* list) {
    const std::vector<std::string> names = root.strings(list);
    return std::find(names.begin(), names.end(), quantization) != names.end();
  };
  const bool required = listed("extensionsRequired");
  const bool quantized = required || listed("extensionsUsed");
  if (quantized && !required) {
    scene.warnings.push_back("extension " + std::string(quantization) + " must stand in extensionsRequired: it is not optional");
  }
  std::vector<std::vector<int>> meshes;
  for (const Element& mesh : root.children("meshes")) {
    std::vector<int>& primitives = meshes.emplace_back();
    for (const Element& element : mesh.children("primitives")) {
      const int material = material_of(element, file_materials, scene);
      std::optional<Primitive> primitive = read_primitive(element, accessors, quantized, material, scene);
      if (!primitive) {
        continue;
      }
      primitives.push_back(static_cast<int>(scene.primitives.size()));
      scene.primitives.push_back(std::move(*primitive));
    }
  }
  return meshes;
}

}  // namespace sheen::scene
