#include "golden/window_triangle.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "golden/frame.h"
#include "golden/near_misses.h"
#include "golden/test_scenes.h"

namespace sheen::golden {
namespace {

constexpr int grid_size = 16;

/// A triangle as a driver has it: its corners in the window, each moved, and what it finds at a place there.
struct Moved {
  std::array<glm::dvec2, 3> corners;
  std::array<double, 3> depths;

  double twice_area() const { return cross(corners[1] - corners[0], corners[2] - corners[0]); }
  bool covers(const glm::dvec2& place) const {
    const glm::dvec3 s = spanned(place);
    return (s.x > 0.0 && s.y > 0.0 && s.z > 0.0) || (s.x < 0.0 && s.y < 0.0 && s.z < 0.0);
  }
  /// Barycentrics in world space: those of the window over depth, scaled to a sum of 1 (OpenGL ES 3.0.6, section 3.6.1).
  glm::dvec3 weights(const glm::dvec2& place, bool perspective) const {
    glm::dvec3 w = spanned(place);
    for (int i = 0; i < 3 && perspective; ++i) {
      w[i] /= depths.at(static_cast<std::size_t>(i));
    }
    return w / (w.x + w.y + w.z);
  }

 private:
  static double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }
  glm::dvec3 spanned(const glm::dvec2& place) const {
    const auto edge = [&](std::size_t i, std::size_t j) { return cross(corners.at(i) - place, corners.at(j) - place); };
    return {edge(1, 2), edge(2, 0), edge(0, 1)};
  }
};

class MovedTriangles : public testing::TestWithParam<bool> {
 protected:
  bool perspective() const { return GetParam(); }
  double within(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }

  /// Corners near the picture's middle; two of three of them within a thousandth of a pixel of one line.
  scene::Scene triangle(bool narrow) {
    scene::Primitive p;
    const glm::vec3 a(within(-1.0, 1.0), within(-1.0, 1.0), within(-0.5, 0.5));
    const glm::vec3 b(within(-1.0, 1.0), within(-1.0, 1.0), within(-0.5, 0.5));
    const glm::vec3 c(within(-1.0, 1.0), within(-1.0, 1.0), within(-0.5, 0.5));
    p.positions = {a, b, narrow ? glm::mix(a, b, static_cast<float>(within(0.0, 1.0))) + 1e-4F * c : c};
    p.normals.assign(3, {0.0F, 0.0F, 1.0F});
    p.indices = {0, 1, 2};
    scene::Material material;
    material.double_sided = true;
    return test::scene_with(p, material, perspective() ? test::camera_at(4.0) : test::orthographic_at(4.0, 1.0), {});
  }
  Moved moved(const Frame& frame, double reach) {
    Moved out{};
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec3& position = frame.geometry.positions()[i];
      out.corners.at(i) = frame.rays.window(position) + glm::dvec2(within(-reach, reach), within(-reach, reach));
      out.depths.at(i) = frame.rays.depth(position);
    }
    return out;
  }

  std::mt19937_64 random_{11};
};

TEST_P(MovedTriangles, ShadeACoveredPlaceWithWeightsOfThePartAroundIt) {
  const Settings settings = test::settings_for(grid_size, grid_size, true);
  int covered = 0;
  int turned = 0;
  for (int i = 0; i < 400; ++i) {
    const scene::Scene s = triangle(i % 2 == 0);
    const Frame frame(s, settings);
    const std::vector<WindowPoint> polygon = window_polygon(frame.geometry, frame.rays, 0);
    const double reach = i % 4 < 2 ? 1.0 / 32 : 0.3;
    for (int k = 0; k < 50; ++k) {
      const Moved driver = moved(frame, reach);
      // Somewhere on the triangle, so that those that are narrow are met.
      const double u = within(0.0, 1.0);
      const double v = within(0.0, 1.0 - u);
      const glm::dvec2 place = (1.0 - u - v) * driver.corners[0] + u * driver.corners[1] + v * driver.corners[2];
      if (!driver.covers(place)) {
        continue;
      }
      ++covered;
      const std::vector<WindowPoint> part = around(polygon, place, reach, perspective());
      ASSERT_FALSE(part.empty());
      const glm::dvec3 weights = driver.weights(place, perspective());
      const glm::dvec3 f(within(-1.0, 1.0), within(-1.0, 1.0), within(-1.0, 1.0));
      const auto [low, high] = std::minmax_element(part.begin(), part.end(), [&](const WindowPoint& a, const WindowPoint& b) {
        return glm::dot(a.weights, f) < glm::dot(b.weights, f);
      });
      EXPECT_GE(glm::dot(weights, f), glm::dot(low->weights, f) - 1e-9);
      EXPECT_LE(glm::dot(weights, f), glm::dot(high->weights, f) + 1e-9);
      double twice_area = 0.0;
      for (std::size_t c = 0; c < 3; ++c) {
        const glm::dvec2& a = polygon[c].window;
        const glm::dvec2& b = polygon[(c + 1) % 3].window;
        twice_area += a.x * b.y - a.y * b.x;
      }
      if (twice_area * driver.twice_area() < 0.0) {
        ++turned;
        EXPECT_TRUE(may_cover_turned_over(polygon, place, reach));
      }
    }
  }
  EXPECT_GT(covered, 10000);
  EXPECT_GT(turned, 500);
}

TEST_P(MovedTriangles, AreAmongThePixelsNearMissesWhereTheyComeToCoverIt) {
  const Settings settings = test::settings_for(grid_size, grid_size, true);
  const double reach = displacement(settings);
  int come = 0;
  for (int i = 0; i < 400; ++i) {
    const scene::Scene s = triangle(i % 2 == 0);
    const Frame frame(s, settings);
    const NearMisses misses(frame);
    for (int k = 0; k < 24; ++k) {
      const Moved exact = moved(frame, 0.0);
      const Moved driver = moved(frame, reach);
      for (int y = 0; y < grid_size; ++y) {
        for (int x = 0; x < grid_size; ++x) {
          const glm::dvec2 place(x + 0.5, y + 0.5);
          if (driver.covers(place) && !exact.covers(place)) {
            ++come;
            EXPECT_NE(misses.at(x, y).begin(), misses.at(x, y).end()) << x << " " << y;
          }
        }
      }
    }
  }
  EXPECT_GT(come, 20);
}

INSTANTIATE_TEST_SUITE_P(Camera, MovedTriangles, testing::Bool(),
                         [](const auto& tested) { return std::string(tested.param ? "perspective" : "orthographic"); });

TEST(WindowTriangle, IsCutAtTheClipPlanes) {
  scene::Primitive p;
  p.positions = {{-1.0F, 0.0F, 2.0F}, {1.0F, 0.0F, 2.0F}, {0.0F, 0.5F, 6.0F}};  // the last behind the camera
  p.normals.assign(3, {0.0F, 1.0F, 0.0F});
  p.indices = {0, 1, 2};
  scene::Scene s = test::scene_with(p, {}, test::camera_at(4.0), {});
  s.cameras[0].znear = 0.5;
  const Geometry geometry(s);
  const RayGenerator rays(s.cameras[0], grid_size, grid_size);
  const std::vector<WindowPoint> polygon = window_polygon(geometry, rays, 0);
  ASSERT_EQ(polygon.size(), 4U);
  double nearest = 4.0;
  for (const WindowPoint& corner : polygon) {
    EXPECT_NEAR(corner.weights.x + corner.weights.y + corner.weights.z, 1.0, 1e-12);
    nearest = std::min(nearest, corner.depth);
  }
  EXPECT_DOUBLE_EQ(nearest, 0.5);
  s.cameras[0].zfar = 1.0;
  EXPECT_EQ(window_polygon(geometry, RayGenerator(s.cameras[0], grid_size, grid_size), 0).size(), 4U) << "its far corners are cut instead";
  s.cameras[0].znear = 3.0;
  s.cameras[0].zfar = 5.0;
  EXPECT_TRUE(window_polygon(geometry, RayGenerator(s.cameras[0], grid_size, grid_size), 0).empty());
}

TEST(WindowTriangle, OfItsSizeDoesNotTurnOver) {
  const scene::Scene s = test::scene_with(test::square(0.9), {}, test::orthographic_at(4.0, 1.0), {});
  const Geometry geometry(s);
  const RayGenerator rays(s.cameras[0], grid_size, grid_size);
  const std::vector<WindowPoint> polygon = window_polygon(geometry, rays, 0);
  EXPECT_FALSE(may_cover_turned_over(polygon, {8.5, 8.5}, 1.0 / 32));
  EXPECT_FALSE(may_cover_turned_over(polygon, polygon[0].window, 1.0 / 32)) << "not even at a corner";
}

}  // namespace
}  // namespace sheen::golden
