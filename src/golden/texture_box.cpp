#include "golden/texture_box.h"

#include <cstddef>
#include <optional>

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

Spread spread(const glm::dvec4& value, const glm::dvec4& reach) {
  return {value, reach + filter_roundings * epsilon * (glm::abs(value) + reach)};
}

}  // namespace

TextureBox::TextureBox(const Texture& texture, glm::dvec2 uv, glm::dvec2 reach)
    : texture_(texture), uv_(uv), off_(reach + coordinate_roundings * epsilon * (glm::abs(uv) + glm::dvec2(1.0) / texture.size())) {}

TextureBox::Level TextureBox::look(LevelReader read, double number) const {
  Level out{};
  const std::optional<Patch> patch = read.patch(uv_, off_);
  out.is_flat = patch.has_value();
  if (patch) {
    out.patch = *patch;
    out.value = patch->value;
    out.below = out.above = patch->reach();
    return out;
  }
  out.value = read(uv_);
  const glm::dvec2 texels = 2.0 * off_ * glm::dvec2(read.level().width, read.level().height);
  const auto hold = [&out](const auto& all) {
    out.below = out.value - glm::dvec4(all.least);
    out.above = glm::dvec4(all.most) - out.value;
  };
  if (texels.x <= widest_box && texels.y <= widest_box) {
    hold(read.extent(uv_, off_));
  } else {
    const LevelReader::Block block = read.block(uv_, off_);
    hold(texture_.levels->extents(static_cast<std::size_t>(number)).over(block.columns, block.rows, read.sampler()));
  }
  return out;
}

const TextureBox::Level& TextureBox::minified_level(double number) {
  Level& level = levels_.at(static_cast<std::size_t>(number));
  const std::uint32_t bit = 1U << static_cast<std::uint32_t>(number);
  if ((known_ & bit) == 0) {
    known_ |= bit;
    level = look(minified(texture_, number), number);
  }
  return level;
}

Spread TextureBox::mixed(const Mixture& mixture) {
  const Level& a = minified_level(mixture.first);
  const Level& b = minified_level(mixture.first + 1.0);
  const double share = mixture.share;
  const auto mix = [share](const glm::dvec4& x, const glm::dvec4& y) { return x * (1.0 - share) + y * share; };
  if (a.is_flat && b.is_flat) {
    const Patch patch{mix(a.value, b.value), mix(a.patch.along_u, b.patch.along_u), mix(a.patch.along_v, b.patch.along_v),
                      mix(a.patch.twist, b.patch.twist)};
    return spread(patch.value, patch.reach());
  }
  return spread(mix(a.value, b.value), glm::max(mix(a.below, b.below), mix(a.above, b.above)));
}

Spread TextureBox::operator()(double lambda) {
  if (const std::optional<Mixture> mixture = golden::mixture(texture_, lambda)) {
    return mixed(*mixture);
  }
  const Level level = look(unmixed(texture_, lambda), unmixed_level(texture_, lambda));
  return spread(level.value, glm::max(level.below, level.above));
}

}  // namespace sheen::golden
