#include "conformance/judge_function.h"

#include <gtest/gtest.h>

#include "conformance/function_findings.h"
#include "conformance/function_samples.h"
#include "conformance/report_function.h"
#include "conformance/test_folder.h"
#include "image/io.h"

namespace sheen::conformance {
namespace {

/// Judges what a viewer of the test's own gives.
class JudgeFunctionTest : public testing::Test {
 protected:
  TestFolder folder_;
  Hello hello_;
  FunctionCase case_;

  void SetUp() override {
    hello_.name = "fake";
    hello_.capabilities = {"functions"};
    case_.name = "d";
    case_.function = "sheen_distribution";
    case_.width = 16;
    case_.height = 16;
  }

  /// The exact values, and one of them off by a share of itself.
  image::Image values(double off) const {
    const FunctionSamples samples = make_samples(case_);
    image::Image picture(case_.width, case_.height, {"R", "G", "B", "A"});
    const std::size_t spoiled = largest();
    for (std::size_t i = 0; i < samples.promises.size(); ++i) {
      picture.data[4 * i] = static_cast<float>(samples.promises[i].front().value * (i == spoiled ? 1 + off : 1));
    }
    return picture;
  }
  /// The sample of the largest value, which no flushing reaches.
  std::size_t largest() const {
    const FunctionSamples samples = make_samples(case_);
    std::size_t at = 0;
    for (std::size_t i = 0; i < samples.promises.size(); ++i) {
      at = samples.promises[i].front().value > samples.promises[at].front().value ? i : at;
    }
    return at;
  }
  CaseResult judge_with(const image::Image& picture) {
    return judge_function(
        case_,
        [&picture](const FunctionRequest& request) {
          EXPECT_EQ(request.function, "sheen_distribution");
          EXPECT_EQ(request.precision, "highp");
          EXPECT_EQ(request.formulation, "stable");
          EXPECT_EQ(image::read(request.arguments).width, request.width);
          image::write(request.output, picture);
          return Answer{AnswerStatus::Rendered, request.output, 0.5, ""};
        },
        hello_, folder_.path());
  }
};

TEST_F(JudgeFunctionTest, TheExactValuesPassWithTheirPlotsAndMap) {
  const CaseResult result = judge_with(values(0));
  EXPECT_EQ(result.status, Status::Pass) << result.message;
  ASSERT_TRUE(result.findings);
  EXPECT_EQ(result.findings->nan_samples, 0);
  EXPECT_FALSE(result.findings->map.empty());
  EXPECT_NE(result.findings->plots.find(">sheen_roughness<"), std::string::npos);
  EXPECT_EQ(result.verdict->compared_pixels, 256);
}

TEST_F(JudgeFunctionTest, OneValueOutsideItsBoundFails) {
  const CaseResult result = judge_with(values(1e-3));
  EXPECT_EQ(result.status, Status::Fail);
  EXPECT_GT(result.verdict->bound_ratio, 1);
  EXPECT_EQ(result.verdict->worst_x, static_cast<int>(largest() % 16));
  EXPECT_EQ(result.verdict->worst_y, static_cast<int>(largest() / 16));
  EXPECT_NE(result.message.find("outside its bound at sheen_roughness"), std::string::npos) << result.message;
}

TEST_F(JudgeFunctionTest, AViewerThatDoesNotEvaluateIsNotAsked) {
  hello_.capabilities = {"settings"};
  const CaseResult result = judge_function(
      case_,
      [](const FunctionRequest&) -> Answer {
        ADD_FAILURE() << "it was asked";
        return {};
      },
      hello_, folder_.path());
  EXPECT_EQ(result.status, Status::Unsupported);
}

TEST_F(JudgeFunctionTest, WhatGoesWrongWithTheViewerIsTheCasesStatus) {
  const auto status_with = [this](const Answer& answer) {
    return judge_function(
               case_, [&answer](const FunctionRequest&) { return answer; }, hello_, folder_.path())
        .status;
  };
  EXPECT_EQ(status_with({AnswerStatus::Crash, {}, 0, "died"}), Status::Crash);
  EXPECT_EQ(status_with({AnswerStatus::Failed, {}, 0, "no such function"}), Status::Fail);
  EXPECT_EQ(status_with({AnswerStatus::Rendered, folder_.path() / "missing.exr", 0, ""}), Status::Invalid);
  EXPECT_EQ(judge_with(image::Image(8, 8, {"R", "G", "B"})).status, Status::Invalid);
}

TEST_F(JudgeFunctionTest, TheTableSetsThePrintedFormBesideTheStableOne) {
  RunRecord record;
  record.cases.push_back(judge_with(values(0)));
  EXPECT_EQ(formulation_table(record), "") << "without a printed form there is nothing to compare";
  FunctionFindings printed = *record.cases[0].findings;
  printed.tested.formulation = renderer::Formulation::Literal;
  printed.nan_samples = 321;
  printed.largest_error = 0.25;
  printed.largest_at = "theta_h 0.5";
  record.cases.emplace_back();
  record.cases[1].findings = std::make_shared<const FunctionFindings>(printed);
  const std::string table = formulation_table(record);
  EXPECT_NE(table.find("<td>sheen_distribution</td><td>highp</td><td><b>321</b></td><td>0</td><td><span title=\"theta_h 0.5\">0.25<"),
            std::string::npos)
      << table;
  EXPECT_NE(table.find("<td>0</td><td>0</td>"), std::string::npos) << "the stable form has no NaN";
}

}  // namespace
}  // namespace sheen::conformance
