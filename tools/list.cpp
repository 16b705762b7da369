#include <iostream>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "conformance/json_text.h"
#include "conformance/run.h"
#include "tools/errors.h"
#include "tools/options.h"

namespace sheen::tools {

int list(const ListOptions& options) {
  const std::vector<conformance::CaseInfo> cases = conformance::list(options.suite, options.filter);
  if (!options.json) {
    for (const conformance::CaseInfo& info : cases) {
      fmt::print("{}\n", info.name);
    }
    return done;
  }
  nlohmann::ordered_json report{
      {"suite", options.suite}, {"suites", conformance::suite_names()}, {"cases", nlohmann::ordered_json::array()}};
  for (const conformance::CaseInfo& info : cases) {
    report["cases"].push_back({{"name", info.name},
                               {"visibility", info.visibility},
                               {"albedo_scaling", info.albedo_scaling},
                               {"width", info.width},
                               {"height", info.height}});
    if (!info.law.empty()) {
      report["cases"].back()["law"] = info.law;
    }
  }
  std::cout << conformance::json_text(report, 2) << '\n';
  return done;
}

}  // namespace sheen::tools
