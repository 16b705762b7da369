#include "conformance/relate.h"

#include <limits>

#include <gtest/gtest.h>

#include "image/srgb.h"

namespace sheen::conformance {
namespace {

constexpr int side = 16;

Relation relation_of(RelationKind kind, std::vector<double> weights = {}) {
  Relation relation;
  relation.name = "a.law";
  relation.kind = kind;
  relation.law = "that it is so";
  relation.weights = std::move(weights);
  for (std::size_t i = 0; i < std::max<std::size_t>(relation.weights.size(), 2); ++i) {
    Case scene;
    scene.width = scene.height = side;
    relation.scenes.push_back(scene);
    relation.labels.push_back("scene_" + std::to_string(i));
  }
  return relation;
}

/// A smooth picture of a disc; `scale` times as bright.
image::Image disc(double scale) {
  image::Image picture(side, side, {"R", "G", "B", "A"});
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const bool inside = (x - 7.5) * (x - 7.5) + (y - 7.5) * (y - 7.5) < 36;
      for (int c = 0; c < 3 && inside; ++c) {
        picture.at(x, y, c) = static_cast<float>(scale * (0.1 + 0.02 * x + 0.01 * y + 0.05 * c));
      }
      picture.at(x, y, 3) = inside ? 1.0F : 0.0F;
    }
  }
  return picture;
}

/// The same with one channel of one pixel changed.
image::Image touched(image::Image picture, int x, int y, double by) {
  picture.at(x, y, 1) += static_cast<float>(by);
  return picture;
}

/// What is left of a picture that went through 8-bit sRGB codes.
image::Image coded(image::Image picture) {
  for (float& value : picture.data) {
    const double code = std::round(255 * image::linear_to_srgb(static_cast<double>(value)));
    value = static_cast<float>(image::srgb_to_linear(code / 255));
  }
  return picture;
}

/// A tone mapping: any growing function of each pixel.
image::Image mapped(image::Image picture) {
  for (std::size_t i = 0; i < picture.data.size(); ++i) {
    picture.data[i] = i % 4 == 3 ? picture.data[i] : picture.data[i] / (1 + picture.data[i]);
  }
  return picture;
}

Status status(const Relation& relation, const std::vector<image::Image>& pictures, const RelationRules& rules = {}) {
  return relate(relation, pictures, rules).status;
}

TEST(RelateEqual, FailsForOnePixelAndSaysWhichAndByHowMuch) {
  const Relation equal = relation_of(RelationKind::Equal);
  EXPECT_EQ(status(equal, {disc(1), disc(1)}), Status::Pass);
  EXPECT_EQ(status(equal, {disc(1), disc(1.0005)}), Status::Pass) << "as far apart as two pictures that meet one golden may be";
  const Verdict verdict = relate(equal, {disc(1), touched(disc(1), 9, 5, 0.01)}, {});
  EXPECT_EQ(verdict.status, Status::Fail);
  EXPECT_EQ(verdict.worst_x, 9);
  EXPECT_EQ(verdict.worst_y, 5);
  // 0.38 and 0.39, each with 1e-3 of itself and 2e-5.
  EXPECT_NEAR(verdict.bound_ratio, 0.01 / (1e-3 * 0.77 + 4e-5), 0.3);
  EXPECT_NEAR(verdict.max_abs, 0.01, 1e-6);
  EXPECT_EQ(verdict.compared_pixels, side * side);
  EXPECT_NE(verdict.message.find("'scene_0' and 'scene_1' are off by"), std::string::npos) << verdict.message;
  EXPECT_NE(verdict.message.find("at pixel 9, 5 (0.33 0.38 0.43 against 0.33 0.39 0.43)"), std::string::npos) << verdict.message;
}

TEST(RelateEqual, HoldsEveryPictureAndCoverage) {
  Relation equal = relation_of(RelationKind::Equal);
  equal.scenes.push_back(equal.scenes.front());
  equal.labels.push_back("third");
  EXPECT_EQ(status(equal, {disc(1), disc(1), disc(1)}), Status::Pass);
  EXPECT_NE(relate(equal, {disc(1), disc(1), disc(1.1)}, {}).message.find("'third'"), std::string::npos);
  image::Image hole = disc(1);
  hole.at(8, 8, 3) = 0.5F;
  EXPECT_EQ(status(equal, {disc(1), disc(1), hole}), Status::Fail);
}

TEST(RelateEqual, ExactBindsOurOwnViewerToTheBit) {
  Relation equal = relation_of(RelationKind::Equal);
  equal.exact = true;
  const std::vector<image::Image> nearly = {disc(1), touched(disc(1), 9, 5, 1e-6)};
  RelationRules rules;
  EXPECT_EQ(status(equal, nearly, rules), Status::Pass);
  rules.ours = true;
  EXPECT_EQ(status(equal, nearly, rules), Status::Fail);
  EXPECT_NE(relate(equal, nearly, rules).message.find("are not the same to the bit at pixel 9, 5"), std::string::npos);
  EXPECT_EQ(status(equal, {disc(1), disc(1)}, rules), Status::Pass);
}

TEST(RelateEqual, OfCodesMayBeOneApart) {
  const Relation equal = relation_of(RelationKind::Equal);
  RelationRules rules;
  rules.srgb8 = true;
  const std::vector<image::Image> rounded = {coded(disc(1)), coded(disc(1.001))};
  EXPECT_NE(rounded[0].data, rounded[1].data);
  EXPECT_EQ(status(equal, rounded, rules), Status::Pass);
  EXPECT_EQ(status(equal, rounded), Status::Fail) << "floats have no codes to round to";
  EXPECT_EQ(status(equal, {coded(disc(1)), coded(disc(1.03))}, rules), Status::Fail) << "two codes and more";
}

TEST(RelateDiffers, FailsWhenTooFewPixelsDo) {
  Relation differs = relation_of(RelationKind::Differs);
  differs.share = 0.1;
  EXPECT_EQ(status(differs, {disc(1), disc(1.1)}), Status::Pass);
  EXPECT_EQ(status(differs, {mapped(disc(1)), mapped(disc(1.1))}), Status::Pass) << "whatever the tone mapping";
  EXPECT_EQ(status(differs, {disc(1), disc(1)}), Status::Fail);
  const Verdict one = relate(differs, {disc(1), touched(disc(1), 9, 5, 0.1)}, {});
  EXPECT_EQ(one.status, Status::Fail) << "one pixel is no tenth";
  EXPECT_NE(one.message.find("must differ in 10 % of the pixels, and do not; they differ most at pixel 9, 5"), std::string::npos)
      << one.message;
  EXPECT_EQ(status(differs, {disc(1), disc(1.0005)}), Status::Fail) << "within the tolerance nothing differs";
}

TEST(RelateBrighter, FailsWhereDarkerAndWhereNoBrighter) {
  Relation brighter = relation_of(RelationKind::Brighter);
  brighter.share = 0.1;
  EXPECT_EQ(status(brighter, {disc(1.1), disc(1)}), Status::Pass);
  EXPECT_EQ(status(brighter, {mapped(disc(1.1)), mapped(disc(1))}), Status::Pass);
  EXPECT_EQ(status(brighter, {disc(1), disc(1.1)}), Status::Fail);
  EXPECT_NE(relate(brighter, {disc(1), disc(1)}, {}).message.find("must be brighter in 10 % of the pixels"), std::string::npos);
  const Verdict spot = relate(brighter, {disc(1.1), touched(disc(1), 9, 5, 0.2)}, {});
  EXPECT_EQ(spot.status, Status::Fail) << "brighter nearly everywhere is not enough";
  EXPECT_EQ(spot.worst_x, 9);
}

TEST(RelateLinear, HoldsTheWeightedSumToZero) {
  const Relation sum = relation_of(RelationKind::Linear, {1, -1, -1});
  EXPECT_EQ(status(sum, {disc(3), disc(1), disc(2)}), Status::Pass);
  EXPECT_EQ(status(sum, {disc(3), disc(1), disc(1.9)}), Status::Fail);
  const Relation half = relation_of(RelationKind::Linear, {1, -2, 1});
  EXPECT_EQ(status(half, {disc(1), disc(2), disc(3)}), Status::Pass);
  EXPECT_EQ(status(half, {disc(1), disc(2.1), disc(3)}), Status::Fail);
  EXPECT_EQ(status(half, {mapped(disc(1)), mapped(disc(2)), mapped(disc(3))}), Status::Fail) << "a tone mapping breaks it";
}

TEST(RelateLinear, LeavesToneMappedPicturesTheirOrder) {
  RelationRules rules;
  rules.tone_mapped = true;
  const Relation twice = relation_of(RelationKind::Linear, {1, -2});
  EXPECT_EQ(status(twice, {mapped(disc(2)), mapped(disc(1))}, rules), Status::Pass);
  EXPECT_EQ(status(twice, {mapped(disc(1)), mapped(disc(2))}, rules), Status::Fail);
  const Relation half = relation_of(RelationKind::Linear, {1, -2, 1});
  EXPECT_EQ(status(half, {disc(1), disc(2), disc(3)}, rules), Status::Unsupported);
  image::Image holes = disc(1);
  holes.at(3, 3, 0) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(status(half, {disc(1), holes, disc(3)}, rules), Status::Fail);
}

TEST(RelateLinear, OfCodesLeavesOutWhatMayBeClipped) {
  const Relation twice = relation_of(RelationKind::Linear, {1, -2});
  RelationRules rules;
  rules.srgb8 = true;
  image::Image once = coded(disc(0.5));
  image::Image both = coded(disc(1));
  once.at(8, 8, 0) = 0.9F;
  both.at(8, 8, 0) = 1.0F;
  const Verdict verdict = relate(twice, {both, once}, rules);
  EXPECT_EQ(verdict.status, Status::Pass) << verdict.message;
  EXPECT_EQ(verdict.excluded_pixels, 1);
  for (float& value : both.data) {
    value = 1.0F;
  }
  EXPECT_EQ(status(twice, {both, once}, rules), Status::Invalid) << "where all is clipped nothing is judged";
}

TEST(Relate, RegionAndMirrorSayWhatIsLookedAt) {
  Relation equal = relation_of(RelationKind::Equal);
  const image::Image picture = disc(1);
  image::Image turned = picture;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      for (int c = 0; c < 4; ++c) {
        turned.at(x, y, c) = picture.at(side - 1 - x, y, c);
      }
    }
  }
  EXPECT_EQ(status(equal, {picture, turned}), Status::Fail);
  equal.mirrored = true;
  EXPECT_EQ(status(equal, {picture, turned}), Status::Pass);
  equal.mirrored = false;
  equal.region = {0, 0, 0.5, 1};
  const Verdict verdict = relate(equal, {picture, touched(picture, 9, 5, 0.1)}, {});
  EXPECT_EQ(verdict.status, Status::Pass) << "the right half is not looked at";
  EXPECT_EQ(verdict.compared_pixels, side * side / 2);
}

TEST(Relate, MovedScenesMayDifferAtEdgesAndByAStep) {
  Relation equal = relation_of(RelationKind::Equal);
  image::Image other = disc(1);
  // A pixel of the rim that the other grid does not cover.
  for (int c = 0; c < 4; ++c) {
    other.at(2, 6, c) = 0;
  }
  // An eighth of the way to a neighbour, in both directions: SUBPIXEL_BITS 4.
  other = touched(other, 8, 8, 0.02 / 8);
  EXPECT_EQ(status(equal, {disc(1), other}), Status::Fail);
  equal.moved = true;
  const Verdict verdict = relate(equal, {disc(1), other}, {});
  EXPECT_EQ(verdict.status, Status::Pass) << verdict.message;
  EXPECT_GT(verdict.excluded_pixels, 0);
  EXPECT_EQ(status(equal, {disc(1), touched(other, 8, 8, 0.02)}), Status::Fail);
}

TEST(Relate, NaNFailsEveryKind) {
  image::Image holes = disc(1);
  holes.at(0, 0, 2) = std::numeric_limits<float>::infinity();
  for (const RelationKind kind : {RelationKind::Equal, RelationKind::Differs, RelationKind::Brighter}) {
    const Verdict verdict = relate(relation_of(kind), {disc(1.5), holes}, {});
    EXPECT_EQ(verdict.status, Status::Fail) << to_string(kind);
    EXPECT_EQ(verdict.nonfinite_pixels, 1);
  }
}

TEST(Relate, PicturesThatCannotBeJudgedAreInvalid) {
  const Relation equal = relation_of(RelationKind::Equal);
  EXPECT_EQ(status(equal, {disc(1), image::Image(8, 8, {"R", "G", "B"})}), Status::Invalid);
  EXPECT_EQ(status(equal, {disc(1), image::Image(side, side, {"R", "G"})}), Status::Invalid);
  const image::Image empty(side, side, {"R", "G", "B", "A"});
  EXPECT_EQ(status(equal, {empty, empty}), Status::Invalid) << "a viewer that draws nothing has kept no law";
}

TEST(RelationMap, IsTheVerdictPixelByPixel) {
  const Relation equal = relation_of(RelationKind::Equal);
  const std::vector<image::Image> pictures = {disc(1), touched(disc(1), 9, 5, 0.01)};
  const std::vector<double> map = relation_map(equal, pictures, {});
  EXPECT_EQ(map[5 * side + 9], relate(equal, pictures, {}).bound_ratio);
  EXPECT_EQ(map[5 * side + 8], 0);
}

}  // namespace
}  // namespace sheen::conformance
