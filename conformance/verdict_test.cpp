#include "conformance/verdict.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "conformance/verdict_fixture_test.h"

namespace sheen::conformance {
namespace {

TEST_F(VerdictTest, TheGoldenItselfPasses) {
  const Verdict v = verdict();
  EXPECT_EQ(v.status, Status::Pass) << v.message;
  EXPECT_EQ(v.compared_pixels, 100);
  EXPECT_EQ(v.bound_ratio, 0);
}

TEST_F(VerdictTest, JustWithinTheBoundPassesAndJustOutsideFails) {
  candidate_.at(3, 4, 1) += 0.9F * golden_.at(3, 4, 5);
  EXPECT_EQ(verdict().status, Status::Pass);
  EXPECT_NEAR(verdict().bound_ratio, 0.9, 1e-3);
  candidate_.at(3, 4, 1) += 0.2F * golden_.at(3, 4, 5);
  EXPECT_EQ(verdict().status, Status::Fail) << "one channel of one pixel is enough";
  EXPECT_EQ(verdict().worst_x, 3);
  EXPECT_EQ(verdict().worst_y, 4);
}

TEST_F(VerdictTest, EachChannelAlphaTooIsCompared) {
  for (int c = 0; c < 4; ++c) {
    image::Image off = candidate_;
    off.at(7, 2, c) -= 0.01F;
    EXPECT_EQ(judge(off, golden_, rules_).status, Status::Fail) << "channel " << c;
  }
}

TEST_F(VerdictTest, EveryCoveredPixelAloneDecides) {
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width / 2; ++x) {
      image::Image off = candidate_;
      off.at(x, y, 0) += 0.01F;
      EXPECT_EQ(judge(off, golden_, rules_).status, Status::Fail) << "pixel " << x << ", " << y;
    }
  }
}

TEST_F(VerdictTest, SwappedChannelsFail) {
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      std::swap(candidate_.at(x, y, 0), candidate_.at(x, y, 2));
    }
  }
  EXPECT_EQ(verdict().status, Status::Fail);
}

TEST_F(VerdictTest, ChannelsAreFoundByNameNotByPlace) {
  image::Image shuffled(width, height, {"B", "A", "R", "G"});
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      shuffled.at(x, y, 0) = candidate_.at(x, y, 2);
      shuffled.at(x, y, 1) = candidate_.at(x, y, 3);
      shuffled.at(x, y, 2) = candidate_.at(x, y, 0);
      shuffled.at(x, y, 3) = candidate_.at(x, y, 1);
    }
  }
  EXPECT_EQ(judge(shuffled, golden_, rules_).status, Status::Pass);
}

TEST_F(VerdictTest, AMissingObjectFails) {
  const Verdict v = judge(image::Image(width, height, {"R", "G", "B", "A"}), golden_, rules_);
  EXPECT_EQ(v.status, Status::Fail) << "pixels that only the golden covers are compared";
  EXPECT_EQ(v.compared_pixels, 100);
}

TEST_F(VerdictTest, SomethingDrawnOutsideFails) {
  candidate_.at(15, 5, 0) = 0.5F;
  candidate_.at(15, 5, 3) = 1.0F;
  EXPECT_EQ(verdict().status, Status::Fail);
  EXPECT_EQ(verdict().compared_pixels, 101);
}

TEST_F(VerdictTest, NanOrInfFailsWhereverItStands) {
  for (const auto& [x, y] : {std::pair{2, 2}, std::pair{18, 8}}) {
    for (const float value : {nan_value, infinite_value, -infinite_value}) {
      image::Image off = candidate_;
      off.at(x, y, 2) = value;
      const Verdict v = judge(off, golden_, rules_);
      EXPECT_EQ(v.status, Status::Fail) << value << " at " << x;
      EXPECT_EQ(v.nonfinite_pixels, 1);
    }
  }
  golden_.at(2, 2, 7) = 1.0F;
  candidate_.at(2, 2, 0) = nan_value;
  EXPECT_EQ(verdict().status, Status::Fail) << "an excluded pixel must be finite too";
}

TEST_F(VerdictTest, ANegativePixelFailsWhereTheGoldenIsNot) {
  golden_.at(2, 3, 0) = 0.0F;
  golden_.at(2, 3, 4) = 0.5F;
  candidate_.at(2, 3, 0) = -1e-6F;
  const Verdict v = verdict();
  EXPECT_LT(v.bound_ratio, 1) << "the bound alone would let it pass";
  EXPECT_EQ(v.status, Status::Fail);
  EXPECT_EQ(v.negative_pixels, 1);
  EXPECT_NE(v.message.find("1 pixels are negative"), std::string::npos) << v.message;
}

TEST_F(VerdictTest, ANegativePixelFailsWhereverItStands) {
  golden_.at(2, 2, 7) = 1.0F;
  for (const auto& [x, y] : {std::pair{18, 8}, std::pair{2, 2}}) {
    for (int c = 0; c < 3; ++c) {
      image::Image off = candidate_;
      off.at(x, y, c) = -1e-30F;
      EXPECT_EQ(judge(off, golden_, rules_).status, Status::Fail) << "pixel " << x << ", " << y << " channel " << c;
    }
  }
}

TEST_F(VerdictTest, WhatIsNegativeInTheGoldenMayBeSo) {
  golden_.at(2, 3, 1) = candidate_.at(2, 3, 1) = -0.25F;
  candidate_.at(18, 8, 0) = -0.0F;
  EXPECT_EQ(verdict().status, Status::Pass) << verdict().message;
  EXPECT_EQ(verdict().negative_pixels, 0);
}

TEST_F(VerdictTest, AnInfiniteOrNanBoundForgivesNothing) {
  for (const float bound : {infinite_value, nan_value}) {
    image::Image loose = golden_;
    loose.at(4, 4, 4) = bound;
    candidate_.at(4, 4, 0) += 100.0F;
    EXPECT_NE(judge(candidate_, loose, rules_).status, Status::Pass) << bound;
  }
}

TEST_F(VerdictTest, ANanGoldenIsInvalid) {
  golden_.at(4, 4, 0) = nan_value;
  EXPECT_EQ(verdict().status, Status::Invalid);
}

TEST_F(VerdictTest, ExcludedPixelsAreLeftOutUpToTwoPercent) {
  golden_.at(1, 1, 7) = 1.0F;
  golden_.at(1, 2, 7) = 1.0F;
  candidate_.at(1, 1, 0) = 9.0F;
  const Verdict v = verdict();
  EXPECT_EQ(v.status, Status::Pass) << v.message;
  EXPECT_EQ(v.excluded_pixels, 2);
  EXPECT_EQ(v.compared_pixels, 98);
  golden_.at(1, 3, 7) = 1.0F;
  EXPECT_EQ(verdict().status, Status::Invalid) << "three of a hundred are too many to judge by the rest";
}

TEST_F(VerdictTest, TooManyExcludedAreToldByTheirReasons) {
  for (int y = 0; y < 5; ++y) {
    golden_.at(1, y, 7) = 2.0F;
    golden_.at(2, y, 7) = 3.0F;
  }
  golden_.at(0, 0, 7) = 1.0F;
  const Verdict v = verdict();
  EXPECT_EQ(v.excluded_by, (std::array<std::int64_t, 5>{0, 1, 5, 5, 0}));
  EXPECT_NE(
      v.message.find("11 of 100 covered pixels are excluded, more than may be: 1 at edges, 5 where an alpha mask may fall either way, "
                     "5 where a texture without mipmaps"),
      std::string::npos)
      << v.message;
}

TEST_F(VerdictTest, ABoundThatLetsAnythingPassJudgesNothing) {
  const auto widen = [&](int rows) {
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < width / 2; ++x) {
        golden_.at(x, y, 6) = 1.1F * golden_.at(x, y, 2);  // blue is the brightest
      }
    }
  };
  widen(2);
  EXPECT_EQ(verdict().vague_pixels, 20);
  EXPECT_EQ(verdict().status, Status::Pass);
  widen(3);
  EXPECT_EQ(verdict().vague_pixels, 30);
  EXPECT_EQ(verdict().status, Status::Invalid);
  EXPECT_NE(verdict().message.find("30 of 100 compared pixels"), std::string::npos);
}

TEST_F(VerdictTest, ADarkPixelIsNotVague) {
  for (int y = 0; y < height; ++y) {
    for (int c = 0; c < 3; ++c) {
      golden_.at(0, y, c) = golden_.at(1, y, c) = golden_.at(2, y, c) = candidate_.at(0, y, c) = candidate_.at(1, y, c) =
          candidate_.at(2, y, c) = 0.0F;
    }
  }
  EXPECT_EQ(verdict().vague_pixels, 0);
  EXPECT_EQ(verdict().status, Status::Pass);
}

TEST_F(VerdictTest, ABlackPictureIsNotVagueForWhatMayBeFlushed) {
  for (const float bound : {0x1p-140F, 0x1p-100F}) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width / 2; ++x) {
        for (int c = 0; c < 3; ++c) {
          golden_.at(x, y, c) = candidate_.at(x, y, c) = 0.0F;
          golden_.at(x, y, 4 + c) = bound;
        }
      }
    }
    EXPECT_EQ(verdict().vague_pixels, bound < 0x1p-126F ? 0 : 100);
  }
}

TEST_F(VerdictTest, ExcludedPixelsThatNobodyCoversDoNotCount) {
  for (int y = 0; y < height; ++y) {
    golden_.at(19, y, 7) = 1.0F;
  }
  EXPECT_EQ(verdict().status, Status::Pass);
  EXPECT_EQ(verdict().excluded_pixels, 0);
}

TEST_F(VerdictTest, AllExcludedIsInvalid) {
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      golden_.at(x, y, 7) = 1.0F;
    }
  }
  EXPECT_EQ(verdict().status, Status::Invalid);
}

TEST_F(VerdictTest, AnEmptyGoldenIsInvalidEvenIfTheCandidateIsEmptyToo) {
  const image::Image empty(width, height, golden_.channels);
  EXPECT_EQ(judge(image::Image(width, height, {"R", "G", "B", "A"}), empty, rules_).status, Status::Invalid);
  EXPECT_NE(judge(candidate_, empty, rules_).status, Status::Pass);
}

TEST_F(VerdictTest, AnotherSizeIsInvalid) {
  EXPECT_EQ(judge(image::Image(width, height + 1, {"R", "G", "B", "A"}), golden_, rules_).status, Status::Invalid);
}

TEST_F(VerdictTest, AMissingChannelIsInvalid) {
  EXPECT_EQ(judge(image::Image(width, height, {"R", "G", "A"}), golden_, rules_).status, Status::Invalid);
  EXPECT_EQ(judge(candidate_, rgba_of(golden_), rules_).status, Status::Invalid) << "a golden without bounds judges nothing";
}

TEST_F(VerdictTest, ACandidateWithoutAlphaCoversWhatTheSceneCovers) {
  image::Image opaque(width, height, {"R", "G", "B"});
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c) {
        opaque.at(x, y, c) = x < width / 2 ? candidate_.at(x, y, c) : 0.7F;
      }
    }
  }
  const Verdict v = judge(opaque, golden_, rules_);
  EXPECT_EQ(v.status, Status::Pass) << v.message;
  EXPECT_EQ(v.compared_pixels, 100);
}

TEST_F(VerdictTest, FiguresAreThoseOfCompare) {
  candidate_.at(0, 0, 0) += 0.05F;
  const Verdict v = verdict();
  EXPECT_NEAR(v.max_abs, 0.05, 1e-6);
  EXPECT_NEAR(v.max_rel, 0.05 / golden_.at(0, 0, 0), 1e-5);
  EXPECT_EQ(v.p99_rel, 0) << "one channel value of 400 is not among the first 99 %";
}

TEST_F(VerdictTest, TheMedianBoundIsThatOfTheColoursBoundsRelativeToTheGolden) {
  const auto set = [&](int columns) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        for (int c = 0; c < 3; ++c) {
          golden_.at(x, y, 4 + c) = (x < columns ? 1e-2F : 1e-4F) * golden_.at(x, y, c);
        }
        golden_.at(x, y, 8) = 7.0F;
      }
    }
  };
  set(4);
  EXPECT_NEAR(verdict().median_bound, 1e-4, 1e-9);
  set(6);
  EXPECT_NEAR(verdict().median_bound, 1e-2, 1e-7);
  for (int y = 0; y < height; ++y) {
    golden_.at(0, y, 7) = golden_.at(1, y, 7) = golden_.at(2, y, 7) = 1.0F;
  }
  EXPECT_NEAR(verdict().median_bound, 1e-4, 1e-9) << "what is excluded does not count";
}

TEST_F(VerdictTest, TheMedianBoundOfTheDarkIsRelativeToAThousandth) {
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c) {
        golden_.at(x, y, c) = candidate_.at(x, y, c) = 0.0F;
        golden_.at(x, y, 4 + c) = 2e-6F;
      }
    }
  }
  EXPECT_NEAR(verdict().median_bound, 2e-3, 1e-9);
}

TEST_F(VerdictTest, TheMapShowsWhatTheVerdictSaw) {
  candidate_.at(3, 4, 1) += 2 * golden_.at(3, 4, 5);
  candidate_.at(18, 9, 0) = nan_value;
  golden_.at(0, 0, 7) = 1.0F;
  const std::vector<double> map = ratio_map(candidate_, golden_, rules_);
  EXPECT_NEAR(map[4 * width + 3], 2, 1e-3);
  EXPECT_EQ(map[0], -1);
  EXPECT_TRUE(std::isinf(map[9 * width + 18]));
  EXPECT_EQ(map[5 * width + 15], 0);
}

}  // namespace
}  // namespace sheen::conformance
