#include "renderer/picture_texture.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <glm/vec4.hpp>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "renderer/unfiltered_texture.h"

namespace sheen::renderer {
namespace {

/// Texels of 128 bits that a row of level 0 takes as codes.
int fours(int width) {
  return (width + 3) / 4;
}

int rows_a_line(Storage storage) {
  return storage == Storage::Floats ? 1 : 2;
}

int columns_of_level0(Storage storage, int width) {
  return storage == Storage::Floats ? width : 2 * fours(width);
}

int lines_of_level0(Storage storage, int height) {
  return (height + rows_a_line(storage) - 1) / rows_a_line(storage);
}

/// The number of the last level, 1 x 1.
int last_level(int width, int height) {
  return std::bit_width(static_cast<unsigned>(std::max(width, height))) - 1;
}

/// A row's codes, 8 bits each from red upwards.
void pack(const std::uint16_t* codes, int width, std::uint32_t* out) {
  for (int x = 0; x < width; ++x, codes += 4) {
    out[x] = static_cast<std::uint32_t>(codes[0]) | static_cast<std::uint32_t>(codes[1]) << 8U |
             static_cast<std::uint32_t>(codes[2]) << 16U | static_cast<std::uint32_t>(codes[3]) << 24U;
  }
}

}  // namespace

Storage storage_of(const scene::Picture& picture, scene::ColorSpace space) {
  if (picture.bits != 8) {
    return Storage::Floats;
  }
  return space == scene::ColorSpace::Srgb ? Storage::SrgbCodes : Storage::LinearCodes;
}

PictureTexture::PictureTexture(const gles::Functions& gl, std::string what, int width, int height, Storage storage, bool mipmapped)
    : gl_(&gl), what_(std::move(what)), width_(width), height_(height), storage_(storage), texture_([&] {
        int columns = columns_of_level0(storage, width);
        int lines = lines_of_level0(storage, height);
        for (int level = 1; mipmapped && level <= last_level(width, height) + 1; ++level) {
          const Place place = origin(level);
          columns = std::max(columns, place.x + std::max(width >> level, 1));
          lines = std::max(lines, place.y + std::max(height >> level, 1));
        }
        return unfiltered_texture(gl, what_ + ", as it is stored,", GL_RGBA32UI, GL_RGBA_INTEGER, GL_UNSIGNED_INT, columns, lines, nullptr);
      }()) {}

PictureTexture::Place PictureTexture::origin(int level) const {
  const int below = lines_of_level0(storage_, height_);
  if (level <= 1) {
    return {0, level == 0 ? 0 : below};
  }
  return {(width_ >> 1) - (width_ >> (level - 1)) + level - 2, below + std::max(height_ >> 1, 1)};
}

/// Lines of level 0 that fill(first, count, out) gives, as many bands at once as there are processors: what is made stays in their caches.
template <class Value, class Fill>
void PictureTexture::put_lines(int columns, int lines, const Fill& fill) const {
  constexpr int texels_a_band = 1 << 14;
  constexpr std::size_t values_a_texel = 16 / sizeof(Value);
  const int band = std::clamp(texels_a_band / columns, 1, lines);
  std::vector<std::vector<Value>> bands(static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()));
  for (int first = 0; first < lines; first += band * static_cast<int>(bands.size())) {
    const auto begin = [&](std::size_t i) { return std::min(first + band * static_cast<int>(i), lines); };
    tbb::parallel_for(std::size_t{0}, bands.size(), [&](std::size_t i) {
      const int count = begin(i + 1) - begin(i);
      bands[i].resize(values_a_texel * static_cast<std::size_t>(count) * static_cast<std::size_t>(columns));
      fill(begin(i), count, bands[i].data());
    });
    for (std::size_t i = 0; i < bands.size(); ++i) {
      gl_->TexSubImage2D(GL_TEXTURE_2D, 0, 0, begin(i), columns, begin(i + 1) - begin(i), GL_RGBA_INTEGER, GL_UNSIGNED_INT,
                         bands[i].data());
    }
  }
}

void PictureTexture::put_level0(const scene::Picture& picture, scene::ColorSpace space) const {
  const int columns = columns_of_level0(storage_, width_);
  const int lines = lines_of_level0(storage_, height_);
  if (storage_ == Storage::Floats) {
    const scene::RowDecoder decoder(picture, space);
    put_lines<glm::vec4>(columns, lines, decoder);
    return;
  }
  put_lines<std::uint32_t>(columns, lines, [&](int first, int count, std::uint32_t* out) {
    for (int row = 2 * first; row < std::min(2 * (first + count), height_); ++row, out += std::ptrdiff_t{4} * fours(width_)) {
      const std::size_t at = std::size_t{4} * static_cast<std::size_t>(width_) * static_cast<std::size_t>(row);
      pack(picture.codes.data() + at, width_, out);
    }
  });
}

void PictureTexture::put_level(int level, const scene::Texels& texels) const {
  const Place place = origin(level);
  gl_->TexSubImage2D(GL_TEXTURE_2D, 0, place.x, place.y, texels.width, texels.height, GL_RGBA_INTEGER, GL_UNSIGNED_INT, texels.rgba.data());
}

gles::Texture PictureTexture::take() {
  gles::check(*gl_, "uploading " + what_);
  return std::move(texture_);
}

std::vector<scene::Texels> levels_below(const scene::Picture& picture, scene::ColorSpace space) {
  std::vector<scene::Texels> levels = scene::mipmaps_below(picture, space);
  levels.push_back(levels.empty() ? scene::decode(picture, space) : levels.back());
  return levels;
}

gles::Texture upload_mipmapped(const gles::Functions& gl, const std::string& what, const std::vector<scene::Texels>& levels) {
  PictureTexture texture(gl, what, levels.front().width, levels.front().height, Storage::Floats, true);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    texture.put_level(static_cast<int>(i), levels[i]);
  }
  texture.put_level(static_cast<int>(levels.size()), levels.back());
  return texture.take();
}

}  // namespace sheen::renderer
