#include "conformance/report.h"

#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace sheen::conformance {
namespace {

using nlohmann::json;

RunRecord record_of(const std::vector<Status>& statuses) {
  RunRecord record;
  record.suite = "core";
  record.viewer.name = "viewer <1>";
  for (const Status status : statuses) {
    CaseResult one;
    one.name = "case_" + std::to_string(record.cases.size());
    one.status = status;
    one.width = one.height = 8;
    record.cases.push_back(one);
  }
  return record;
}

TEST(Results, OkMeansThatAllPassed) {
  EXPECT_TRUE(summarize(record_of({Status::Pass, Status::Pass}), false).ok);
  for (const Status bad : {Status::Fail, Status::Crash, Status::Timeout, Status::Invalid}) {
    EXPECT_FALSE(summarize(record_of({Status::Pass, bad}), false).ok) << to_string(bad);
  }
  EXPECT_TRUE(summarize(record_of({Status::Pass, Status::Unsupported}), false).ok);
  EXPECT_FALSE(summarize(record_of({Status::Unsupported}), false).ok) << "a viewer that draws nothing has not passed";
  EXPECT_FALSE(summarize(record_of({}), false).ok);
  EXPECT_TRUE(summarize(record_of({}), true).ok) << "a shard may be empty";
}

TEST(Results, ApproximationPassesUnlessStrict) {
  RunRecord record = record_of({Status::Approximation});
  EXPECT_TRUE(summarize(record, false).ok);
  record.strict = true;
  EXPECT_FALSE(summarize(record, false).ok);
}

TEST(Results, JsonHasTheMembersOfTheContract) {
  RunRecord record = record_of({Status::Pass, Status::Crash});
  Verdict verdict;
  verdict.status = Status::Pass;
  verdict.worst_x = 3;
  verdict.worst_y = 4;
  verdict.compared_pixels = 9;
  verdict.bound_ratio = 0.5;
  verdict.median_bound = 0.25;
  verdict.vague_pixels = 2;
  verdict.negative_pixels = 1;
  record.cases[0].verdict = verdict;
  const json root = json::parse(results_json(record));
  for (const char* key : {"suite", "viewer", "context", "summary", "seconds", "cases"}) {
    EXPECT_TRUE(root.contains(key)) << key;
  }
  for (const char* key : {"pass", "approximation", "fail", "unsupported", "crash", "timeout", "invalid"}) {
    EXPECT_TRUE(root["summary"].contains(key)) << key;
  }
  EXPECT_EQ(root["summary"]["crash"], 1);
  for (const json& one : root["cases"]) {
    for (const char* key :
         {"name", "status", "max_abs", "max_rel", "p99_rel", "worst_pixel", "bound_ratio", "compared_pixels", "excluded_pixels",
          "excluded_by", "nonfinite_pixels", "median_bound", "vague_pixels", "negative_pixels", "identified", "seconds", "message"}) {
      EXPECT_TRUE(one.contains(key)) << key;
    }
  }
  EXPECT_EQ(root["cases"][0]["worst_pixel"], json::array({3, 4}));
  EXPECT_EQ(root["cases"][0]["bound_ratio"], 0.5);
  EXPECT_EQ(root["cases"][0]["median_bound"], 0.25);
  EXPECT_EQ(root["cases"][0]["vague_pixels"], 2);
  EXPECT_EQ(root["cases"][0]["negative_pixels"], 1);
  for (const char* key : {"bound_ratio", "median_bound", "vague_pixels", "negative_pixels"}) {
    EXPECT_TRUE(root["cases"][1][key].is_null()) << key << ": nothing was compared";
  }
}

TEST(Results, WhatWasLeftOutIsToldThoughNothingWasCompared) {
  RunRecord record = record_of({Status::Pass});
  record.cases[0].verdict = Verdict{};
  record.cases[0].verdict->excluded_pixels = 40;
  record.cases[0].verdict->excluded_by = {0, 30, 4, 0, 6};
  const json one = json::parse(results_json(record))["cases"][0];
  EXPECT_EQ(one["excluded_pixels"], 40);
  EXPECT_EQ(one["excluded_by"], (json{{"edges", 30}, {"masks", 4}, {"textures", 0}, {"unpromised", 6}}));
  EXPECT_EQ(one["compared_pixels"], 0);
  EXPECT_TRUE(one["bound_ratio"].is_null()) << "an error of 0 is a measured one";
}

TEST(Results, JsonStaysJsonWhateverTheNumbers) {
  RunRecord record = record_of({Status::Fail});
  Verdict verdict;
  verdict.bound_ratio = std::numeric_limits<double>::infinity();
  verdict.max_rel = std::numeric_limits<double>::quiet_NaN();
  record.cases[0].verdict = verdict;
  record.cases[0].message = "bytes \xff\xfe no text";
  EXPECT_TRUE(json::parse(results_json(record), nullptr, false).is_object());
}

TEST(Report, HoldsItselfAndEscapesWhatAViewerSays) {
  RunRecord record = record_of({Status::Fail, Status::Pass});
  record.cases[0].message = "<script>alert(1)</script>";
  record.cases[0].pictures.candidate = {1, 2, 3};
  const std::string html = report_html(record);
  EXPECT_EQ(html.find("<script>alert"), std::string::npos);
  EXPECT_NE(html.find("&lt;script&gt;alert"), std::string::npos);
  EXPECT_NE(html.find("viewer &lt;1&gt;"), std::string::npos);
  EXPECT_NE(html.find("data:image/png;base64,AQID"), std::string::npos);
  for (const char* outside : {"http:", "https:", "href=", "src=\"images", "@import", "url("}) {
    EXPECT_EQ(html.find(outside), std::string::npos) << outside;
  }
  EXPECT_LT(html.find("case_0"), html.find("case_1")) << "failures first";
}

TEST(Report, ShowsTheMedianBoundAndWhatIsNegativeOfEachCaseThatHasThem) {
  RunRecord record = record_of({Status::Fail, Status::Pass});
  for (CaseResult& one : record.cases) {
    one.verdict = Verdict{};
  }
  const auto times = [&record](const std::string& text) {
    const std::string html = report_html(record);
    int count = 0;
    for (std::size_t at = html.find(text); at != std::string::npos; at = html.find(text, at + 1)) {
      ++count;
    }
    return count;
  };
  EXPECT_EQ(times("median bound"), 0) << "a law between pictures has none";
  record.cases[0].verdict->median_bound = 0.000125;
  record.cases[1].verdict->median_bound = 0.00025;
  record.cases[0].verdict->negative_pixels = 17;
  EXPECT_EQ(times("median bound"), 2);
  EXPECT_EQ(times("median bound <b>0.000125</b>"), 1);
  EXPECT_EQ(times("median bound <b>0.00025</b>"), 1);
  EXPECT_EQ(times("negative <b>17</b>"), 1);
}

TEST(Base64, IsThatOfItsRfc) {
  const auto encoded = [](const std::string& text) { return base64({text.begin(), text.end()}); };
  EXPECT_EQ(encoded(""), "");
  EXPECT_EQ(encoded("f"), "Zg==");
  EXPECT_EQ(encoded("fo"), "Zm8=");
  EXPECT_EQ(encoded("foo"), "Zm9v");
  EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
}

TEST(PaintRatios, TellsWithinFromWithoutAndLeftOut) {
  const image::Image painted = paint_ratios({0, 0.99, 1.01, -1, std::numeric_limits<double>::infinity()}, 5, 1);
  EXPECT_EQ(painted.at(0, 0, 0) + painted.at(0, 0, 1) + painted.at(0, 0, 2), 0.0F);
  EXPECT_LT(painted.at(1, 0, 0), 0.6F);
  EXPECT_EQ(painted.at(2, 0, 0), 1.0F);
  EXPECT_GT(painted.at(3, 0, 2), painted.at(3, 0, 0));
  EXPECT_EQ(painted.at(4, 0, 2), 1.0F);
}

}  // namespace
}  // namespace sheen::conformance
