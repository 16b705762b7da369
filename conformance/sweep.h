#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace sheen::conformance {

/// One point of a sweep: its name and the case description that its patches add up to.
struct SweepPoint {
  std::string name;
  nlohmann::json description;
};

/// Expands one group {name, base?, axes?, combine?}: `defaults`, then `base`, then one patch of each axis, merged as JSON merge patches
/// (RFC 7396) in the order in which the axes stand. "{axis}" in the name is replaced by the label chosen on that axis.
/// @param file, element  for messages
/// Throws SuiteError for unknown keys, an axis that the name does not mention, a hole in the name that no axis fills, unequal axes under
/// "zip".
std::vector<SweepPoint> expand_group(const nlohmann::ordered_json& group, const nlohmann::json& defaults, const std::string& file,
                                     const std::string& element);

/// Throws SuiteError unless every key of the object is among those known.
void check_keys(const nlohmann::json& object, const std::vector<std::string>& known, const std::string& file, const std::string& element);

}  // namespace sheen::conformance
