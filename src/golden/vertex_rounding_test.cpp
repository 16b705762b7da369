#include "golden/vertex_rounding.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>
#include <gtest/gtest.h>

#include "golden/test_scenes.h"
#include "scene/view.h"

namespace sheen::golden {
namespace {

constexpr int window_size = 160;

/// A triangle whose corner lies 100 m from its mesh's origin and 0.3 m before the camera.
scene::Scene far_corner() {
  scene::Primitive p;
  p.positions = {{100.0F, 0.013F, 99.7F}, {100.11F, 0.02F, 99.71F}, {100.04F, 0.13F, 99.69F}, {-100.0F, 0.0F, -100.0F}};
  p.normals.assign(4, {0.0F, 0.0F, 1.0F});
  p.indices = {0, 1, 2};
  scene::Scene s = test::scene_with(p, {}, test::camera_at(0.0), {});
  s.cameras[0].world_from_camera = glm::rotate(glm::translate(glm::dmat4(1.0), glm::dvec3(100.05, 0.05, 100.0)), 0.1, glm::dvec3(0, 1, 0));
  s.cameras[0].znear = 0.01;
  return s;
}

/// Where a vertex comes to lie in the window, in pixels, by matrices and sums of 32-bit floats.
glm::dvec2 by_floats(const scene::Scene& s, const glm::mat4& clip_from_local, std::size_t vertex) {
  const glm::vec4 p(s.primitives[0].positions[vertex], 1.0F);
  glm::vec4 clip;
  for (int row = 0; row < 4; ++row) {
    float sum = clip_from_local[0][row] * p.x;
    sum += clip_from_local[1][row] * p.y;
    sum += clip_from_local[2][row] * p.z;
    clip[row] = sum + clip_from_local[3][row];
  }
  const float x = clip.x / clip.w;
  const float y = clip.y / clip.w;
  return {0.5F * window_size * x + 0.5F * window_size, 0.5F * window_size * y + 0.5F * window_size};
}

TEST(VertexRounding, HoldsWhereFloatsPutASample) {
  const scene::Scene s = far_corner();
  const Geometry geometry(s);
  const RayGenerator rays(s.cameras[0], window_size, window_size);
  const glm::dmat4 exact_matrix = scene::clip_from_camera(s.cameras[0], 1.0) * scene::camera_from_world(s.cameras[0]);
  const glm::mat4 matrix(exact_matrix);
  double farthest = 0.0;
  for (double x = 20.5; x < window_size; x += 3.0) {
    for (double y = 20.5; y < window_size; y += 3.0) {
      const std::optional<Hit> hit = geometry.meet(0, rays.through(x, y));
      if (!hit || hit->smallest_weight() < 0.0) {
        continue;
      }
      glm::dvec2 moved(0.0);
      for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec4 clip = exact_matrix * glm::dvec4(glm::dvec3(s.primitives[0].positions[i]), 1.0);
        const glm::dvec2 exact = 0.5 * window_size * glm::dvec2(clip) / clip.w + 0.5 * window_size;
        // Its share of the window's point, where weights count by 1 / w.
        moved += hit->weights[static_cast<int>(i)] * clip.w / hit->t * (by_floats(s, matrix, i) - exact);
      }
      const double most = VertexRounding(geometry, rays, hit->triangle).in_window(rays, *hit);
      EXPECT_LE(std::max(std::abs(moved.x), std::abs(moved.y)), most) << x << ' ' << y;
      farthest = std::max(farthest, std::max(std::abs(moved.x), std::abs(moved.y)) / most);
    }
  }
  EXPECT_GT(farthest, 0.03) << "rounding to nearest, by chance, uses that much of it";
}

TEST(VertexRounding, IsSmallWhereNothingCancels) {
  const scene::Scene s = test::scene_with(test::square(1.0), {}, test::camera_at(4.0), {});
  const Geometry geometry(s);
  const RayGenerator rays(s.cameras[0], window_size, window_size);
  const Hit hit = geometry.meet(0, rays.through(70.5, 60.5)).value();
  EXPECT_LT(VertexRounding(geometry, rays, hit.triangle).in_window(rays, hit), 16.0 * window_size * 0x1p-23);
}

TEST(VertexRounding, KnowsThatAFarMeshIsDrawnAboutItsMiddle) {
  scene::Primitive far = test::square(1.0);
  for (glm::vec3& p : far.positions) {
    p += glm::vec3(4096.0F, 0.0F, 0.0F);
  }
  scene::Scene s = test::scene_with(far, {}, test::camera_at(4.0), {});
  s.cameras[0].world_from_camera = glm::translate(glm::dmat4(1.0), glm::dvec3(4096.0, 0.0, 4.0));
  const Geometry geometry(s);
  const RayGenerator rays(s.cameras[0], window_size, window_size);
  for (const glm::dvec3& m : position_magnitudes(geometry, rays, 0)) {
    EXPECT_LT(m.x, 2.0);
    EXPECT_NEAR(m.z, 4.0, 1e-9);
  }
}

}  // namespace
}  // namespace sheen::golden
