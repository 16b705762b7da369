#include "golden/tracer.h"

#include <cmath>
#include <random>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "golden/frame.h"
#include "golden/test_scenes.h"

namespace sheen::golden {
namespace {

// The nearest visible triangle by trying all of them in double.
std::optional<Hit> search_all(const Frame& frame, const Ray& ray) {
  std::optional<Hit> nearest;
  for (std::uint32_t i = 0; i < frame.geometry.triangle_count(); ++i) {
    const std::optional<Hit> hit = frame.geometry.meet(i, ray);
    if (!hit || hit->smallest_weight() < 0.0 || hit->t < frame.rays.camera().znear) {
      continue;
    }
    if (!hit->front && !frame.geometry.placed(i).material->double_sided) {
      continue;
    }
    if (!nearest || hit->t < nearest->t) {
      nearest = hit;
    }
  }
  return nearest;
}

// How many of `count` random rays see another triangle than the search does.
int disagreements(const scene::Scene& s, int count) {
  const Settings settings = test::settings_for(64, 64);
  const Frame frame(s, settings);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> pixel(0.0, 64.0);
  Seen seen;
  int wrong = 0;
  int met = 0;
  for (int i = 0; i < count; ++i) {
    const Ray ray = frame.rays.through(pixel(random), pixel(random));
    frame.tracer.trace(ray, false, seen);
    const std::optional<Hit> want = search_all(frame, ray);
    met += want ? 1 : 0;
    const bool same =
        want.has_value() == seen.nearest.has_value() && (!want || (want->triangle == seen.nearest->triangle && want->t == seen.nearest->t));
    wrong += same ? 0 : 1;
  }
  EXPECT_GT(met, count / 4) << "rays must hit for the count to mean anything";
  return wrong;
}

// A disc of slivers about its centre: single precision alone often names the neighbour.
scene::Primitive fan(int slivers) {
  scene::Primitive p;
  p.positions.emplace_back(0.0f, 0.0f, 0.1f);
  for (int i = 0; i < slivers; ++i) {
    const double a = 2.0 * 3.14159265358979323846 * i / slivers;
    p.positions.emplace_back(std::cos(a), std::sin(a), 0.0);
  }
  p.normals.assign(p.positions.size(), glm::vec3(0.0f, 0.0f, 1.0f));
  const auto n = static_cast<std::uint32_t>(slivers);
  for (std::uint32_t i = 0; i < n; ++i) {
    for (const std::uint32_t v : {0u, 1 + i, 1 + (i + 1) % n}) {
      p.indices.push_back(v);
    }
  }
  return p;
}

TEST(Tracer, FindsTheTriangleThatTheExactRayPassesThrough) {
  EXPECT_EQ(disagreements(test::scene_with(test::sphere(60, 30), {}, test::camera_at(4.0), {}), 2000), 0);
  EXPECT_EQ(disagreements(test::scene_with(fan(20000), {}, test::camera_at(4.0), {}), 300), 0);
}

TEST(Tracer, FindsItFarFromTheOriginToo) {
  scene::Scene s = test::scene_with(fan(3000), {}, test::camera_at(4.0), {});
  const glm::dmat4 far = glm::translate(glm::dmat4(1.0), glm::dvec3(70000.3, -40000.7, 90000.1));
  s.instances[0].world_from_local = far * glm::rotate(glm::dmat4(1.0), 0.2, glm::dvec3(1.0, 0.0, 0.0));
  s.cameras[0].world_from_camera = far * s.cameras[0].world_from_camera;
  EXPECT_EQ(disagreements(s, 600), 0);
  s.cameras[0].perspective = false;
  s.cameras[0].ymag = 1.0;
  s.cameras[0].zfar = 100.0;
  EXPECT_EQ(disagreements(s, 600), 0);
}

// A long lens, 20,000 units away along no axis: rounded to single precision, vertices move by more than a sliver's width.
TEST(Tracer, FindsItBeyondSinglePrecision) {
  const double distance = 20000.0;
  scene::Scene s = test::scene_with(fan(3000), {}, test::camera_at(distance, 2.0 * std::atan(0.6 / distance)), {});
  const glm::dmat4 turned = glm::rotate(glm::dmat4(1.0), 0.7, glm::normalize(glm::dvec3(1.0, 1.0, 0.3)));
  s.instances[0].world_from_local = turned;
  s.cameras[0].world_from_camera = turned * s.cameras[0].world_from_camera;
  EXPECT_EQ(disagreements(s, 600), 0);
}

TEST(Tracer, NeighbouringBlendTrianglesCountOnce) {
  scene::Material m = test::lambertian({1.0, 1.0, 1.0, 0.5});
  m.alpha_mode = scene::AlphaMode::Blend;
  const scene::Scene s = test::scene_with(fan(20000), m, test::camera_at(4.0), {});
  const Settings settings = test::settings_for(64, 64);
  const Frame frame(s, settings);
  Seen seen;
  for (int i = 0; i < 200; ++i) {
    frame.tracer.trace(frame.rays.through(25.0 + 0.071 * i, 30.0 + 0.013 * i), false, seen);
    EXPECT_EQ(seen.blended.size(), 1u) << i;
  }
}

TEST(Tracer, FindsATriangleThatIsAloneWithoutCastingARay) {
  scene::Scene s = test::scene_with(test::sphere(40, 20), {}, test::camera_at(4.0), {});
  const Settings settings = test::settings_for(64, 64);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> pixel(0.0, 64.0);
  const auto found = [&] {
    const Frame frame(s, settings);
    Seen seen;
    int count = 0;
    for (int i = 0; i < 500; ++i) {
      const Ray ray = frame.rays.through(pixel(random), pixel(random));
      frame.tracer.trace(ray, false, seen);
      const std::optional<Hit> alone = seen.nearest ? frame.tracer.trace_alone(seen.nearest->triangle, ray) : std::nullopt;
      count += alone ? 1 : 0;
      if (alone) {
        EXPECT_EQ(alone->weights, seen.nearest->weights);
        EXPECT_EQ(alone->t, seen.nearest->t);
        EXPECT_EQ(alone->front, seen.nearest->front);
      }
    }
    return count;
  };
  EXPECT_GT(found(), 200);
  s.materials[0].alpha_mode = scene::AlphaMode::Mask;
  EXPECT_EQ(found(), 0) << "its alpha may discard it";
}

TEST(Tracer, CastsARayAtATrianglesEdgeAtAClipPlaneAndFromBehind) {
  scene::Scene s = test::scene_with(test::square(1.0), {}, test::orthographic_at(5.0, 1.0), {});
  const auto is_found = [&](double x, double y) {
    const Settings settings = test::settings_for(64, 64);
    const Frame frame(s, settings);
    // The upper right triangle.
    return frame.tracer.trace_alone(1, frame.rays.through(x, y)).has_value();
  };
  EXPECT_TRUE(is_found(50.0, 20.0));
  EXPECT_FALSE(is_found(20.0, 50.0)) << "the other triangle's side";
  EXPECT_FALSE(is_found(40.0 - 1e-6, 40.0)) << "on the diagonal";
  s.cameras[0].znear = 5.0 - 1e-9;
  EXPECT_FALSE(is_found(50.0, 20.0)) << "at the near plane";
  s.cameras[0].znear = 5.5;
  EXPECT_FALSE(is_found(50.0, 20.0)) << "before it";
  s.cameras[0].znear = 0.1;
  s.instances[0].world_from_local = glm::rotate(glm::dmat4(1.0), 3.14159265358979323846, glm::dvec3(1.0, 1.0, 0.0));
  EXPECT_FALSE(is_found(50.0, 20.0)) << "from behind";
}

}  // namespace
}  // namespace sheen::golden
