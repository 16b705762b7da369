#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "scene/json_element.h"

namespace sheen::scene {

/// Whether a URI holds its data itself (RFC 2397).
bool is_data_uri(std::string_view uri);

/// The base64 text of a data URI. Throws Error, about member `uri` of `element`, when it is not base64.
std::string_view base64_payload(const Element& element, std::string_view uri);

/// Bytes that base64 text decodes to.
std::size_t base64_size(std::string_view payload);

/// The path, relative to the asset's folder, that a URI reference names, percent-decoded and without "." and "..". Throws Error, about
/// member `uri` of `element`, when it leaves the asset's folder or names another scheme (glTF 2.0, section 2.8). The check is lexical.
std::filesystem::path path_of_uri(const Element& element, std::string_view uri);

}  // namespace sheen::scene
