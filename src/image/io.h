#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "image/image.h"

namespace sheen::image {

/// A picture file that cannot be read or written; the message names file and reason.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class ExrCompression { Zip, Pxr24 };

/// Reads .exr, .hdr, .pfm, .png, .jpg, .jpeg to linear floats, channels R G B (A) first, then the others by name. Codes of 8 and 16 bits
/// are decoded from sRGB (IEC 61966-2-1; colour, not alpha), grey becomes RGB, straight alpha is multiplied in. An EXR is read over its
/// display window, with 0 where it has no data. Thread-safe. Throws Error naming file and reason.
Image read(const std::filesystem::path& file);

/// Writes by extension: .exr (32-bit float, all channels; Pxr24: 24-bit), .hdr (RGB; negative and NaN become 0) and .pfm (RGB), .png (8-bit
/// sRGB of RGBA, un-premultiplied, clipped to [0, 1], rounded to the nearest code; a pixel with a NaN becomes opaque magenta, so that it is
/// seen). Goes to a temporary name in the same folder and is renamed, so that a failure leaves nothing behind and an old file as it was.
/// The same picture gives the same bytes. Thread-safe. Throws Error naming file and reason.
void write(const std::filesystem::path& file, const Image& image, ExrCompression compression = ExrCompression::Zip);

/// The bytes of an 8-bit sRGB PNG of the image (RGB or RGBA), as write() would put in a file. Throws Error.
std::vector<std::uint8_t> encode_png(const Image& image);

/// The bytes of a PNG whose codes are given: width * height * channels (1 to 4) codes of 8 or 16 bits, stored as they are
/// (alpha straight). Throws Error when they do not fit.
std::vector<std::uint8_t> encode_png_codes(int width, int height, int channels, int bits, const std::vector<std::uint16_t>& codes);

}  // namespace sheen::image
