#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "golden/rays.h"
#include "scene/scene.h"

namespace sheen::golden {

/// Where a ray meets a triangle's plane. Weights are the barycentrics of the triangle's three vertices in world space: their sum is 1, and
/// none is negative inside.
struct Hit {
  std::uint32_t triangle = 0;  ///< index over the whole scene
  glm::dvec3 weights{0.0};
  double t = 0.0;     ///< depth along the viewing axis
  bool front = true;  ///< whether the front face is seen

  double smallest_weight() const;
};

/// An instance with what its triangles share.
struct Placed {
  const scene::Primitive* primitive = nullptr;
  const scene::Material* material = nullptr;
  int material_index = 0;
  bool mirrored = false;
  glm::dmat3 linear{1.0};         ///< world from local, directions
  glm::dmat3 normal_matrix{1.0};  ///< a positive multiple of the inverse transpose; its cofactors, so that a flattened instance has one too
  /// What a vertex shader takes local coordinates about: the middle of the primitive's box where that lies more than four times as far from
  /// the origin as the box is wide, so that their digits are kept; else the origin. And where that is in world space.
  glm::dvec3 middle{0.0};
  glm::dvec3 offset{0.0};
  std::uint32_t first_vertex = 0;
  std::uint32_t first_triangle = 0;
};

/// Every triangle of a scene in world space, in double.
class Geometry {
 public:
  /// Throws scene::Error where an instance, primitive or index is out of range.
  explicit Geometry(const scene::Scene& scene);

  std::size_t triangle_count() const { return triangles_.size(); }
  const Placed& placed(std::uint32_t triangle) const { return placed_[triangles_[triangle].placed]; }
  std::uint32_t triangle_in_primitive(std::uint32_t triangle) const { return triangle - placed(triangle).first_triangle; }
  std::uint32_t global_triangle(std::uint32_t instance, std::uint32_t triangle) const {
    return placed_[instance].first_triangle + triangle;
  }
  /// Indices of the triangle's vertices within its primitive.
  std::array<std::uint32_t, 3> local_vertices(std::uint32_t triangle) const;
  const std::array<std::uint32_t, 3>& vertices(std::uint32_t triangle) const { return triangles_[triangle].vertices; }
  const std::vector<glm::dvec3>& positions() const { return positions_; }

  /// The triangle's plane met by a ray, inside the triangle or not; none where they are parallel. Two triangles that share an edge decide
  /// alike on which side of it the ray passes, since the edge function is the same up to its sign.
  std::optional<Hit> meet(std::uint32_t triangle, const Ray& ray) const;

  /// The volumes that the ray's direction spans with each edge as seen from its origin: proportional to the weights of the point where it
  /// meets the triangle's plane, and affine in where it crosses the picture.
  glm::dvec3 edge_volumes(std::uint32_t triangle, const Ray& ray) const;

  /// Whether a triangle's edge, that opposite its corner of that number, is an edge of another triangle of its instance: between vertices
  /// in the same places, which every vertex shader moves alike.
  bool share_edge(std::uint32_t triangle, int opposite, std::uint32_t other) const;

  /// Unit normal of the triangle on its front side, world space.
  glm::dvec3 face_normal(std::uint32_t triangle) const;

 private:
  struct Triangle {
    std::array<std::uint32_t, 3> vertices;  // into positions_
    std::uint32_t placed;
  };
  std::vector<glm::dvec3> positions_;
  std::vector<Triangle> triangles_;
  std::vector<Placed> placed_;
};

}  // namespace sheen::golden
