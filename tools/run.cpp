#include "conformance/run.h"

#include <filesystem>
#include <iostream>
#include <memory>

#include <fmt/format.h>

#include "tools/errors.h"
#include "tools/options.h"
#include "tools/progress.h"
#include "tools/words.h"

namespace sheen::tools {

int run(const RunOptions& options) {
  conformance::RunOptions settings;
  settings.suite = options.suite;
  settings.filter = options.filter;
  settings.viewer = options.viewer;
  settings.context = word_of(context_words, options.context);
  settings.precision = word_of(precision_words, options.precision);
  settings.report =
      std::filesystem::absolute(options.report.empty() ? std::filesystem::path("sheen-cts-report") / options.suite : options.report);
  settings.strict = options.strict;
  settings.case_limit_seconds = options.case_limit_seconds;
  settings.environment_samples = options.environment_samples;
  settings.goldens = options.goldens;
  std::unique_ptr<Progress> progress;
  settings.progress = [&progress, &options](const conformance::RunProgress& step) {
    if (!progress) {
      progress = std::make_unique<Progress>("run " + options.suite, "cases", static_cast<std::int64_t>(step.total));
    }
    if (step.status != "pass") {
      progress->message(fmt::format("{}: {}: {}", step.case_name, step.status, step.message));
    }
    progress->update(static_cast<std::int64_t>(step.done));
  };
  const conformance::RunResult result = conformance::run(settings);
  progress.reset();
  if (options.json) {
    std::cout << result.results_json << '\n';
  } else {
    fmt::print("{} passed, {} approximations, {} failed, {} unsupported, {} crashed, {} timed out, {} invalid in {:.1f} s\n", result.pass,
               result.approximation, result.fail, result.unsupported, result.crash, result.timeout, result.invalid, result.seconds);
  }
  fmt::print(options.json ? stderr : stdout, "report: {}\n", (settings.report / "index.html").string());
  return result.ok ? done : failed;
}

}  // namespace sheen::tools
