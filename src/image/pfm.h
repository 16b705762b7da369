#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "image/image.h"

namespace sheen::image {

/// Reads a portable float map: "PF" (colour) or "Pf" (grey, given to R, G and B), either byte order, rows stored from the bottom. The
/// magnitude of its scale is left unused, as by other readers. Throws Error naming the file and what is wrong in it.
/// Source: Debevec, "PFM Portable FloatMap Image Format"; Netpbm, pfm(5).
Image read_pfm(const std::filesystem::path& file);

/// The bytes of a colour PFM, least significant byte first, of the channels R, G, B. Throws Error when one of them is missing.
std::vector<std::uint8_t> encode_pfm(const Image& image);

}  // namespace sheen::image
