#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace sheen::image {

/// A picture as its file holds it, before colour is decoded: either `values` (bits == 0) or `codes` (bits 8 or 16), interleaved, rows from
/// the top, width * height * channels.size() of them.
struct RawPicture {
  int width = 0;
  int height = 0;
  std::vector<std::string> channels;
  int bits = 0;  ///< bits of a code; 0: the picture is in floats
  std::vector<float> values;
  std::vector<std::uint16_t> codes;
};

/// What the image module offers. It is a library of its own because linking OpenImageIO loads some 260 libraries at every start. Plain
/// function pointers and messages instead of exceptions, so that nothing but data crosses the dlopen border: each function returns an empty
/// string, or why it failed.
struct Module {
  /// @param format  OpenImageIO's name of the format: "openexr", "hdr", "png", "jpeg"
  /// Alpha is left as the file has it (straight in PNG, premultiplied in EXR). An EXR is returned over its display window.
  std::string (*read)(const char* path, const char* format, RawPicture& out);
  /// Writes floats; @param compression  "zip" or "pxr24" (openexr only).
  std::string (*write_floats)(const char* path, const char* format, const char* compression, const RawPicture& picture);
  /// Appends the bytes of a PNG of the codes, as they are; @param srgb  marks the file as sRGB.
  std::string (*encode_png)(const RawPicture& picture, bool srgb, std::vector<std::uint8_t>& bytes);
};

/// Name and type of the module's one symbol.
inline constexpr const char* module_symbol = "sheen_image_module";
using ModuleEntry = const Module* (*)();

}  // namespace sheen::image
