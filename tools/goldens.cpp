#include "conformance/goldens.h"

#include <cstddef>
#include <cstdint>
#include <iostream>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "conformance/json_text.h"
#include "tools/errors.h"
#include "tools/options.h"
#include "tools/progress.h"

namespace sheen::tools {
namespace {

using Operation = conformance::GoldensReport (*)(const conformance::GoldensOptions&);

int process(const GoldensOptions& options, const char* what, Operation operation) {
  std::unique_ptr<Progress> progress;
  conformance::GoldensOptions settings;
  settings.dir = options.goldens;
  settings.suite = options.suite;
  settings.progress = [&progress, what](std::size_t count, std::size_t total) {
    if (!progress) {
      progress = std::make_unique<Progress>(what, "goldens", static_cast<std::int64_t>(total));
    }
    progress->update(static_cast<std::int64_t>(count));
  };
  const conformance::GoldensReport report = operation(settings);
  progress.reset();
  for (const std::string& problem : report.problems) {
    std::cerr << problem << '\n';
  }
  if (options.json) {
    std::cout << conformance::json_text(nlohmann::ordered_json{{"suite", options.suite},
                                                               {"goldens", report.dir.string()},
                                                               {"cases", report.cases},
                                                               {"bytes", report.bytes},
                                                               {"problems", report.problems}},
                                        2)
              << '\n';
  } else {
    fmt::print("{}: {} goldens, {:.2f} MB, {} problems\n", report.dir.string(), report.cases, static_cast<double>(report.bytes) / 1e6,
               report.problems.size());
  }
  return report.problems.empty() ? done : failed;
}

}  // namespace

int goldens_generate(const GoldensOptions& options) {
  return process(options, "goldens generate", conformance::generate_goldens);
}

int goldens_verify(const GoldensOptions& options) {
  return process(options, "goldens verify", conformance::verify_goldens);
}

}  // namespace sheen::tools
