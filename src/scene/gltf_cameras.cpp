#include "scene/gltf_cameras.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace sheen::scene {
namespace {

constexpr Range field_of_view{.low = 0.0, .high = std::numbers::pi, .low_excluded = true, .high_excluded = true};

void read_perspective(const Element& element, Camera& camera) {
  camera.perspective = true;
  camera.yfov = element.required_number("yfov", field_of_view);
  camera.znear = element.required_number("znear", positive);
  element.number("aspectRatio", 1.0, positive);
  if (!element.has("zfar")) {
    return;
  }
  camera.zfar = element.required_number("zfar", positive);
  if (camera.zfar <= camera.znear) {
    element.fail("zfar", "must be greater than znear (section 3.10.3)");
  }
}

void read_orthographic(const Element& element, Camera& camera) {
  camera.perspective = false;
  element.required_number("xmag", positive);
  camera.ymag = element.required_number("ymag", positive);
  camera.znear = element.required_number("znear", non_negative);
  camera.zfar = element.required_number("zfar", positive);
  if (camera.zfar <= camera.znear) {
    element.fail("zfar", "must be greater than znear (section 3.10.3)");
  }
}

}  // namespace

std::vector<Camera> read_cameras(const Element& root) {
  std::vector<Camera> cameras;
  for (const Element& element : root.children("cameras")) {
    Camera& camera = cameras.emplace_back();
    camera.name = element.string("name", "");
    const std::string type = element.required_string("type");
    if (type == "perspective") {
      read_perspective(element.required_child("perspective"), camera);
    } else if (type == "orthographic") {
      read_orthographic(element.required_child("orthographic"), camera);
    } else {
      element.fail("type", "is '" + type + "', must be perspective or orthographic (section 3.10.3)");
    }
  }
  return cameras;
}

std::optional<glm::dmat4> rigid_part(const glm::dmat4& world) {
  const double length = glm::length(glm::dvec3(world[2]));
  if (!(length > 0.0)) {
    return std::nullopt;
  }
  const glm::dvec3 z = glm::dvec3(world[2]) / length;
  const glm::dvec3 y_skewed(world[1]);
  const glm::dvec3 y_plane = y_skewed - z * glm::dot(z, y_skewed);
  const double y_length = glm::length(y_plane);
  if (!(y_length > 0.0)) {
    return std::nullopt;
  }
  const glm::dvec3 y = y_plane / y_length;
  return glm::dmat4(glm::dvec4(glm::cross(y, z), 0.0), glm::dvec4(y, 0.0), glm::dvec4(z, 0.0), world[3]);
}

}  // namespace sheen::scene
