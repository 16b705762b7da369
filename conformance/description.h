#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace sheen::conformance {

/// Throws SuiteError unless a case description holds only what the language knows (conformance/suites/README.md), down to the members of
/// the material and its extensions, and names only shapes and pictures that exist. Ranges are the scene loader's business: a case may be
/// wrong on purpose.
void check_description(const nlohmann::json& description, const std::string& file, const std::string& element);

}  // namespace sheen::conformance
