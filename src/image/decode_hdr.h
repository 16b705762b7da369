#pragma once

#include <filesystem>
#include <string>

#include "image/module.h"

namespace sheen::image {

/// Reads a Radiance picture, flat or run-length encoded, rows from the top (Ward 1991, "Real Pixels", Graphics Gems II). Its EXPOSURE is
/// left unused, as by other readers.
/// @return  why it failed; empty if it did not
std::string decode_hdr(const std::filesystem::path& path, RawPicture& out);

}  // namespace sheen::image
