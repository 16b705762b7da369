#include "golden/triangle_edges.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <string>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "golden/test_scenes.h"

namespace sheen::golden {
namespace {

/// Random triangles before, behind and beside a camera at z = 2, whose near plane lies at z = 1.5.
class TriangleEdgesTest : public testing::TestWithParam<bool> {
 protected:
  scene::Scene triangle() {
    scene::Primitive p;
    std::uniform_real_distribution<float> within(-2.5F, 2.5F);
    for (std::uint32_t i = 0; i < 3; ++i) {
      p.positions.emplace_back(within(random), within(random), within(random));
      p.indices.push_back(i);
    }
    p.normals.assign(3, {0.0F, 0.0F, 1.0F});
    scene::Scene s = test::scene_with(p, {}, GetParam() ? test::camera_at(2.0, 1.4) : test::orthographic_at(2.0, 2.0), {});
    s.cameras[0].znear = 0.5;
    return s;
  }

  std::mt19937 random{8};
};

TEST_P(TriangleEdgesTest, TellWhatRaysBesideOneMeet) {
  int met = 0;
  int missed = 0;
  for (int i = 0; i < 2000; ++i) {
    const scene::Scene s = triangle();
    const Geometry geometry(s);
    const RayGenerator rays(s.cameras[0], 20, 16);
    std::uniform_real_distribution<double> place(0.0, 16.0);
    const Ray ray = rays.through(place(random), place(random));
    const EdgeFunctions functions = TriangleEdges(geometry, rays, 0).at(geometry, ray);
    for (const glm::dvec2& by : {glm::dvec2(1.0, 0.0), glm::dvec2(0.0, -1.0), glm::dvec2(-0.5, 3.0)}) {
      const EdgeFunctions::Beside beside = functions.beside(by.x, by.y);
      const std::optional<Hit> hit = geometry.meet(0, rays.through(ray.x + by.x, ray.y + by.y));
      const bool is_met = hit && (!GetParam() || hit->t > 0.0);
      EXPECT_EQ(beside.is_met, is_met);
      if (is_met) {
        ++met;
        EXPECT_LE(glm::length(beside.weights - hit->weights), 1e-9 * (1.0 + glm::dot(hit->weights, hit->weights)));
      } else {
        ++missed;
      }
    }
  }
  EXPECT_GT(met, 2000);
  EXPECT_EQ(missed > 500, GetParam()) << "in a parallel view every ray meets every plane";
}

using PerspectiveEdgesTest = TriangleEdgesTest;

TEST_P(PerspectiveEdgesTest, KnowTheLargestShareOfADepth) {
  std::uniform_real_distribution<double> within(-1.0, 1.0);
  int cut = 0;
  for (int i = 0; i < 400; ++i) {
    const scene::Scene s = triangle();
    const Geometry geometry(s);
    const RayGenerator rays(s.cameras[0], 20, 16);
    const TriangleEdges edges(geometry, rays, 0);
    const glm::dvec3 attribute(within(random), within(random), within(random));
    double largest = 0.0;
    bool is_cut = false;
    constexpr int steps = 150;
    for (int a = 0; a <= steps; ++a) {
      for (int b = 0; a + b <= steps; ++b) {
        const glm::dvec3 weights = glm::dvec3(a, b, steps - a - b) / static_cast<double>(steps);
        const auto& p = geometry.positions();
        const double depth = rays.depth(p[0] * weights.x + p[1] * weights.y + p[2] * weights.z);
        is_cut = is_cut || depth < 0.5;
        largest = depth >= 0.5 ? std::max(largest, std::abs(glm::dot(attribute, weights)) / depth) : largest;
      }
    }
    if (largest > 0.0) {
      EXPECT_GE(edges.largest_share(attribute), largest * (1.0 - 1e-12));
      EXPECT_LE(edges.largest_share(attribute), 1.2 * largest + 0.1);
      cut += is_cut ? 1 : 0;
    }
  }
  EXPECT_GT(cut, 100);
}

INSTANTIATE_TEST_SUITE_P(Camera, PerspectiveEdgesTest, testing::Values(true));
INSTANTIATE_TEST_SUITE_P(Camera, TriangleEdgesTest, testing::Bool(),
                         [](const auto& tested) { return std::string(tested.param ? "perspective" : "orthographic"); });

}  // namespace
}  // namespace sheen::golden
