#include "scene/picture_codecs.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <memory>
#include <string_view>
#include <vector>

#include <spng.h>
#include <turbojpeg.h>

namespace sheen::scene {
namespace {

using Bytes = std::span<const std::uint8_t>;

// MAX_TEXTURE_SIZE of the drivers this suite runs on (Mesa's llvmpipe); also keeps a few bytes of PNG from asking for any amount of memory.
constexpr std::uint32_t largest_side = 16384;
constexpr std::uint32_t most_pixels = std::uint32_t{1} << 27;

bool starts_with(Bytes bytes, std::string_view magic) {
  return bytes.size() >= magic.size() && std::memcmp(bytes.data(), magic.data(), magic.size()) == 0;
}

// Takes the size over into the picture; what is wrong with it, if anything.
std::string take_size(std::uint32_t width, std::uint32_t height, Picture& picture) {
  if (width == 0 || height == 0) {
    return "is truncated or has no pixels";
  }
  if (width > largest_side || height > largest_side || width * height > most_pixels) {
    return "is " + std::to_string(width) + " x " + std::to_string(height) + ", more than " + std::to_string(largest_side) +
           " on a side or " + std::to_string(most_pixels) + " pixels, the most that is read";
  }
  picture.width = static_cast<int>(width);
  picture.height = static_cast<int>(height);
  return {};
}

/// The codes of 8 bits that decode(bytes) gives, in a picture's own 16: the bytes come to lie in the upper half of the room for the codes
/// and are widened from its beginning on, for pages of memory never touched before cost more than decoding does.
template <class Decode>
auto decode_bytes(std::size_t count, std::vector<std::uint16_t>& codes, const Decode& decode) {
  codes.resize(count);
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(codes.data()) + count;
  const auto result = decode(reinterpret_cast<std::uint8_t*>(codes.data()) + count);
  std::array<std::uint8_t, 4096> some{};
  for (std::size_t first = 0; first < count; first += some.size()) {
    const std::size_t size = std::min(some.size(), count - first);
    std::memcpy(some.data(), bytes + first, size);
    std::copy_n(some.begin(), size, codes.begin() + static_cast<std::ptrdiff_t>(first));
  }
  return result;
}

std::string decode_png(Bytes file, Picture& picture) {
  const std::unique_ptr<spng_ctx, void (*)(spng_ctx*)> context(spng_ctx_new(0), spng_ctx_free);
  if (!context) {
    return "cannot be decoded: no memory";
  }
  const auto failure = [](int error) { return std::string("cannot be decoded as PNG: ") + spng_strerror(error); };
  // Bounds what any other chunk may ask for.
  spng_set_chunk_limits(context.get(), std::size_t{1} << 24, std::size_t{1} << 26);
  spng_ihdr header{};
  int error = spng_set_png_buffer(context.get(), file.data(), file.size());
  error = error != 0 ? error : spng_get_ihdr(context.get(), &header);
  if (error != 0) {
    return failure(error);
  }
  if (std::string wrong = take_size(header.width, header.height, picture); !wrong.empty()) {
    return wrong;
  }
  picture.bits = header.bit_depth == 16 ? 16 : 8;
  const int format = picture.bits == 16 ? SPNG_FMT_RGBA16 : SPNG_FMT_RGBA8;
  std::size_t size = 0;
  error = spng_decoded_image_size(context.get(), format, &size);
  const std::size_t count = std::size_t{header.width} * header.height * 4;
  if (error == 0 && size != count * (picture.bits == 16 ? 2 : 1)) {
    error = SPNG_EINTERNAL;
  }
  if (error != 0) {
    return failure(error);
  }
  const auto decode = [&](void* out) { return spng_decode_image(context.get(), out, size, format, SPNG_DECODE_TRNS); };
  if (picture.bits == 16) {
    picture.codes.resize(count);
    error = decode(picture.codes.data());
  } else {
    error = decode_bytes(count, picture.codes, decode);
  }
  // What follows the pixels is read too: a file cut there is damaged.
  error = error != 0 ? error : spng_decode_chunks(context.get());
  return error != 0 ? failure(error) : std::string();
}

std::string decode_jpeg(Bytes file, Picture& picture) {
  const std::unique_ptr<void, int (*)(tjhandle)> decoder(tjInitDecompress(), tjDestroy);
  if (!decoder) {
    return "cannot be decoded: no memory";
  }
  const auto failure = [&] { return std::string("cannot be decoded as JPEG: ") + tjGetErrorStr2(decoder.get()); };
  int width = 0;
  int height = 0;
  int subsampling = 0;
  int space = 0;
  if (tjDecompressHeader3(decoder.get(), file.data(), file.size(), &width, &height, &subsampling, &space) != 0) {
    return failure();
  }
  if (space == TJCS_CMYK || space == TJCS_YCCK) {
    return "is a JPEG in CMYK, which is no texture";
  }
  if (std::string wrong = take_size(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), picture); !wrong.empty()) {
    return wrong;
  }
  picture.bits = 8;
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4;
  // A limit on scans stops progressive files that would take hours.
  constexpr int flags = TJFLAG_ACCURATEDCT | TJFLAG_STOPONWARNING | TJFLAG_LIMITSCANS;
  const int error = decode_bytes(count, picture.codes, [&](std::uint8_t* out) {
    return tjDecompress2(decoder.get(), file.data(), file.size(), out, width, 0, height, TJPF_RGBA, flags);
  });
  return error != 0 ? failure() : std::string();
}

}  // namespace

std::string decode_picture(Bytes file, Picture& picture) {
  constexpr std::string_view png("\x89PNG\r\n\x1A\n", 8);
  constexpr std::string_view jpeg("\xFF\xD8\xFF", 3);
  if (starts_with(file, png)) {
    return decode_png(file, picture);
  }
  if (starts_with(file, jpeg)) {
    return decode_jpeg(file, picture);
  }
  return "is neither PNG nor JPEG (section 3.8.3)";
}

}  // namespace sheen::scene
