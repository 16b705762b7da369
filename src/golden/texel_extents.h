#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec4.hpp>

#include "scene/scene.h"
#include "scene/texels.h"

namespace sheen::golden {

/// Least and most of each channel of some values, one at least.
template <class Color>
struct Extent {
  Color least, most;

  void include(const Color& c) {
    least = glm::min(least, c);
    most = glm::max(most, c);
  }
  void include(const Extent& other) {
    least = glm::min(least, other.least);
    most = glm::max(most, other.most);
  }
};

/// Column or row of a texel after wrapping. @param i  whole
int wrapped(double i, int size, scene::Wrap wrap);

/// What the texels of one level come to over any block of them: from a pyramid of blocks of 4 x 4 texels, of 8 x 8, and so on.
class TexelExtents {
 public:
  /// The level must outlive this.
  explicit TexelExtents(const scene::Texels& level);

  /// From one texel to another before wrapping, both included; whole numbers, or anything that may be all of an axis.
  struct Span {
    double first, last;
  };
  /// A block of many texels is taken for the smallest of at most some hundred blocks of the pyramid that hold it.
  Extent<glm::vec4> over(const Span& columns, const Span& rows, const scene::Sampler& sampler) const;

 private:
  struct Grid {
    int width, height;
    std::vector<Extent<glm::vec4>> cells;
  };
  using Indices = std::pair<int, int>;  // first and last
  struct Parts {
    std::array<Indices, 2> at;
    std::size_t count;

    const Indices* begin() const { return at.data(); }
    const Indices* end() const { return at.data() + count; }
  };
  static Parts wrapped_parts(const Span& span, int size, scene::Wrap wrap);
  Extent<glm::vec4> of_block(const Indices& columns, const Indices& rows) const;

  const scene::Texels& level_;
  std::vector<Grid> grids_;  // of cells of 4, 8, ... texels a side; the last is one cell
};

}  // namespace sheen::golden
