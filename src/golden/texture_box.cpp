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

/// About the first of some values, all of them.
class Looks {
 public:
  void include(const glm::dvec4& there) {
    value_ = is_first_ ? there : value_;
    is_first_ = false;
    reach_ = glm::max(reach_, glm::abs(there - value_));
    largest_ = glm::max(largest_, glm::abs(there));
  }
  Spread spread() const { return {value_, reach_ + filter_roundings * epsilon * largest_}; }

 private:
  bool is_first_ = true;
  glm::dvec4 value_{0.0}, reach_{0.0}, largest_{0.0};
};

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

// Between both ends along one axis, the bends of a linear filter, which are the middles of texels; of one that is not, these and the edges:
// where two levels are mixed, the edges of one may cut the other's texels anywhere.
void TextureBox::Places::add_between(double from, double to, double texels, scene::Filter filter) {
  const double each = filter == scene::Filter::Linear ? 1.0 : 0.5;  // of a texel
  const double last = std::ceil((to * texels - 0.5) / each) - 1.0;
  for (double place = std::floor((from * texels - 0.5) / each) + 1.0; place <= last; place += 1.0) {
    at.at(count++) = (place * each + 0.5) / texels;
  }
}

// For one level, or for two that are mixed, uv first.
template <class Look>
void TextureBox::at_places(const LevelReader& finer, const LevelReader* coarser, const Look& look) const {
  Places x;
  Places y;
  x.at[0] = uv_.x - off_.x;
  x.at[1] = uv_.x + off_.x;
  y.at[0] = uv_.y - off_.y;
  y.at[1] = uv_.y + off_.y;
  x.count = y.count = 2;
  for (const LevelReader* reader : {&finer, coarser}) {
    if (reader != nullptr) {
      x.add_between(x.at[0], x.at[1], reader->level().width, reader->filter());
      y.add_between(y.at[0], y.at[1], reader->level().height, reader->filter());
    }
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
  at_places(finer, &coarser, [&](const glm::dvec2& at) { made.values.push_back({finer(at), coarser(at)}); });
  return made;
}

Spread TextureBox::operator()(double lambda) {
  const auto last = static_cast<double>(texture_.levels->size() - 1);
  if (is_wide(std::clamp(std::floor(lambda), 0.0, last))) {
    return over_levels(lambda);
  }
  if (const std::optional<Mixture> mixed = mixture(texture_, lambda)) {
    const double share = mixed->share;
    const Level& finer = level(mixed->first);
    const Level& coarser = level(mixed->first + 1.0);
    const auto mix = [share](const glm::dvec4& a, const glm::dvec4& b) { return a * (1.0 - share) + b * share; };
    if (finer.is_flat && coarser.is_flat) {
      const Patch& a = finer.patch;
      const Patch& b = coarser.patch;
      return spread({mix(a.value, b.value), mix(a.along_u, b.along_u), mix(a.along_v, b.along_v), mix(a.twist, b.twist)});
    }
    Looks looks;
    for (const auto& [fine, coarse] : pair(mixed->first).values) {
      looks.include(mix(fine, coarse));
    }
    return looks.spread();
  }
  LevelReader read = unmixed(texture_, lambda);
  if (const std::optional<Patch> patch = read.patch(uv_, off_)) {
    return spread(*patch);
  }
  Looks looks;
  at_places(read, nullptr, [&](const glm::dvec2& at) { looks.include(read(at)); });
  return looks.spread();
}

}  // namespace sheen::golden
