#include "tools/tolerance.h"

#include <limits>

#include <gtest/gtest.h>

namespace sheen::tools {
namespace {

image::Image grey(float value, float alpha) {
  image::Image image(2, 1, {"R", "G", "B", "A"});
  image.data = {value, value, value, alpha, 0.0f, 0.0f, 0.0f, 0.0f};
  return image;
}

TEST(ValuesOutside, EqualImagesHaveNone) {
  EXPECT_EQ(values_outside(grey(1.0f, 1.0f), grey(1.0f, 1.0f), {0.0, 0.0}), 0);
}

TEST(ValuesOutside, TheLargerOfAbsoluteAndRelativeIsAllowed) {
  EXPECT_EQ(values_outside(grey(1.01f, 1.0f), grey(1.0f, 1.0f), {0.02, 0.0}), 0);
  EXPECT_EQ(values_outside(grey(1.01f, 1.0f), grey(1.0f, 1.0f), {0.0, 0.02}), 0);
  EXPECT_EQ(values_outside(grey(1.01f, 1.0f), grey(1.0f, 1.0f), {0.005, 0.005}), 3) << "three channels, alpha agrees";
}

TEST(ValuesOutside, AMissingObjectIsSeenFromEitherSide) {
  EXPECT_EQ(values_outside(grey(0.0f, 0.0f), grey(1.0f, 1.0f), {0.1, 0.1}), 4);
  EXPECT_EQ(values_outside(grey(1.0f, 1.0f), grey(0.0f, 0.0f), {0.1, 0.1}), 4);
}

TEST(ValuesOutside, NotANumberIsOutsideWhateverTheTolerance) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  EXPECT_EQ(values_outside(grey(nan, 1.0f), grey(1.0f, 1.0f), {1e9, 1e9}), 3);
  EXPECT_EQ(values_outside(grey(1.0f, 1.0f), grey(nan, 1.0f), {1e9, 1e9}), 3);
  EXPECT_EQ(values_outside(grey(inf, 1.0f), grey(inf, 1.0f), {1e9, 1e9}), 3);
  EXPECT_EQ(values_outside(grey(1.0f, 1.0f), grey(inf, 1.0f), {1e9, 1e9}), 3);
  EXPECT_EQ(values_outside(grey(1.0f, nan), grey(1.0f, 1.0f), {1e9, 1e9}), 1);
}

}  // namespace
}  // namespace sheen::tools
