#include "golden/rays.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace sheen::golden {

RayGenerator::RayGenerator(const scene::Camera& camera, int width, int height)
    : camera_(camera),
      width_(width),
      height_(height),
      view_from_world_(glm::transpose(glm::dmat3(camera.world_from_camera))),
      origin_(camera.world_from_camera[3]) {
  const double half_height = camera.perspective ? std::tan(0.5 * camera.yfov) : camera.ymag;
  const double aspect = static_cast<double>(width) / height;
  right_ = glm::dvec3(camera.world_from_camera[0]) * (half_height * aspect);
  up_ = glm::dvec3(camera.world_from_camera[1]) * half_height;
  forward_ = -glm::dvec3(camera.world_from_camera[2]);
}

Ray RayGenerator::through(double x, double y) const {
  const glm::dvec3 across = right_ * (2.0 * x / width_ - 1.0) + up_ * (1.0 - 2.0 * y / height_);
  if (camera_.perspective) {
    return {origin_, forward_ + across, x, y};
  }
  return {origin_ + across, forward_, x, y};
}

glm::dvec2 RayGenerator::window(const glm::dvec3& point) const {
  const glm::dvec3 from_eye = point - origin_;
  const double per_depth = camera_.perspective ? 1.0 / glm::dot(from_eye, forward_) : 1.0;
  const double across = glm::dot(from_eye, right_) / glm::dot(right_, right_) * per_depth;
  const double up = glm::dot(from_eye, up_) / glm::dot(up_, up_) * per_depth;
  return {0.5 * (1.0 + across) * width_, 0.5 * (1.0 - up) * height_};
}

glm::dvec3 RayGenerator::toward_camera(const Ray& ray) const {
  return -glm::normalize(ray.direction);
}

}  // namespace sheen::golden
