#include "renderer/function_evaluator.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "renderer/functions.h"
#include "renderer/renderer_fixture.h"

namespace sheen::renderer {
namespace {

class FunctionEvaluatorTest : public testing::Test {
 protected:
  std::unique_ptr<gles::Context> context_ = gles::Context::create_any(gles::ContextKind::OsMesa);
  FunctionEvaluator evaluator_{*context_};

  /// Arguments whose number i at (x, y) is value(x, y, i).
  template <class Value>
  static image::Image arguments(int width, int rows, int scalars, const Value& value) {
    image::Image picture(width, rows * ((scalars + 3) / 4), {"R", "G", "B", "A"});
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < width; ++x) {
        for (int i = 0; i < scalars; ++i) {
          picture.at(x, y + rows * (i / 4), i % 4) = value(x, y, i);
        }
      }
    }
    return picture;
  }
};

TEST_F(FunctionEvaluatorTest, CompilesEveryFunctionInEveryPrecisionAndFormulation) {
  for (const ShaderFunction& function : shader_functions()) {
    const image::Image halves = arguments(2, 2, function.scalars(), [](int, int, int) { return 0.5F; });
    for (const Precision precision : {Precision::Highp, Precision::Mediump}) {
      for (const Formulation formulation : {Formulation::Literal, Formulation::Stable}) {
        Settings settings;
        settings.precision = precision;
        settings.formulation = formulation;
        const image::Image result = evaluator_.evaluate(function.name, halves, 2, settings);
        EXPECT_TRUE(std::isfinite(result.at(1, 1, 0))) << function.name;
        EXPECT_EQ(result.at(0, 0, 3), 1.0F) << function.name;
      }
    }
  }
}

TEST_F(FunctionEvaluatorTest, GivesEachPixelItsOwnArguments) {
  const auto value = [](int x, int y, int i) { return static_cast<float>(1 + x + 8 * y + 64 * i); };
  const image::Image sums = evaluator_.evaluate("add", arguments(3, 4, 2, value), 4, {});
  const image::Image crosses = evaluator_.evaluate("cross", arguments(3, 4, 6, value), 4, {});
  ASSERT_EQ(sums.width, 3);
  ASSERT_EQ(sums.height, 4);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 3; ++x) {
      EXPECT_EQ(sums.at(x, y, 0), value(x, y, 0) + value(x, y, 1));
      const auto a = [&](int i) { return value(x, y, i); };
      EXPECT_EQ(crosses.at(x, y, 0), a(1) * a(5) - a(2) * a(4));
      EXPECT_EQ(crosses.at(x, y, 2), a(0) * a(4) - a(1) * a(3));
    }
  }
}

TEST_F(FunctionEvaluatorTest, FollowsTheFormulation) {
  // Beyond a cosine of 1 the printed power has a negative base, of which GLSL says "undefined if x < 0"; the stable form holds it at 0.
  const image::Image beyond = arguments(1, 1, 1, [](int, int, int) { return std::nextafterf(1.0F, 2.0F); });
  Settings settings;
  EXPECT_EQ(evaluator_.evaluate("fresnel_weight", beyond, 1, settings).at(0, 0, 0), 0.0F);
  const image::Image quarter = arguments(1, 1, 1, [](int, int, int) { return 0.25F; });
  settings.formulation = Formulation::Literal;
  EXPECT_NEAR(evaluator_.evaluate("fresnel_weight", quarter, 1, settings).at(0, 0, 0), std::pow(0.75, 5), 1e-5);
}

TEST_F(FunctionEvaluatorTest, ReadsTheTableOfTheVisibilityThatItIsNamedAfter) {
  const image::Image at = arguments(1, 1, 2, [](int, int, int) { return 0.5F; });
  // E(0.5, 0.5), from a quadrature made apart.
  EXPECT_NEAR(evaluator_.evaluate("sheen_albedo_charlie", at, 1, {}).at(0, 0, 0), 0.187853931, 2e-5);
  EXPECT_NEAR(evaluator_.evaluate("sheen_albedo_ashikhmin", at, 1, {}).at(0, 0, 0), 0.229552784, 2e-5);
}

TEST_F(FunctionEvaluatorTest, RefusesWhatItDoesNotKnowAndArgumentsThatDoNotFit) {
  const image::Image two_rows = arguments(2, 2, 4, [](int, int, int) { return 0.5F; });
  EXPECT_THROW(evaluator_.evaluate("sheen", two_rows, 2, {}), std::invalid_argument);
  EXPECT_THROW(evaluator_.evaluate("cross", two_rows, 2, {}), std::invalid_argument);
  EXPECT_THROW(evaluator_.evaluate("exp", image::Image(2, 2, {"R"}), 2, {}), std::invalid_argument);
  EXPECT_NO_THROW(evaluator_.evaluate("exp", two_rows, 2, {}));
}

}  // namespace
}  // namespace sheen::renderer
