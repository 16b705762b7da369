#pragma once

#include <filesystem>
#include <string>

#include "image/module.h"

namespace sheen::image {

/// Reads a Radiance picture of R, G, B and a common exponent (Ward 1991, "Real Pixels", Graphics Gems II), rows from the top, flat or in
/// runs of each component; Radiance's older runs of whole pixels are not read. Its EXPOSURE is left unused, as by other readers.
/// @return  why it failed; empty if it did not
std::string decode_hdr(const std::filesystem::path& path, RawPicture& out);

}  // namespace sheen::image
