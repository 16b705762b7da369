#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "golden/texel_extents.h"
#include "scene/scene.h"
#include "scene/texels.h"

namespace sheen::golden {

/// Mipmap levels, and what blocks of their texels come to, found when it is asked for.
class TextureLevels {
 public:
  explicit TextureLevels(std::vector<scene::Texels> levels) : levels_(std::move(levels)), extents_(levels_.size()) {}
  const scene::Texels& operator[](std::size_t level) const { return levels_[level]; }
  const scene::Texels& front() const { return levels_.front(); }
  std::size_t size() const { return levels_.size(); }
  /// Safe to call from many threads.
  const TexelExtents& extents(std::size_t level) const;

 private:
  struct Lazy {
    std::once_flag found;
    std::optional<TexelExtents> extents;
  };
  std::vector<scene::Texels> levels_;
  mutable std::vector<Lazy> extents_;
};

/// A decoded picture with the sampler that reads it.
struct Texture {
  std::shared_ptr<const TextureLevels> levels;  ///< level 0 alone where the sampler has no mipmaps
  scene::Sampler sampler;

  /// Whether the level of detail changes what is read: with mipmaps, or where the two filters differ.
  bool needs_lod() const { return sampler.mip != scene::MipFilter::None || sampler.mag != sampler.min; }
  /// Size of level 0, texels.
  glm::dvec2 size() const { return {levels->front().width, levels->front().height}; }
};

/// Decodes each picture once for each colour space it is read in, with mipmaps and without.
class TextureStore {
 public:
  explicit TextureStore(const scene::Scene& scene) : scene_(scene) {}
  /// Throws scene::Error where texture or picture do not exist or are empty.
  Texture get(int texture, scene::ColorSpace space);

 private:
  using Levels = std::shared_ptr<const TextureLevels>;
  const scene::Scene& scene_;
  std::map<std::tuple<int, scene::ColorSpace, bool>, Levels> decoded_;  // the last: whether with mipmaps
};

/// The texture's value by OpenGL ES 3.0.6, section 3.8.10: filters, wrap modes, choice between magnification and minification, and mipmaps,
/// in double.
/// @param uv      texture coordinates, v = 0 at the picture's top row
/// @param lambda  level of detail, log2 of texels a pixel
glm::dvec4 sample(const Texture& texture, glm::dvec2 uv, double lambda);

/// Of a texture that is minified with linear filtering between mipmaps: the finer of the two levels that lambda mixes, and the other's
/// share. None elsewhere, where one level is read.
struct Mixture {
  double first, share;
};
std::optional<Mixture> mixture(const Texture& texture, double lambda);

/// The largest level of detail at which a texture is magnified, read at level 0 with the magnification filter.
double magnified_up_to(const scene::Sampler& sampler);

/// Of a texture that is minified without filtering between mipmaps: the level that is read.
double nearest_level(const Texture& texture, double lambda);

/// What one level gives over a box: value + s along_u + t along_v + s t twist, for s and t in [-1, 1].
struct Patch {
  glm::dvec4 value, along_u, along_v, twist;

  /// The most that what it gives departs from the value, by channel: at a corner.
  glm::dvec4 reach() const;
};

/// One level, by one filter, at one place after another: texels of neighbouring places are fetched once.
class LevelReader {
 public:
  /// The references must outlive this.
  LevelReader(const scene::Texels& level, const scene::Sampler& sampler, scene::Filter filter)
      : level_(level), sampler_(sampler), filter_(filter) {}

  /// @param uv  texture coordinates, v = 0 at the picture's top row; as (0, 0), where they are not finite
  glm::dvec4 operator()(glm::dvec2 uv);

  /// About uv, `off` to either side; none where the filter has an edge or a bend within.
  std::optional<Patch> patch(glm::dvec2 uv, glm::dvec2 off);

  /// Texels that are read about uv, `off` to either side.
  struct Block {
    TexelExtents::Span columns, rows;
  };
  Block block(glm::dvec2 uv, glm::dvec2 off) const;

  /// What is read there. Only of a block of at most widest_block texels a side.
  Extent<glm::dvec4> extent(glm::dvec2 uv, glm::dvec2 off) const;
  static constexpr std::size_t widest_block = 10;

  const scene::Texels& level() const { return level_; }
  const scene::Sampler& sampler() const { return sampler_; }

 private:
  glm::dvec4 texel(double i, double j) const;
  const glm::vec4& texel_at(int x, int y) const;
  glm::dvec2 texels_at(glm::dvec2 uv) const;

  const scene::Texels& level_;
  const scene::Sampler& sampler_;
  scene::Filter filter_;
  double i_ = std::numeric_limits<double>::quiet_NaN(), j_ = 0;  // of the texels that were fetched last
  std::array<glm::dvec4, 4> texels_{};
};

/// Reads one level by the minification filter.
LevelReader minified(const Texture& texture, double level);

/// Of a level of detail without a mixture(): the level that is read.
double unmixed_level(const Texture& texture, double lambda);

/// Reads what sample() does there.
LevelReader unmixed(const Texture& texture, double lambda);

/// Texels that a pixel spans: by the specification's ideal formula, and the least and the most that OpenGL ES 3.0.6, section 3.8.10.1,
/// allows: any f with max(m_u, m_v) <= f <= m_u + m_v, from differences to either neighbour.
struct TexelSpans {
  double ideal = 0, least = 0, most = 0;
};

/// @param texels  coordinates in texels of level 0 at the 3 x 3 pixel centres around a pixel, row by row, all on the plane of one triangle
TexelSpans texel_spans(const glm::dvec2 (&texels)[9]);

/// The level of detail of a span of texels, its log2; of none, -infinity.
double level_of(double texels);

/// The ideal level alone, from the pixel and its neighbours along +x and +y.
double ideal_lod(glm::dvec2 here, glm::dvec2 right, glm::dvec2 below);

}  // namespace sheen::golden
