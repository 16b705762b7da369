#pragma once

#include <optional>

#include <glm/mat4x4.hpp>

#include "scene/scene.h"

namespace sheen::scene {

/// The picture to take of a scene.
struct View {
  int width = 512;
  int height = 512;
  std::optional<int> camera;  ///< index into Scene::cameras; none: the first camera, else one that frames the scene
};

/// The camera a view asks for. Throws Error when the index is out of range.
Camera resolve_camera(const Scene& scene, const View& view);

/// A perspective camera (yfov 45 degrees) on the +Z side that sees the whole scene, up +Y.
Camera framing_camera(const Scene& scene, double aspect);

/// Clip from view space (OpenGL conventions, z in [-1,1]); the image's aspect wins, yfov or ymag is kept. Infinite zfar gives an infinite
/// projection (glTF 2.0, section 3.10.3.1).
glm::dmat4 clip_from_camera(const Camera& camera, double aspect);

/// View space from world space: the inverse of world_from_camera.
glm::dmat4 camera_from_world(const Camera& camera);

/// One triangle of a BLEND primitive.
struct BlendTriangle {
  std::uint32_t instance = 0;
  std::uint32_t triangle = 0;  ///< index into the primitive's triangles
};

/// Every triangle with a BLEND material, farthest first by its centroid's distance along the viewing axis; ties keep the file's order.
/// Golden and renderer both draw in this order.
std::vector<BlendTriangle> blend_order(const Scene& scene, const Camera& camera);

}  // namespace sheen::scene
