#pragma once

#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace sheen::conformance {

/// The viewer under test did not start: no such program, no hello line in time, or it died before it. Says why, with its last words.
class ViewerUnavailable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One step of a run, told after each case.
struct RunProgress {
  std::size_t done = 0;
  std::size_t total = 0;
  std::string case_name;  ///< the case just judged
  std::string status;     ///< "pass", "approximation", "fail", "unsupported", "crash", "timeout", "invalid"
  std::string message;    ///< why, where it is not "pass"
};

struct RunOptions {
  std::string suite = "core";
  /// GoogleTest's filter syntax over case names: globs of * and ?, separated by ':', those after a '-' excluded. A pattern may or may not
  /// begin with the suite's name and a dot.
  std::string filter = "*";
  /// "sheen-cts" (or empty): our own renderer, as `sheen-cts serve` in a child process. Else a command: words separated by spaces, quoted
  /// as in a shell; no shell runs it.
  std::string viewer = "sheen-cts";
  std::string context = "osmesa";                    ///< "osmesa" or "egl", for our own viewer
  std::string precision = "highp";                   ///< "highp" or "mediump", for our own viewer
  std::filesystem::path report;                      ///< folder of the report; made when missing
  bool strict = false;                               ///< approximations count as failures
  int environment_samples = 4096;                    ///< directions a pixel that our own viewer is to draw; 0: the real-time way
  double start_limit_seconds = 60;                   ///< time a viewer has to say hello
  double case_limit_seconds = 30;                    ///< time a viewer has to answer one request
  std::filesystem::path goldens;                     ///< committed goldens; empty: find_goldens()
  std::filesystem::path cache;                       ///< scenes and computed goldens; empty: default_cache()
  std::filesystem::path executable;                  ///< what to start for our own viewer; empty: this program
  std::function<void(const RunProgress&)> progress;  ///< called from the thread that called run()
};

/// What a run came to.
struct RunResult {
  int pass = 0, approximation = 0, fail = 0, unsupported = 0, crash = 0, timeout = 0, invalid = 0;
  double seconds = 0;
  bool ok = false;  ///< no fail, crash, timeout or invalid, nothing approximated if strict, and something passed (or this shard is empty)
  std::string results_json;  ///< the text of results.json
};

/// Runs a suite against a viewer: every case is a GoogleTest test registered now (so GTEST_FILTER, GTEST_TOTAL_SHARDS and GTEST_SHARD_INDEX
/// are honoured), goldens are computed ahead while the viewer draws. Writes results.json, results.xml, index.html and images/ in
/// options.report. Prints nothing. GoogleTest runs once in a process, so may this. Throws ViewerUnavailable, std::invalid_argument (unknown
/// suite, a filter that no case matches, an unknown context or precision, a malformed viewer command), suite Error, image::Error (the
/// report cannot be written).
RunResult run(const RunOptions& options);

/// One case as `list` shows it.
struct CaseInfo {
  std::string name;
  std::string visibility, albedo_scaling;
  int width = 0, height = 0;
  std::string law;  ///< of a relation; what is tried of a function; empty for a case that is judged by its golden
};

/// The cases of a suite that the filter (as in RunOptions) lets through, in order. Throws std::invalid_argument for an unknown suite.
std::vector<CaseInfo> list(const std::string& suite, const std::string& filter = "*");

/// Names of the suites this program carries.
std::vector<std::string> suite_names();

}  // namespace sheen::conformance
