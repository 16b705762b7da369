#include "conformance/description.h"

#include <algorithm>
#include <map>
#include <vector>

#include "conformance/case.h"
#include "conformance/environments.h"
#include "conformance/pictures.h"
#include "conformance/shapes.h"
#include "conformance/sweep.h"

namespace sheen::conformance {
namespace {

using nlohmann::json;

/// Names the file and the element, so that checks below say only what is wrong.
struct Place {
  const std::string& file;
  std::string element;

  Place inside(const std::string& member) const { return {file, element + "." + member}; }
  [[noreturn]] void fail(const std::string& rule) const { throw SuiteError(file, element, rule); }
};

void check_numbers(const json& value, std::size_t count, const Place& place) {
  const bool good = value.is_array() && value.size() == count &&
                    std::all_of(value.begin(), value.end(), [](const json& number) { return number.is_number(); });
  if (!good) {
    place.fail("must be an array of " + std::to_string(count) + " numbers");
  }
}

void check_number(const json& value, const Place& place) {
  if (!value.is_number()) {
    place.fail("must be a number");
  }
}

void require(const json& object, const std::string& key, const Place& place) {
  if (!object.contains(key)) {
    place.fail("needs '" + key + "'");
  }
}

void check_texture(const json& texture, const Place& place) {
  check_keys(texture, {"index", "texCoord", "scale", "strength", "extensions"}, place.file, place.element);
  require(texture, "index", place);
  if (!texture["index"].is_string() || !parse_texture_name(texture["index"].get<std::string>())) {
    place.fail("index must name a picture and perhaps a sampler, as \"channels\" or \"channels/nearest\"; pictures: " + picture_names());
  }
  if (texture.contains("extensions")) {
    check_keys(texture["extensions"], {"KHR_texture_transform"}, place.file, place.element + ".extensions");
    check_keys(texture["extensions"].value("KHR_texture_transform", json::object()), {"offset", "rotation", "scale", "texCoord"},
               place.file, place.element + ".extensions.KHR_texture_transform");
  }
}

/// A member of a material that is a number, a list of numbers or the like has no members of its own; textures and extensions do.
const std::map<std::string, std::vector<std::string>>& known_members() {
  static const std::map<std::string, std::vector<std::string>> members = {
      {"material",
       {"name", "pbrMetallicRoughness", "normalTexture", "occlusionTexture", "emissiveTexture", "emissiveFactor", "alphaMode",
        "alphaCutoff", "doubleSided", "extensions"}},
      {"pbrMetallicRoughness", {"baseColorFactor", "baseColorTexture", "metallicFactor", "roughnessFactor", "metallicRoughnessTexture"}},
      {"KHR_materials_sheen", {"sheenColorFactor", "sheenColorTexture", "sheenRoughnessFactor", "sheenRoughnessTexture"}},
      {"KHR_materials_clearcoat",
       {"clearcoatFactor", "clearcoatTexture", "clearcoatRoughnessFactor", "clearcoatRoughnessTexture", "clearcoatNormalTexture"}},
      {"KHR_materials_emissive_strength", {"emissiveStrength"}},
      {"KHR_materials_ior", {"ior"}},
      {"KHR_materials_specular", {"specularFactor", "specularTexture", "specularColorFactor", "specularColorTexture"}},
  };
  return members;
}

void check_members(const json& object, const std::string& kind, const Place& place) {
  check_keys(object, known_members().at(kind), place.file, place.element);
  for (const auto& [key, value] : object.items()) {
    if (key.size() > 7 && key.ends_with("Texture")) {
      check_texture(value, place.inside(key));
    }
  }
}

void check_material(const json& material, const Place& place) {
  check_members(material, "material", place);
  if (material.contains("pbrMetallicRoughness")) {
    check_members(material["pbrMetallicRoughness"], "pbrMetallicRoughness", place.inside("pbrMetallicRoughness"));
  }
  const json extensions = material.value("extensions", json::object());
  if (!extensions.is_object()) {
    place.fail("extensions must be an object");
  }
  for (const auto& [name, extension] : extensions.items()) {
    if (name.rfind("KHR_materials_", 0) != 0 || !known_members().contains(name)) {
      place.fail("unknown extension '" + name + "'");
    }
    check_members(extension, name, place.inside("extensions." + name));
  }
}

void check_light(const json& light, const Place& place) {
  const std::string type = light.is_object() ? light.value("type", "") : "";
  if (type == "directional") {
    check_keys(light, {"type", "toward", "color", "intensity"}, place.file, place.element);
    require(light, "toward", place);
  } else if (type == "point") {
    check_keys(light, {"type", "position", "color", "intensity", "range"}, place.file, place.element);
    require(light, "position", place);
  } else if (type == "spot") {
    check_keys(light, {"type", "position", "target", "color", "intensity", "range", "inner_cone", "outer_cone"}, place.file, place.element);
    require(light, "position", place);
    require(light, "target", place);
  } else {
    place.fail("type must be \"directional\", \"point\" or \"spot\"");
  }
  for (const auto& [key, value] : light.items()) {
    if (key == "toward" || key == "position" || key == "target" || key == "color") {
      check_numbers(value, 3, place.inside(key));
    } else if (key != "type") {
      check_number(value, place.inside(key));
    }
  }
}

void check_camera(const json& camera, const Place& place) {
  const std::string type = camera.is_object() ? camera.value("type", "") : "";
  if (type != "perspective" && type != "orthographic") {
    place.fail("type must be \"perspective\" or \"orthographic\"");
  }
  const std::string size = type == "perspective" ? "yfov" : "ymag";
  check_keys(camera, {"type", "position", "target", "znear", "zfar", size}, place.file, place.element);
  for (const std::string& key : {std::string("position"), std::string("target"), std::string("znear"), size}) {
    require(camera, key, place);
  }
  if (type == "orthographic") {
    require(camera, "zfar", place);
  }
  for (const auto& [key, value] : camera.items()) {
    if (key == "position" || key == "target") {
      check_numbers(value, 3, place.inside(key));
    } else if (key != "type") {
      check_number(value, place.inside(key));
    }
  }
}

void check_node(const json& node, const Place& place) {
  check_keys(node, {"translation", "rotation", "scale"}, place.file, place.element);
  for (const auto& [key, value] : node.items()) {
    check_numbers(value, key == "rotation" ? 4 : 3, place.inside(key));
  }
}

void check_size(const json& size, const Place& place) {
  const bool good = size.is_array() && size.size() == 2 && size[0].is_number_unsigned() && size[1].is_number_unsigned() &&
                    size[0].get<unsigned>() >= 1 && size[1].get<unsigned>() >= 1 && size[0].get<unsigned>() <= 4096 &&
                    size[1].get<unsigned>() <= 4096;
  if (!good) {
    place.fail("must be [width, height], whole numbers from 1 to 4096");
  }
}

}  // namespace

void check_description(const json& description, const std::string& file, const std::string& element) {
  const Place place{file, element};
  check_keys(description,
             {"shape", "node", "vertex_colors", "mirrored_texcoords", "material", "lights", "environment", "law", "camera", "model", "size",
              "precision", "refused"},
             file, element);
  for (const char* key : {"shape", "material", "lights", "camera", "size"}) {
    require(description, key, place);
  }
  if (!description["shape"].is_string() || !is_shape(description["shape"].get<std::string>())) {
    place.inside("shape").fail("unknown shape; known: " + shape_names());
  }
  if (description.contains("node")) {
    check_node(description["node"], place.inside("node"));
  }
  for (const char* flag : {"vertex_colors", "mirrored_texcoords", "refused"}) {
    if (description.contains(flag) && !description[flag].is_boolean()) {
      place.inside(flag).fail("must be true or false");
    }
  }
  check_material(description["material"], place.inside("material"));
  if (description.contains("environment") &&
      !(description["environment"].is_string() && is_environment(description["environment"].get<std::string>()))) {
    place.inside("environment").fail("must be one of " + environment_names());
  }
  if (description.contains("law") && !description["law"].is_string()) {
    place.inside("law").fail("must be a text");
  }
  if (!description["lights"].is_array() || (description["lights"].empty() && !description.contains("environment"))) {
    place.inside("lights").fail("must be an array of at least one light, unless there is an environment");
  }
  for (std::size_t i = 0; i < description["lights"].size(); ++i) {
    check_light(description["lights"][i], place.inside("lights[" + std::to_string(i) + "]"));
  }
  check_camera(description["camera"], place.inside("camera"));
  check_size(description["size"], place.inside("size"));
  const json model = description.value("model", json::object());
  check_keys(model, {"visibility", "albedo_scaling"}, file, element + ".model");
  if (description.contains("precision") && description["precision"] != "highp" && description["precision"] != "mediump") {
    place.inside("precision").fail("must be \"highp\" or \"mediump\"");
  }
  try {
    parse_visibility(model.value("visibility", "charlie"));
    parse_albedo_scaling(model.value("albedo_scaling", "full"));
  } catch (const std::exception& error) {
    place.inside("model").fail(error.what());
  }
}

}  // namespace sheen::conformance
