#pragma once

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "scene/scene.h"

namespace sheen::golden {

/// A ray of the camera. The direction's length is such that the ray's parameter t is the depth along the viewing axis.
struct Ray {
  glm::dvec3 origin;
  glm::dvec3 direction;
  double x = 0, y = 0;  ///< where it crosses the picture, in pixels from the top left corner
};

/// The rays a camera sends through a picture; the inverse of scene::clip_from_camera.
class RayGenerator {
 public:
  RayGenerator(const scene::Camera& camera, int width, int height);

  /// @param x, y  pixels from the top left corner; pixel centres lie at halves
  Ray through(double x, double y) const;

  /// Unit vector from a point the ray meets toward the camera.
  glm::dvec3 toward_camera(const Ray& ray) const;

  /// Where a point in front of the camera shows, in pixels from the top left corner; the inverse of through().
  glm::dvec2 window(const glm::dvec3& point) const;

  /// Depth of a point along the viewing axis.
  double depth(const glm::dvec3& point) const { return glm::dot(point - origin_, forward_); }

  /// Of directions; in view space the camera looks along -Z, +Y up.
  const glm::dmat3& view_from_world() const { return view_from_world_; }
  /// A point in view space, of which the camera is the origin.
  glm::dvec3 in_view(const glm::dvec3& point) const { return view_from_world_ * (point - origin_); }

  const scene::Camera& camera() const { return camera_; }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  scene::Camera camera_;
  int width_, height_;
  glm::dmat3 view_from_world_;
  glm::dvec3 origin_, right_, up_, forward_;  // world space; right and up reach the picture's edge
};

}  // namespace sheen::golden
