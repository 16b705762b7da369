#include "golden/varying.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

#include "number/precision.h"

namespace sheen::golden {
namespace {

double sum_of(const glm::dvec3& v) {
  return v.x + v.y + v.z;
}

}  // namespace

Interpolation::Interpolation(const Geometry& geometry, const RayGenerator& rays, const Hit& hit, const Ray& ray, double step)
    : weights_(hit.weights), steps_x_(rays.width() / step), steps_y_(rays.height() / step) {
  volumes_ = geometry.edge_volumes(hit.triangle, ray);
  volumes_x_ = geometry.edge_volumes(hit.triangle, rays.through(ray.x + step, ray.y)) - volumes_;
  volumes_y_ = geometry.edge_volumes(hit.triangle, rays.through(ray.x, ray.y + step)) - volumes_;
  sum_ = sum_of(volumes_);
  sum_x_ = sum_of(volumes_x_);
  sum_y_ = sum_of(volumes_y_);
  // Of a triangle narrower than the step, what may be shown is held to twice its own size (Tile's triangles carried on are, too).
  const glm::dvec3 moved = glm::abs(volumes_x_) + glm::abs(volumes_y_);
  const double most = std::max({moved.x, moved.y, moved.z, std::abs(sum_x_) + std::abs(sum_y_)});
  within_ = most < std::abs(sum_);
  if (rays.camera().perspective) {
    double nearest = hit.t;
    for (const std::uint32_t vertex : geometry.vertices(hit.triangle)) {
      nearest = std::min(nearest, rays.depth(geometry.positions()[vertex]));
    }
    nearness_ = hit.t / std::max(nearest, rays.camera().znear);
  }
}

// The exact value is N / D with N and D affine in the displacement: its deviation from the linear part is that part times D0 / D - 1.
// Roundings: by the specification's formula, a sum of three a f / w over a sum of three a / w, each term has 3.5 and each sum 2 of the
// largest term, and the quotient 2.5: 13.5, of f as it is magnified by 1 / w. An implementation may as well walk along the plane of f / w
// from the window's corner: four roundings of what the plane spans there.
Varying Interpolation::operator()(const std::array<double, 3>& f, double rounding) const {
  constexpr double epsilon = number::epsilon<number::Highp>;
  const glm::dvec3 at(f[0], f[1], f[2]);
  const double largest = std::max({std::abs(f[0]), std::abs(f[1]), std::abs(f[2])});
  Varying v;
  v.value = glm::dot(weights_, at);
  v.radius = (13.5 * epsilon * largest + rounding) * nearness_;
  if (!within_) {
    const double spread = std::max({f[0], f[1], f[2]}) - std::min({f[0], f[1], f[2]});
    v.radius += 3.0 * spread;  // weights from -1 to 2
    return v;
  }
  v.shift_x = (glm::dot(volumes_x_, at) - v.value * sum_x_) / sum_;
  v.shift_y = (glm::dot(volumes_y_, at) - v.value * sum_y_) / sum_;
  const double bend = (std::abs(sum_x_) + std::abs(sum_y_)) / std::abs(sum_);
  v.radius += (std::abs(v.shift_x) + std::abs(v.shift_y)) * bend / (1.0 - bend);
  v.radius += 4.0 * epsilon * (std::abs(v.shift_x) * steps_x_ + std::abs(v.shift_y) * steps_y_);
  return v;
}

}  // namespace sheen::golden
