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

Spread spread(const Patch& patch) {
  const glm::dvec4 reach = patch.reach();
  return {patch.value, reach + filter_roundings * epsilon * (glm::abs(patch.value) + reach)};
}

Spread spread(const glm::dvec4& value, const Extent<glm::dvec4>& all) {
  const glm::dvec4 largest = glm::max(glm::abs(all.least), glm::abs(all.most));
  return {value, glm::max(all.most - value, value - all.least) + filter_roundings * epsilon * largest};
}

}  // namespace

TextureBox::TextureBox(const Texture& texture, glm::dvec2 uv, glm::dvec2 reach)
    : texture_(texture), uv_(uv), off_(reach + coordinate_roundings * epsilon * (glm::abs(uv) + glm::dvec2(1.0) / texture.size())) {}

bool TextureBox::is_wide(const scene::Texels& level) const {
  return !(2.0 * off_.x * level.width <= widest_box && 2.0 * off_.y * level.height <= widest_box);
}

// What a reader may find of a level of that number, by its texels.
Extent<glm::dvec4> TextureBox::over_texels(double number, const LevelReader& reader) const {
  const LevelReader::Block block = reader.block(uv_, off_);
  const TexelExtents& extents = texture_.levels->extents(static_cast<std::size_t>(number));
  const Extent<glm::vec4> texels = extents.over(block.columns, block.rows, reader.sampler());
  return {glm::dvec4(texels.least), glm::dvec4(texels.most)};
}

// Between both ends along one axis, the bends of a linear filter, which are the middles of texels; of one that is not, these and the edges:
// where two levels are mixed, the edges of one may cut the other's texels anywhere.
void TextureBox::Places::add_between(double from, double to, double texels, scene::Filter filter) {
  const double each = filter == scene::Filter::Linear ? 1.0 : 0.5;  // of a texel
  const double last = std::ceil((to * texels - 0.5) / each) - 1.0;
  for (double place = std::floor((from * texels - 0.5) / each) + 1.0; place <= last; place += 1.0) {
    at.at(count++) = (place * each + 0.5) / texels;
  }
}

// For two levels that are mixed, uv first.
template <class Look>
void TextureBox::at_places(const LevelReader& finer, const LevelReader& coarser, const Look& look) const {
  Places x;
  Places y;
  x.at[0] = uv_.x - off_.x;
  x.at[1] = uv_.x + off_.x;
  y.at[0] = uv_.y - off_.y;
  y.at[1] = uv_.y + off_.y;
  x.count = y.count = 2;
  for (const LevelReader* reader : {&finer, &coarser}) {
    x.add_between(x.at[0], x.at[1], reader->level().width, reader->filter());
    y.add_between(y.at[0], y.at[1], reader->level().height, reader->filter());
  }
  look(uv_);
  for (std::size_t row = 0; row < y.count; ++row) {
    for (std::size_t column = 0; column < x.count; ++column) {
      look({x.at.at(column), y.at.at(row)});
    }
  }
}

const TextureBox::Level& TextureBox::level(double number) {
  Level& level = levels_.at(static_cast<std::size_t>(number));
  const std::uint32_t bit = 1U << static_cast<std::uint32_t>(number);
  if ((known_ & bit) == 0) {
    known_ |= bit;
    const std::optional<Patch> patch = minified(texture_, number).patch(uv_, off_);
    level.is_flat = patch.has_value();
    if (patch) {
      level.patch = *patch;
    }
  }
  return level;
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
  at_places(finer, coarser, [&](const glm::dvec2& at) { made.values.push_back({finer(at), coarser(at)}); });
  return made;
}

Spread TextureBox::mixed(const Mixture& mixture) {
  const double share = mixture.share;
  const auto mix = [share](const glm::dvec4& a, const glm::dvec4& b) { return a * (1.0 - share) + b * share; };
  if (is_wide((*texture_.levels)[static_cast<std::size_t>(mixture.first)])) {
    LevelReader finer = minified(texture_, mixture.first);
    LevelReader coarser = minified(texture_, mixture.first + 1.0);
    Extent<glm::dvec4> all = over_texels(mixture.first, finer);
    all.include(over_texels(mixture.first + 1.0, coarser));
    return spread(mix(finer(uv_), coarser(uv_)), all);
  }
  const Level& finer = level(mixture.first);
  const Level& coarser = level(mixture.first + 1.0);
  if (finer.is_flat && coarser.is_flat) {
    const Patch& a = finer.patch;
    const Patch& b = coarser.patch;
    return spread({mix(a.value, b.value), mix(a.along_u, b.along_u), mix(a.along_v, b.along_v), mix(a.twist, b.twist)});
  }
  const std::vector<std::array<glm::dvec4, 2>>& values = pair(mixture.first).values;
  const glm::dvec4 value = mix(values.front()[0], values.front()[1]);
  Extent<glm::dvec4> all{value, value};
  for (const auto& [fine, coarse] : values) {
    all.include(mix(fine, coarse));
  }
  return spread(value, all);
}

Spread TextureBox::operator()(double lambda) {
  if (const std::optional<Mixture> mixture = golden::mixture(texture_, lambda)) {
    return mixed(*mixture);
  }
  LevelReader read = unmixed(texture_, lambda);
  if (const std::optional<Patch> patch = read.patch(uv_, off_)) {
    return spread(*patch);
  }
  return spread(read(uv_), is_wide(read.level()) ? over_texels(unmixed_level(texture_, lambda), read) : read.extent(uv_, off_));
}

}  // namespace sheen::golden
