#include <algorithm>
#include <atomic>
#include <cstring>
#include <exception>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <tiny_gltf.h>

#include "scene/gltf_textures.h"

namespace sheen::scene {
namespace {

using Bytes = std::span<const std::uint8_t>;

// MAX_TEXTURE_SIZE of the drivers this suite runs on (Mesa's llvmpipe); also keeps a few bytes of PNG from asking for any amount of memory.
constexpr std::uint32_t largest_side = 16384;
// tinygltf counts the bytes of a decoded picture (at most 8 a pixel) in int.
constexpr std::uint32_t most_pixels = std::uint32_t{1} << 27;

bool starts_with(Bytes bytes, std::string_view magic) {
  return bytes.size() >= magic.size() && std::memcmp(bytes.data(), magic.data(), magic.size()) == 0;
}

std::uint32_t big_endian(Bytes bytes, std::size_t offset, int count) {
  std::uint32_t value = 0;
  for (int i = 0; i < count; ++i) {
    value = value << 8 | bytes[offset + static_cast<std::size_t>(i)];
  }
  return value;
}

struct Size {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};

// PNG (ISO/IEC 15948), section 11.2.2: IHDR comes first.
Size png_size(Bytes bytes) {
  return bytes.size() < 24 ? Size{} : Size{big_endian(bytes, 16, 4), big_endian(bytes, 20, 4)};
}

// JPEG (ITU-T T.81), annex B: markers up to the frame header, SOF0 to SOF15 without DHT, JPG and DAC.
Size jpeg_size(Bytes bytes) {
  std::size_t at = 2;
  while (at + 9 <= bytes.size() && bytes[at] == 0xFF) {
    const std::uint8_t marker = bytes[at + 1];
    if (marker == 0xFF) {
      ++at;
      continue;
    }
    if (marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC) {
      return {big_endian(bytes, at + 7, 2), big_endian(bytes, at + 5, 2)};
    }
    at += 2 + big_endian(bytes, at + 2, 2);
  }
  return {};
}

Size checked_size(const Element& element, Bytes bytes) {
  constexpr std::string_view png("\x89PNG\r\n\x1A\n", 8);
  constexpr std::string_view jpeg("\xFF\xD8\xFF", 3);
  Size size;
  if (starts_with(bytes, png)) {
    size = png_size(bytes);
  } else if (starts_with(bytes, jpeg)) {
    size = jpeg_size(bytes);
  } else {
    element.fail(nullptr, "is neither PNG nor JPEG (section 3.8.3)");
  }
  if (size.width == 0 || size.height == 0) {
    element.fail(nullptr, "is truncated or has no pixels");
  }
  if (size.width > largest_side || size.height > largest_side || size.width * size.height > most_pixels) {
    element.fail(nullptr, "is " + std::to_string(size.width) + " x " + std::to_string(size.height) + ", more than " +
                              std::to_string(largest_side) + " on a side or " + std::to_string(most_pixels) + " pixels");
  }
  return size;
}

Picture decode_image(const Element& element, Bytes bytes) {
  const Size size = checked_size(element, bytes);
  tinygltf::Image image;
  std::string error;
  std::string warning;
  // Without options tinygltf expands every picture to RGBA.
  if (!tinygltf::LoadImageData(&image, 0, &error, &warning, static_cast<int>(size.width), static_cast<int>(size.height), bytes.data(),
                               static_cast<int>(bytes.size()), nullptr) ||
      image.component != 4 || (image.bits != 8 && image.bits != 16)) {
    element.fail(nullptr, "cannot be decoded as PNG or JPEG (section 3.8.3)");
  }
  Picture picture;
  picture.name = element.string("name", "");
  picture.width = image.width;
  picture.height = image.height;
  picture.bits = image.bits;
  const std::size_t count = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 4;
  if (image.bits == 16) {
    picture.codes.resize(count);
    std::memcpy(picture.codes.data(), image.image.data(), count * 2);
  } else {
    picture.codes.assign(image.image.begin(), image.image.begin() + static_cast<std::ptrdiff_t>(count));
  }
  return picture;
}

Bytes encoded_bytes(const Element& element, std::size_t index, const Resources& resources) {
  const int view = element.index("bufferView", resources.views.size(), "bufferViews");
  if ((view >= 0) == element.has("uri")) {
    element.fail(nullptr, "must have either a uri or a bufferView (section 5.18)");
  }
  return view >= 0 ? resources.bytes(view) : Bytes(resources.encoded_images[index]);
}

}  // namespace

std::vector<Picture> decode_images(const Element& root, const Resources& resources, const std::vector<int>& images) {
  const std::vector<Element> elements = root.children("images");
  std::vector<Picture> pictures(images.size());
  std::vector<std::exception_ptr> errors(images.size());
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < images.size(); i = next++) {
      try {
        const auto index = static_cast<std::size_t>(images[i]);
        pictures[i] = decode_image(elements[index], encoded_bytes(elements[index], index, resources));
      } catch (...) {
        errors[i] = std::current_exception();
      }
    }
  };
  {
    std::vector<std::jthread> helpers;
    const std::size_t threads = std::min<std::size_t>(images.size(), std::max(1U, std::thread::hardware_concurrency()));
    for (std::size_t i = 1; i < threads; ++i) {
      helpers.emplace_back(work);
    }
    work();
  }
  for (const std::exception_ptr& error : errors) {
    if (error) {
      std::rethrow_exception(error);
    }
  }
  return pictures;
}

}  // namespace sheen::scene
