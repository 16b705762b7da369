#include "scene/gltf_nodes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "scene/gltf_cameras.h"

namespace sheen::scene {
namespace {

struct Node {
  Element element;
  glm::dmat4 local{1.0};
  std::vector<int> children;
  int parent = -1;
  int mesh = -1;
  int camera = -1;
  int light = -1;
};

glm::dmat4 read_matrix(const Element& element) {
  const std::vector<double> m = element.numbers("matrix", 16);
  glm::dmat4 matrix;
  for (int i = 0; i < 16; ++i) {
    matrix[i / 4][i % 4] = m[static_cast<std::size_t>(i)];
  }
  if (matrix[0][3] != 0.0 || matrix[1][3] != 0.0 || matrix[2][3] != 0.0 || matrix[3][3] != 1.0) {
    element.fail("matrix", "must have (0, 0, 0, 1) as its last row (section 3.5.3)");
  }
  return matrix;
}

// Unit quaternion (x, y, z, w) as a rotation matrix; files round it, so it is normalised first.
glm::dmat3 rotation_matrix(const Element& element) {
  // A little more than 1, for components that were rounded up.
  constexpr Range component{.low = -1.0 - 1e-5, .high = 1.0 + 1e-5};
  const auto q = element.numbers<4>("rotation", {0.0, 0.0, 0.0, 1.0}, component);
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (!(length > 0.0)) {
    element.fail("rotation", "must be a unit quaternion, but its length is 0 (section 3.5.3)");
  }
  const double x = q[0] / length;
  const double y = q[1] / length;
  const double z = q[2] / length;
  const double w = q[3] / length;
  return glm::dmat3(1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w),  //
                    2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w),  //
                    2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y));
}

glm::dmat4 read_transform(const Element& element) {
  if (element.has("matrix")) {
    for (const char* key : {"translation", "rotation", "scale"}) {
      if (element.has(key)) {
        element.fail(key, "must not be given together with matrix (section 3.5.3)");
      }
    }
    return read_matrix(element);
  }
  const auto translation = element.numbers<3>("translation", {0.0, 0.0, 0.0});
  const auto scale = element.numbers<3>("scale", {1.0, 1.0, 1.0});
  const glm::dmat3 rotation = rotation_matrix(element);
  return glm::dmat4(glm::dvec4(rotation[0] * scale[0], 0.0), glm::dvec4(rotation[1] * scale[1], 0.0),
                    glm::dvec4(rotation[2] * scale[2], 0.0), glm::dvec4(translation[0], translation[1], translation[2], 1.0));
}

std::vector<Node> read_nodes(const Element& root, const Placeables& placeables, std::vector<std::string>& warnings) {
  const std::vector<Element> elements = root.children("nodes");
  const std::size_t skins = root.children("skins").size();
  std::vector<Node> nodes;
  for (const Element& element : elements) {
    Node node{.element = element, .children = {}};
    node.local = read_transform(element);
    node.children = element.indices("children", elements.size(), "nodes");
    node.mesh = element.index("mesh", placeables.meshes.size(), "meshes");
    node.camera = element.index("camera", placeables.cameras.size(), "cameras");
    if (const auto light = element.extension("KHR_lights_punctual")) {
      node.light = light->required_index("light", placeables.lights.size(), "lights");
    }
    if (element.index("skin", skins, "skins") >= 0) {
      warnings.push_back(element.name() + ": the skin is not applied");
    }
    nodes.push_back(std::move(node));
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (const int child : nodes[i].children) {
      Node& node = nodes[static_cast<std::size_t>(child)];
      if (node.parent >= 0) {
        node.element.fail(nullptr, "has two parents, nodes[" + std::to_string(node.parent) + "] and nodes[" + std::to_string(i) +
                                       "]: nodes must form strict trees (section 3.5.2)");
      }
      node.parent = static_cast<int>(i);
    }
  }
  return nodes;
}

std::vector<int> root_nodes(const std::vector<Node>& nodes) {
  std::vector<int> roots;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].parent < 0) {
      roots.push_back(static_cast<int>(i));
    }
  }
  return roots;
}

// Nodes in depth-first order from `roots`, each with its parent before it.
std::vector<int> depth_first(const std::vector<Node>& nodes, const std::vector<int>& roots) {
  std::vector<int> order;
  std::vector<int> open(roots.rbegin(), roots.rend());
  while (!open.empty()) {
    const int node = open.back();
    open.pop_back();
    order.push_back(node);
    const std::vector<int>& children = nodes[static_cast<std::size_t>(node)].children;
    open.insert(open.end(), children.rbegin(), children.rend());
  }
  return order;
}

// With one parent at most, a node that no root reaches is on a cycle, or below one.
void check_cycles(const std::vector<Node>& nodes) {
  std::vector<bool> reached(nodes.size(), false);
  for (const int node : depth_first(nodes, root_nodes(nodes))) {
    reached[static_cast<std::size_t>(node)] = true;
  }
  const auto cyclic = std::find(reached.begin(), reached.end(), false);
  if (cyclic != reached.end()) {
    nodes[static_cast<std::size_t>(cyclic - reached.begin())].element.fail(
        nullptr, "is its own ancestor: nodes must form strict trees without cycles (section 3.5.2)");
  }
}

std::vector<int> default_scene_roots(const Element& root, const std::vector<Node>& nodes, std::vector<std::string>& warnings) {
  const std::vector<Element> scenes = root.children("scenes");
  std::vector<std::vector<int>> scene_roots;
  for (const Element& element : scenes) {
    std::vector<int> roots = element.indices("nodes", nodes.size(), "nodes");
    std::vector<bool> seen(nodes.size(), false);
    for (const int node : roots) {
      const auto i = static_cast<std::size_t>(node);
      if (nodes[i].parent >= 0) {
        element.fail("nodes", "holds " + std::to_string(node) + ", which is no root node (section 3.5.1)");
      }
      if (seen[i]) {
        element.fail("nodes", "holds " + std::to_string(node) + " twice (section 5.27)");
      }
      seen[i] = true;
    }
    scene_roots.push_back(std::move(roots));
  }
  const int index = root.index("scene", scenes.size(), "scenes");
  if (scenes.empty()) {
    if (!nodes.empty()) {
      warnings.emplace_back("the file has no scene: every root node is drawn");
    }
    return root_nodes(nodes);
  }
  return scene_roots[static_cast<std::size_t>(std::max(index, 0))];
}

bool is_finite(const glm::dmat4& m) {
  for (int i = 0; i < 16; ++i) {
    if (!std::isfinite(m[i / 4][i % 4])) {
      return false;
    }
  }
  return true;
}

void place_mesh(const Node& node, const glm::dmat4& world, const Placeables& placeables, Scene& scene) {
  const double determinant = glm::determinant(glm::dmat3(world));
  if (determinant == 0.0 || !std::isfinite(1.0 / determinant)) {
    scene.warnings.push_back(node.element.name() + ": its mesh is not drawn, because the node's transform has no inverse");
    return;
  }
  for (const int primitive : placeables.meshes[static_cast<std::size_t>(node.mesh)]) {
    scene.instances.push_back({primitive, world});
  }
}

glm::dmat4 checked_rigid(const Node& node, const glm::dmat4& world) {
  const std::optional<glm::dmat4> rigid = rigid_part(world);
  if (!rigid) {
    node.element.fail(nullptr, "has a camera or light but its transform leaves no direction (a scale of 0)");
  }
  return *rigid;
}

void place_light(const Node& node, const glm::dmat4& world, const Placeables& placeables, Scene& scene) {
  Light light = placeables.lights[static_cast<std::size_t>(node.light)];
  light.position = glm::dvec3(world[3]);
  if (light.type != LightType::Point) {
    light.direction = -glm::dvec3(checked_rigid(node, world)[2]);
  }
  scene.lights.push_back(light);
}

}  // namespace

void place_nodes(const Element& root, const Placeables& placeables, Scene& scene) {
  const std::vector<Node> nodes = read_nodes(root, placeables, scene.warnings);
  check_cycles(nodes);
  std::vector<glm::dmat4> world(nodes.size());
  std::vector<std::pair<int, Camera>> cameras;
  for (const int index : depth_first(nodes, default_scene_roots(root, nodes, scene.warnings))) {
    const auto i = static_cast<std::size_t>(index);
    const Node& node = nodes[i];
    world[i] = node.parent < 0 ? node.local : world[static_cast<std::size_t>(node.parent)] * node.local;
    if (!is_finite(world[i])) {
      node.element.fail(nullptr, "its world transform overflows");
    }
    if (node.mesh >= 0) {
      place_mesh(node, world[i], placeables, scene);
    }
    if (node.light >= 0) {
      place_light(node, world[i], placeables, scene);
    }
    if (node.camera >= 0) {
      Camera camera = placeables.cameras[static_cast<std::size_t>(node.camera)];
      camera.world_from_camera = checked_rigid(node, world[i]);
      cameras.emplace_back(node.camera, std::move(camera));
    }
  }
  std::stable_sort(cameras.begin(), cameras.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (auto& [index, camera] : cameras) {
    scene.cameras.push_back(std::move(camera));
  }
}

}  // namespace sheen::scene
