#pragma once

#include <cstdint>
#include <vector>

#include "image/image.h"
#include "image/io.h"

// Each format through the small library that owns it, not through OpenImageIO: a program that only writes starts 0.4 s earlier.
namespace sheen::image {

/// The bytes of an OpenEXR file of every channel as 32-bit floats (Pxr24: rounded to 24 bits), scan lines, 16 a block (ASWF, "The OpenEXR
/// File Layout"). Throws Error.
std::vector<std::uint8_t> encode_exr(const Image& image, ExrCompression compression);

/// The bytes of a Radiance picture of R, G, B: 8 bits of significand and a common exponent (Ward 1991, "Real Pixels", Graphics Gems II).
/// Negative values and NaN become 0, what exceeds the largest exponent becomes the largest value. Throws Error without R, G, B.
std::vector<std::uint8_t> encode_hdr(const Image& image);

}  // namespace sheen::image
