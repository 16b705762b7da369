#include "golden/normal_levels.h"

#include <algorithm>
#include <random>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "golden/test_scenes.h"

namespace sheen::golden {
namespace {

using scene::Filter;
using scene::MipFilter;

/// A normal map whose codes lie up to `bump` from (128, 128, 255).
Texture normal_map(int bump, const scene::Sampler& sampler, int width = 32, int height = 16) {
  scene::Scene s;
  std::mt19937 random(4);
  std::uniform_int_distribution<int> code(-bump, bump);
  const auto texel = [&](int, int) { return glm::ivec4(128 + code(random), 128 + code(random), 255 - std::abs(code(random)), 255); };
  test::add_texture(s, test::picture(width, height, texel), sampler);
  return TextureStore(s).get(0, scene::ColorSpace::Linear);
}

std::vector<scene::Sampler> samplers() {
  std::vector<scene::Sampler> all;
  for (const Filter mag : {Filter::Nearest, Filter::Linear}) {
    for (const Filter min : {Filter::Nearest, Filter::Linear}) {
      for (const MipFilter mip : {MipFilter::None, MipFilter::Nearest, MipFilter::Linear}) {
        all.push_back({scene::Wrap::Repeat, scene::Wrap::MirroredRepeat, mag, min, mip});
      }
    }
  }
  return all;
}

const std::vector<LodInterval> ranges{{-1.0, -0.5}, {-0.3, 0.2}, {0.5, 1.5}, {1.5, 2.5}, {-1.0, 6.0}, {0.2, 0.7},
                                      {0.6, 0.9},   {1.2, 3.4},  {2.0, 2.0}, {0.0, 0.5}, {4.5, 6.0},  {5.5, 6.0}};

TEST(StraightPieces, HoldEveryLevelOfTheirRange) {
  for (const scene::Sampler& sampler : samplers()) {
    const Texture texture = normal_map(60, sampler);
    const glm::dvec2 uv(0.37, 0.61);
    for (const LodInterval& range : ranges) {
      const std::vector<LodInterval> pieces = straight_pieces(texture, range);
      for (int i = 0; i <= 1000; ++i) {
        const double lambda = range.low + i / 1000.0 * (range.high - range.low);
        const glm::dvec4 read = sample(texture, uv, lambda);
        const bool held = std::any_of(pieces.begin(), pieces.end(), [&](const LodInterval& piece) {
          const double length = piece.high - piece.low;
          const double along = length > 0.0 ? std::clamp((lambda - piece.low) / length, 0.0, 1.0) : 0.0;
          const glm::dvec4 there = glm::mix(sample(texture, uv, piece.low), sample(texture, uv, piece.high), along);
          return glm::length(read - there) < 1e-12;
        });
        EXPECT_TRUE(held) << lambda << " of " << range.low << " to " << range.high;
      }
    }
  }
}

TEST(StraightPieces, AreOneAReading) {
  const Texture nearest = normal_map(60, {scene::Wrap::Repeat, scene::Wrap::Repeat, Filter::Linear, Filter::Linear, MipFilter::Nearest});
  EXPECT_EQ(straight_pieces(nearest, {-1.0, 0.0}).size(), 1U) << "magnified";
  EXPECT_EQ(straight_pieces(nearest, {0.7, 1.4}).size(), 1U) << "level 1";
  EXPECT_EQ(straight_pieces(nearest, {0.7, 2.6}).size(), 3U) << "levels 1 to 3, and nothing between";
  const Texture mixed = normal_map(60, {scene::Wrap::Repeat, scene::Wrap::Repeat, Filter::Linear, Filter::Linear, MipFilter::Linear});
  EXPECT_EQ(straight_pieces(mixed, {0.7, 2.6}).size(), 3U) << "cut at 1 and 2";
  EXPECT_EQ(straight_pieces(mixed, {1.7, 1.7}).size(), 1U);
}

bool holds(const Spread& box, const glm::dvec4& code) {
  return glm::all(glm::lessThanEqual(glm::abs(code - box.value), box.radius));
}

void expect_held(const Texture& texture, double scale, double reach, bool one_box) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const LodInterval& range : ranges) {
    for (int i = 0; i < 4; ++i) {
      const glm::dvec2 uv(3.0 * unit(random) - 1.0, 3.0 * unit(random) - 1.0);
      TextureBox box(texture, uv, glm::dvec2(reach));
      const double ideal = range.low + unit(random) * (range.high - range.low);
      const NormalLevels all = normal_levels(box, ideal, straight_pieces(texture, range), scale);
      if (!all.is_open) {
        ASSERT_EQ(all.boxes.size(), 1U);
        EXPECT_EQ(all.boxes.front().value, sample(texture, uv, ideal));
      }
      EXPECT_TRUE(!all.is_open || !one_box) << "small enough for one";
      for (int k = 0; k < 200; ++k) {
        const glm::dvec2 moved = uv + reach * (2.0 * glm::dvec2(unit(random), unit(random)) - 1.0);
        const glm::dvec4 code = sample(texture, moved, range.low + unit(random) * (range.high - range.low));
        const auto in = [&code](const Spread& s) { return holds(s, code); };
        EXPECT_TRUE(std::any_of(all.boxes.begin(), all.boxes.end(), in));
      }
    }
  }
}

TEST(NormalLevels, HoldWhatAnyLevelGivesInFewSmallBoxes) {
  for (scene::Sampler sampler : samplers()) {
    expect_held(normal_map(1, sampler), 1.0, 1e-4, true);
    expect_held(normal_map(60, sampler), 1.0, 1e-4, false);
    expect_held(normal_map(60, sampler), 1.0, 0.4, false);
    sampler.wrap_s = scene::Wrap::ClampToEdge;
    for (const double scale : {-2.0, 0.0, 0.3}) {
      expect_held(normal_map(60, sampler, 7, 5), scale, 1e-4, false);
      expect_held(normal_map(60, sampler, 1, 1), scale, 1e-4, true);
      expect_held(normal_map(60, sampler, 1, 6), scale, 1e-4, false);
    }
  }
}

TEST(NormalLevels, AreNotPutIntoOneBoxWhereTheyLieFarApart) {
  const Texture texture = normal_map(100, {scene::Wrap::Repeat, scene::Wrap::Repeat, Filter::Nearest, Filter::Nearest, MipFilter::Nearest});
  TextureBox box(texture, {0.37, 0.61}, glm::dvec2(1e-6));
  const NormalLevels all = normal_levels(box, 1.0, straight_pieces(texture, {0.7, 2.6}), 1.0);
  EXPECT_TRUE(all.is_open);
  EXPECT_EQ(all.boxes.size(), 3U);
  for (const Spread& level : all.boxes) {
    EXPECT_LT(glm::length(level.radius), 1e-4);
  }
  const Texture gentle = normal_map(1, texture.sampler);
  TextureBox again(gentle, {0.37, 0.61}, glm::dvec2(1e-6));
  EXPECT_FALSE(normal_levels(again, 1.0, straight_pieces(gentle, {0.7, 2.6}), 1.0).is_open);
  EXPECT_TRUE(normal_levels(again, 1.0, straight_pieces(gentle, {0.7, 2.6}), 30.0).is_open) << "scaled up";
}

}  // namespace
}  // namespace sheen::golden
