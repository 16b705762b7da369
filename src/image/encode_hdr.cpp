#include <algorithm>
#include <array>
#include <cstddef>

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb_image_write.h>

#include "image/encode.h"
#include "image/rgb_channels.h"

namespace sheen::image {
namespace {

void append(void* to, void* bytes, int count) {
  const auto* first = static_cast<const std::uint8_t*>(bytes);
  auto& out = *static_cast<std::vector<std::uint8_t>*>(to);
  out.insert(out.end(), first, first + count);
}

}  // namespace

std::vector<std::uint8_t> encode_hdr(const Image& image) {
  constexpr float largest = 1.69e38f;  // a little below (255/256) 2^127
  const std::array<int, 3> rgb = rgb_channels(image, "an .hdr file");
  std::vector<float> colors;
  colors.reserve(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 3);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      for (const int c : rgb) {
        const float value = image.at(x, y, c);
        colors.push_back(value > 0 ? std::min(value, largest) : 0.0f);
      }
    }
  }
  std::vector<std::uint8_t> bytes;
  if (stbi_write_hdr_to_func(append, &bytes, image.width, image.height, 3, colors.data()) == 0) {
    throw Error("a Radiance picture cannot be encoded");
  }
  return bytes;
}

}  // namespace sheen::image
