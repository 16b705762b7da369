#include "golden/varying.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "golden/test_scenes.h"

namespace sheen::golden {
namespace {

/// A triangle leaning away from a perspective camera, its attribute, and what displaced samples find of it.
class VaryingTest : public testing::Test {
 protected:
  static scene::Primitive leaning(float height) {
    scene::Primitive p;
    p.positions = {{-1.0F, -0.5F, 1.0F}, {1.2F, -0.4F, -2.0F}, {0.1F, -0.5F + height, 0.3F}};
    p.normals.assign(3, {0.0F, 0.0F, 1.0F});
    p.indices = {0, 1, 2};
    return p;
  }
  static double exact(const Geometry& geometry, const Ray& ray) {
    return glm::dot(geometry.meet(0, ray).value().weights, glm::dvec3(f[0], f[1], f[2]));
  }

  static constexpr std::array<double, 3> f{2.0, -1.0, 5.0};
};

TEST_F(VaryingTest, HoldsWhatDisplacedSamplesFind) {
  const scene::Scene s = test::scene_with(leaning(1.4F), {}, test::camera_at(4.0), {});
  const Geometry geometry(s);
  const RayGenerator rays(s.cameras[0], 64, 64);
  const Ray ray = rays.through(34.0, 32.0);
  const Hit hit = geometry.meet(0, ray).value();
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> within(-1.0, 1.0);
  for (const double step : {1.0 / 512, 1.0 / 32, 0.5}) {
    const Varying v = Interpolation(geometry, rays, TriangleEdges(geometry, rays, 0), hit, ray, step)(f, 0.0);
    double farthest = 0.0;
    for (int i = 0; i < 2000; ++i) {
      const double x = i < 4 ? (i % 2 == 0 ? 1.0 : -1.0) : within(random);
      const double y = i < 4 ? (i / 2 == 0 ? 1.0 : -1.0) : within(random);
      const double there = exact(geometry, rays.through(ray.x + step * x, ray.y + step * y));
      const double left = std::abs(there - (v.value + x * v.shift_x + y * v.shift_y));
      EXPECT_LE(left, v.radius) << step;
      farthest = std::max(farthest, left);
    }
    if (step == 0.5) {
      EXPECT_GT(farthest, 0.3 * v.radius) << "the bend of perspective is most of it";
    }
  }
}

TEST_F(VaryingTest, HoldsARasteriserThatWalksAlongThePlaneInFloats) {
  const scene::Scene s = test::scene_with(leaning(1.4F), {}, test::orthographic_at(4.0, 1.0), {});
  const Geometry geometry(s);
  const RayGenerator rays(s.cameras[0], 512, 512);
  double farthest = 0.0;
  for (double x = 200.5; x < 320.0; x += 1.0) {
    const Ray ray = rays.through(x, 256.5);
    const Hit hit = geometry.meet(0, ray).value();
    const Varying v = Interpolation(geometry, rays, TriangleEdges(geometry, rays, 0), hit, ray, 1.0 / 512)(f, 0.0);
    const auto per_x = static_cast<float>(v.shift_x * 512);
    const auto per_y = static_cast<float>(v.shift_y * 512);
    const auto corner = static_cast<float>(exact(geometry, rays.through(0.0, 0.0)));
    const float walked = (corner + per_x * static_cast<float>(x)) + per_y * 256.5F;
    EXPECT_LE(std::abs(static_cast<double>(walked) - v.value), v.radius) << x;
    farthest = std::max(farthest, std::abs(static_cast<double>(walked) - v.value) / v.radius);
  }
  EXPECT_GT(farthest, 0.02);
}

TEST_F(VaryingTest, OfATriangleNarrowerThanTheStepHoldsWhatLiesWithinTheStep) {
  scene::Primitive thin = leaning(1.0F);
  thin.positions = {{-1.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, {0.0F, 0.001F, 0.0F}};  // a step is ten times as high
  const scene::Scene s = test::scene_with(thin, {}, test::camera_at(4.0), {});
  const Geometry geometry(s);
  const RayGenerator rays(s.cameras[0], 16, 16);
  const Ray ray = rays.through(8.0, 8.0);
  Hit hit;
  hit.triangle = 0;
  hit.weights = {0.4, 0.4, 0.2};
  hit.t = 4.0;
  const Varying v = Interpolation(geometry, rays, TriangleEdges(geometry, rays, 0), hit, ray, 1.0 / 16)(f, 0.0);
  EXPECT_NEAR(v.value, 0.8 - 0.4 + 1.0, 1e-12);
  // Across it all: from the foot, where f is 0.5 and changes by 1.5 a unit, to the tip, where it is 5; along it no more than the step.
  const double along = 1.0 / 16 * (4.0 * std::tan(0.5 * s.cameras[0].yfov) / 8.0);
  EXPECT_NEAR(v.radius, 5.0 - v.value, 1e-5);
  EXPECT_GE(v.value - v.radius, -3.0) << "nothing of its far ends";
  EXPECT_LE(v.value - v.radius, 0.5 - 1.5 * along);
}

}  // namespace
}  // namespace sheen::golden
