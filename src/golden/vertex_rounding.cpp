#include "golden/vertex_rounding.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "golden/bound.h"

namespace sheen::golden {
namespace {

glm::dmat3 absolute(const glm::dmat3& m) {
  return {glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2])};
}

}  // namespace

std::array<glm::dvec3, 3> position_magnitudes(const Geometry& geometry, const RayGenerator& rays, std::uint32_t triangle) {
  const Placed& placed = geometry.placed(triangle);
  const glm::dmat3 magnitudes = absolute(rays.view_from_world() * placed.linear);
  const glm::dvec3 offset = glm::abs(rays.in_view(placed.offset));
  const auto local = geometry.local_vertices(triangle);
  std::array<glm::dvec3, 3> out;
  for (std::size_t i = 0; i < 3; ++i) {
    out.at(i) = magnitudes * glm::abs(glm::dvec3(placed.primitive->positions[local.at(i)]) - placed.middle) + offset;
  }
  return out;
}

VertexRounding::VertexRounding(const Geometry& geometry, const RayGenerator& rays, std::uint32_t triangle) {
  const std::array<glm::dvec3, 3> magnitudes = position_magnitudes(geometry, rays, triangle);
  const scene::Camera& camera = rays.camera();
  const double aspect = static_cast<double>(rays.width()) / rays.height();
  const double per_height = 1.0 / (camera.perspective ? std::tan(0.5 * camera.yfov) : camera.ymag);  // of clip coordinates by view space
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3& m = magnitudes.at(i);
    const glm::dvec3 p = glm::abs(rays.in_view(geometry.positions()[geometry.vertices(triangle).at(i)]));
    const double w = camera.perspective ? transform_roundings * m.z : 0.0;  // a point of the picture lies within w of its axis
    const glm::dvec2 clip(per_height / aspect * (transform_roundings * m.x + 4.5 * p.x) + w,
                          per_height * (transform_roundings * m.y + 4.5 * p.y) + w);
    of_vertices_.at(i) = 0.5 * epsilon * glm::dvec2(rays.width(), rays.height()) * clip;
  }
}

double VertexRounding::in_window(const RayGenerator& rays, const Hit& hit) const {
  const glm::dvec3 shares = glm::abs(hit.weights);
  const glm::dvec2 sum = shares.x * of_vertices_[0] + shares.y * of_vertices_[1] + shares.z * of_vertices_[2];
  const double depth = rays.camera().perspective ? std::max(hit.t, rays.camera().znear) : 1.0;
  return std::max(sum.x, sum.y) / depth + epsilon * std::max(rays.width(), rays.height());
}

}  // namespace sheen::golden
