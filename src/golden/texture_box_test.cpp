#include "golden/texture_box.h"

#include <cmath>
#include <random>
#include <vector>

#include <glm/common.hpp>
#include <gtest/gtest.h>

#include "golden/test_scenes.h"

namespace sheen::golden {
namespace {

scene::Scene noise(const scene::Sampler& sampler) {
  scene::Scene s;
  std::mt19937 random(4);
  test::add_texture(s, test::picture(16, 8, [&](int, int) { return glm::ivec4(random() % 256, random() % 256, random() % 256, 255); }),
                    sampler);
  return s;
}

TEST(TextureBox, HoldsEveryCoordinateInsideAndReachesWhatTheyReach) {
  using scene::Filter;
  using scene::MipFilter;
  using scene::Wrap;
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> within(-1.0, 1.0);
  for (const Filter filter : {Filter::Nearest, Filter::Linear}) {
    for (const MipFilter mip : {MipFilter::None, MipFilter::Nearest, MipFilter::Linear}) {
      const scene::Scene s = noise({Wrap::MirroredRepeat, Wrap::Repeat, filter, filter, mip});
      const Texture texture = TextureStore(s).get(0, scene::ColorSpace::Srgb);
      for (const double reach : {1e-5, 0.02, 0.3}) {
        for (int i = 0; i < 20; ++i) {
          const glm::dvec2 uv(2.0 * within(random), 2.0 * within(random));
          const double lambda = 2.0 * within(random);
          const Spread spread = TextureBox(texture, uv, {reach, 0.5 * reach})(lambda);
          EXPECT_EQ(spread.value, sample(texture, uv, lambda));
          std::vector<glm::dvec2> places;
          for (int k = 0; k < 400; ++k) {
            const glm::dvec2 to = k < 4 ? glm::dvec2(k % 2 == 0 ? 1 : -1, k < 2 ? 1 : -1) : glm::dvec2(within(random), within(random));
            places.push_back(uv + glm::dvec2(reach, 0.5 * reach) * to);
          }
          const auto farthest = [&](double level) {
            glm::dvec4 most(0.0);
            for (const glm::dvec2& place : places) {
              most = glm::max(most, glm::abs(sample(texture, place, level) - sample(texture, uv, level)));
            }
            return most;
          };
          const glm::dvec4 found = farthest(lambda);
          // Where levels are mixed, each may do its worst at a place of its own.
          const double share = lambda - std::floor(lambda);
          const glm::dvec4 apart = mip == MipFilter::Linear && lambda > 0.0
                                       ? farthest(std::floor(lambda)) * (1.0 - share) + farthest(std::floor(lambda) + 1.0) * share
                                       : found;
          for (int c = 0; c < 4; ++c) {
            EXPECT_LE(found[c], spread.radius[c]) << reach;
            if (filter == Filter::Linear && reach < 0.1) {
              EXPECT_LE(spread.radius[c], 1.3 * apart[c] + 1e-4) << "not much wider: " << reach;
            }
          }
        }
      }
    }
  }
}

TEST(TextureBox, SeesATexelThatTheBoxEncloses) {
  scene::Scene s;
  test::add_texture(s, test::picture(8, 1, [](int x, int) { return glm::ivec4(glm::ivec3(x == 4 ? 255 : 0), 255); }),
                    {scene::Wrap::Repeat, scene::Wrap::Repeat, scene::Filter::Linear, scene::Filter::Linear, scene::MipFilter::None});
  const Texture texture = TextureStore(s).get(0, scene::ColorSpace::Linear);
  // From one dark texel's middle to the other side's: the bright one lies between.
  EXPECT_NEAR(TextureBox(texture, {4.1 / 8, 0.5}, {1.0 / 8, 0.1})(-1.0).value.x, 0.6, 1e-9);
  EXPECT_NEAR(TextureBox(texture, {3.5 / 8, 0.5}, {1.2 / 8, 0.1})(-1.0).radius.x, 1.0, 1e-5);
}

TEST(TextureBox, GivesTheSameWhateverItWasAskedBefore) {
  const scene::Scene s =
      noise({scene::Wrap::Repeat, scene::Wrap::Repeat, scene::Filter::Linear, scene::Filter::Linear, scene::MipFilter::Linear});
  const Texture texture = TextureStore(s).get(0, scene::ColorSpace::Linear);
  TextureBox box(texture, {0.3, 0.6}, {0.01, 0.02});
  for (const double lambda : {0.4, 1.7, 0.4, -1.0, 2.0, 1.2, 9.0}) {
    const Spread anew = TextureBox(texture, {0.3, 0.6}, {0.01, 0.02})(lambda);
    const Spread again = box(lambda);
    EXPECT_EQ(again.value, anew.value) << lambda;
    EXPECT_EQ(again.radius, anew.radius) << lambda;
  }
}

// A box over many texels of level 1 too, whose one bright texel level 0 would not show as bright.
TEST(TextureBox, HoldsBothLevelsThatAreMixedOverAWideBox) {
  scene::Scene s;
  test::add_texture(
      s, test::picture(512, 512, [](int x, int y) { return glm::ivec4(glm::ivec3(x / 2 == 100 && y / 2 == 100 ? 255 : 0), 255); }));
  const Texture texture = TextureStore(s).get(0, scene::ColorSpace::Linear);
  const Spread spread = TextureBox(texture, {0.5, 0.5}, {0.2, 0.2})(3.5);
  const double mixed = 0.5 * (1.0 / 16.0 + 1.0 / 64.0);  // level 3 has the mean of 64 texels, 4 of them bright, level 4 that of 256
  EXPECT_GE(spread.value.x + spread.radius.x, mixed);
  EXPECT_LE(spread.value.x + spread.radius.x, mixed + 1e-5);
}

// The finer level's texels end at the 39th column; the coarser one's last reaches over the 40th and 41st.
TEST(TextureBox, HoldsWhatTheCoarserLevelSeesBeyondTheFinerOnesTexels) {
  scene::Scene s;
  test::add_texture(s, test::picture(64, 64, [](int x, int) { return glm::ivec4(glm::ivec3(x == 40 || x == 41 ? 255 : 0), 255); }));
  const Texture texture = TextureStore(s).get(0, scene::ColorSpace::Linear);
  const double high = 39.4 / 64;
  const double reach = 5.0 / 64;
  const Spread spread = TextureBox(texture, {high - reach, 0.5}, {reach, 0.01})(0.5);
  EXPECT_GE(spread.value.x + spread.radius.x, 0.1) << "of which the mixture has half of a fifth";
}

TEST(TextureBox, HoldsTheTexelsOfAWideBoxAndFewBeside) {
  scene::Scene s;
  test::add_texture(s, test::picture(512, 4, [](int x, int) { return glm::ivec4(x == 300 ? 255 : 51, 102, 102, 255); }),
                    {scene::Wrap::Repeat, scene::Wrap::Repeat, scene::Filter::Nearest, scene::Filter::Nearest, scene::MipFilter::None});
  const Texture texture = TextureStore(s).get(0, scene::ColorSpace::Linear);
  const Spread spread = TextureBox(texture, {0.5, 0.5}, {50.0 / 512, 0.1})(3.0);
  EXPECT_EQ(spread.value, sample(texture, {0.5, 0.5}, 3.0));
  EXPECT_NEAR(spread.radius.x, 0.8, 1e-5);
  EXPECT_NEAR(spread.radius.y, 0.0, 1e-5);
  EXPECT_NEAR(TextureBox(texture, {0.5, 0.5}, {30.0 / 512, 0.1})(3.0).radius.x, 0.0, 1e-5) << "14 texels off";
}

}  // namespace
}  // namespace sheen::golden
