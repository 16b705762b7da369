#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "conformance/results.h"

namespace sheen::conformance {

/// A results.json that cannot be joined: the file, the element in it ("cases[3] 'lights.spot'") and the rule it breaks.
class ResultsError : public std::runtime_error {
 public:
  ResultsError(const std::string& file, const std::string& element, const std::string& rule)
      : std::runtime_error(file + ": " + element + ": " + rule) {}
};

/// A report folder, and the column that it belongs to. Runs of several suites, or shards of one, share a name.
struct RunFolder {
  std::string driver;
  std::filesystem::path folder;
};

/// What one run says of one case.
struct CaseFigures {
  Status status = Status::Invalid;
  std::optional<double> bound_ratio;   ///< nothing where no picture was compared, or an error was more than any multiple of its bound
  std::optional<double> p99_rel;       ///< 99th percentile of the relative errors
  std::optional<double> median_bound;  ///< median of the bounds, relative; 0 where there is no golden
  std::optional<std::int64_t> compared_pixels, excluded_pixels;
  std::string message;
};

/// One driver: a column of the joint report.
struct DriverColumn {
  std::string name;
  std::string renderer, version;  ///< GL_RENDERER and GL_VERSION; empty when the viewer did not say
  std::optional<int> subpixel_bits, mediump_bits;
  double seconds = 0;  ///< of all its runs
  std::vector<std::filesystem::path> folders;
};

/// One case: a row, with one cell a column; an empty cell where the driver's runs do not have the case.
struct CaseRow {
  std::string suite, name;
  std::vector<std::optional<CaseFigures>> cells;
};

/// What a column comes to.
struct ColumnTotals {
  std::map<Status, int> counts;  ///< of every status
  int missing = 0;               ///< cases that other columns have
  /// Over the cases with a bound_ratio; 0 where there are none.
  double median_bound_ratio = 0, p99_bound_ratio = 0, worst_bound_ratio = 0;
  double excluded_share = 0;  ///< of the covered pixels of all its cases
};

/// Runs of the same suites on several drivers, side by side.
struct JoinedRuns {
  std::vector<DriverColumn> drivers;
  std::vector<CaseRow> cases;  ///< suites and cases in the order in which the runs name them first

  ColumnTotals totals(std::size_t driver) const;
  /// Whether every case has passed (an approximation has; what is unsupported is no failure) on every driver, and none is missing.
  bool ok() const;
};

/// Reads the results.json of each folder; columns stand in the order in which they are first named. Throws ResultsError for a file that
/// cannot be read or lacks what a run writes, for a case that two runs of one name have, and for runs of one name whose contexts differ: a
/// column is one driver.
JoinedRuns join_runs(const std::vector<RunFolder>& runs);

/// The same for programs to read:
/// `{drivers[{name,renderer,version,subpixel_bits,mediump_bits,seconds,summary{...,missing},bound_ratio{median,
/// p99,worst},excluded_share,folders[]}], cases[{suite,name,drivers{NAME:{status,bound_ratio,p99_rel,median_bound,
/// compared_pixels,excluded_pixels,message} or null}}]}`.
std::string joined_json(const JoinedRuns& joined);

/// Share of the covered pixels that were left out; nothing where no picture was compared.
std::optional<double> excluded_share(const CaseFigures& figures);

}  // namespace sheen::conformance
