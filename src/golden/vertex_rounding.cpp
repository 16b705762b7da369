#include "golden/vertex_rounding.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "number/precision.h"

namespace sheen::golden {
namespace {

glm::dmat3 absolute(const glm::dmat3& m) {
  return {glm::abs(m[0]), glm::abs(m[1]), glm::abs(m[2])};
}

glm::dmat3 view_from_world(const RayGenerator& rays) {
  return glm::transpose(glm::dmat3(rays.camera().world_from_camera));
}

}  // namespace

std::array<glm::dvec3, 3> position_magnitudes(const Geometry& geometry, const RayGenerator& rays, std::uint32_t triangle) {
  const Placed& placed = geometry.placed(triangle);
  const glm::dmat3 view = view_from_world(rays);
  const glm::dmat3 magnitudes = absolute(view * placed.linear);
  const glm::dvec3 offset = glm::abs(view * (placed.offset - glm::dvec3(rays.camera().world_from_camera[3])));
  const auto local = geometry.local_vertices(triangle);
  std::array<glm::dvec3, 3> out;
  for (std::size_t i = 0; i < 3; ++i) {
    out.at(i) = magnitudes * glm::abs(glm::dvec3(placed.primitive->positions[local.at(i)]) - placed.middle) + offset;
  }
  return out;
}

double window_rounding(const Geometry& geometry, const RayGenerator& rays, const Hit& hit) {
  constexpr double epsilon = number::epsilon<number::Highp>;
  const std::array<glm::dvec3, 3> magnitudes = position_magnitudes(geometry, rays, hit.triangle);
  const scene::Camera& camera = rays.camera();
  const glm::dmat3 view = view_from_world(rays);
  const double aspect = static_cast<double>(rays.width()) / rays.height();
  const double per_height = 1.0 / (camera.perspective ? std::tan(0.5 * camera.yfov) : camera.ymag);  // of clip coordinates by view space
  const double depth = camera.perspective ? std::max(hit.t, camera.znear) : 1.0;
  double across = 0.0;  // at the hit, in clip coordinates over w
  double along = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double weight = std::abs(hit.weights[static_cast<int>(i)]);
    const glm::dvec3& m = magnitudes.at(i);
    const glm::dvec3 p =
        glm::abs(view * (geometry.positions()[geometry.vertices(hit.triangle).at(i)] - glm::dvec3(camera.world_from_camera[3])));
    const double w = camera.perspective ? transform_roundings * m.z : 0.0;  // a point of the picture lies within w of its axis
    across += weight * (per_height / aspect * (transform_roundings * m.x + 4.5 * p.x) + w);
    along += weight * (per_height * (transform_roundings * m.y + 4.5 * p.y) + w);
  }
  return 0.5 * epsilon * std::max(rays.width() * across, rays.height() * along) / depth + epsilon * std::max(rays.width(), rays.height());
}

}  // namespace sheen::golden
