#pragma once

#include <array>
#include <string>
#include <vector>

#include "conformance/judge.h"
#include "conformance/run.h"
#include "conformance/viewer.h"

namespace sheen::conformance {

/// Every status, the worst first.
inline constexpr std::array<Status, 7> statuses = {Status::Fail,          Status::Crash,       Status::Timeout, Status::Invalid,
                                                   Status::Approximation, Status::Unsupported, Status::Pass};

/// Everything a run found, as the reports tell it.
struct RunRecord {
  std::string suite;
  std::string description;
  Hello viewer;
  std::string viewer_command;
  bool strict = false;
  double seconds = 0;
  std::vector<CaseResult> cases;
};

/// Counts by status, and whether the run as a whole is good (RunResult::ok). @param may_be_empty  whether a run of no case may be good (a
/// shard)
RunResult summarize(const RunRecord& record, bool may_be_empty);

/// results.json, what a run leaves for programs to read. Figures of a case whose pictures were never compared are null.
std::string results_json(const RunRecord& record);

}  // namespace sheen::conformance
