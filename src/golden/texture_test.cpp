#include "golden/texture.h"

#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "golden/test_scenes.h"

namespace sheen::golden {
namespace {

using scene::Filter;
using scene::MipFilter;
using scene::Wrap;

// Levels of one colour each: level i is i everywhere but for level 0, which has `row` as its only row.
Texture strip(const std::vector<float>& row, scene::Sampler sampler) {
  std::vector<scene::Texels> levels;
  scene::Texels first;
  first.width = static_cast<int>(row.size());
  first.height = 1;
  for (const float v : row) {
    first.rgba.emplace_back(v);
  }
  levels.push_back(first);
  for (int i = 1; (first.width >> i) > 0; ++i) {
    scene::Texels level;
    level.width = first.width >> i;
    level.height = 1;
    level.rgba.assign(static_cast<std::size_t>(level.width), glm::vec4(static_cast<float>(i)));
    levels.push_back(level);
  }
  return {std::make_shared<const TextureLevels>(std::move(levels)), sampler};
}

double at(const Texture& t, double u, double lambda = -10.0) {
  return sample(t, {u, 0.3}, lambda).x;
}

TEST(Texture, BilinearWeightsTheFourTexelsAround) {
  const scene::Texels texels{2, 2, {glm::vec4(1), glm::vec4(2), glm::vec4(4), glm::vec4(8)}};
  scene::Sampler s;
  s.mip = MipFilter::None;
  s.wrap_s = s.wrap_t = Wrap::ClampToEdge;
  const Texture t{std::make_shared<const TextureLevels>(std::vector<scene::Texels>{texels}), s};
  EXPECT_DOUBLE_EQ(sample(t, {0.25, 0.25}, -1.0).x, 1.0);
  EXPECT_DOUBLE_EQ(sample(t, {0.75, 0.25}, -1.0).x, 2.0);
  EXPECT_DOUBLE_EQ(sample(t, {0.5, 0.5}, -1.0).x, 3.75);
  EXPECT_DOUBLE_EQ(sample(t, {0.375, 0.25}, -1.0).x, 1.25);
  EXPECT_DOUBLE_EQ(sample(t, {0.25, 0.375}, -1.0).x, 1.75);
  EXPECT_DOUBLE_EQ(sample(t, {0.0, 0.0}, -1.0).x, 1.0);
}

TEST(Texture, WrapModesRepeatMirrorAndClamp) {
  scene::Sampler s;
  s.mag = s.min = Filter::Nearest;
  s.mip = MipFilter::None;
  const std::vector<float> row{10, 11, 12, 13};
  s.wrap_s = Wrap::Repeat;
  EXPECT_EQ(at(strip(row, s), 1.1), 10.0);
  EXPECT_EQ(at(strip(row, s), -0.1), 13.0);
  s.wrap_s = Wrap::MirroredRepeat;
  EXPECT_EQ(at(strip(row, s), 1.1), 13.0);
  EXPECT_EQ(at(strip(row, s), -0.1), 10.0);
  EXPECT_EQ(at(strip(row, s), 2.3), 11.0);
  s.wrap_s = Wrap::ClampToEdge;
  EXPECT_EQ(at(strip(row, s), 7.0), 13.0);
  EXPECT_EQ(at(strip(row, s), -7.0), 10.0);
  s.mag = s.min = Filter::Linear;
  s.wrap_s = Wrap::Repeat;
  EXPECT_DOUBLE_EQ(at(strip(row, s), 0.0), 11.5);
}

TEST(Texture, MipmapsAreChosenAndMixedByTheLevel) {
  scene::Sampler s;
  const std::vector<float> row(16, 0.0f);
  EXPECT_DOUBLE_EQ(at(strip(row, s), 0.4, 0.75), 0.75);
  EXPECT_DOUBLE_EQ(at(strip(row, s), 0.4, 2.25), 2.25);
  EXPECT_DOUBLE_EQ(at(strip(row, s), 0.4, 99.0), 4.0);
  EXPECT_DOUBLE_EQ(at(strip(row, s), 0.4, -3.0), 0.0);
  s.mip = MipFilter::Nearest;
  EXPECT_DOUBLE_EQ(at(strip(row, s), 0.4, 1.4), 1.0);
  EXPECT_DOUBLE_EQ(at(strip(row, s), 0.4, 1.6), 2.0);
  EXPECT_DOUBLE_EQ(at(strip(row, s), 0.4, 99.0), 4.0);
  s.mip = MipFilter::None;
  EXPECT_DOUBLE_EQ(at(strip(row, s), 0.4, 3.0), 0.0);
}

// OpenGL ES 3.0.6, section 3.8.10.3: the constant c.
TEST(Texture, MagnificationReachesHalfALevelFurtherOverUnfilteredMipmaps) {
  scene::Sampler s;
  s.min = Filter::Nearest;
  s.mip = MipFilter::Linear;
  const Texture t = strip({0, 1, 0, 1}, s);
  EXPECT_DOUBLE_EQ(at(t, 0.25, 0.4), 0.5) << "linear magnification between two texels";
  EXPECT_DOUBLE_EQ(at(t, 0.26, 0.6), 0.4 * 1.0 + 0.6 * 1.0) << "nearest in levels 0 and 1";
  s.mag = Filter::Nearest;
  EXPECT_DOUBLE_EQ(at(strip({0, 5, 0, 5}, s), 0.26, 0.4), 0.6 * 5.0 + 0.4 * 1.0);
}

TEST(Texture, LevelRangeIsWhatTheSpecificationAllows) {
  glm::dvec2 texels[9];
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      texels[3 * row + column] = glm::dvec2(3.0 * column + 1.0 * row, -2.0 * column + 4.0 * row);
    }
  }
  const TexelSpans spans = texel_spans(texels);
  EXPECT_DOUBLE_EQ(spans.ideal, std::sqrt(17.0));
  EXPECT_DOUBLE_EQ(spans.least, 4.0);
  EXPECT_DOUBLE_EQ(spans.most, 7.0);
  EXPECT_DOUBLE_EQ(ideal_lod(texels[4], texels[5], texels[7]), std::log2(std::sqrt(17.0)));
}

TEST(Texture, ColourIsDecodedFromSrgbAndDataIsNot) {
  scene::Scene s;
  s.file = "test";
  scene::Sampler sampler;
  sampler.mip = MipFilter::None;
  test::add_texture(s, test::picture(1, 1, [](int, int) { return glm::ivec4(128, 0, 255, 128); }), sampler);
  TextureStore store(s);
  const double linear = std::pow((128.0 / 255.0 + 0.055) / 1.055, 2.4);
  EXPECT_NEAR(sample(store.get(0, scene::ColorSpace::Srgb), {0.5, 0.5}, 0.0).x, linear, 1e-6);
  EXPECT_NEAR(sample(store.get(0, scene::ColorSpace::Srgb), {0.5, 0.5}, 0.0).w, 128.0 / 255.0, 1e-6);
  EXPECT_NEAR(sample(store.get(0, scene::ColorSpace::Linear), {0.5, 0.5}, 0.0).x, 128.0 / 255.0, 1e-6);
  EXPECT_THROW(store.get(1, scene::ColorSpace::Linear), scene::Error);
}

TEST(Texture, WithoutMipmapsHasLevel0AloneWhoeverElseReadsThePicture) {
  scene::Scene s;
  s.file = "test";
  scene::Sampler sampler;
  for (const MipFilter mip : {MipFilter::Linear, MipFilter::None, MipFilter::Nearest}) {
    sampler.mip = mip;
    test::add_texture(s, test::picture(8, 4, [](int x, int y) { return glm::ivec4(20 * x, 40 * y, 0, 255); }), sampler);
  }
  for (scene::Texture& texture : s.textures) {
    texture.picture = 0;
  }
  TextureStore store(s);
  EXPECT_EQ(store.get(0, scene::ColorSpace::Linear).levels->size(), 4U);
  EXPECT_EQ(store.get(1, scene::ColorSpace::Linear).levels->size(), 1U);
  EXPECT_EQ(store.get(2, scene::ColorSpace::Linear).levels, store.get(0, scene::ColorSpace::Linear).levels) << "decoded once";
}

TEST(Texture, CoordinatesWithoutMeaningReadSomething) {
  scene::Sampler s;
  const Texture t = strip({1, 1, 1, 1}, s);
  for (const double u : {std::nan(""), 1e300, -1e300, static_cast<double>(INFINITY)}) {
    EXPECT_EQ(at(t, u), 1.0) << u;
  }
}

}  // namespace
}  // namespace sheen::golden
