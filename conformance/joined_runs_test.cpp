#include "conformance/joined_runs.h"

#include <fstream>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "conformance/test_folder.h"

namespace sheen::conformance {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

CaseResult result_of(const std::string& name, Status status, double bound_ratio = 0.5) {
  CaseResult one;
  one.name = name;
  one.status = status;
  Verdict verdict;
  verdict.bound_ratio = bound_ratio;
  verdict.p99_rel = 1e-5;
  verdict.median_bound = 2e-4;
  verdict.compared_pixels = 90;
  verdict.excluded_pixels = 10;
  one.verdict = verdict;
  return one;
}

RunRecord record_of(const std::string& suite, const std::string& renderer, const std::vector<CaseResult>& cases) {
  RunRecord record;
  record.suite = suite;
  record.viewer.name = "sheen-cts";
  record.viewer.renderer = renderer;
  record.viewer.context_version = "OpenGL ES 3.1";
  record.viewer.mediump_bits = 10;
  record.viewer.subpixel_bits = 8;
  record.seconds = 2;
  record.cases = cases;
  return record;
}

/// Writes results.json files as a run does, and joins them.
class JoinedRunsTest : public testing::Test {
 protected:
  fs::path write(const std::string& folder, const std::string& text) const {
    const fs::path path = folder_.path() / folder;
    fs::create_directories(path);
    std::ofstream(path / "results.json") << text;
    return path;
  }
  fs::path write(const std::string& folder, const RunRecord& record) const { return write(folder, results_json(record)); }

  /// What is said of a results.json of that text.
  std::string refusal_of(const std::string& text) const {
    try {
      join_runs({{"one", write("refused", text)}});
    } catch (const ResultsError& error) {
      return error.what();
    }
    return "nothing";
  }

  TestFolder folder_;
};

TEST_F(JoinedRunsTest, WhatARunWritesIsReadBack) {
  const fs::path run = write("a", record_of("core", "llvmpipe (LLVM)", {result_of("first", Status::Pass, 0.25)}));
  const JoinedRuns joined = join_runs({{"one", run}});
  ASSERT_EQ(joined.drivers.size(), 1U);
  const DriverColumn& driver = joined.drivers[0];
  EXPECT_EQ(driver.name, "one");
  EXPECT_EQ(driver.renderer, "llvmpipe (LLVM)");
  EXPECT_EQ(driver.version, "OpenGL ES 3.1");
  EXPECT_EQ(driver.subpixel_bits, 8);
  EXPECT_EQ(driver.mediump_bits, 10);
  EXPECT_EQ(driver.seconds, 2);
  EXPECT_EQ(driver.folders, std::vector<fs::path>{run});
  ASSERT_EQ(joined.cases.size(), 1U);
  EXPECT_EQ(joined.cases[0].suite, "core");
  const CaseFigures figures = joined.cases[0].cells.at(0).value();
  EXPECT_EQ(figures.status, Status::Pass);
  EXPECT_EQ(figures.bound_ratio, 0.25);
  EXPECT_EQ(figures.p99_rel, 1e-5);
  EXPECT_EQ(figures.median_bound, 2e-4);
  EXPECT_EQ(excluded_share(figures), 0.1);
}

TEST_F(JoinedRunsTest, ACaseThatOneDriverLacksIsMissingAndNotPassed) {
  const CaseResult first = result_of("first", Status::Pass);
  const CaseResult second = result_of("second", Status::Pass);
  const fs::path all = write("a", record_of("core", "x", {first, second}));
  const fs::path some = write("b", record_of("core", "y", {second}));
  const JoinedRuns joined = join_runs({{"all", all}, {"some", some}});
  ASSERT_EQ(joined.cases.size(), 2U);
  EXPECT_EQ(joined.cases[0].name, "first");
  EXPECT_TRUE(joined.cases[0].cells.at(0).has_value());
  EXPECT_FALSE(joined.cases[0].cells.at(1).has_value());
  EXPECT_EQ(joined.totals(1).missing, 1);
  EXPECT_FALSE(joined.ok());
  EXPECT_TRUE(join_runs({{"all", all}}).ok());
  const json root = json::parse(joined_json(joined));
  EXPECT_TRUE(root["cases"][0]["drivers"]["some"].is_null());
  EXPECT_EQ(root["cases"][0]["drivers"]["all"]["status"], "pass");
  EXPECT_EQ(root["cases"][0]["drivers"]["all"]["median_bound"], 2e-4);
  EXPECT_EQ(root["drivers"][1]["summary"]["missing"], 1);
}

TEST_F(JoinedRunsTest, SuitesOfOneDriverShareItsColumnAndStandTogether) {
  const CaseResult one = result_of("one", Status::Pass);
  const CaseResult two = result_of("two", Status::Pass);
  const JoinedRuns joined = join_runs({{"a", write("a-core", record_of("core", "x", {one}))},
                                       {"a", write("a-other", record_of("other", "x", {one}))},
                                       {"b", write("b-core", record_of("core", "y", {one, two}))},
                                       {"b", write("b-other", record_of("other", "y", {one}))}});
  ASSERT_EQ(joined.drivers.size(), 2U);
  EXPECT_EQ(joined.drivers[0].seconds, 4);
  std::vector<std::string> names;
  for (const CaseRow& row : joined.cases) {
    names.push_back(row.suite + "." + row.name);
  }
  EXPECT_THAT(names, testing::ElementsAre("core.one", "core.two", "other.one"));
}

TEST_F(JoinedRunsTest, AColumnIsOneDriverAndEachCaseIsInItOnce) {
  const CaseResult one = result_of("one", Status::Pass);
  const fs::path core = write("a", record_of("core", "x", {one}));
  EXPECT_EQ(join_runs({{"a", core}, {"a", write("shard", record_of("core", "x", {result_of("two", Status::Pass)}))}}).cases.size(), 2U);
  EXPECT_THROW(join_runs({{"a", core}, {"a", core}}), ResultsError);
  EXPECT_THROW(join_runs({{"a", core}, {"a", write("b", record_of("other", "another renderer", {one}))}}), ResultsError);
  EXPECT_NO_THROW(join_runs({{"a", core}, {"b", core}}));
}

TEST_F(JoinedRunsTest, AFailureOfOneDriverIsAFailureOfAll) {
  const fs::path good = write("good", record_of("core", "x", {result_of("one", Status::Pass)}));
  for (const Status status : statuses) {
    const JoinedRuns joined = join_runs({{"good", good}, {"other", write("other", record_of("core", "y", {result_of("one", status)}))}});
    const bool passes = status == Status::Pass || status == Status::Approximation || status == Status::Unsupported;
    EXPECT_EQ(joined.ok(), passes) << to_string(status);
    EXPECT_EQ(joined.totals(1).counts.at(status), 1);
    EXPECT_EQ(json::parse(joined_json(joined))["drivers"][1]["summary"][to_string(status)], 1);
  }
}

TEST_F(JoinedRunsTest, TotalsAreOverTheCasesThatWereMeasured) {
  CaseResult crashed = result_of("crashed", Status::Crash);
  crashed.verdict.reset();
  const double infinity = std::numeric_limits<double>::infinity();
  const fs::path run = write("a", record_of("core", "x",
                                            {result_of("a", Status::Pass, 0.1), result_of("b", Status::Pass, 0.2),
                                             result_of("c", Status::Fail, 3), crashed, result_of("d", Status::Fail, infinity)}));
  const ColumnTotals totals = join_runs({{"a", run}}).totals(0);
  EXPECT_EQ(totals.median_bound_ratio, 0.2);
  EXPECT_EQ(totals.worst_bound_ratio, 3) << "JSON has no infinity: the status says that the case failed";
  EXPECT_EQ(totals.excluded_share, 0.1);
  EXPECT_EQ(totals.counts.at(Status::Fail), 2);
  EXPECT_EQ(totals.counts.at(Status::Crash), 1);
}

TEST_F(JoinedRunsTest, AFileThatIsNoResultsIsRefusedByNameElementAndRule) {
  const json good = json::parse(results_json(record_of("core", "x", {result_of("first", Status::Pass)})));
  EXPECT_EQ(refusal_of(good.dump()), "nothing");
  EXPECT_THAT(refusal_of("{"), testing::AllOf(testing::HasSubstr("results.json"), testing::HasSubstr("no JSON")));
  EXPECT_THAT(refusal_of("[]"), testing::HasSubstr("the file: must be an object"));
  for (const char* key : {"suite", "context", "seconds", "cases"}) {
    json lacking = good;
    lacking.erase(key);
    EXPECT_THAT(refusal_of(lacking.dump()), testing::HasSubstr(std::string("needs '") + key + "'"));
  }
  for (const char* key : {"name", "status", "bound_ratio", "p99_rel", "median_bound", "compared_pixels", "excluded_pixels", "message"}) {
    json lacking = good;
    lacking["cases"][0].erase(key);
    EXPECT_THAT(refusal_of(lacking.dump()), testing::AllOf(testing::HasSubstr("cases[0]"), testing::HasSubstr(key)));
  }
  const auto with = [&good](const char* pointer, const json& value) {
    json wrong = good;
    wrong[json::json_pointer(pointer)] = value;
    return wrong.dump();
  };
  EXPECT_THAT(refusal_of(with("/cases", json::object())), testing::HasSubstr("must be an array"));
  EXPECT_THAT(refusal_of(with("/cases/0", 1)), testing::HasSubstr("cases[0]: must be an object"));
  EXPECT_THAT(refusal_of(with("/cases/0/status", "good")), testing::HasSubstr("cases[0] 'first': unknown status 'good'"));
  EXPECT_THAT(refusal_of(with("/cases/0/bound_ratio", -1)), testing::HasSubstr("bound_ratio"));
  EXPECT_THAT(refusal_of(with("/cases/0/median_bound", "small")), testing::HasSubstr("median_bound"));
  EXPECT_THAT(refusal_of(with("/cases/0/excluded_pixels", 0.5)), testing::HasSubstr("excluded_pixels"));
  EXPECT_THAT(refusal_of(with("/context/subpixel_bits", 5000000000)), testing::HasSubstr("subpixel_bits"));
  EXPECT_THAT(refusal_of(with("/context/renderer", 7)), testing::HasSubstr("renderer"));
  json twice = good;
  twice["cases"].push_back(good["cases"][0]);
  EXPECT_THAT(refusal_of(twice.dump()), testing::HasSubstr("cases[1] 'first': is given twice"));
  EXPECT_THROW(join_runs({{"none", folder_.path() / "no-such-run"}}), ResultsError);
}

}  // namespace
}  // namespace sheen::conformance
