#pragma once

#include <filesystem>
#include <string>

#include "image/module.h"

namespace sheen::image {

/// Reads the first part of an OpenEXR file, scan lines or tiles (their finest level), as floats over its display window.
/// @return  why it failed; empty if it did not
std::string decode_exr(const std::filesystem::path& path, RawPicture& out);

}  // namespace sheen::image
