#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

namespace sheen::scene {

/// Parses strict JSON (RFC 8259). Throws Error naming `file`, the path of the value at fault ("materials[2].alphaCutoff") and what is wrong
/// with it: syntax, a number that no double can hold (1e999), a member given twice, or nesting too deep to be a real document.
nlohmann::json parse_json(std::string_view text, const std::string& file);

}  // namespace sheen::scene
