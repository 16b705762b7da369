#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace sheen::conformance {

/// JSON as text, on one line unless an indent is given. Bytes that are not UTF-8 (a file's name, a viewer's word) become U+FFFD.
template <class Json>
std::string json_text(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// The text, or null where it is empty.
inline nlohmann::json text_or_null(const std::string& text) {
  return text.empty() ? nlohmann::json(nullptr) : nlohmann::json(text);
}

}  // namespace sheen::conformance
