#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "conformance/verdict.h"
#include "conformance/verdict_fixture_test.h"

namespace sheen::conformance {
namespace {

/// What may widen a bound or leave out a pixel.
class VerdictRulesTest : public VerdictTest {};

TEST_F(VerdictRulesTest, Pxr24WidensTheBoundByItsRoundingAlone) {
  const float value = golden_.at(6, 6, 0);
  golden_.at(6, 6, 4) = 0.0F;
  candidate_.at(6, 6, 0) = value * (1 + 0x1p-17F);
  EXPECT_EQ(verdict().status, Status::Fail);
  rules_.golden_is_pxr24 = true;
  EXPECT_EQ(verdict().status, Status::Pass) << verdict().message;
  candidate_.at(6, 6, 0) = value * (1 + 0x1p-15F);
  EXPECT_EQ(verdict().status, Status::Fail);
}

/// The linear value of the sRGB code nearest to a linear value, found by trying all.
float through_codes(float linear) {
  double best = 0;
  double distance = 1e9;
  const double wanted = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(static_cast<double>(linear), 1 / 2.4) - 0.055;
  for (int code = 0; code < 256; ++code) {
    const double s = code / 255.0;
    if (std::abs(s - wanted) < distance) {
      distance = std::abs(s - wanted);
      best = s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
    }
  }
  return static_cast<float>(best);
}

TEST_F(VerdictRulesTest, EightBitCodesAreForgivenHalfACodeAndTheClip) {
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width / 2; ++x) {
      for (int c = 0; c < 3; ++c) {
        golden_.at(x, y, c) *= 3.5F;  // up to 1.36
        golden_.at(x, y, 4 + c) = 0.0F;
        candidate_.at(x, y, c) = through_codes(golden_.at(x, y, c));
      }
    }
  }
  EXPECT_EQ(verdict().status, Status::Fail);
  rules_.candidate_is_srgb8 = true;
  EXPECT_EQ(verdict().status, Status::Pass) << verdict().message;
  candidate_.at(5, 5, 1) = through_codes(golden_.at(5, 5, 1) * 0.97F);
  EXPECT_EQ(verdict().status, Status::Fail) << "a code off by one or more is seen";
}

TEST_F(VerdictRulesTest, ReplicasAreGrantedWhatTheyShowByChanceWhereTheRulesSaySo) {
  const float value = golden_.at(6, 6, 1);
  candidate_.at(6, 6, 1) = 1.07F * value;
  rules_.standard_errors = 8;
  EXPECT_EQ(verdict().status, Status::Fail) << "there are no replicas";
  image::Image told(width, height, {"R", "G", "B", "A", "standard_error.R", "standard_error.G", "standard_error.B"});
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 4; ++c) {
        told.at(x, y, c) = candidate_.at(x, y, c);
      }
    }
  }
  candidate_ = told;
  EXPECT_EQ(verdict().status, Status::Fail) << "they all agree";
  candidate_.at(6, 6, 4) = 1.0F;
  EXPECT_EQ(verdict().status, Status::Fail) << "another channel does not";
  candidate_.at(6, 6, 5) = 0.01F * value;
  EXPECT_EQ(verdict().status, Status::Pass) << verdict().message;
  EXPECT_NEAR(verdict().bound_ratio, 0.07 * value / (0.08 * value + golden_.at(6, 6, 5)), 1e-4);
  candidate_.at(6, 6, 5) = 0.008F * value;
  EXPECT_EQ(verdict().status, Status::Fail);
  candidate_.at(6, 6, 5) = 1e30F;
  golden_.channels.insert(golden_.channels.end(), {"direction.R", "direction.G", "direction.B"});
  std::vector<float> wider;
  for (std::size_t i = 0; i < golden_.data.size(); i += 9) {
    wider.insert(wider.end(), golden_.data.begin() + static_cast<std::ptrdiff_t>(i),
                 golden_.data.begin() + static_cast<std::ptrdiff_t>(i + 9));
    wider.insert(wider.end(), {0.0F, 0.0F, 0.0F});
  }
  golden_.data = wider;
  EXPECT_EQ(verdict().status, Status::Fail) << "what replicas show is not believed beyond what directions bring";
  golden_.at(6, 6, golden_.channel("direction.G")) = 0.004F * value;
  EXPECT_EQ(verdict().status, Status::Pass) << verdict().message;
  candidate_.at(6, 6, 5) = 0.01F * value;
  rules_.standard_errors = 0;
  EXPECT_EQ(verdict().status, Status::Fail);
}

TEST_F(VerdictRulesTest, MirroredPixelsAreLeftOutOnlyIfTheRulesSaySo) {
  golden_.channels.push_back("mirrored");
  std::vector<float> data;
  for (std::size_t i = 0; i < static_cast<std::size_t>(width) * height; ++i) {
    data.insert(data.end(), golden_.data.begin() + static_cast<std::ptrdiff_t>(9 * i),
                golden_.data.begin() + static_cast<std::ptrdiff_t>(9 * i + 9));
    data.push_back(i == 5 ? 1.0F : 0.0F);
  }
  golden_.data = data;
  candidate_.at(5, 0, 0) = 3.0F;
  EXPECT_EQ(verdict().status, Status::Fail);
  rules_.leave_out_mirrored = true;
  EXPECT_EQ(verdict().status, Status::Pass);
  EXPECT_EQ(verdict().mirrored_pixels, 1);
  EXPECT_EQ(verdict().compared_pixels, 99);
}

TEST_F(VerdictRulesTest, WithinItsBoundAValueMayBeNegativeOnlyIfTheRulesSaySo) {
  golden_.at(1, 3, 0) = 0.01F;
  golden_.at(1, 3, 4) = 0.03F;
  candidate_.at(1, 3, 0) = -0.01F;
  EXPECT_EQ(verdict().status, Status::Fail);
  EXPECT_EQ(verdict().negative_pixels, 1);
  rules_.may_be_negative = true;
  EXPECT_EQ(verdict().status, Status::Pass);
  golden_.at(1, 3, 4) = 0.005F;
  EXPECT_EQ(verdict().negative_pixels, 1) << "where the bound does not reach below zero";
  golden_.at(1, 3, golden_.channel("excluded")) = 1.0F;
  EXPECT_EQ(verdict().negative_pixels, 0) << "another surface may show";
  rules_.may_be_negative = false;
  EXPECT_EQ(verdict().negative_pixels, 1) << "no surface may show that";
}

TEST_F(VerdictRulesTest, AToleranceIsGrantedBeyondTheBoundAndToColoursAlone) {
  for (const auto& [relative, absolute] : {std::pair{1e-2, 0.0}, std::pair{0.0, 3e-3}, std::pair{1e-2, 3e-3}}) {
    VerdictRules rules;
    rules.relative_tolerance = relative;
    rules.absolute_tolerance = absolute;
    const double granted = relative * golden_.at(6, 6, 1) + absolute;
    image::Image off = candidate_;
    off.at(6, 6, 1) = static_cast<float>(golden_.at(6, 6, 1) + golden_.at(6, 6, 5) + 0.98 * granted);
    EXPECT_EQ(judge(off, golden_, rules).status, Status::Pass) << relative << " and " << absolute;
    EXPECT_EQ(judge(off, golden_, {}).status, Status::Fail) << "nothing is granted unasked";
    off.at(6, 6, 1) = static_cast<float>(golden_.at(6, 6, 1) + golden_.at(6, 6, 5) + 1.02 * granted);
    EXPECT_EQ(judge(off, golden_, rules).status, Status::Fail) << relative << " and " << absolute;
    off = candidate_;
    off.at(6, 6, 3) -= static_cast<float>(0.5 * granted);
    EXPECT_EQ(judge(off, golden_, rules).status, Status::Fail) << "coverage is granted nothing";
  }
}

/// A golden of which the rules of GLSL ES promise nothing in the first so many columns.
class UnpromisedTest : public VerdictRulesTest {
 protected:
  void leave_unpromised(int columns) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < columns; ++x) {
        golden_.at(x, y, 7) = 4.0F;
        candidate_.at(x, y, 0) = 1e6F;
      }
    }
  }
};

TEST_F(UnpromisedTest, PixelsCountAmongTheExcludedAndAreTold) {
  leave_unpromised(5);
  const Verdict v = verdict();
  EXPECT_EQ(v.status, Status::Invalid);
  EXPECT_EQ(v.excluded_by, (std::array<std::int64_t, 5>{0, 0, 0, 0, 50}));
  EXPECT_NE(v.message.find("50 where the rules of GLSL ES promise nothing"), std::string::npos) << v.message;
}

TEST_F(UnpromisedTest, PixelsAreLeftOutHoweverManyIfTheRulesSaySo) {
  rules_.leave_out_unpromised = true;
  for (const int columns : {5, 10}) {
    leave_unpromised(columns);
    const Verdict v = verdict();
    EXPECT_EQ(v.status, Status::Pass) << v.message;
    EXPECT_EQ(v.compared_pixels, 100 - 10 * columns);
    EXPECT_NE(v.message.find("of " + percent(0.1 * columns) + " of the covered pixels the rules of GLSL ES promise no more"),
              std::string::npos)
        << v.message;
  }
}

TEST_F(UnpromisedTest, PixelsMayBeAllThatIsLeftBesideAFewEdges) {
  rules_.leave_out_unpromised = true;
  leave_unpromised(10);
  golden_.at(7, 1, 7) = 1.0F;
  golden_.at(7, 2, 7) = 1.0F;
  EXPECT_EQ(verdict().status, Status::Pass) << verdict().message;
  golden_.at(7, 3, 7) = 1.0F;
  EXPECT_EQ(verdict().status, Status::Invalid) << "three of a hundred are too many";
}

TEST_F(UnpromisedTest, PixelsMustBeFiniteAndNotNegative) {
  rules_.leave_out_unpromised = true;
  leave_unpromised(5);
  for (const float value : {nan_value, infinite_value, -1e-6F}) {
    image::Image off = candidate_;
    off.at(2, 2, 1) = value;
    EXPECT_EQ(judge(off, golden_, rules_).status, Status::Fail) << value;
  }
}

TEST_F(UnpromisedTest, PixelsExcuseNeitherTheOthersNorOtherReasons) {
  rules_.leave_out_unpromised = true;
  leave_unpromised(5);
  image::Image off = candidate_;
  off.at(7, 2, 1) += 0.5F;
  EXPECT_EQ(judge(off, golden_, rules_).status, Status::Fail) << "a pixel of which something is promised";
  for (int y = 0; y < 3; ++y) {
    golden_.at(7, y, 7) = 1.0F;
  }
  EXPECT_EQ(verdict().status, Status::Invalid) << "three of a hundred covered pixels at edges are too many still";
}

}  // namespace
}  // namespace sheen::conformance
