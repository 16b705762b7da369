#include "scene/texels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>

namespace sheen::scene {
namespace {

// IEC 61966-2-1, the inverse of its transfer function, in double.
double srgb_to_linear(double code) {
  return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}

std::vector<float> decoding_table(int bits, ColorSpace space) {
  std::vector<float> table(std::size_t{1} << static_cast<unsigned>(bits));
  const auto largest = static_cast<double>(table.size() - 1);
  for (std::size_t code = 0; code < table.size(); ++code) {
    const double x = static_cast<double>(code) / largest;
    table[code] = static_cast<float>(space == ColorSpace::Srgb ? srgb_to_linear(x) : x);
  }
  return table;
}

// Which texels of the level above a texel covers along one axis, and how much of it each one fills. A texel of a level of n / 2 (rounded
// down) covers between 2 and 3 texels of n; of a level of 1 made from 1, one.
struct Footprint {
  int first = 0;
  int count = 0;
  double weight[4] = {0.0, 0.0, 0.0, 0.0};
};

std::vector<Footprint> footprints(int above, int below) {
  std::vector<Footprint> result(static_cast<std::size_t>(below));
  // In units of 1 / below of a texel all ends are whole numbers, so the overlaps are exact.
  for (int x = 0; x < below; ++x) {
    Footprint& footprint = result[static_cast<std::size_t>(x)];
    const int begin = x * above;
    const int end = begin + above;
    footprint.first = begin / below;
    for (int texel = footprint.first; texel * below < end; ++texel) {
      const int overlap = std::min(end, (texel + 1) * below) - std::max(begin, texel * below);
      footprint.weight[footprint.count++] = static_cast<double>(overlap) / static_cast<double>(above);
    }
  }
  return result;
}

/// The mean of each 2 x 2 texels: what halve() gives for even sizes, to the last bit, three times as fast.
template <class Rows>
void halve_even(const Rows& rows, Texels& below) {
  const std::size_t line = 2 * static_cast<std::size_t>(below.width);
  for (int y = 0; y < below.height; ++y) {
    const glm::vec4* upper = rows(2 * y, 2);
    glm::vec4* out = below.rgba.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(below.width);
    for (std::size_t x = 0; x < line; x += 2) {
      const glm::dvec4 sum =
          glm::dvec4(upper[x]) + glm::dvec4(upper[x + 1]) + glm::dvec4(upper[line + x]) + glm::dvec4(upper[line + x + 1]);
      *out++ = glm::vec4(0.25 * sum);
    }
  }
}

/// The level below one of that size. rows(first, count) gives the texels of so many rows of it, one after the other.
template <class Rows>
Texels halve(int width, int height, const Rows& rows) {
  Texels below;
  below.width = std::max(1, width / 2);
  below.height = std::max(1, height / 2);
  below.rgba.resize(static_cast<std::size_t>(below.width) * static_cast<std::size_t>(below.height));
  if (width % 2 == 0 && height % 2 == 0) {
    halve_even(rows, below);
    return below;
  }
  const std::vector<Footprint> across = footprints(width, below.width);
  std::size_t texel = 0;
  for (const Footprint& down : footprints(height, below.height)) {
    const glm::vec4* above = rows(down.first, down.count);
    for (const Footprint& column : across) {
      glm::dvec4 sum(0.0);
      for (int y = 0; y < down.count; ++y) {
        const std::size_t line = static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
        for (int x = 0; x < column.count; ++x) {
          sum += down.weight[y] * column.weight[x] * glm::dvec4(above[line + static_cast<std::size_t>(column.first + x)]);
        }
      }
      below.rgba[texel++] = glm::vec4(sum);
    }
  }
  return below;
}

Texels halve(const Texels& above) {
  return halve(above.width, above.height, [&above](int first, int) {
    return above.rgba.data() + static_cast<std::size_t>(first) * static_cast<std::size_t>(above.width);
  });
}

void add_smaller(std::vector<Texels>& levels) {
  while (levels.back().width > 1 || levels.back().height > 1) {
    levels.push_back(halve(levels.back()));
  }
}

}  // namespace

RowDecoder::RowDecoder(const Picture& picture, ColorSpace space)
    : picture_(picture), color_(decoding_table(picture.bits, space)), alpha_(decoding_table(picture.bits, ColorSpace::Linear)) {}

void RowDecoder::operator()(int first, int count, glm::vec4* out) const {
  const auto line = static_cast<std::size_t>(picture_.width);
  const std::uint16_t* code = picture_.codes.data() + 4 * line * static_cast<std::size_t>(first);
  for (std::size_t i = 0; i < line * static_cast<std::size_t>(count); ++i, code += 4) {
    out[i] = glm::vec4(color_[code[0]], color_[code[1]], color_[code[2]], alpha_[code[3]]);
  }
}

Texels decode(const Picture& picture, ColorSpace space) {
  Texels texels;
  texels.width = picture.width;
  texels.height = picture.height;
  texels.rgba.resize(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
  RowDecoder(picture, space)(0, picture.height, texels.rgba.data());
  return texels;
}

std::vector<Texels> mipmaps(Texels level0) {
  std::vector<Texels> levels;
  levels.push_back(std::move(level0));
  add_smaller(levels);
  return levels;
}

std::vector<Texels> mipmaps_below(const Picture& picture, ColorSpace space) {
  std::vector<Texels> levels;
  if (picture.width == 1 && picture.height == 1) {
    return levels;
  }
  const RowDecoder decoder(picture, space);
  std::vector<glm::vec4> decoded(static_cast<std::size_t>(picture.width) * std::size(Footprint{}.weight));
  levels.push_back(halve(picture.width, picture.height, [&](int first, int count) {
    decoder(first, count, decoded.data());
    return decoded.data();
  }));
  add_smaller(levels);
  return levels;
}

}  // namespace sheen::scene
