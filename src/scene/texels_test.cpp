#include "scene/texels.h"

#include <cmath>
#include <cstdint>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

namespace sheen::scene {
namespace {

Texels row(std::initializer_list<float> reds) {
  Texels texels{static_cast<int>(reds.size()), 1, {}};
  for (const float r : reds) {
    texels.rgba.emplace_back(r, 0, 0, 1);
  }
  return texels;
}

glm::dvec4 mean(const Texels& texels) {
  glm::dvec4 sum(0.0);
  for (const glm::vec4& t : texels.rgba) {
    sum += glm::dvec4(t);
  }
  return sum / static_cast<double>(texels.rgba.size());
}

TEST(Texels, LinearCodesAreFractionsOfTheLargest) {
  const Texels eight = decode(Picture{"", 1, 1, 8, {0, 255, 51, 128}}, ColorSpace::Linear);
  EXPECT_EQ(eight.rgba[0], glm::vec4(0.0f, 1.0f, 0.2f, static_cast<float>(128.0 / 255.0)));
  const Texels sixteen = decode(Picture{"", 1, 1, 16, {0, 65535, 13107, 1}}, ColorSpace::Linear);
  EXPECT_EQ(sixteen.rgba[0], glm::vec4(0.0f, 1.0f, 0.2f, static_cast<float>(1.0 / 65535.0)));
}

// IEC 61966-2-1: a straight line up to 0.04045, then ((x + 0.055) / 1.055)^2.4; alpha is never touched.
TEST(Texels, SrgbDecodesColoursAndLeavesAlpha) {
  const Texels texels = decode(Picture{"", 1, 1, 8, {10, 11, 255, 128}}, ColorSpace::Srgb);
  EXPECT_FLOAT_EQ(texels.rgba[0].r, static_cast<float>(10.0 / 255.0 / 12.92));
  EXPECT_FLOAT_EQ(texels.rgba[0].g, static_cast<float>(std::pow((11.0 / 255.0 + 0.055) / 1.055, 2.4)));
  EXPECT_EQ(texels.rgba[0].b, 1.0f);
  EXPECT_EQ(texels.rgba[0].a, static_cast<float>(128.0 / 255.0));
}

TEST(Texels, MipmapsEndAtOneByOneAndRoundSizesDown) {
  const std::vector<Texels> levels = mipmaps(Texels{7, 3, std::vector<glm::vec4>(21, glm::vec4(0.5f))});
  ASSERT_EQ(levels.size(), 3U);
  EXPECT_EQ(levels[1].width, 3);
  EXPECT_EQ(levels[1].height, 1);
  EXPECT_EQ(levels[2].width, 1);
  for (const Texels& level : levels) {
    for (const glm::vec4& texel : level.rgba) {
      EXPECT_EQ(texel, glm::vec4(0.5f));
    }
  }
}

TEST(Texels, EvenSizesAverageBlocksOfFour) {
  Texels texels{2, 2, {glm::vec4(0), glm::vec4(1), glm::vec4(2), glm::vec4(5)}};
  EXPECT_EQ(mipmaps(texels).back().rgba[0], glm::vec4(2));
}

// Three texels into one: a third each. Five into two: 1, 1 and a half over 2.5 each.
TEST(Texels, OddSizesAreWeightedByArea) {
  EXPECT_FLOAT_EQ(mipmaps(row({3, 6, 9}))[1].rgba[0].r, 6.0f);
  const Texels two = mipmaps(row({1, 2, 4, 8, 16}))[1];
  EXPECT_FLOAT_EQ(two.rgba[0].r, static_cast<float>((1 + 2 + 2) / 2.5));
  EXPECT_FLOAT_EQ(two.rgba[1].r, static_cast<float>((2 + 8 + 16) / 2.5));
}

// Which never holds level 0 as a whole.
TEST(Texels, LevelsBelowAPictureAreThoseOfItsDecodedTexels) {
  for (const auto& [width, height, bits] : {std::tuple(8, 6, 8), std::tuple(7, 5, 8), std::tuple(1, 9, 16), std::tuple(1, 1, 8)}) {
    Picture picture{"", width, height, bits, {}};
    for (int i = 0; i < 4 * width * height; ++i) {
      picture.codes.push_back(static_cast<std::uint16_t>(i * 7919 % (1 << bits)));
    }
    for (const ColorSpace space : {ColorSpace::Linear, ColorSpace::Srgb}) {
      const std::vector<Texels> all = mipmaps(decode(picture, space));
      const std::vector<Texels> below = mipmaps_below(picture, space);
      ASSERT_EQ(below.size() + 1, all.size());
      for (std::size_t i = 0; i < below.size(); ++i) {
        EXPECT_EQ(below[i].width, all[i + 1].width);
        EXPECT_EQ(below[i].height, all[i + 1].height);
        EXPECT_EQ(below[i].rgba, all[i + 1].rgba) << width << " x " << height << ", level " << i + 1;
      }
    }
  }
}

TEST(Texels, EveryLevelKeepsTheMean) {
  Texels texels{13, 11, {}};
  for (int i = 0; i < 13 * 11; ++i) {
    texels.rgba.emplace_back(static_cast<float>((i * 37) % 101), static_cast<float>(i % 5), 1, 0);
  }
  const glm::dvec4 whole = mean(texels);
  for (const Texels& level : mipmaps(texels)) {
    EXPECT_NEAR(mean(level).r, whole.r, 1e-4);
    EXPECT_NEAR(mean(level).g, whole.g, 1e-5);
  }
}

}  // namespace
}  // namespace sheen::scene
