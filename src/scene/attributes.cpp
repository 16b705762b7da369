#include "scene/attributes.h"

#include <cmath>
#include <numeric>

#include <glm/geometric.hpp>

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

struct UvFrame {
  glm::dvec3 along_u{0.0};
  double handedness = 1.0;
};

// With e1, e2 the edges and (du, dv) their texture coordinates: dp/du = (e1 dv2 - e2 dv1) / det, det = du1 dv2 - du2 dv1, and
// dp/du x dp/dv = (e1 x e2) / det. cross(n, t) * w is to point along -dp/dv, hence w = -sign(det) on the front of the triangle.
UvFrame uv_frame(const Primitive& primitive, const Triangle& t, const TextureInfo& uv) {
  const std::vector<glm::vec2>& set = primitive.texcoords[static_cast<std::size_t>(uv.texcoord)];
  glm::dvec2 st[3];
  for (int i = 0; i < 3; ++i) {
    st[i] = glm::dvec2(uv.transform * glm::dvec3(glm::dvec2(set[t.v[i]]), 1.0));
  }
  const glm::dvec3 origin(primitive.positions[t.v[0]]);
  const glm::dvec3 e1 = glm::dvec3(primitive.positions[t.v[1]]) - origin;
  const glm::dvec3 e2 = glm::dvec3(primitive.positions[t.v[2]]) - origin;
  const glm::dvec2 d1 = st[1] - st[0];
  const glm::dvec2 d2 = st[2] - st[0];
  const double det = d1.x * d2.y - d2.x * d1.y;
  UvFrame frame;
  if (det == 0.0) {
    return frame;
  }
  const double sign = det > 0.0 ? 1.0 : -1.0;
  frame.along_u = sign * (e1 * d2.y - e2 * d1.y);
  // Shading normals that face away from the triangle's front turn the frame over.
  const glm::dvec3 shading =
      glm::dvec3(primitive.normals[t.v[0]]) + glm::dvec3(primitive.normals[t.v[1]]) + glm::dvec3(primitive.normals[t.v[2]]);
  const bool facing_away = glm::dot(shading, glm::cross(e1, e2)) < 0.0;
  frame.handedness = facing_away ? sign : -sign;
  return frame;
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
  primitive.tangents.resize(primitive.positions.size());
  for (std::size_t i = 0; i < primitive.indices.size() / 3; ++i) {
    const Triangle t = triangle(primitive, i);
    const UvFrame frame = uv_frame(primitive, t, uv);
    const glm::dvec3 along_u = normalized_or(frame.along_u, glm::dvec3(0.0));
    for (const std::size_t v : t.v) {
      const glm::dvec3 n = normalized_or(glm::dvec3(primitive.normals[v]), {0.0, 0.0, 1.0});
      const glm::dvec3 tangent = normalized_or(along_u - n * glm::dot(n, along_u), any_perpendicular(n));
      primitive.tangents[v] = glm::vec4(glm::vec3(tangent), static_cast<float>(frame.handedness));
    }
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
