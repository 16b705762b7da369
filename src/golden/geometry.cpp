#include "golden/geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

namespace sheen::golden {
namespace {

// Cofactors of the matrix, times the sign of its determinant: the inverse transpose up to a positive factor.
glm::dmat3 normal_matrix(const glm::dmat3& m) {
  const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
  const double determinant = glm::dot(m[0], cofactors[0]);
  return determinant < 0.0 ? -cofactors : cofactors;
}

void require(bool holds, const scene::Scene& scene, const std::string& element, const char* rule) {
  if (!holds) {
    throw scene::Error(scene.file, element, rule);
  }
}

// Attributes are as long as the positions or empty; normals are never empty.
void check(const scene::Scene& scene, const scene::Primitive& p, const std::string& element) {
  const std::size_t count = p.positions.size();
  const auto fits = [&](std::size_t size) { return size == 0 || size == count; };
  require(fits(p.tangents.size()) && fits(p.texcoords[0].size()) && fits(p.texcoords[1].size()) && fits(p.colors.size()) &&
              fits(p.normals.size()),
          scene, element, "every attribute must have as many values as POSITION");
  require(p.indices.size() % 3 == 0, scene, element, "the number of indices must be a multiple of 3");
  require(std::all_of(p.indices.begin(), p.indices.end(), [&](std::uint32_t i) { return i < count; }), scene, element,
          "an index must be smaller than the number of vertices");
  require(p.material >= 0 && p.material < static_cast<int>(scene.materials.size()), scene, element, "its material does not exist");
}

}  // namespace

double Hit::smallest_weight() const {
  return std::min({weights.x, weights.y, weights.z});
}

Geometry::Geometry(const scene::Scene& scene) {
  for (std::size_t i = 0; i < scene.primitives.size(); ++i) {
    check(scene, scene.primitives[i], "primitives[" + std::to_string(i) + "]");
  }
  placed_.reserve(scene.instances.size());
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const scene::Instance& instance = scene.instances[i];
    require(instance.primitive >= 0 && instance.primitive < static_cast<int>(scene.primitives.size()), scene,
            "instances[" + std::to_string(i) + "]", "its primitive does not exist");
    const scene::Primitive& primitive = scene.primitives[static_cast<std::size_t>(instance.primitive)];
    Placed placed;
    placed.primitive = &primitive;
    placed.material_index = primitive.material;
    placed.material = &scene.materials[static_cast<std::size_t>(primitive.material)];
    placed.linear = glm::dmat3(instance.world_from_local);
    placed.mirrored = glm::dot(placed.linear[0], glm::cross(placed.linear[1], placed.linear[2])) < 0.0;
    placed.normal_matrix = normal_matrix(placed.linear);
    placed.first_vertex = static_cast<std::uint32_t>(positions_.size());
    placed.first_triangle = static_cast<std::uint32_t>(triangles_.size());
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high(-low);
    for (const glm::vec3& p : primitive.positions) {
      positions_.emplace_back(instance.world_from_local * glm::dvec4(glm::dvec3(p), 1.0));
      low = glm::min(low, glm::dvec3(p));
      high = glm::max(high, glm::dvec3(p));
    }
    if (!primitive.positions.empty() && glm::length(0.5 * (low + high)) > 4.0 * glm::length(high - low)) {
      placed.middle = 0.5 * (low + high);
    }
    placed.offset = glm::dvec3(instance.world_from_local * glm::dvec4(placed.middle, 1.0));
    for (std::size_t k = 0; k + 2 < primitive.indices.size(); k += 3) {
      triangles_.push_back({{placed.first_vertex + primitive.indices[k], placed.first_vertex + primitive.indices[k + 1],
                             placed.first_vertex + primitive.indices[k + 2]},
                            static_cast<std::uint32_t>(i)});
    }
    placed_.push_back(placed);
  }
}

std::array<std::uint32_t, 3> Geometry::local_vertices(std::uint32_t triangle) const {
  const std::uint32_t first = placed(triangle).first_vertex;
  const auto& v = vertices(triangle);
  return {v[0] - first, v[1] - first, v[2] - first};
}

glm::dvec3 Geometry::edge_volumes(std::uint32_t triangle, const Ray& ray) const {
  const auto& v = vertices(triangle);
  const glm::dvec3 a = positions_[v[0]] - ray.origin;
  const glm::dvec3 b = positions_[v[1]] - ray.origin;
  const glm::dvec3 c = positions_[v[2]] - ray.origin;
  return {glm::dot(ray.direction, glm::cross(b, c)), glm::dot(ray.direction, glm::cross(c, a)), glm::dot(ray.direction, glm::cross(a, b))};
}

std::optional<Hit> Geometry::meet(std::uint32_t triangle, const Ray& ray) const {
  const auto& v = vertices(triangle);
  const glm::dvec3 a = positions_[v[0]] - ray.origin;
  const glm::dvec3 b = positions_[v[1]] - ray.origin;
  const glm::dvec3 c = positions_[v[2]] - ray.origin;
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double facing = glm::dot(normal, ray.direction);
  const glm::dvec3 volumes = edge_volumes(triangle, ray);
  const double sum = volumes.x + volumes.y + volumes.z;
  if (facing == 0.0 || sum == 0.0 || !std::isfinite(1.0 / sum)) {
    return std::nullopt;
  }
  Hit hit;
  hit.triangle = triangle;
  hit.weights = volumes / sum;
  hit.t = glm::dot(normal, a) / facing;
  hit.front = (facing < 0.0) != placed(triangle).mirrored;
  return hit;
}

bool Geometry::share_edge(std::uint32_t triangle, int opposite, std::uint32_t other) const {
  const Placed& instance = placed(triangle);
  if (triangle == other || &instance != &placed(other)) {
    return false;
  }
  const std::vector<glm::vec3>& positions = instance.primitive->positions;
  const auto ours = local_vertices(triangle);
  const auto theirs = local_vertices(other);
  const auto is_corner_of_other = [&](int corner) {
    const glm::vec3& place = positions[ours.at(static_cast<std::size_t>(corner % 3))];
    return std::any_of(theirs.begin(), theirs.end(), [&](std::uint32_t vertex) { return positions[vertex] == place; });
  };
  return is_corner_of_other(opposite + 1) && is_corner_of_other(opposite + 2);
}

glm::dvec3 Geometry::face_normal(std::uint32_t triangle) const {
  const auto& v = vertices(triangle);
  const glm::dvec3 normal = glm::cross(positions_[v[1]] - positions_[v[0]], positions_[v[2]] - positions_[v[0]]);
  const double length = glm::length(normal);
  if (!(length > 0.0)) {
    return {0.0, 0.0, 1.0};
  }
  return normal * ((placed(triangle).mirrored ? -1.0 : 1.0) / length);
}

}  // namespace sheen::golden
