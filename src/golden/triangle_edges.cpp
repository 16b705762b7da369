#include "golden/triangle_edges.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace sheen::golden {

EdgeFunctions::Beside EdgeFunctions::beside(double dx, double dy) const {
  const glm::dvec3 there = here + along_x * dx + along_y * dy;
  const double sum = there.x + there.y + there.z;
  const double per_sum = 1.0 / sum;
  if (!(sum * ahead > 0.0) || !std::isfinite(per_sum)) {
    return {false, glm::dvec3(0.0)};
  }
  return {true, there * per_sum};
}

TriangleEdges::TriangleEdges(const Geometry& geometry, const RayGenerator& rays, std::uint32_t triangle) : triangle_(triangle) {
  const double x = 0.5 * rays.width();
  const double y = 0.5 * rays.height();
  const glm::dvec3 middle = geometry.edge_volumes(triangle, rays.through(x, y));
  along_x_ = geometry.edge_volumes(triangle, rays.through(x + 1.0, y)) - middle;
  along_y_ = geometry.edge_volumes(triangle, rays.through(x, y + 1.0)) - middle;
  if (!rays.camera().perspective) {
    ahead_ = middle.x + middle.y + middle.z;  // alike for all rays, which have one direction
    return;
  }
  const auto& v = geometry.vertices(triangle);
  std::array<glm::dvec3, 3> from_camera;
  glm::dvec3 depth;
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3& place = geometry.positions()[v.at(i)];
    from_camera.at(i) = place - glm::dvec3(rays.camera().world_from_camera[3]);
    depth[static_cast<int>(i)] = rays.depth(place);
  }
  ahead_ = glm::dot(glm::cross(from_camera[1] - from_camera[0], from_camera[2] - from_camera[0]), from_camera[0]);
  is_cut_ = !(std::min({depth.x, depth.y, depth.z}) >= rays.camera().znear);
  nearness_ = 1.0 / depth;
  if (is_cut_) {
    cut(depth, rays.camera().znear);
  }
}

void TriangleEdges::cut(const glm::dvec3& depth, double near) {
  for (int i = 0; i < 3; ++i) {
    const int next = (i + 1) % 3;
    if (depth[i] >= near) {
      corners_.at(corner_count_)[i] = 1.0 / depth[i];
      ++corner_count_;
    }
    if ((depth[i] < near) != (depth[next] < near)) {
      const double share = (near - depth[i]) / (depth[next] - depth[i]);
      corners_.at(corner_count_)[i] = (1.0 - share) / near;
      corners_.at(corner_count_)[next] = share / near;
      ++corner_count_;
    }
  }
}

EdgeFunctions TriangleEdges::at(const Geometry& geometry, const Ray& ray) const {
  return {geometry.edge_volumes(triangle_, ray), along_x_, along_y_, ahead_};
}

double TriangleEdges::largest_share(const glm::dvec3& attribute) const {
  if (!is_cut_) {
    const glm::dvec3 shares = glm::abs(attribute * nearness_);
    return std::max({shares.x, shares.y, shares.z});
  }
  double largest = 0.0;
  for (std::size_t i = 0; i < corner_count_; ++i) {
    largest = std::max(largest, std::abs(glm::dot(corners_.at(i), attribute)));
  }
  return largest;
}

}  // namespace sheen::golden
