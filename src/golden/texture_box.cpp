#include "golden/texture_box.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/common.hpp>

#include "number/precision.h"

namespace sheen::golden {
namespace {

constexpr double epsilon = number::epsilon<number::Highp>;
/// Of a filter whose weights are exact, relative to the largest texel. 20 for a texel that the shader decodes from its sRGB code:
/// x = (code + 0.055) / 1.055 3.5, magnified 2.4 times by x^2.4, of whose factor x^0.4 log2 costs 0.4 ln 2 times 8 (4 ulp of a value up to
/// 4), the exponent's product ln 2, exp2 3 + 2 * 1.4, and two products. And for each of three interpolations, x (1 - a) + y a, 1 for 1 - a,
/// 1 for the products and 1 for the sum.
constexpr double filter_roundings = 29;
/// Of a coordinate in texels: the product with the size, and the two differences that make a weight of it.
constexpr double coordinate_roundings = 3;
/// A box over more texels than this is no longer looked at edge by edge: such a texture is left out of verdicts.
constexpr double most_edges = 32;

// Coordinates along one axis to look at: both ends, and the edges and bends between them, which lie at halves of a texel.
void add_places(double from, double to, double texels, std::vector<double>& places) {
  const double first = std::floor(2.0 * from * texels) + 1.0;
  const double last = std::min(std::ceil(2.0 * to * texels) - 1.0, first + most_edges);
  for (double half = first; half <= last; half += 1.0) {
    places.push_back(0.5 * half / texels);
  }
}

}  // namespace

Spread sample_box(const Texture& texture, glm::dvec2 uv, glm::dvec2 reach, double lambda) {
  Spread out;
  out.value = sample(texture, uv, lambda);
  const glm::dvec2 off = reach + coordinate_roundings * epsilon * (glm::abs(uv) + glm::dvec2(1.0) / texture.size());
  // The two levels that may be read; of a texture without mipmaps, level 0.
  const auto last = static_cast<double>(texture.levels->size() - 1);
  const double first_level = std::clamp(std::floor(lambda), 0.0, last);
  std::vector<double> x{uv.x - off.x, uv.x + off.x};
  std::vector<double> y{uv.y - off.y, uv.y + off.y};
  for (const double level : {first_level, std::min(first_level + 1.0, last)}) {
    const scene::Texels& texels = (*texture.levels)[static_cast<std::size_t>(level)];
    add_places(uv.x - off.x, uv.x + off.x, texels.width, x);
    add_places(uv.y - off.y, uv.y + off.y, texels.height, y);
    if (last == 0.0) {
      break;
    }
  }
  glm::dvec4 largest = glm::abs(out.value);
  for (const double v : y) {
    for (const double u : x) {
      const glm::dvec4 there = sample(texture, {u, v}, lambda);
      out.radius = glm::max(out.radius, glm::abs(there - out.value));
      largest = glm::max(largest, glm::abs(there));
    }
  }
  out.radius += filter_roundings * epsilon * largest;
  return out;
}

}  // namespace sheen::golden
