#pragma once

#include <string_view>
#include <vector>

namespace sheen::conformance {

/// A suite file as it was when the program was built.
struct EmbeddedSuite {
  std::string_view name;
  std::string_view text;
};

const std::vector<EmbeddedSuite>& embedded_suites();

}  // namespace sheen::conformance
