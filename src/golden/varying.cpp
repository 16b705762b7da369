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

Interpolation::Interpolation(const Geometry& geometry, const RayGenerator& rays, const TriangleEdges& edges, const Hit& hit, const Ray& ray,
                             double step)
    : edges_(edges),
      weights_(hit.weights),
      functions_(edges.at(geometry, ray)),
      volumes_x_(functions_.along_x * step),
      volumes_y_(functions_.along_y * step),
      sum_x_(sum_of(volumes_x_)),
      sum_y_(sum_of(volumes_y_)),
      shares_(sum_of(glm::abs(hit.weights))),
      steps_x_(rays.width() / step),
      steps_y_(rays.height() / step) {
  const double sum = sum_of(functions_.here);
  const glm::dvec3 moved = glm::abs(volumes_x_) + glm::abs(volumes_y_);
  const double moved_sum = std::abs(sum_x_) + std::abs(sum_y_);
  within_ = std::max({moved.x, moved.y, moved.z, moved_sum}) < std::abs(sum);
  per_sum_ = 1.0 / sum;
  bent_ = moved_sum / (std::abs(sum) - moved_sum);
  if (!within_) {
    const std::vector<WindowPoint> polygon = window_polygon(geometry, rays, hit.triangle);
    for (const WindowPoint& corner : around(polygon, {ray.x, ray.y}, step, rays.camera().perspective)) {
      shown_.push_back(corner.weights);
    }
  }
  if (rays.camera().perspective) {
    depth_ = hit.t;
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
  const double magnified = depth_ == 0.0 ? largest : std::max(std::abs(v.value), std::abs(depth_) * edges_.largest_share(at));
  v.radius = 13.5 * epsilon * magnified + 3.0 * epsilon * largest + rounding * shares_;
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
