#include "image/decode_hdr.h"

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <memory>

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

}  // namespace

std::string decode_hdr(const std::filesystem::path& path, RawPicture& out) {
  Endless file{std::ifstream(path, std::ios::binary)};
  const stbi_io_callbacks callbacks = {Endless::read, Endless::skip, Endless::at_end};
  int in_file = 0;
  const std::unique_ptr<float, void (*)(void*)> values(stbi_loadf_from_callbacks(&callbacks, &file, &out.width, &out.height, &in_file, 3),
                                                       stbi_image_free);
  if (!values) {
    return stbi_failure_reason();
  }
  if (file.overrun) {
    return "its data ends early";
  }
  const std::size_t count = sample_count(out.width, out.height, 3);
  if (count == 0) {
    return "its header gives an impossible size";
  }
  out.channels = {"R", "G", "B"};
  out.values.assign(values.get(), values.get() + count);
  return {};
}

}  // namespace sheen::image
