// Which pixels a golden leaves out of verdicts, and why.

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "golden/frame.h"
#include "golden/test_scenes.h"

namespace sheen::golden {
namespace {

/// How many pixels of the golden's inside are left out for a reason, of 16 x 16 of which the scene covers all.
int excluded(const scene::Scene& s, float reason) {
  constexpr int size = 16;
  const image::Image golden = render(s, test::settings_for(size, size, true));
  const int channel = golden.channel("excluded");
  int count = 0;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      count += golden.at(x, y, channel) == reason ? 1 : 0;
    }
  }
  return count;
}

scene::Scene plane(const scene::Material& m, double z = 0.0) {
  return test::scene_with(test::square(2.0, z), m, test::orthographic_at(5.0, 1.0), {test::directional({0.0, 0.0, 1.0})});
}

scene::Material mask(double opacity, double cutoff) {
  scene::Material m = test::lambertian({0.5, 0.5, 0.5, opacity});
  m.alpha_mode = scene::AlphaMode::Mask;
  m.alpha_cutoff = cutoff;
  return m;
}

TEST(Exclusion, AMaskOfOneOpacityIsCertainEvenAtTheCutoff) {
  EXPECT_EQ(excluded(plane(mask(0.5, 0.5)), 2.0F), 0);
  EXPECT_EQ(excluded(plane(mask(0.3, 0.3)), 2.0F), 0) << "both reach the shader as the same float";
  EXPECT_EQ(excluded(plane(mask(0.7, 0.3)), 2.0F), 0);
}

TEST(Exclusion, AMaskIsUncertainWhereItsTextureCrossesTheCutoff) {
  // Opacity rises from 0 to 1 across four pixels a texel; the step is 1/512 of a pixel.
  scene::Scene s = plane(mask(1.0, 0.5));
  s.materials[0].base_color_texture = test::add_texture(
      s, test::picture(8, 8, [](int x, int) { return glm::ivec4(255, 255, 255, x < 4 ? 0 : 255); }),
      {scene::Wrap::ClampToEdge, scene::Wrap::ClampToEdge, scene::Filter::Linear, scene::Filter::Linear, scene::MipFilter::None});
  EXPECT_EQ(excluded(s, 1.0F) + excluded(s, 2.0F), 0) << "no pixel centre lies on the cut";
  s.cameras[0].world_from_camera = glm::translate(glm::dmat4(1.0), glm::dvec3(0.5 * 2.0 / 16, 0.0, 5.0));
  EXPECT_EQ(excluded(s, 1.0F) + excluded(s, 2.0F), 16) << "one column's centres do";
}

TEST(Exclusion, AMaskIsUncertainWhereALevelOfDetailDecides) {
  // Minified twice; level 0 has stripes of 0 and 1, coarser ones a half.
  scene::Scene s = plane(mask(1.0, 0.4));
  s.materials[0].base_color_texture =
      test::add_texture(s, test::picture(64, 64, [](int x, int) { return glm::ivec4(255, 255, 255, x % 2 * 255); }));
  s.materials[0].base_color_texture.transform = glm::dmat3(0.75, 0.0, 0.0, 0.0, 0.4, 0.0, 0.0, 0.0, 1.0);
  EXPECT_GT(excluded(s, 2.0F), 20);
}

TEST(Exclusion, ABlendedSurfaceAtTheDepthOfAnOpaqueOne) {
  scene::Material glass = test::lambertian({0.9, 0.1, 0.1, 0.5});
  glass.alpha_mode = scene::AlphaMode::Blend;
  scene::Scene s = plane(test::lambertian({0.2, 0.2, 0.2, 1.0}));
  test::add(s, test::square(2.0), glass);
  // No centre lies on a square's diagonal.
  s.cameras[0].world_from_camera = glm::translate(glm::dmat4(1.0), glm::dvec3(0.03, 0.01, 5.0));
  EXPECT_EQ(excluded(s, 1.0F), 256);
  s.instances[1].world_from_local = glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, 0.1));
  EXPECT_EQ(excluded(s, 1.0F), 0);
}

TEST(Exclusion, ASurfaceOnAClipPlane) {
  scene::Scene s = plane(test::lambertian({0.2, 0.2, 0.2, 1.0}));
  s.cameras[0].zfar = 5.0;
  EXPECT_EQ(excluded(s, 1.0F), 256) << "on the far plane";
  s.cameras[0].zfar = 6.0;
  EXPECT_EQ(excluded(s, 1.0F), 0);
  s.cameras[0].znear = 5.0;
  EXPECT_EQ(excluded(s, 1.0F), 256) << "on the near plane";
  s.cameras[0].znear = 1.0;
  s.cameras[0].zfar = 7.0;
  test::add(s, test::square(2.0, -2.0), test::lambertian({0.9, 0.9, 0.9, 1.0}));
  EXPECT_EQ(excluded(s, 1.0F), 0) << "what lies on the far plane is hidden";
}

/// A strip at 45 degrees from pixel (8, 7)'s lower left to its upper right: pixels from its centre line on, and to where, along `across`.
void add_strip(scene::Primitive& p, double half_length, double from, double to, const glm::vec4& color) {
  constexpr double pixel = 2.0 / 16;
  const auto first = static_cast<std::uint32_t>(p.positions.size());
  for (const glm::dvec2& at :
       {glm::dvec2(-half_length, from), glm::dvec2(half_length, from), glm::dvec2(half_length, to), glm::dvec2(-half_length, to)}) {
    p.positions.emplace_back(pixel * (0.5 + (at.x - at.y) * std::sqrt(0.5)), pixel * (0.5 + (at.x + at.y) * std::sqrt(0.5)), 0.0);
    p.normals.emplace_back(0.0F, 0.0F, 1.0F);
    p.colors.push_back(color);
  }
  for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) {
    p.indices.push_back(first + corner);
  }
}

// Between a pixel's centre and the corners of its step, 1/512: no ray through these meets it.
constexpr double sliver_from = 0.4 / 512;
constexpr double sliver_to = 0.7 / 512;
const glm::vec4 black(0.0F, 0.0F, 0.0F, 1.0F);
const glm::vec4 vertex_white(1.0F);

TEST(Exclusion, ASliverBetweenTheLooksIsASurfaceOfItsOwn) {
  scene::Scene s = plane(test::lambertian({0.5, 0.5, 0.5, 1.0}));
  EXPECT_EQ(excluded(s, 1.0F), 0);
  scene::Primitive sliver;
  add_strip(sliver, 0.3, sliver_from, sliver_to, black);
  test::add(s, sliver, test::lambertian({1.0, 1.0, 1.0, 1.0}), glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, 0.1)));
  EXPECT_EQ(excluded(s, 1.0F), 1);
  s.instances[1].world_from_local = glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, 0.0, -0.1));
  EXPECT_EQ(excluded(s, 1.0F), 0) << "it is hidden";
}

scene::Scene strips(const scene::Primitive& p) {
  return test::scene_with(p, test::lambertian({0.5, 0.5, 0.5, 1.0}), test::orthographic_at(5.0, 1.0), {test::directional({0.0, 0.0, 1.0})});
}

TEST(Exclusion, AGapBetweenTheLooksMayShowWhatIsBehind) {
  scene::Primitive p;
  add_strip(p, 40.0, -40.0, sliver_from, vertex_white);
  add_strip(p, 40.0, sliver_to, 40.0, vertex_white);
  EXPECT_EQ(excluded(strips(p), 1.0F), 16) << "the pixels of a diagonal";
  p = {};
  add_strip(p, 40.0, -40.0, sliver_from, vertex_white);
  add_strip(p, 40.0, sliver_from, 40.0, vertex_white);
  EXPECT_EQ(excluded(strips(p), 1.0F), 0) << "both have both corners of the edge between them";
  p = {};
  add_strip(p, 40.0, -40.0, sliver_from, vertex_white);
  add_strip(p, 39.0, sliver_from, 40.0, vertex_white);
  EXPECT_EQ(excluded(strips(p), 1.0F), 16) << "a T-junction: corners that are moved by themselves";
}

TEST(Exclusion, ASliverOnTheEdgeOfWhatItLiesOnIsFoundWhicheverComesFirst) {
  // It covers nothing that is not covered, and its every point is on an edge, by the digits of weights.
  scene::Primitive sheet;
  add_strip(sheet, 40.0, -40.0, sliver_from, vertex_white);
  add_strip(sheet, 40.0, sliver_from, 40.0, vertex_white);
  scene::Primitive sliver;
  add_strip(sliver, 0.3, sliver_from - 1e-6, sliver_from, black);
  const scene::Material material = test::lambertian({0.5, 0.5, 0.5, 1.0});
  for (const bool first : {true, false}) {
    scene::Scene s = strips(first ? sliver : sheet);
    test::add(s, first ? sheet : sliver, material);
    EXPECT_EQ(excluded(s, 1.0F), 1) << first;
  }
}

TEST(Exclusion, ALightOppositeToTheViewWhoseHalfVectorMayHaveAnyDirection) {
  // Lit and seen along the surface, from either side: N.L and N.V are 0 but for roundings, and so is L + V.
  scene::Primitive p = test::square(2.0);
  std::fill(p.normals.begin(), p.normals.end(), glm::vec3(1.0F, 0.0F, 0.0F));
  scene::Material coated = test::lambertian({0.5, 0.5, 0.5, 1.0});
  coated.roughness_factor = 0.5;
  coated.clearcoat.factor = 1.0;
  coated.clearcoat.roughness_factor = 0.3;
  coated.double_sided = true;
  scene::Scene s = test::scene_with(p, coated, test::orthographic_at(5.0, 1.0), {test::directional({3e-8, 0.0, -1.0})});
  s.cameras[0].perspective = true;
  s.cameras[0].yfov = 1e-6;
  EXPECT_EQ(excluded(s, 4.0F), 0) << "GGX is never above 1 / (pi alpha^2)";
}

// A fan about a point beside a pixel's centre, all of whose triangles come within the step of it: none is more likely than another.
TEST(Exclusion, MoreTrianglesThanAnyoneWouldAskFor) {
  const auto of = [](std::uint32_t count) {
    scene::Scene s = plane(test::lambertian({0.5, 0.5, 0.5, 1.0}));
    scene::Primitive& fan = s.primitives[0];
    fan = {};
    fan.positions.emplace_back(1.0 / 16 + 1e-4, 1.0 / 16 + 1e-4, 0.0);
    for (std::uint32_t i = 0; i < count; ++i) {
      const double angle = 2.0 * brdf::pi * i / count;
      fan.positions.emplace_back(3.0 * std::cos(angle), 3.0 * std::sin(angle), 0.0);
      fan.indices.insert(fan.indices.end(), {0, i + 1, (i + 1) % count + 1});
    }
    fan.normals.assign(fan.positions.size(), {0.0, 0.0, 1.0});
    return excluded(s, 1.0F);
  };
  EXPECT_EQ(of(60), 0);
  EXPECT_EQ(of(200), 1);
}

TEST(Exclusion, ATriangleOfTwoCornersIsNothing) {
  scene::Primitive p;
  add_strip(p, 40.0, -40.0, 40.0, vertex_white);
  const auto vertex = static_cast<std::uint32_t>(p.positions.size());
  add_strip(p, 0.3, sliver_from, sliver_to, black);
  p.indices.resize(6);
  p.indices.insert(p.indices.end(), {vertex, vertex + 1, vertex});
  EXPECT_EQ(excluded(strips(p), 1.0F), 0);
}

TEST(Exclusion, ABlendedSampleOnASharedEdgeIsBlendedOnce) {
  // The square's diagonal runs through the centres of 16 pixels.
  scene::Material glass = test::lambertian({0.5, 0.5, 0.5, 0.5});
  glass.alpha_mode = scene::AlphaMode::Blend;
  const scene::Scene s = plane(glass);
  EXPECT_EQ(excluded(s, 1.0F), 0);
  const image::Image golden = render(s, test::settings_for(16, 16, true));
  for (int i = 0; i < 16; ++i) {
    EXPECT_FLOAT_EQ(golden.at(i, i, golden.channel("A")), 0.5F) << i;
    EXPECT_FLOAT_EQ(golden.at(i, 15 - i, golden.channel("A")), 0.5F) << i;
  }
}

TEST(Exclusion, ASliverThatContinuesASurfaceIsPartOfTheBound) {
  scene::Primitive p;
  add_strip(p, 40.0, -40.0, sliver_from, vertex_white);
  add_strip(p, 40.0, sliver_from, sliver_to, black);
  add_strip(p, 40.0, sliver_to, 40.0, vertex_white);
  const scene::Scene s = strips(p);
  const image::Image golden = render(s, test::settings_for(16, 16, true));
  EXPECT_EQ(golden.at(8, 7, golden.channel("excluded")), 0.0F);
  EXPECT_GT(golden.at(8, 7, 0), 0.1F);
  EXPECT_GE(golden.at(8, 7, golden.channel("bound.R")), golden.at(8, 7, 0)) << "a driver may show black there";
  EXPECT_LT(golden.at(8, 9, golden.channel("bound.R")), 1e-3F * golden.at(8, 9, 0));
}

}  // namespace
}  // namespace sheen::golden
