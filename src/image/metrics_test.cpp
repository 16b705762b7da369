#include "image/metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "image/io.h"

namespace sheen::image {
namespace {

using Names = std::vector<std::string>;
const Names rgba_names = {"R", "G", "B", "A"};
const Names rgb_names = {"R", "G", "B"};

Image filled(int width, int height, const Names& names, const std::vector<float>& pixel) {
  Image image(width, height, names);
  for (std::size_t i = 0; i < image.data.size(); ++i) {
    image.data[i] = pixel[i % pixel.size()];
  }
  return image;
}

TEST(Compare, EqualImagesAreInfinitelyGoodAndHaveNoError) {
  const Image image = filled(9, 4, rgba_names, {0.2f, 3.0f, 0.0f, 1.0f});
  const Comparison c = compare(image, image);
  EXPECT_EQ(c.max_abs, 0);
  EXPECT_EQ(c.p99_rel, 0);
  EXPECT_EQ(c.flip, 0);
  EXPECT_TRUE(std::isinf(c.psnr) && c.psnr > 0);
  EXPECT_EQ(c.compared_pixels, 36);
}

TEST(Compare, ErrorsAreOverEveryChannelAndRelativeToTheReferenceFlooredAtAThousandth) {
  const Image reference = filled(2, 1, rgb_names, {2.0f, 1e-4f, 0.5f});
  Image candidate = reference;
  candidate.at(1, 0, 0) = 1.0f;     // absolute 1, relative 0.5
  candidate.at(1, 0, 1) = 1.1e-3f;  // absolute 1e-3, relative 1 by the floor
  const Comparison c = compare(candidate, reference);
  EXPECT_DOUBLE_EQ(c.max_abs, 1.0);
  EXPECT_NEAR(c.mean_abs, (1.0 + 1e-3) / 6, 1e-9);
  EXPECT_NEAR(c.max_rel, 1.0, 1e-6);
  EXPECT_NEAR(c.mean_rel, 1.5 / 6, 1e-6);
  EXPECT_NEAR(c.psnr, 10 * std::log10(6 / (1.0 + 1e-6)), 1e-6);
  EXPECT_EQ(c.worst_x, 1);
  EXPECT_EQ(c.worst_y, 0);
}

TEST(Compare, ANegativeReferenceCountsByItsMagnitude) {
  const Comparison c = compare(filled(1, 1, rgb_names, {-1, 0, 0}), filled(1, 1, rgb_names, {-2, 0, 0}));
  EXPECT_DOUBLE_EQ(c.max_rel, 0.5);
}

TEST(Compare, TheNinetyNinthPercentileIsTheNearestRank) {
  for (const int count : {1, 50, 99, 100, 101, 200, 1000}) {
    Image reference(count, 1, {"R"});
    Image candidate(count, 1, {"R"});
    std::vector<double> errors;
    for (int x = 0; x < count; ++x) {
      candidate.at(x, 0, 0) = static_cast<float>((x * 7919) % count);  // a permutation of 0 ... count - 1
      errors.push_back(candidate.at(x, 0, 0));
    }
    std::sort(errors.begin(), errors.end());
    // The definition: the smallest value that at least 99 % of them do not exceed.
    const double expected = *std::find_if(errors.begin(), errors.end(), [&](double value) {
      return 100 * std::count_if(errors.begin(), errors.end(), [&](double other) { return other <= value; }) >= 99 * count;
    });
    EXPECT_EQ(compare(candidate, reference, Flip::Skip).p99_abs, expected) << count << " values";
  }
}

TEST(Compare, AMissingObjectDoesNotPass) {
  Image reference = filled(8, 8, rgba_names, {0, 0, 0, 0});
  for (int c = 0; c < 4; ++c) {
    reference.at(3, 3, c) = 1;
  }
  const Comparison c = compare(filled(8, 8, rgba_names, {0, 0, 0, 0}), reference);
  EXPECT_EQ(c.compared_pixels, 1);
  EXPECT_EQ(c.max_abs, 1);
  EXPECT_EQ(c.mean_abs, 1) << "not diluted by the background";
  EXPECT_GT(c.flip, 0.1);
}

TEST(Compare, AnObjectThatShouldNotBeThereDoesNotPassEither) {
  Image candidate = filled(8, 8, rgba_names, {0, 0, 0, 0});
  for (int c = 0; c < 4; ++c) {
    candidate.at(3, 3, c) = 1;
  }
  EXPECT_EQ(compare(candidate, filled(8, 8, rgba_names, {0, 0, 0, 0})).max_abs, 1);
}

TEST(Compare, WrongCoverageIsAnErrorToo) {
  EXPECT_NEAR(compare(filled(1, 1, rgba_names, {1, 1, 1, 0.5f}), filled(1, 1, rgba_names, {1, 1, 1, 1})).max_abs, 0.5, 1e-12);
}

TEST(Compare, AnImageWithoutAlphaCoversWhatTheOtherCovers) {
  Image reference = filled(4, 1, rgba_names, {0, 0, 0, 0});
  reference.at(2, 0, 0) = 1;
  reference.at(2, 0, 3) = 1;
  const Comparison c = compare(filled(4, 1, rgb_names, {0.5f, 0, 0}), reference);
  EXPECT_EQ(c.compared_pixels, 1);
  EXPECT_EQ(c.max_abs, 0.5) << "the missing alpha is not an error";
  EXPECT_EQ(compare(filled(4, 1, rgb_names, {0.5f, 0, 0}), filled(4, 1, rgb_names, {0.5f, 0, 0})).compared_pixels, 4);
}

TEST(Compare, NanAndInfinityAreCountedAndInNoOtherFigure) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  Image reference = filled(4, 1, rgba_names, {1, 1, 1, 1});
  Image candidate = reference;
  candidate.at(0, 0, 1) = nan;
  candidate.at(1, 0, 3) = nan;
  reference.at(2, 0, 0) = -std::numeric_limits<float>::infinity();
  const Comparison c = compare(candidate, reference);
  EXPECT_EQ(c.nonfinite_pixels, 3);
  EXPECT_EQ(c.compared_pixels, 1);
  EXPECT_EQ(c.max_abs, 0);
  EXPECT_TRUE(std::isfinite(c.flip));
}

TEST(Compare, ANanOutsideTheCoveredPixelsIsStillCounted) {
  Image candidate = filled(2, 1, rgba_names, {0, 0, 0, 0});
  candidate.at(1, 0, 0) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(compare(candidate, filled(2, 1, rgba_names, {0, 0, 0, 0})).nonfinite_pixels, 1);
}

TEST(Compare, WithoutCoveredPixelsEveryFigureIsZero) {
  const Image empty = filled(3, 3, rgba_names, {0, 0, 0, 0});
  const Comparison c = compare(empty, empty);
  EXPECT_EQ(c.compared_pixels, 0);
  EXPECT_EQ(c.max_rel, 0);
  EXPECT_EQ(c.flip, 0);
  EXPECT_TRUE(std::isinf(c.psnr));
  EXPECT_EQ(c.worst_x, -1);
}

TEST(Compare, BoundsAndOtherChannelsAreNotThePicture) {
  const Image reference = filled(1, 1, {"R", "G", "B", "A", "bound.R", "excluded"}, {1, 1, 1, 1, 0.5f, 1});
  const Image candidate = filled(1, 1, {"A", "B", "G", "R", "bound.R", "excluded"}, {1, 1, 1, 1, std::nanf(""), 0});
  const Comparison c = compare(candidate, reference);
  EXPECT_EQ(c.max_abs, 0);
  EXPECT_EQ(c.nonfinite_pixels, 0);
}

TEST(Compare, UnequalSizesOrNothingInCommonIsAnError) {
  try {
    compare(Image(2, 1, rgb_names), Image(1, 2, rgb_names));
    ADD_FAILURE() << "sizes differ";
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("2 x 1"), std::string::npos) << e.what();
  }
  EXPECT_THROW(compare(Image(1, 1, {"Z"}), Image(1, 1, {"Z"})), Error);
  Image broken(2, 2, rgb_names);
  broken.data.pop_back();
  EXPECT_THROW(compare(broken, Image(2, 2, rgb_names)), Error);
}

TEST(Compare, FlipLeftOutIsZeroAndChangesNothingElse) {
  const Image reference = filled(2, 2, rgb_names, {0.5f, 0.5f, 0.5f});
  const Image candidate = filled(2, 2, rgb_names, {0.9f, 0.5f, 0.1f});
  const Comparison with = compare(candidate, reference);
  const Comparison without = compare(candidate, reference, Flip::Skip);
  EXPECT_GT(with.flip, 0);
  EXPECT_EQ(without.flip, 0);
  EXPECT_EQ(with.p99_rel, without.p99_rel);
  EXPECT_EQ(with.psnr, without.psnr);
}

}  // namespace
}  // namespace sheen::image
