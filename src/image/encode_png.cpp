#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <string>

#include <spng.h>

#include "image/io.h"
#include "image/rgb_channels.h"
#include "image/srgb.h"

namespace sheen::image {
namespace {

[[noreturn]] void fail(const std::string& why) {
  throw Error("a PNG cannot be encoded: " + why);
}

/// @param codes  of 8 bits a byte each, of 16 bits in the machine's byte order
std::vector<std::uint8_t> encode(int width, int height, int channels, int bits, bool srgb, const void* codes, std::size_t size) {
  const std::unique_ptr<spng_ctx, void (*)(spng_ctx*)> context(spng_ctx_new(SPNG_CTX_ENCODER), spng_ctx_free);
  if (!context) {
    fail("no memory");
  }
  constexpr std::array<std::uint8_t, 5> color_types = {0, SPNG_COLOR_TYPE_GRAYSCALE, SPNG_COLOR_TYPE_GRAYSCALE_ALPHA,
                                                       SPNG_COLOR_TYPE_TRUECOLOR, SPNG_COLOR_TYPE_TRUECOLOR_ALPHA};
  spng_ihdr header{};
  header.width = static_cast<std::uint32_t>(width);
  header.height = static_cast<std::uint32_t>(height);
  header.bit_depth = static_cast<std::uint8_t>(bits);
  header.color_type = color_types[static_cast<std::size_t>(channels)];
  int error = spng_set_option(context.get(), SPNG_ENCODE_TO_BUFFER, 1);
  error = error != 0 ? error : spng_set_ihdr(context.get(), &header);
  if (srgb) {
    constexpr std::uint8_t perceptual = 0;
    error = error != 0 ? error : spng_set_srgb(context.get(), perceptual);
  }
  error = error != 0 ? error : spng_encode_image(context.get(), codes, size, SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE);
  std::size_t count = 0;
  const std::unique_ptr<void, void (*)(void*)> png(error != 0 ? nullptr : spng_get_png_buffer(context.get(), &count, &error), std::free);
  if (error != 0) {
    fail(spng_strerror(error));
  }
  const auto* first = static_cast<const std::uint8_t*>(png.get());
  return {first, first + count};
}

std::uint8_t code_of(double signal) {
  return static_cast<std::uint8_t>(std::lround(255.0 * signal));
}

}  // namespace

std::vector<std::uint8_t> encode_png(const Image& image) {
  const std::array<int, 3> rgb = rgb_channels(image, "a PNG");
  const int alpha = image.channel("A");
  std::vector<std::uint8_t> codes;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      std::array<double, 3> color{};
      for (std::size_t c = 0; c < 3; ++c) {
        color[c] = image.at(x, y, rgb[c]);
      }
      const double coverage = alpha < 0 ? 1.0 : image.at(x, y, alpha);
      if (std::isnan(color[0]) || std::isnan(color[1]) || std::isnan(color[2]) || std::isnan(coverage)) {
        codes.insert(codes.end(), {255, 0, 255});
        if (alpha >= 0) {
          codes.push_back(255);
        }
        continue;
      }
      for (const double value : color) {
        codes.push_back(coverage > 0 ? code_of(linear_to_srgb(value / coverage)) : std::uint8_t{0});
      }
      if (alpha >= 0) {
        codes.push_back(code_of(std::clamp(coverage, 0.0, 1.0)));
      }
    }
  }
  return encode(image.width, image.height, alpha < 0 ? 3 : 4, 8, true, codes.data(), codes.size());
}

std::vector<std::uint8_t> encode_png_codes(int width, int height, int channels, int bits, const std::vector<std::uint16_t>& codes) {
  if (width <= 0 || height <= 0 || channels < 1 || channels > 4 || (bits != 8 && bits != 16)) {
    fail("it holds 1 to 4 channels of 8 or 16 bits and at least one pixel");
  }
  const std::size_t expected = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * static_cast<std::size_t>(channels);
  if (codes.size() != expected) {
    fail("the codes do not fit its size");
  }
  if (bits == 16) {
    return encode(width, height, channels, bits, false, codes.data(), codes.size() * sizeof(std::uint16_t));
  }
  if (std::any_of(codes.begin(), codes.end(), [](std::uint16_t code) { return code > 255; })) {
    fail("a code of 8 bits is over 255");
  }
  const std::vector<std::uint8_t> narrow(codes.begin(), codes.end());
  return encode(width, height, channels, bits, false, narrow.data(), narrow.size());
}

}  // namespace sheen::image
