#pragma once

#include <array>
#include <cstddef>

namespace sheen::albedo {

// Places in a grid of patches, each a polynomial through `nodes` x `nodes` values: what interpolation takes of one argument, to be asked
// for with many of the other. Plain numbers, so that a batched translation unit may hold them; the interpolants make them.

/// Along y.
template <int nodes>
struct PlaceInRow {
  double value = 0;  ///< the argument itself
  int row = 0;       ///< of patches
  std::array<double, nodes> shares{};
};

/// Along x. What it makes of a patch, which is all that the places in a row of patches ask of it, is kept.
template <int nodes, class Value>
struct PlaceInColumn {
  /// The patch at x: what it holds at its nodes along y.
  struct Column {
    int row;
    bool usable;
    std::array<Value, nodes> values;
  };

  double value;
  int column;
  std::array<double, nodes> shares;
  std::array<Column, 3> kept;  ///< the last ones
  std::size_t made = 0;        ///< of those ever kept

  /// @param make  whether the patch in that row is usable, and its values
  template <class Make>
  const Column& in(int row, const Make& make) {
    for (std::size_t i = 0; i < made && i < kept.size(); ++i) {
      if (kept[i].row == row) {
        return kept[i];
      }
    }
    Column& next = kept[made++ % kept.size()];
    next.row = row;
    make(next.usable, next.values);
    return next;
  }
};

}  // namespace sheen::albedo
