#include "image/decode_hdr.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <memory>
#include <system_error>

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_NO_STDIO
#define STBI_ONLY_HDR
#define STBI_FAILURE_USERMSG
#include <stb_image.h>

namespace sheen::image {
namespace {

/// A file that seems to go on for ever: past a picture's end stb_image would read zeros, and a run of length zero is where it never ends.
struct Endless {
  std::ifstream stream;
  bool overrun = false;

  static int read(void* user, char* to, int size) {
    auto& self = *static_cast<Endless*>(user);
    self.stream.read(to, size);
    const auto count = static_cast<int>(self.stream.gcount());
    // A buffer may be filled in part: it asks again if that is not enough. The rest of a pixel may not.
    constexpr int pixel = 4;
    if (count == size || (count > 0 && size > pixel)) {
      return count;
    }
    self.overrun = true;
    std::fill_n(to, size, '\n');  // ends a header's line, and is a run of ten in a row of pixels
    return size;
  }
  static void skip(void* user, int size) { static_cast<Endless*>(user)->stream.seekg(size, std::ios::cur); }
  static int at_end(void* /*user*/) { return 0; }
};

constexpr const char* ends_early = "its data ends early, or is in the old runs of whole pixels, which are not read";

}  // namespace

std::string decode_hdr(const std::filesystem::path& path, RawPicture& out) {
  const stbi_io_callbacks callbacks = {Endless::read, Endless::skip, Endless::at_end};
  int in_file = 0;
  Endless header{std::ifstream(path, std::ios::binary)};
  if (stbi_info_from_callbacks(&callbacks, &header, &out.width, &out.height, &in_file) == 0) {
    return std::string("must be a Radiance picture of FORMAT=32-bit_rle_rgbe with its rows from the top (-Y HEIGHT +X WIDTH)");
  }
  // Before a damaged header makes anybody ask for memory: a line is four bytes and two for every run of 127 of each component, at least.
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  const std::uintmax_t least = 4 + 8 * ((static_cast<std::uintmax_t>(std::max(out.width, 0)) + 126) / 127);
  if (sample_count(out.width, out.height, 3) == 0) {
    return "its header gives an impossible size";
  }
  if (!error && out.width >= 8 && size < least * static_cast<std::uintmax_t>(out.height)) {
    return ends_early;
  }
  Endless file{std::ifstream(path, std::ios::binary)};
  const std::unique_ptr<float, void (*)(void*)> values(stbi_loadf_from_callbacks(&callbacks, &file, &out.width, &out.height, &in_file, 3),
                                                       stbi_image_free);
  if (!values) {
    return stbi_failure_reason();
  }
  if (file.overrun) {
    return ends_early;
  }
  const std::size_t count = sample_count(out.width, out.height, 3);
  out.channels = {"R", "G", "B"};
  out.values.assign(values.get(), values.get() + count);
  return {};
}

}  // namespace sheen::image
