#include "golden/texture_box.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/common.hpp>

#include "golden/bound.h"

namespace sheen::golden {
namespace {

/// Of a filter whose weights are exact, relative to the largest texel. 20 for a texel that the shader decodes from its sRGB code:
/// x = (code + 0.055) / 1.055 3.5, magnified 2.4 times by x^2.4, of whose factor x^0.4 log2 costs 0.4 ln 2 times 8 (4 ulp of a value up to
/// 4), the exponent's product ln 2, exp2 3 + 2 * 1.4, and two products. And for each of three interpolations, x (1 - a) + y a, 1 for 1 - a,
/// 1 for the products and 1 for the sum.
constexpr double filter_roundings = 29;
/// Of a coordinate in texels: the product with the size, and the two differences that make a weight of it.
constexpr double coordinate_roundings = 3;

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

// Both ends along one axis, and the edges and bends between them, which lie at halves of a texel.
void TextureBox::Places::add_between(double from, double to, double texels) {
  const double last = std::ceil(2.0 * to * texels) - 1.0;
  for (double half = std::floor(2.0 * from * texels) + 1.0; half <= last; half += 1.0) {
    at.at(count++) = 0.5 * half / texels;
  }
}

// For a level and the next coarser one, uv first.
template <class Look>
void TextureBox::at_places(double first_level, const Look& look) const {
  const auto last = static_cast<double>(texture_.levels->size() - 1);
  Places x{{uv_.x - off_.x, uv_.x + off_.x}, 2};
  Places y{{uv_.y - off_.y, uv_.y + off_.y}, 2};
  for (double level = first_level; level <= std::min(first_level + 1.0, last); level += 1.0) {
    const scene::Texels& texels = (*texture_.levels)[static_cast<std::size_t>(level)];
    x.add_between(x.at[0], x.at[1], texels.width);
    y.add_between(y.at[0], y.at[1], texels.height);
  }
  look(uv_);
  for (std::size_t row = 0; row < y.count; ++row) {
    for (std::size_t column = 0; column < x.count; ++column) {
      look({x.at.at(column), y.at.at(row)});
    }
  }
}

const TextureBox::Pair& TextureBox::pair(double first) {
  for (const Pair& known : pairs_) {
    if (known.first == first) {
      return known;
    }
  }
  Pair& made = pairs_.emplace_back();
  made.first = first;
  LevelReader finer = minified(texture_, first);
  LevelReader coarser = minified(texture_, first + 1.0);
  at_places(first, [&](const glm::dvec2& at) { made.values.push_back({finer(at), coarser(at)}); });
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
    LevelReader read = unmixed(texture_, lambda);
    at_places(std::clamp(std::floor(lambda), 0.0, last), [&](const glm::dvec2& at) { include(read(at)); });
  }
  out.radius += filter_roundings * epsilon * largest;
  return out;
}

}  // namespace sheen::golden
