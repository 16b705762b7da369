#include <string>

#include "tools/cli_fixture_test.h"

namespace sheen::tools {
namespace {

TEST_F(CommandLine, ListNamesTheCasesThatTheFilterLetsThrough) {
  const Outcome all = run({"list", "--json"});
  ASSERT_EQ(all.exit_code, 0) << all.err;
  const auto cases = nlohmann::json::parse(all.out)["cases"];
  EXPECT_GE(cases.size(), 120U);
  const std::string first = cases[0]["name"];
  EXPECT_EQ(run({"list", "--filter", first}).out, first + "\n");
  EXPECT_EQ(run({"list", "--suite", "no-such-suite"}).exit_code, 2);
}

TEST_F(CommandLine, ARunOfOneCaseWritesItsReport) {
  const auto cases = nlohmann::json::parse(run({"list", "--json"}).out)["cases"];
  const std::string first = cases[0]["name"];
  const Outcome outcome = run({"run", "--filter", first, "--report", path("report"), "--json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto results = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(results["summary"]["pass"], 1);
  EXPECT_EQ(results["cases"][0]["name"], first);
  for (const char* name : {"report/index.html", "report/results.json", "report/results.xml"}) {
    EXPECT_TRUE(exists(name)) << name;
  }
  EXPECT_NE(outcome.err.find("index.html"), std::string::npos);
}

TEST_F(CommandLine, RunsOfOneCaseAreJoinedAndACaseThatOneLacksIsAFailure) {
  const std::string one = "defaults.sheen_empty";
  ASSERT_EQ(run({"run", "--filter", one, "--report", path("osmesa"), "--context", "osmesa"}).exit_code, 0);
  ASSERT_EQ(run({"run", "--filter", one, "--report", path("egl"), "--context", "egl"}).exit_code, 0);
  ASSERT_EQ(run({"run", "--filter", one + ":emission.strong", "--report", path("more")}).exit_code, 0);
  const Outcome joined = run({"join", path("osmesa"), "by EGL=" + path("egl"), "-o", path("joined"), "--json"});
  EXPECT_EQ(joined.exit_code, 0) << joined.err;
  const auto report = nlohmann::json::parse(joined.out);
  EXPECT_EQ(report["drivers"][0]["name"], "osmesa");
  EXPECT_EQ(report["drivers"][1]["name"], "by EGL");
  EXPECT_EQ(report["cases"][0]["drivers"]["by EGL"]["status"], "pass");
  EXPECT_EQ(nlohmann::json::parse(text("joined/drivers.json")), report);
  EXPECT_NE(text("joined/index.html").find("by EGL"), std::string::npos);
  EXPECT_EQ(run({"join", path("osmesa"), path("more"), "-o", path("joined")}).exit_code, 1);
}

TEST_F(CommandLine, JoinSaysWhichFileItCannotReadAndLeavesNothing) {
  const Outcome outcome = run({"join", path("none"), "-o", path("joined")});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("none/results.json"), std::string::npos) << outcome.err;
  EXPECT_FALSE(exists("joined"));
  EXPECT_EQ(run({"join", "name=", "-o", path("joined")}).exit_code, 2);
}

TEST_F(CommandLine, ACaseThatTakesLongerThanItsLimitIsATimeout) {
  const Outcome outcome = run({"run", "--filter", "defaults.sheen_empty", "--case-limit", "0.001", "--report", path("report"), "--json"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(nlohmann::json::parse(outcome.out)["summary"]["timeout"], 1) << outcome.out;
}

}  // namespace
}  // namespace sheen::tools
