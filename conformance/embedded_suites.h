#pragma once

#include <string_view>
#include <vector>

namespace sheen::conformance {

/// A suite file as it was when the program was built. The first of a name begins the suite, the others add groups to it.
struct EmbeddedSuite {
  std::string_view name;
  std::string_view file;
  std::string_view text;
};

const std::vector<EmbeddedSuite>& embedded_suites();

}  // namespace sheen::conformance
