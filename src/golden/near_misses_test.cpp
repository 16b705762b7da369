#include "golden/near_misses.h"

#include <random>

#include <gtest/gtest.h>

#include "golden/test_scenes.h"

namespace sheen::golden {
namespace {

/// Triangles in all directions, which cross one another.
scene::Primitive soup(int triangles, double extent, std::mt19937& random) {
  std::uniform_real_distribution<float> within(-1.0F, 1.0F);
  scene::Primitive p;
  const auto anywhere = [&] { return glm::vec3(within(random), within(random), within(random)); };
  for (int i = 0; i < triangles; ++i) {
    const glm::vec3 middle = anywhere();
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      p.positions.push_back(middle + static_cast<float>(extent) * anywhere());
      p.indices.push_back(static_cast<std::uint32_t>(3 * i) + corner);
    }
  }
  p.normals.assign(p.positions.size(), {0.0F, 0.0F, 1.0F});
  return p;
}

/// What trace_alone() gives where it may be asked is all that there is to see: by trying all triangles.
TEST(NearMisses, KnowWhereOneTriangleAloneIsNear) {
  constexpr int across = 32;  // pixels
  std::mt19937 random(3);
  std::uniform_real_distribution<double> within(-1.0, 1.0);
  Settings settings = test::settings_for(across, across, true);
  settings.subpixel_bits = 2;
  const double reach = NearMisses::near_steps * displacement(settings);
  int alone = 0;
  int others = 0;
  for (int k = 0; k < 12; ++k) {
    scene::Scene s = test::scene_with(soup(5, 0.8, random), {}, k % 2 == 0 ? test::camera_at(4.0) : test::orthographic_at(4.0, 1.2), {});
    scene::Material both;
    both.double_sided = true;
    test::add(s, soup(4, 0.8, random), both);
    const Frame frame(s, settings);
    const NearMisses misses(frame);
    for (int i = 0; i < across * across * 8; ++i) {
      const int x = i / 8 % across;
      const int y = i / 8 / across;
      if (!misses.has_one_triangle(x, y)) {
        ++others;
        continue;
      }
      const Ray ray = frame.rays.through(x + 0.5 + reach * within(random), y + 0.5 + reach * within(random));
      int met = 0;
      for (std::uint32_t t = 0; t < frame.geometry.triangle_count(); ++t) {
        const std::optional<Hit> hit = frame.geometry.meet(t, ray);
        met += hit && hit->smallest_weight() >= 0.0 && (hit->front || frame.geometry.placed(t).material->double_sided) ? 1 : 0;
      }
      EXPECT_LE(met, 1) << x << " " << y;
      alone += met;
    }
  }
  EXPECT_GT(alone, 2000);
  EXPECT_GT(others, 2000);
}

// A strip at the near plane, on the side that a depth buffer may or may not see, hides a wall; its edge lies beside pixels' centres.
TEST(NearMisses, KnowOfATriangleAtAClipPlane) {
  constexpr int across = 32;
  const auto alone_beside_a_strip_at = [](double depth) {
    scene::Scene s = test::scene_with(test::square(9.0, -4.0), {}, test::camera_at(0.0, 1.5), {});
    s.cameras[0].znear = 1.0;
    scene::Primitive strip = test::square(1.0, -depth);
    for (glm::vec3& p : strip.positions) {
      p.x = 0.5F * p.x + 0.6F;
    }
    test::add(s, strip, {});
    const Settings settings = test::settings_for(across, across, true);
    const Frame frame(s, settings);
    const NearMisses misses(frame);
    int alone = 0;
    for (int x = 0; x < across; ++x) {
      alone += misses.has_one_triangle(x, across / 2 + 3) ? 1 : 0;
    }
    return alone;
  };
  EXPECT_EQ(alone_beside_a_strip_at(0.9), across - 1) << "before the plane for certain, on the wall's diagonal once";
  const int beside = alone_beside_a_strip_at(1.0 - 0x1p-23);
  EXPECT_LT(beside, across - 8);
  EXPECT_GT(beside, 0);
  EXPECT_LT(alone_beside_a_strip_at(1.0 + 0x1p-23), across - 8);
}

}  // namespace
}  // namespace sheen::golden
