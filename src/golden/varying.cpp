#include "golden/varying.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

#include "golden/bound.h"
#include "golden/window_triangle.h"

namespace sheen::golden {
namespace {

double sum_of(const glm::dvec3& v) {
  return v.x + v.y + v.z;
}

}  // namespace

Interpolation::Interpolation(const Geometry& geometry, const RayGenerator& rays, const Hit& hit, const Ray& ray, double step)
    : weights_(hit.weights), steps_x_(rays.width() / step), steps_y_(rays.height() / step) {
  const glm::dvec3 volumes = geometry.edge_volumes(hit.triangle, ray);
  volumes_x_ = geometry.edge_volumes(hit.triangle, rays.through(ray.x + step, ray.y)) - volumes;
  volumes_y_ = geometry.edge_volumes(hit.triangle, rays.through(ray.x, ray.y + step)) - volumes;
  const double sum = sum_of(volumes);
  sum_x_ = sum_of(volumes_x_);
  sum_y_ = sum_of(volumes_y_);
  const glm::dvec3 moved = glm::abs(volumes_x_) + glm::abs(volumes_y_);
  const double most = std::max({moved.x, moved.y, moved.z, std::abs(sum_x_) + std::abs(sum_y_)});
  within_ = most < std::abs(sum);
  per_sum_ = 1.0 / sum;
  const double bend = (std::abs(sum_x_) + std::abs(sum_y_)) / std::abs(sum);
  bent_ = bend / (1.0 - bend);
  if (!within_) {
    const std::vector<WindowPoint> polygon = window_polygon(geometry, rays, hit.triangle);
    for (const WindowPoint& corner : around(polygon, {ray.x, ray.y}, step, rays.camera().perspective)) {
      shown_.push_back(corner.weights);
    }
  }
  if (rays.camera().perspective) {
    add_corners(geometry, rays, hit);
  }
}

void Interpolation::add_corners(const Geometry& geometry, const RayGenerator& rays, const Hit& hit) {
  const double near = rays.camera().znear;
  std::array<double, 3> depth{};
  for (std::size_t i = 0; i < 3; ++i) {
    depth.at(i) = rays.depth(geometry.positions()[geometry.vertices(hit.triangle).at(i)]);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t next = (i + 1) % 3;
    if (depth.at(i) >= near) {
      corners_.at(corner_count_)[static_cast<int>(i)] = hit.t / depth.at(i);
      ++corner_count_;
    }
    if ((depth.at(i) < near) != (depth.at(next) < near)) {
      const double share = (near - depth.at(i)) / (depth.at(next) - depth.at(i));
      corners_.at(corner_count_)[static_cast<int>(i)] = (1.0 - share) * hit.t / near;
      corners_.at(corner_count_)[static_cast<int>(next)] = share * hit.t / near;
      ++corner_count_;
    }
  }
}

// The exact value is N / D with N and D affine in the displacement: its deviation from the linear part is that part times D0 / D - 1.
// Roundings: by the specification's formula, a sum of three a f / w over a sum of three a / w, each term has 3.5 and each sum 2 of the
// largest term, and the quotient 2.5: 13.5, of f / w where that is largest; a corner that clipping makes adds 3 of f. An implementation may
// as well walk along the plane of f / w from the window's corner: four roundings of what the plane spans there.
Varying Interpolation::operator()(const std::array<double, 3>& f, double rounding) const {
  const glm::dvec3 at(f[0], f[1], f[2]);
  const double largest = std::max({std::abs(f[0]), std::abs(f[1]), std::abs(f[2])});
  Varying v;
  v.value = glm::dot(weights_, at);
  double magnified = corner_count_ == 0 ? largest : std::abs(v.value);
  for (std::size_t i = 0; i < corner_count_; ++i) {
    magnified = std::max(magnified, std::abs(glm::dot(corners_.at(i), at)));
  }
  const glm::dvec3 shares = glm::abs(weights_);
  v.radius = 13.5 * epsilon * magnified + 3.0 * epsilon * largest + rounding * (shares.x + shares.y + shares.z);
  if (!within_) {
    double farthest = 0.0;
    for (const glm::dvec3& weights : shown_) {
      farthest = std::max(farthest, std::abs(glm::dot(weights, at) - v.value));
    }
    if (shown_.empty()) {  // no rasteriser shows it here, within the reach of its own roundings: all of it
      farthest = std::max({std::abs(f[0] - v.value), std::abs(f[1] - v.value), std::abs(f[2] - v.value)});
    }
    v.radius += farthest;
    return v;
  }
  v.shift_x = (glm::dot(volumes_x_, at) - v.value * sum_x_) * per_sum_;
  v.shift_y = (glm::dot(volumes_y_, at) - v.value * sum_y_) * per_sum_;
  v.radius += (std::abs(v.shift_x) + std::abs(v.shift_y)) * bent_;
  v.radius += 4.0 * epsilon * (std::abs(v.shift_x) * steps_x_ + std::abs(v.shift_y) * steps_y_);
  return v;
}

}  // namespace sheen::golden
