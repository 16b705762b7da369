#include "scene/attributes.h"

#include <cmath>
#include <numeric>

#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>

#include "scene/mikktspace.h"

namespace sheen::scene {
namespace {

struct Triangle {
  std::size_t v[3];
};

Triangle triangle(const Primitive& primitive, std::size_t i) {
  return {{primitive.indices[3 * i], primitive.indices[3 * i + 1], primitive.indices[3 * i + 2]}};
}

// Twice the triangle's area along its normal; in double, so that small triangles far from the origin keep their normal.
glm::dvec3 area_normal(const Primitive& primitive, const Triangle& t) {
  const glm::dvec3 a(primitive.positions[t.v[0]]);
  return glm::cross(glm::dvec3(primitive.positions[t.v[1]]) - a, glm::dvec3(primitive.positions[t.v[2]]) - a);
}

glm::dvec3 normalized_or(const glm::dvec3& v, const glm::dvec3& fallback) {
  const double length = glm::length(v);
  return length > 0.0 && std::isfinite(length) ? v / length : fallback;
}

// A unit vector perpendicular to the unit vector n.
glm::dvec3 any_perpendicular(const glm::dvec3& n) {
  const glm::dvec3 axis = std::abs(n.x) < 0.9 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
  return glm::normalize(axis - n * glm::dot(n, axis));
}

template <class T>
void gather(std::vector<T>& attribute, const std::vector<std::uint32_t>& indices) {
  if (attribute.empty()) {
    return;
  }
  std::vector<T> result(indices.size());
  for (std::size_t i = 0; i < indices.size(); ++i) {
    result[i] = attribute[indices[i]];
  }
  attribute = std::move(result);
}

}  // namespace

void unshare_vertices(Primitive& primitive) {
  gather(primitive.positions, primitive.indices);
  gather(primitive.normals, primitive.indices);
  gather(primitive.tangents, primitive.indices);
  for (std::vector<glm::vec2>& set : primitive.texcoords) {
    gather(set, primitive.indices);
  }
  gather(primitive.colors, primitive.indices);
  std::iota(primitive.indices.begin(), primitive.indices.end(), 0U);
}

void make_flat_normals(Primitive& primitive) {
  primitive.tangents.clear();
  primitive.normals.clear();
  unshare_vertices(primitive);
  primitive.normals.resize(primitive.positions.size());
  for (std::size_t i = 0; i < primitive.indices.size() / 3; ++i) {
    const Triangle t = triangle(primitive, i);
    const glm::vec3 normal(normalized_or(area_normal(primitive, t), {0.0, 0.0, 1.0}));
    for (const std::size_t v : t.v) {
      primitive.normals[v] = normal;
    }
  }
}

void make_tangents(Primitive& primitive, const TextureInfo& uv) {
  primitive.tangents.clear();
  unshare_vertices(primitive);
  std::vector<glm::vec3> normals;
  normals.reserve(primitive.normals.size());
  for (const glm::vec3& normal : primitive.normals) {
    normals.emplace_back(normalized_or(glm::dvec3(normal), {0.0, 0.0, 1.0}));
  }
  // Tangents depend on differences of uv alone: without the offset these keep their digits.
  const glm::dmat2 linear(uv.transform);
  std::vector<glm::vec2> uvs;
  uvs.reserve(primitive.positions.size());
  for (const glm::vec2& given : primitive.texcoords[static_cast<std::size_t>(uv.texcoord)]) {
    uvs.emplace_back(linear * glm::dvec2(given));
  }
  primitive.tangents = mikktspace(primitive.positions, normals, uvs);
  for (std::size_t v = 0; v < primitive.tangents.size(); ++v) {
    glm::vec4& tangent = primitive.tangents[v];
    const glm::dvec3 n(normals[v]);
    const glm::dvec3 t(tangent);
    tangent = glm::vec4(glm::vec3(normalized_or(t - n * glm::dot(n, t), any_perpendicular(n))), tangent.w);
  }
}

std::size_t repair_frames(Primitive& primitive) {
  std::size_t repaired = 0;
  std::vector<glm::dvec3> means;
  for (std::size_t v = 0; v < primitive.normals.size(); ++v) {
    if (primitive.normals[v] != glm::vec3(0.0f)) {
      continue;
    }
    if (means.empty()) {
      means.resize(primitive.normals.size(), glm::dvec3(0.0));
      for (std::size_t i = 0; i < primitive.indices.size() / 3; ++i) {
        const Triangle t = triangle(primitive, i);
        for (const std::size_t corner : t.v) {
          means[corner] += area_normal(primitive, t);
        }
      }
    }
    primitive.normals[v] = glm::vec3(normalized_or(means[v], {0.0, 0.0, 1.0}));
    ++repaired;
  }
  for (std::size_t v = 0; v < primitive.tangents.size(); ++v) {
    glm::vec4& tangent = primitive.tangents[v];
    if (glm::vec3(tangent) == glm::vec3(0.0f)) {
      const glm::dvec3 n = normalized_or(glm::dvec3(primitive.normals[v]), {0.0, 0.0, 1.0});
      tangent = glm::vec4(glm::vec3(any_perpendicular(n)), tangent.w);
      ++repaired;
    }
    tangent.w = tangent.w < 0.0f ? -1.0f : 1.0f;
  }
  return repaired;
}

}  // namespace sheen::scene
