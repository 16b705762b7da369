#pragma once

#include <array>
#include <cstdint>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "golden/texture.h"

namespace sheen::golden {

/// A texture's value at a point, and the most that each channel departs from it.
struct Spread {
  glm::dvec4 value{0.0};
  glm::dvec4 radius{0.0};
};

/// What a texture may give at coordinates that lie within `reach` of uv along either axis, with a shader's roundings in highp of the
/// filter's arithmetic. Where the filter has neither an edge (nearest) nor a bend (linear) within that box it is bilinear, and its corners
/// tell; elsewhere it is no less and no more than the texels it reads, one by one where they are few, else in blocks that hold them
/// (TexelExtents). Of two mipmap levels that are mixed each does its worst on its own where one of them bends. A level is read once,
/// however often it is asked for.
class TextureBox {
 public:
  /// The texture must outlive this.
  TextureBox(const Texture& texture, glm::dvec2 uv, glm::dvec2 reach);

  /// At one level of detail.
  Spread operator()(double lambda);

 private:
  /// A box of more texels than this along an axis is not gone through texel by texel, but in blocks that hold it.
  static constexpr int widest_box = 6;
  /// One level by one filter.
  struct Level {
    glm::dvec4 value, below, above;  // at uv, and how far what is found about it lies on either side
    bool is_flat;
    Patch patch;  // if it is
  };
  Level look(LevelReader read, double number) const;
  const Level& minified_level(double number);
  Spread mixed(const Mixture& mixture);

  const Texture& texture_;
  glm::dvec2 uv_, off_;
  std::array<Level, 32> levels_;  // by number, of those that are mixed: with more than these a side would have 2^32 texels
  std::uint32_t known_ = 0;       // a bit for each that was read
};

}  // namespace sheen::golden
