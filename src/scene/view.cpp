#include "scene/view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include <glm/geometric.hpp>

namespace sheen::scene {
namespace {

struct Sphere {
  glm::dvec3 center{0.0};
  double radius = 1.0;
};

template <class Visit>
void for_each_world_position(const Scene& scene, const Visit& visit) {
  for (const Instance& instance : scene.instances) {
    for (const glm::vec3& position : scene.primitives[static_cast<std::size_t>(instance.primitive)].positions) {
      visit(glm::dvec3(instance.world_from_local * glm::dvec4(glm::dvec3(position), 1.0)));
    }
  }
}

// The sphere around the centre of the world's bounding box that holds every vertex; a unit sphere for an empty scene or a single point.
Sphere bounding_sphere(const Scene& scene) {
  glm::dvec3 low(std::numeric_limits<double>::infinity());
  glm::dvec3 high(-std::numeric_limits<double>::infinity());
  for_each_world_position(scene, [&](const glm::dvec3& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  });
  Sphere sphere;
  if (!(low.x <= high.x)) {
    return sphere;
  }
  sphere.center = 0.5 * (low + high);
  double radius = 0.0;
  for_each_world_position(scene, [&](const glm::dvec3& p) { radius = std::max(radius, glm::distance(p, sphere.center)); });
  if (radius > 0.0) {
    sphere.radius = radius;
  }
  return sphere;
}

}  // namespace

Camera resolve_camera(const Scene& scene, const View& view) {
  if (view.camera) {
    if (*view.camera < 0 || static_cast<std::size_t>(*view.camera) >= scene.cameras.size()) {
      throw Error(scene.file, "cameras[" + std::to_string(*view.camera) + "]",
                  "there is no such camera: the scene has " + std::to_string(scene.cameras.size()));
    }
    return scene.cameras[static_cast<std::size_t>(*view.camera)];
  }
  if (!scene.cameras.empty()) {
    return scene.cameras.front();
  }
  return framing_camera(scene, static_cast<double>(view.width) / static_cast<double>(view.height));
}

Camera framing_camera(const Scene& scene, double aspect) {
  // Room between the sphere and the picture's edge.
  constexpr double margin = 1.05;
  const Sphere sphere = bounding_sphere(scene);
  Camera camera;
  camera.name = "framing";
  camera.yfov = std::numbers::pi / 4;
  // A sphere touches the side planes of a pyramid of half angle h, seen from its tip, at distance r / sin(h).
  const double half_height = std::tan(camera.yfov / 2);
  const double narrower = std::atan(half_height * std::min(aspect, 1.0));
  const double distance = margin * sphere.radius / std::sin(narrower);
  camera.world_from_camera[3] = glm::dvec4(sphere.center + glm::dvec3(0.0, 0.0, distance), 1.0);
  camera.znear = (distance - sphere.radius) / 2;
  camera.zfar = distance + 2 * sphere.radius;
  return camera;
}

glm::dmat4 clip_from_camera(const Camera& camera, double aspect) {
  const double n = camera.znear;
  const double f = camera.zfar;
  glm::dmat4 clip(0.0);
  if (!camera.perspective) {
    clip[0][0] = 1.0 / (camera.ymag * aspect);
    clip[1][1] = 1.0 / camera.ymag;
    clip[2][2] = 2.0 / (n - f);
    clip[3][2] = (f + n) / (n - f);
    clip[3][3] = 1.0;
    return clip;
  }
  const double cotangent = 1.0 / std::tan(camera.yfov / 2);
  clip[0][0] = cotangent / aspect;
  clip[1][1] = cotangent;
  clip[2][3] = -1.0;
  if (std::isinf(f)) {
    clip[2][2] = -1.0;
    clip[3][2] = -2.0 * n;
  } else {
    clip[2][2] = (f + n) / (n - f);
    clip[3][2] = 2.0 * f * n / (n - f);
  }
  return clip;
}

glm::dmat4 camera_from_world(const Camera& camera) {
  // The inverse of a rigid motion: the transposed rotation, and the origin seen from the camera.
  const glm::dmat4& m = camera.world_from_camera;
  glm::dmat4 inverse(1.0);
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      inverse[column][row] = m[row][column];
    }
    inverse[3][column] = -glm::dot(glm::dvec3(m[column]), glm::dvec3(m[3]));
  }
  return inverse;
}

std::vector<BlendTriangle> blend_order(const Scene& scene, const Camera& camera) {
  struct Entry {
    double depth;
    BlendTriangle triangle;
  };
  const glm::dmat4 view = camera_from_world(camera);
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const Instance& instance = scene.instances[i];
    const Primitive& primitive = scene.primitives[static_cast<std::size_t>(instance.primitive)];
    if (scene.materials[static_cast<std::size_t>(primitive.material)].alpha_mode != AlphaMode::Blend) {
      continue;
    }
    const glm::dmat4 view_from_local = view * instance.world_from_local;
    for (std::size_t t = 0; t < primitive.indices.size() / 3; ++t) {
      glm::dvec3 centroid(0.0);
      for (std::size_t corner = 0; corner < 3; ++corner) {
        centroid += glm::dvec3(primitive.positions[primitive.indices[3 * t + corner]]);
      }
      const double depth = -(view_from_local * glm::dvec4(centroid / 3.0, 1.0)).z;
      entries.push_back({depth, {static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(t)}});
    }
  }
  std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.depth > b.depth; });
  std::vector<BlendTriangle> order;
  order.reserve(entries.size());
  for (const Entry& entry : entries) {
    order.push_back(entry.triangle);
  }
  return order;
}

}  // namespace sheen::scene
