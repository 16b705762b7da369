#include "golden/texel_extents.h"

#include <cstddef>
#include <limits>
#include <random>
#include <utility>

#include <glm/vec2.hpp>
#include <gtest/gtest.h>

namespace sheen::golden {
namespace {

/// Against going through every texel of a block, wherever it wraps: all of them, and not many more.
TEST(TexelExtents, HoldEveryTexelOfABlockHoweverItWraps) {
  std::mt19937 random(6);
  int narrow = 0;
  int exact = 0;
  for (const auto& [width, height] : {std::pair(37, 18), std::pair(64, 64), std::pair(5, 1), std::pair(1, 90)}) {
    scene::Texels level{width, height, {}};
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        level.rgba.emplace_back(std::uniform_real_distribution<float>(0.0F, 1.0F)(random), x, y, 1.0F);
      }
    }
    const TexelExtents extents(level);
    for (const scene::Wrap wrap : {scene::Wrap::Repeat, scene::Wrap::ClampToEdge, scene::Wrap::MirroredRepeat}) {
      for (int i = 0; i < 300; ++i) {
        const auto span = [&](int size) {
          const double first = std::uniform_int_distribution(-3 * size, 3 * size)(random);
          return TexelExtents::Span{first, first + std::uniform_int_distribution(0, i % 2 == 0 ? size : 8)(random)};
        };
        const TexelExtents::Span columns = span(width);
        const TexelExtents::Span rows = span(height);
        const Extent<glm::vec4> found = extents.over(columns, rows, {wrap, wrap, {}, {}, {}});
        Extent<glm::vec4> all{glm::vec4(1e9F), glm::vec4(-1e9F)};
        for (double y = rows.first; y <= rows.last; y += 1.0) {
          for (double x = columns.first; x <= columns.last; x += 1.0) {
            all.include(level.rgba[static_cast<std::size_t>(wrapped(y, height, wrap) * width + wrapped(x, width, wrap))]);
          }
        }
        for (int c = 0; c < 4; ++c) {
          EXPECT_LE(found.least[c], all.least[c]);
          EXPECT_GE(found.most[c], all.most[c]);
        }
        // Of a block of few texels, no other; of more, in the second and third channel, those a cell farther off.
        const glm::dvec2 size(columns.last - columns.first + 1.0, rows.last - rows.first + 1.0);
        const bool is_small = size.x * size.y <= 144.0 && size.x < width && size.y < height;
        exact += is_small && found.least == all.least && found.most == all.most ? 1 : 0;
        narrow += is_small ? 1 : 0;
        if (found.most.y - found.least.y < static_cast<float>(width - 1)) {
          EXPECT_LE(found.most.y - found.least.y, 2.0F * (all.most.y - all.least.y) + 16.0F);
        }
      }
    }
  }
  EXPECT_EQ(exact, narrow);
  EXPECT_GT(narrow, 500);
}

TEST(TexelExtents, OfWhatIsNoBlockAreThoseOfTheWholeLevel) {
  const scene::Texels level{2, 1, {glm::vec4(0.25F), glm::vec4(0.75F)}};
  const TexelExtents extents(level);
  const double infinity = std::numeric_limits<double>::infinity();
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (const scene::Wrap wrap : {scene::Wrap::Repeat, scene::Wrap::ClampToEdge, scene::Wrap::MirroredRepeat}) {
    for (const TexelExtents::Span& span : {TexelExtents::Span{-infinity, infinity}, TexelExtents::Span{none, none}}) {
      const Extent<glm::vec4> all = extents.over(span, {0.0, 0.0}, {wrap, wrap, {}, {}, {}});
      EXPECT_EQ(all.least.x, 0.25F);
      EXPECT_EQ(all.most.x, 0.75F);
    }
  }
}

}  // namespace
}  // namespace sheen::golden
