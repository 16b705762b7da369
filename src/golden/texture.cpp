#include "golden/texture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace sheen::golden {
namespace {

double ideal_span(glm::dvec2 here, glm::dvec2 right, glm::dvec2 below) {
  return std::max(glm::length(right - here), glm::length(below - here));
}

// Least and most of |difference| along one axis of the 3 x 3 block, over its rows and over either neighbour: an implementation may take its
// quad's difference on either side and in either row.
void extremes(const glm::dvec2 (&texels)[9], int along, int across, glm::dvec2& least, glm::dvec2& most) {
  least = glm::dvec2(std::numeric_limits<double>::infinity());
  most = glm::dvec2(0.0);
  for (int line = 0; line < 3; ++line) {
    for (int step = 0; step < 2; ++step) {
      const int from = line * across + step * along;
      const glm::dvec2 d = glm::abs(texels[from + along] - texels[from]);
      least = glm::min(least, d);
      most = glm::max(most, d);
    }
  }
}

}  // namespace

// Section 3.8.10.3: where a smooth magnification meets an unfiltered mipmapped minification, the switch lies half a level higher.
double magnified_up_to(const scene::Sampler& s) {
  using scene::Filter;
  return s.mag == Filter::Linear && s.min == Filter::Nearest && s.mip != scene::MipFilter::None ? 0.5 : 0.0;
}

// Equation 3.24: halves round down.
double nearest_level(const Texture& texture, double lambda) {
  const auto last = static_cast<double>(texture.levels->size() - 1);
  return std::clamp(std::ceil(std::min(lambda, last) + 0.5) - 1.0, 0.0, last);
}

const TexelExtents& TextureLevels::extents(std::size_t level) const {
  Lazy& lazy = extents_[level];
  std::call_once(lazy.found, [&] { lazy.extents.emplace(levels_[level]); });
  return *lazy.extents;
}

Texture TextureStore::get(int texture, scene::ColorSpace space) {
  const std::string element = "textures[" + std::to_string(texture) + "]";
  if (texture < 0 || texture >= static_cast<int>(scene_.textures.size())) {
    throw scene::Error(scene_.file, element, "does not exist");
  }
  const scene::Texture& source = scene_.textures[static_cast<std::size_t>(texture)];
  if (source.picture < 0 || source.picture >= static_cast<int>(scene_.pictures.size())) {
    throw scene::Error(scene_.file, element, "its image does not exist");
  }
  const bool mips = source.sampler.mip != scene::MipFilter::None;
  // With mipmaps and without, a picture is two textures: what reads level 0 alone takes the last level for 0.
  Levels& levels = decoded_[{source.picture, space, mips}];
  if (levels == nullptr) {
    scene::Texels level0 = scene::decode(scene_.pictures[static_cast<std::size_t>(source.picture)], space);
    if (level0.width <= 0 || level0.height <= 0) {
      throw scene::Error(scene_.file, element, "its image is empty");
    }
    std::vector<scene::Texels> chain;
    if (mips) {
      chain = scene::mipmaps(std::move(level0));
    } else {
      chain.push_back(std::move(level0));
    }
    levels = std::make_shared<const TextureLevels>(std::move(chain));
  }
  return {levels, source.sampler};
}

std::optional<Mixture> mixture(const Texture& texture, double lambda) {
  const double first = std::floor(lambda);
  const bool mixes = texture.sampler.mip == scene::MipFilter::Linear && lambda > magnified_up_to(texture.sampler) &&
                     lambda < static_cast<double>(texture.levels->size() - 1);
  return mixes ? std::optional(Mixture{first, lambda - first}) : std::nullopt;
}

const glm::vec4& LevelReader::texel_at(int x, int y) const {
  return level_.rgba[static_cast<std::size_t>(y) * static_cast<std::size_t>(level_.width) + static_cast<std::size_t>(x)];
}

glm::dvec4 LevelReader::texel(double i, double j) const {
  return glm::dvec4(texel_at(wrapped(i, level_.width, sampler_.wrap_s), wrapped(j, level_.height, sampler_.wrap_t)));
}

// Coordinates in texels, from the first texel's middle where the filter is linear and from its edge where it is not.
glm::dvec2 LevelReader::texels_at(glm::dvec2 uv) const {
  const bool finite = std::isfinite(uv.x) && std::isfinite(uv.y);
  const double u = finite ? uv.x * level_.width : 0.0;
  const double v = finite ? uv.y * level_.height : 0.0;
  return filter_ == scene::Filter::Linear ? glm::dvec2(u - 0.5, v - 0.5) : glm::dvec2(u, v);
}

glm::dvec4 LevelReader::operator()(glm::dvec2 uv) {
  const glm::dvec2 at = texels_at(uv);
  const bool linear = filter_ == scene::Filter::Linear;
  const double i = std::floor(at.x);
  const double j = std::floor(at.y);
  if (!(i == i_ && j == j_)) {
    i_ = i;
    j_ = j;
    texels_[0] = texel(i, j);
    if (linear) {
      texels_ = {texels_[0], texel(i + 1.0, j), texel(i, j + 1.0), texel(i + 1.0, j + 1.0)};
    }
  }
  if (!linear) {
    return texels_[0];
  }
  const double a = at.x - i;
  const double b = at.y - j;
  const glm::dvec4 top = texels_[0] * (1.0 - a) + texels_[1] * a;
  const glm::dvec4 bottom = texels_[2] * (1.0 - a) + texels_[3] * a;
  return top * (1.0 - b) + bottom * b;
}

std::optional<Patch> LevelReader::patch(glm::dvec2 uv, glm::dvec2 off) {
  const glm::dvec2 at = texels_at(uv);
  const glm::dvec2 reach = off * glm::dvec2(level_.width, level_.height);
  const glm::dvec2 cell = glm::floor(at);
  if (!(at.x - reach.x >= cell.x && at.x + reach.x < cell.x + 1.0 && at.y - reach.y >= cell.y && at.y + reach.y < cell.y + 1.0)) {
    return std::nullopt;
  }
  Patch p{(*this)(uv), glm::dvec4(0.0), glm::dvec4(0.0), glm::dvec4(0.0)};
  if (filter_ == scene::Filter::Linear) {
    const glm::dvec2 weight = at - cell;
    const glm::dvec4 top = texels_[1] - texels_[0];
    const glm::dvec4 bottom = texels_[3] - texels_[2];
    const glm::dvec4 left = texels_[2] - texels_[0];
    const glm::dvec4 twist = bottom - top;
    p.along_u = (top + twist * weight.y) * reach.x;
    p.along_v = (left + twist * weight.x) * reach.y;
    p.twist = twist * (reach.x * reach.y);
  }
  return p;
}

LevelReader::Block LevelReader::block(glm::dvec2 uv, glm::dvec2 off) const {
  const glm::dvec2 at = texels_at(uv);
  const glm::dvec2 reach = off * glm::dvec2(level_.width, level_.height);
  const glm::dvec2 first = glm::floor(at - reach);
  const glm::dvec2 last = glm::floor(at + reach) + (filter_ == scene::Filter::Linear ? 1.0 : 0.0);
  return {{first.x, last.x}, {first.y, last.y}};
}

// Between two bends, at the middles of texels, the filter is bilinear: what counts are the texels within and, along the block's border,
// where its ends lie between two of them.
Extent<glm::dvec4> LevelReader::extent(glm::dvec2 uv, glm::dvec2 off) const {
  const Block b = block(uv, off);
  const bool linear = filter_ == scene::Filter::Linear;
  const auto width = static_cast<std::size_t>(b.columns.last - b.columns.first + 1.0);
  const auto height = static_cast<std::size_t>(b.rows.last - b.rows.first + 1.0);
  std::array<int, widest_block> columns;
  for (std::size_t i = 0; i < width; ++i) {
    columns.at(i) = wrapped(b.columns.first + static_cast<double>(i), level_.width, sampler_.wrap_s);
  }
  // What share of the first and of the last texel but one lies beyond the ends.
  const glm::dvec2 at = texels_at(uv);
  const glm::dvec2 reach = off * glm::dvec2(level_.width, level_.height);
  const glm::dvec2 low = at - reach - glm::dvec2(b.columns.first, b.rows.first);
  const glm::dvec2 high = at + reach - glm::dvec2(b.columns.last - 1.0, b.rows.last - 1.0);
  const auto mix = [](const glm::dvec4& x, const glm::dvec4& y, double share) { return x * (1.0 - share) + y * share; };
  std::array<glm::dvec4, widest_block> before;
  std::array<glm::dvec4, widest_block> row;
  Extent<glm::dvec4> out{glm::dvec4(std::numeric_limits<double>::infinity()), glm::dvec4(-std::numeric_limits<double>::infinity())};
  for (std::size_t j = 0; j < height; ++j) {
    const int y = wrapped(b.rows.first + static_cast<double>(j), level_.height, sampler_.wrap_t);
    for (std::size_t i = 0; i < width; ++i) {
      row.at(i) = glm::dvec4(texel_at(columns.at(i), y));
    }
    if (linear) {
      const glm::dvec4 first = mix(row[0], row[1], low.x);
      row.at(width - 1) = mix(row.at(width - 2), row.at(width - 1), high.x);
      row[0] = first;
    }
    for (std::size_t i = 0; i < width; ++i) {
      if (!linear || (j > 0 && j + 1 < height)) {
        out.include(row.at(i));
      }
      if (linear && j == 1) {
        out.include(mix(before.at(i), row.at(i), low.y));
      }
      if (linear && j + 1 == height) {
        out.include(mix(before.at(i), row.at(i), high.y));
      }
    }
    before = row;
  }
  return out;
}

// Of the four corners' departures, one pair has the first two with one sign, and the third has it there or at the pair's other end.
glm::dvec4 Patch::reach() const {
  return glm::abs(along_u) + glm::abs(along_v) + glm::abs(twist);
}

LevelReader minified(const Texture& texture, double level) {
  return {(*texture.levels)[static_cast<std::size_t>(level)], texture.sampler, texture.sampler.min};
}

double unmixed_level(const Texture& texture, double lambda) {
  const scene::Sampler& s = texture.sampler;
  if (!(lambda > magnified_up_to(s)) || s.mip == scene::MipFilter::None) {
    return 0.0;
  }
  return s.mip == scene::MipFilter::Nearest ? nearest_level(texture, lambda) : static_cast<double>(texture.levels->size() - 1);
}

LevelReader unmixed(const Texture& texture, double lambda) {
  const scene::Sampler& s = texture.sampler;
  return {(*texture.levels)[static_cast<std::size_t>(unmixed_level(texture, lambda))], s, lambda > magnified_up_to(s) ? s.min : s.mag};
}

glm::dvec4 sample(const Texture& texture, glm::dvec2 uv, double lambda) {
  if (const std::optional<Mixture> mixed = mixture(texture, lambda)) {
    return minified(texture, mixed->first)(uv) * (1.0 - mixed->share) + minified(texture, mixed->first + 1.0)(uv) * mixed->share;
  }
  return unmixed(texture, lambda)(uv);
}

double level_of(double texels) {
  return texels > 0.0 ? std::log2(texels) : -std::numeric_limits<double>::infinity();
}

double ideal_lod(glm::dvec2 here, glm::dvec2 right, glm::dvec2 below) {
  return level_of(ideal_span(here, right, below));
}

TexelSpans texel_spans(const glm::dvec2 (&texels)[9]) {
  glm::dvec2 least_x;
  glm::dvec2 most_x;
  glm::dvec2 least_y;
  glm::dvec2 most_y;
  extremes(texels, 1, 3, least_x, most_x);
  extremes(texels, 3, 1, least_y, most_y);
  const glm::dvec2 least = glm::max(least_x, least_y);
  const glm::dvec2 most = glm::max(most_x, most_y);
  return {ideal_span(texels[4], texels[5], texels[7]), std::max(least.x, least.y), most.x + most.y};
}

}  // namespace sheen::golden
