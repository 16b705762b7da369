#include "golden/triangle_in_view.h"

#include <algorithm>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "golden/bound.h"
#include "golden/vertex_rounding.h"

namespace sheen::golden {
namespace {

// A matrix of floats times the vectors at the vertices.
template <class Attribute>
TriangleInView::Vectors transformed(const std::vector<Attribute>& directions, const std::array<std::uint32_t, 3>& vertices,
                                    const glm::dmat3& view_from_local) {
  const glm::dmat3 magnitudes(glm::abs(view_from_local[0]), glm::abs(view_from_local[1]), glm::abs(view_from_local[2]));
  TriangleInView::Vectors out;
  glm::dvec3 largest(0.0);
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3 direction(directions[vertices.at(i)]);
    out.at.at(i) = view_from_local * direction;
    largest = glm::max(largest, magnitudes * glm::abs(direction));
  }
  out.rounding = transform_roundings * epsilon * largest;
  return out;
}

TriangleInView::Vectors position_of(const Geometry& geometry, const RayGenerator& rays, std::uint32_t triangle) {
  TriangleInView::Vectors out;
  glm::dvec3 largest(0.0);
  const std::array<glm::dvec3, 3> magnitudes = position_magnitudes(geometry, rays, triangle);
  for (std::size_t i = 0; i < 3; ++i) {
    out.at.at(i) = rays.in_view(geometry.positions()[geometry.vertices(triangle).at(i)]);
    largest = glm::max(largest, magnitudes.at(i));
  }
  out.rounding = transform_roundings * epsilon * largest;
  return out;
}

}  // namespace

TriangleInView::TriangleInView(const Geometry& geometry, const RayGenerator& rays, std::uint32_t triangle_in)
    : triangle(triangle_in), edges(geometry, rays, triangle_in), position(position_of(geometry, rays, triangle_in)) {
  const Placed& placed = geometry.placed(triangle);
  const std::array<std::uint32_t, 3> vertices = geometry.local_vertices(triangle);
  const glm::dmat3 view = rays.view_from_world();
  if (!placed.primitive->normals.empty()) {
    // Scaled to lengths near 1, as a shader's matrix has it: the length goes, but what has none must not.
    const glm::dmat3 m = view * placed.normal_matrix;
    const double scale = std::max({glm::length(m[0]), glm::length(m[1]), glm::length(m[2])});
    normal = transformed(placed.primitive->normals, vertices, scale > 0.0 ? m * (1.0 / scale) : m);
  }
  if (!placed.primitive->tangents.empty()) {
    tangent = transformed(placed.primitive->tangents, vertices, view * placed.linear);
    if (std::all_of(tangent->at.begin(), tangent->at.end(), [](const glm::dvec3& t) { return t == glm::dvec3(0.0); })) {
      tangent.reset();
    }
  }
}

const TriangleInView& TrianglesInView::at(std::uint32_t triangle) {
  std::optional<TriangleInView>& kept = kept_.at(triangle % kept_.size());
  if (!kept || kept->triangle != triangle) {
    kept.emplace(geometry_, rays_, triangle);
  }
  return *kept;
}

}  // namespace sheen::golden
