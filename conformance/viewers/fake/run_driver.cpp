// Runs a suite in a process of its own, as `sheen-cts run` does: GoogleTest runs but once in a process, so the tests start this program.
// Arguments: report folder, cache folder, filter, time limit of a case in seconds, "strict" or "lenient", viewer command, suite, precision.
// Prints the results.
#include <cstdio>
#include <exception>
#include <string>

#include "conformance/run.h"

int main(int argc, char** argv) {
  if (argc != 9) {
    return 2;
  }
  try {
    sheen::conformance::RunOptions options;
    options.report = argv[1];
    options.cache = argv[2];
    options.goldens = options.cache;
    options.filter = argv[3];
    options.case_limit_seconds = std::stod(argv[4]);
    options.start_limit_seconds = 20;
    options.strict = std::string(argv[5]) == "strict";
    options.viewer = argv[6];
    options.suite = argv[7];
    options.precision = argv[8];
    const sheen::conformance::RunResult result = sheen::conformance::run(options);
    std::fputs(result.results_json.c_str(), stdout);
    return result.ok ? 0 : 1;
  } catch (const sheen::conformance::ViewerUnavailable& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 4;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 3;
  }
}
