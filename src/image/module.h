#pragma once

#include <cstddef>
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

/// Samples of a picture of that size, or 0 where it is empty or so large (over 8 GiB of floats) that its header must be corrupt: to be
/// asked before memory is.
constexpr std::size_t sample_count(std::int64_t width, std::int64_t height, std::int64_t channels) {
  constexpr std::int64_t most = std::int64_t{1} << 31;
  if (width <= 0 || height <= 0 || channels <= 0 || width > most / height || width * height > most / channels) {
    return 0;
  }
  return static_cast<std::size_t>(width * height * channels);
}

/// What the image module offers: reading. It is a library of its own because linking OpenImageIO loads some 260 libraries at every start.
/// Plain function pointers and messages instead of exceptions, so that nothing but data crosses the dlopen border: each function returns an
/// empty string, or why it failed.
struct Module {
  /// @param format  OpenImageIO's name of the format: "png", "jpeg"
  /// Alpha is left as the file has it (straight).
  std::string (*read)(const char* path, const char* format, RawPicture& out);
};

/// Name and type of the module's one symbol.
inline constexpr const char* module_symbol = "sheen_image_module";
using ModuleEntry = const Module* (*)();

}  // namespace sheen::image
