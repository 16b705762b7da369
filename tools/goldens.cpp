#include "conformance/goldens.h"

#include <cstddef>
#include <cstdint>
#include <iostream>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

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
    std::cout << nlohmann::ordered_json{{"suite", options.suite},
                                        {"goldens", report.dir.string()},
                                        {"cases", report.cases},
                                        {"bytes", report.bytes},
                                        {"problems", report.problems}}
                     .dump(2, ' ', false, nlohmann::json::error_handler_t::replace)
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
