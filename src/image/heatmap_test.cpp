#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "image/io.h"
#include "image/metrics.h"
#include "image/srgb.h"

namespace sheen::image {
namespace {

Image row_of(const std::vector<float>& reds) {
  Image image(static_cast<int>(reds.size()), 1, {"R", "G", "B", "A"});
  for (std::size_t x = 0; x < reds.size(); ++x) {
    image.at(static_cast<int>(x), 0, 0) = reds[x];
    image.at(static_cast<int>(x), 0, 3) = 1;
  }
  return image;
}

double luminance(const Image& map, int x) {
  return 0.2126 * static_cast<double>(map.at(x, 0, 0)) + 0.7152 * static_cast<double>(map.at(x, 0, 1)) +
         0.0722 * static_cast<double>(map.at(x, 0, 2));
}

TEST(Heatmap, NoErrorIsBlackAndFullScaleWhiteAndBeyondToo) {
  const Image map = heatmap(row_of({1.0f, 1.5f, 9.0f}), row_of({1, 1, 1}), 0.5);
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(map.at(0, 0, c), 0, 1e-7);
    EXPECT_NEAR(map.at(1, 0, c), 1, 1e-6);
    EXPECT_NEAR(map.at(2, 0, c), 1, 1e-6);
  }
}

TEST(Heatmap, ALargerErrorIsBrighter) {
  std::vector<float> values;
  for (int i = 0; i <= 100; ++i) {
    values.push_back(1.0f + 0.01f * static_cast<float>(i));
  }
  const Image map = heatmap(row_of(values), row_of(std::vector<float>(values.size(), 1.0f)), 1.0);
  for (int x = 1; x <= 100; ++x) {
    EXPECT_GT(luminance(map, x), luminance(map, x - 1)) << "step " << x;
  }
}

// Green 2011, equation 2 by hand at half way: the angle is 150 degrees, the amplitude 1/8.
TEST(Heatmap, HalfWayIsTheBrownOfCubehelix) {
  const Image map = heatmap(row_of({1.5f}), row_of({1}), 1.0);
  const std::vector<double> signals = {0.62751, 0.47500, 0.28643};
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(linear_to_srgb(static_cast<double>(map.at(0, 0, c))), signals[static_cast<std::size_t>(c)], 1e-4) << "channel " << c;
  }
}

TEST(Heatmap, UncoveredIsBlackAndNanIsMagenta) {
  Image candidate = row_of({5, std::numeric_limits<float>::quiet_NaN()});
  Image reference = row_of({1, 1});
  candidate.at(0, 0, 3) = 0;
  reference.at(0, 0, 3) = 0;
  const Image map = heatmap(candidate, reference, 1.0);
  EXPECT_EQ(luminance(map, 0), 0);
  EXPECT_EQ((std::vector<float>{map.at(1, 0, 0), map.at(1, 0, 1), map.at(1, 0, 2)}), (std::vector<float>{1, 0, 1}));
}

TEST(Heatmap, RefusesAScaleThatIsNotPositive) {
  EXPECT_THROW(heatmap(row_of({1}), row_of({1}), 0), Error);
  EXPECT_THROW(heatmap(row_of({1}), row_of({1}), std::nan("")), Error);
  EXPECT_THROW(heatmap(row_of({1}), row_of({1, 1}), 1), Error);
}

}  // namespace
}  // namespace sheen::image
