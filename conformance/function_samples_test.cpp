#include "conformance/function_samples.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "number/precision.h"

namespace sheen::conformance {
namespace {

constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();

/// A function of which 1 within 3 ulp is promised at every sample but the last, of which nothing is.
FunctionSamples four_samples() {
  FunctionSamples samples;
  samples.spec.name = "f";
  samples.spec.format = {number::Highp::fraction_bits, number::Highp::min_exponent};
  samples.spec.parameters = {cosine_parameter("x", samples.spec.format)};
  for (int i = 0; i < 4; ++i) {
    samples.values.push_back({0.25 * i});
    samples.promises.push_back({{1, {1 - 3 * 0x1p-24, 1 + 3 * 0x1p-23}, 1}});
  }
  constexpr double infinity = std::numeric_limits<double>::infinity();
  samples.promises.back() = {{1, {-infinity, infinity}, 1}};
  return samples;
}

image::Image measured(float a, float b, float c, float d) {
  image::Image picture(2, 2, {"R", "G", "B", "A"});
  picture.at(0, 0, 0) = a;
  picture.at(1, 0, 0) = b;
  picture.at(0, 1, 0) = c;
  picture.at(1, 1, 0) = d;
  return picture;
}

Verdict judged(const FunctionSamples& samples, const image::Image& picture) {
  return judge_samples(samples, hold_to_promises(samples, picture), 2);
}

TEST(FunctionSamples, InsideTheBoundPassesAndOneUlpBeyondFails) {
  const FunctionSamples samples = four_samples();
  const float up = 1 + 3 * 0x1p-23F;
  const Verdict inside = judged(samples, measured(1, up, 1 - 3 * 0x1p-24F, 7));
  EXPECT_EQ(inside.status, Status::Pass) << inside.message;
  EXPECT_EQ(inside.bound_ratio, 1);
  EXPECT_EQ(inside.compared_pixels, 3);
  EXPECT_EQ(inside.excluded_pixels, 1);
  const Verdict above = judged(samples, measured(1, std::nextafterf(up, 2), 1, 7));
  EXPECT_EQ(above.status, Status::Fail);
  EXPECT_NEAR(above.bound_ratio, 4.0 / 3, 1e-9);
  EXPECT_EQ(above.worst_x, 1);
  EXPECT_EQ(above.worst_y, 0);
  EXPECT_NE(above.message.find("outside its bound at x 0.25"), std::string::npos) << above.message;
  const Verdict below = judged(samples, measured(1, 1, std::nextafterf(1 - 3 * 0x1p-24F, 0), 7));
  EXPECT_EQ(below.status, Status::Fail);
  EXPECT_EQ(below.worst_y, 1);
}

TEST(FunctionSamples, AnEndThatIsNoNumberOfTheFormatIsRoundedOutward) {
  FunctionSamples samples = four_samples();
  // 3.1 ulp above 1 lies between two floats: an implementation can give the outer one, and the conformance tests let it.
  samples.promises[0].front().range.upper = 1 + 3.1 * 0x1p-23;
  EXPECT_EQ(judged(samples, measured(1 + 4 * 0x1p-23F, 1, 1, 1)).status, Status::Pass);
  EXPECT_EQ(judged(samples, measured(1 + 5 * 0x1p-23F, 1, 1, 1)).status, Status::Fail);
}

TEST(FunctionSamples, AFlushedValueIsNoError) {
  FunctionSamples samples = four_samples();
  samples.promises[0] = {{0x1p-127, {0, 0x1p-126}, 0x1p-127}};
  const Verdict flushed = judged(samples, measured(0, 1, 1, 1));
  EXPECT_EQ(flushed.status, Status::Pass);
  EXPECT_EQ(flushed.bound_ratio, 0);
  samples.promises[0] = {{0x1p-120, {0x1p-121, 0x1p-119}, 0x1p-120}};
  EXPECT_EQ(judged(samples, measured(0, 1, 1, 1)).status, Status::Fail) << "a normal number must not vanish";
}

TEST(FunctionSamples, WhatIsNotFiniteFailsWhereAValueIsPromisedAndCountsEverywhere) {
  const FunctionSamples samples = four_samples();
  for (const float bad : {nan_value, std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()}) {
    const Verdict promised = judged(samples, measured(1, bad, 1, 1));
    EXPECT_EQ(promised.status, Status::Fail);
    EXPECT_EQ(promised.nonfinite_pixels, 1);
    const Verdict unpromised = judged(samples, measured(1, 1, 1, bad));
    EXPECT_EQ(unpromised.status, Status::Pass);
    EXPECT_EQ(unpromised.nonfinite_pixels, 1);
  }
}

TEST(FunctionSamples, WhatIsDrawnMustBeFiniteEverywhere) {
  FunctionSamples samples = four_samples();
  samples.must_be_finite = true;
  EXPECT_EQ(judged(samples, measured(1, 1, 1, 1e30F)).status, Status::Pass);
  const Verdict verdict = judged(samples, measured(1, 1, 1, nan_value));
  EXPECT_EQ(verdict.status, Status::Fail);
  EXPECT_NE(verdict.message.find("NaN at x 0.75"), std::string::npos) << verdict.message;
}

TEST(FunctionSamples, NothingPromisedJudgesNothing) {
  FunctionSamples samples = four_samples();
  for (auto& promise : samples.promises) {
    promise = samples.promises.back();
  }
  EXPECT_EQ(judged(samples, measured(1, 1, 1, 1)).status, Status::Invalid);
}

TEST(FunctionSamples, EveryChannelIsHeldToItsOwnPromise) {
  FunctionSamples samples = four_samples();
  for (auto& promise : samples.promises) {
    promise.push_back({5, {4, 6}, 5});
  }
  image::Image picture = measured(1, 1, 1, 1);
  for (int i = 0; i < 4; ++i) {
    picture.at(i % 2, i / 2, 1) = 5;
  }
  EXPECT_EQ(judged(samples, picture).status, Status::Pass);
  picture.at(0, 1, 1) = 7;
  EXPECT_EQ(judged(samples, picture).status, Status::Fail);
}

TEST(FunctionSamples, AreArgumentsOfTheFormatLaidOutFourARow) {
  FunctionCase one;
  one.function = "sheen_distribution";
  one.precision = renderer::Precision::Mediump;
  one.arguments = ArgumentSet::Random;
  one.width = 5;
  one.height = 3;
  const FunctionSamples samples = make_samples(one);
  ASSERT_EQ(samples.arguments.size(), 15U);
  for (const auto& arguments : samples.arguments) {
    ASSERT_EQ(arguments.size(), 7U);
    for (const double x : arguments) {
      EXPECT_TRUE(number::is_representable<number::Mediump>(x)) << x;
    }
  }
  const image::Image picture = argument_picture(samples, 5, 3);
  EXPECT_EQ(picture.height, 6);
  EXPECT_EQ(picture.at(4, 1, 2), static_cast<float>(samples.arguments[9][2]));
  EXPECT_EQ(picture.at(4, 1 + 3, 2), static_cast<float>(samples.arguments[9][6]));
}

}  // namespace
}  // namespace sheen::conformance
