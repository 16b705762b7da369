#include "scene/texels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

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
void halve_even(const Texels& above, Texels& below) {
  const auto line = static_cast<std::size_t>(above.width);
  for (std::size_t y = 0; y < static_cast<std::size_t>(below.height); ++y) {
    const glm::vec4* upper = above.rgba.data() + 2 * y * line;
    glm::vec4* out = below.rgba.data() + y * static_cast<std::size_t>(below.width);
    for (std::size_t x = 0; x < 2 * static_cast<std::size_t>(below.width); x += 2) {
      const glm::dvec4 sum =
          glm::dvec4(upper[x]) + glm::dvec4(upper[x + 1]) + glm::dvec4(upper[line + x]) + glm::dvec4(upper[line + x + 1]);
      *out++ = glm::vec4(0.25 * sum);
    }
  }
}

Texels halve(const Texels& above) {
  Texels below;
  below.width = std::max(1, above.width / 2);
  below.height = std::max(1, above.height / 2);
  below.rgba.resize(static_cast<std::size_t>(below.width) * static_cast<std::size_t>(below.height));
  if (above.width % 2 == 0 && above.height % 2 == 0) {
    halve_even(above, below);
    return below;
  }
  const std::vector<Footprint> columns = footprints(above.width, below.width);
  const std::vector<Footprint> rows = footprints(above.height, below.height);
  std::size_t texel = 0;
  for (const Footprint& row : rows) {
    for (const Footprint& column : columns) {
      glm::dvec4 sum(0.0);
      for (int y = 0; y < row.count; ++y) {
        const auto line = static_cast<std::size_t>(row.first + y) * static_cast<std::size_t>(above.width);
        for (int x = 0; x < column.count; ++x) {
          sum += row.weight[y] * column.weight[x] * glm::dvec4(above.rgba[line + static_cast<std::size_t>(column.first + x)]);
        }
      }
      below.rgba[texel++] = glm::vec4(sum);
    }
  }
  return below;
}

}  // namespace

Texels decode(const Picture& picture, ColorSpace space) {
  Texels texels;
  texels.width = picture.width;
  texels.height = picture.height;
  texels.rgba.resize(static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
  const std::vector<float> color = decoding_table(picture.bits, space);
  const std::vector<float> alpha = decoding_table(picture.bits, ColorSpace::Linear);
  const std::uint16_t* code = picture.codes.data();
  for (glm::vec4& texel : texels.rgba) {
    texel = glm::vec4(color[code[0]], color[code[1]], color[code[2]], alpha[code[3]]);
    code += 4;
  }
  return texels;
}

std::vector<Texels> mipmaps(Texels level0) {
  std::vector<Texels> levels;
  levels.push_back(std::move(level0));
  while (levels.back().width > 1 || levels.back().height > 1) {
    levels.push_back(halve(levels.back()));
  }
  return levels;
}

}  // namespace sheen::scene
