#include <cstddef>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "conformance/joined_report.h"
#include "conformance/joined_runs.h"
#include "tools/errors.h"
#include "tools/files.h"
#include "tools/options.h"

namespace sheen::tools {
namespace {

/// "NAME=DIR", or "DIR", named by its last part. What stands before a '=' with a slash in it is no name.
conformance::RunFolder parse_run(const std::string& text) {
  const std::size_t equals = text.find('=');
  conformance::RunFolder run;
  if (equals != std::string::npos && text.find('/') > equals) {
    run = {text.substr(0, equals), text.substr(equals + 1)};
  } else {
    const std::filesystem::path folder = text;
    run = {(folder.has_filename() ? folder : folder.parent_path()).filename().string(), folder};
  }
  if (run.driver.empty() || run.folder.empty()) {
    throw UsageError("RUN '" + text + "': must be DIR or NAME=DIR");
  }
  return run;
}

}  // namespace

int join(const JoinOptions& options) {
  std::vector<conformance::RunFolder> runs;
  runs.reserve(options.runs.size());
  for (const std::string& text : options.runs) {
    runs.push_back(parse_run(text));
  }
  const conformance::JoinedRuns joined = conformance::join_runs(runs);
  std::filesystem::create_directories(options.output);
  const std::filesystem::path page = options.output / "index.html";
  const std::string json = conformance::joined_json(joined);
  write_text(options.output / "drivers.json", json);
  write_text(page, conformance::joined_html(joined));
  if (options.json) {
    std::cout << json;
  } else {
    for (std::size_t i = 0; i < joined.drivers.size(); ++i) {
      const conformance::ColumnTotals totals = joined.totals(i);
      fmt::print("{}: {} of {} passed, worst error / bound {:.3g}\n", joined.drivers[i].name, totals.counts.at(conformance::Status::Pass),
                 joined.cases.size(), totals.worst_bound_ratio);
    }
  }
  fmt::print(options.json ? stderr : stdout, "report: {}\n", page.string());
  return joined.ok() ? done : failed;
}

}  // namespace sheen::tools
