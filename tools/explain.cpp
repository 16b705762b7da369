#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "conformance/json_text.h"
#include "renderer/renderer.h"
#include "tools/errors.h"
#include "tools/options.h"
#include "tools/scene_input.h"

namespace sheen::tools {

int explain(const RenderOptions& options) {
  const auto [scene, environment] = load_input(options);
  const renderer::Requirements required = renderer::requirements(scene, options.settings(environment));
  const std::vector<std::pair<const char*, const std::vector<std::string>*>> lists{{"features", &required.features},
                                                                                   {"defines", &required.defines},
                                                                                   {"tables", &required.tables},
                                                                                   {"uniforms", &required.uniforms},
                                                                                   {"texture_units", &required.texture_units},
                                                                                   {"omitted", &required.omitted}};
  if (options.json) {
    nlohmann::ordered_json report{{"scene", options.scene.string()}};
    for (const auto& [name, entries] : lists) {
      report[name] = *entries;
    }
    std::cout << conformance::json_text(report, 2) << '\n';
    return done;
  }
  for (const auto& [name, entries] : lists) {
    fmt::print("{}\n", name);
    for (const std::string& entry : *entries) {
      fmt::print("  {}\n", entry);
    }
    if (entries->empty()) {
      fmt::print("  none\n");
    }
  }
  return done;
}

}  // namespace sheen::tools
