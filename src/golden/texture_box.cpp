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
/// A box of more texels than this along an axis is no longer looked at edge by edge, of which there are two a texel: a thousand samples.
constexpr double widest_box = 16;

// Coordinates along one axis to look at: both ends, and the edges and bends between them, which lie at halves of a texel.
void add_places(double from, double to, double texels, std::vector<double>& places) {
  const double first = std::floor(2.0 * from * texels) + 1.0;
  const double last = std::ceil(2.0 * to * texels) - 1.0;
  for (double half = first; half <= last; half += 1.0) {
    places.push_back(0.5 * half / texels);
  }
}

}  // namespace

TextureBox::TextureBox(const Texture& texture, glm::dvec2 uv, glm::dvec2 reach)
    : texture_(texture), uv_(uv), off_(reach + coordinate_roundings * epsilon * (glm::abs(uv) + glm::dvec2(1.0) / texture.size())) {}

bool TextureBox::is_wide(double level) const {
  const scene::Texels& texels = (*texture_.levels)[static_cast<std::size_t>(level)];
  return !(2.0 * off_.x * texels.width <= widest_box && 2.0 * off_.y * texels.height <= widest_box);
}

// Whatever the coordinates: of the two levels that may be read, everything.
Spread TextureBox::over_levels(double lambda) const {
  const auto last = static_cast<double>(texture_.levels->size() - 1);
  const double finer = std::clamp(std::floor(lambda), 0.0, last);
  const TextureLevels::Extent& a = texture_.levels->extent(static_cast<std::size_t>(finer));
  const TextureLevels::Extent& b = texture_.levels->extent(static_cast<std::size_t>(std::min(finer + 1.0, last)));
  Spread out;
  out.value = sample(texture_, uv_, lambda);
  out.radius = glm::max(glm::max(a.most, b.most) - out.value, out.value - glm::min(a.least, b.least));
  out.radius += filter_roundings * epsilon * (glm::abs(out.value) + out.radius);
  return out;
}

// For a level and the next coarser one.
std::vector<glm::dvec2> TextureBox::places(double first_level) const {
  const auto last = static_cast<double>(texture_.levels->size() - 1);
  std::vector<double> x{uv_.x - off_.x, uv_.x + off_.x};
  std::vector<double> y{uv_.y - off_.y, uv_.y + off_.y};
  for (const double level : {first_level, std::min(first_level + 1.0, last)}) {
    const scene::Texels& texels = (*texture_.levels)[static_cast<std::size_t>(level)];
    add_places(x[0], x[1], texels.width, x);
    add_places(y[0], y[1], texels.height, y);
    if (last == 0.0) {
      break;
    }
  }
  std::vector<glm::dvec2> all{uv_};
  for (const double v : y) {
    for (const double u : x) {
      all.emplace_back(u, v);
    }
  }
  return all;
}

const TextureBox::Pair& TextureBox::pair(double first) {
  for (const Pair& known : pairs_) {
    if (known.first == first) {
      return known;
    }
  }
  Pair& made = pairs_.emplace_back();
  made.first = first;
  for (const glm::dvec2& at : places(first)) {
    made.values.push_back({sample_minified(texture_, at, first), sample_minified(texture_, at, first + 1.0)});
  }
  return made;
}

Spread TextureBox::operator()(double lambda) {
  if (is_wide(std::clamp(std::floor(lambda), 0.0, static_cast<double>(texture_.levels->size() - 1)))) {
    return over_levels(lambda);
  }
  Spread out;
  glm::dvec4 largest(0.0);
  bool first = true;
  const auto include = [&](const glm::dvec4& there) {
    out.value = first ? there : out.value;
    out.radius = glm::max(out.radius, glm::abs(there - out.value));
    largest = glm::max(largest, glm::abs(there));
    first = false;
  };
  if (const std::optional<Mixture> mixed = mixture(texture_, lambda)) {
    for (const auto& [finer, coarser] : pair(mixed->first).values) {
      include(finer * (1.0 - mixed->share) + coarser * mixed->share);
    }
  } else {
    const auto last = static_cast<double>(texture_.levels->size() - 1);
    for (const glm::dvec2& at : places(std::clamp(std::floor(lambda), 0.0, last))) {
      include(sample(texture_, at, lambda));
    }
  }
  out.radius += filter_roundings * epsilon * largest;
  return out;
}

}  // namespace sheen::golden
