#include "conformance/mutants/hunt.h"

#include <map>
#include <set>

#include <nlohmann/json.hpp>

#include "conformance/child_process.h"
#include "conformance/run.h"

namespace sheen::conformance {
namespace {

using nlohmann::json;

/// Seconds that one case, and that a whole suite may take before the hunt gives up: far more than they need.
constexpr double case_limit = 120;
constexpr double run_limit = 1200;

struct Run {
  std::string results;  ///< text of results.json
  std::string error;    ///< why there are none
};

Run run_cases(const Hunt& hunt, const std::string& mutant, const CaseFilter& cases, bool stop_at_first) {
  const std::string report = (hunt.folder / "reports" / mutant).string();
  const std::string cache = (hunt.folder / "cache").string();
  ChildProcess driver({"/usr/bin/env", "-u", "GTEST_FILTER", "-u", "GTEST_TOTAL_SHARDS", "XDG_CACHE_HOME=" + cache,
                       std::string("GTEST_FAIL_FAST=") + (stop_at_first ? "1" : "0"), hunt.driver, report, cache, cases.filter,
                       json(case_limit).dump(), "lenient", "'" + hunt.viewer + "' " + mutant, cases.suite, "highp"});
  Run run;
  std::string line;
  const Deadline deadline = deadline_in(run_limit);
  while (driver.read_line(line, deadline) == ChildProcess::ReadStatus::Line) {
    run.results += line + "\n";
  }
  const std::string ending = driver.finish(60);
  if (ending != "exited with status 0" && ending != "exited with status 1") {
    run.error = cases.suite + " " + cases.filter + ": the run " + ending + ": " + driver.last_words();
  }
  return run;
}

}  // namespace

Fate read_fate(const std::string& suite, const std::string& results) {
  const json run = json::parse(results);
  for (const json& one : run.at("cases")) {
    const auto status = one.at("status").get<std::string>();
    if (status == "pass" || status == "approximation" || status == "unsupported") {
      continue;
    }
    const Kill failed{suite, one.at("name").get<std::string>(), one.at("message").get<std::string>()};
    // A viewer that could not draw fails its case too, but of its picture nothing was measured.
    if (status == "fail" && !one.at("compared_pixels").is_null()) {
      return {failed, ""};
    }
    return {std::nullopt, failed.suite + " " + failed.name + ": " + status + ", and no picture was judged: " + failed.message};
  }
  return {};
}

Fate hunt(const Hunt& hunt, const Mutant& mutant) {
  std::vector<CaseFilter> places = mutant.first;
  for (const std::string& suite : suite_names()) {
    places.push_back({suite, "*"});
  }
  for (const CaseFilter& place : places) {
    const Run run = run_cases(hunt, mutant.name, place, true);
    if (!run.error.empty()) {
      return {std::nullopt, run.error};
    }
    Fate fate = read_fate(place.suite, run.results);
    if (fate.kill || !fate.error.empty()) {
      return fate;
    }
  }
  return {};
}

Control control(const Hunt& hunt, const std::vector<Kill>& kills) {
  std::map<std::string, std::set<std::string>> killers;
  for (const Kill& kill : kills) {
    killers[kill.suite].insert(kill.name);
  }
  Control control;
  for (const auto& [suite, names] : killers) {
    std::string filter;
    for (const std::string& name : names) {
      filter += (filter.empty() ? "" : ":") + name;
    }
    const Run run = run_cases(hunt, unmutated, {suite, filter}, false);
    if (!run.error.empty()) {
      control.error = run.error;
      return control;
    }
    const json cases = json::parse(run.results).at("cases");
    if (cases.size() != names.size()) {
      control.error = suite + ": " + std::to_string(cases.size()) + " of " + std::to_string(names.size()) + " cases were run";
      return control;
    }
    for (const json& one : cases) {
      if (one.at("status") != "pass") {
        control.killed.push_back({suite, one.at("name").get<std::string>(), one.at("message").get<std::string>()});
      }
    }
  }
  return control;
}

}  // namespace sheen::conformance
