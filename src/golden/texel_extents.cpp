#include "golden/texel_extents.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace sheen::golden {
namespace {

constexpr int finest_cell = 4;   // texels a side
constexpr int most_cells = 144;  // to look at for one block

}  // namespace

// Coordinates are whole doubles, so that none overflows an integer on the way.
int wrapped(double i, int size, scene::Wrap wrap) {
  const double n = size;
  if (i >= 0.0 && i < n) {
    return static_cast<int>(i);
  }
  switch (wrap) {
    case scene::Wrap::ClampToEdge:
      return static_cast<int>(std::clamp(i, 0.0, n - 1.0));
    case scene::Wrap::Repeat:
      return static_cast<int>(std::clamp(i - n * std::floor(i / n), 0.0, n - 1.0));
    case scene::Wrap::MirroredRepeat:
      break;
  }
  const double j = std::clamp(i - 2.0 * n * std::floor(i / (2.0 * n)), 0.0, 2.0 * n - 1.0);
  return static_cast<int>(j < n ? j : 2.0 * n - 1.0 - j);
}

TexelExtents::TexelExtents(const scene::Texels& level) : level_(level) {
  const auto texel = [&](int x, int y) {
    const glm::vec4& c = level.rgba[static_cast<std::size_t>(y) * static_cast<std::size_t>(level.width) + static_cast<std::size_t>(x)];
    return Extent<glm::vec4>{c, c};
  };
  // Of `side` x `side` smaller cells each, of which there are width x height.
  const auto add = [this](int width, int height, int side, const auto& smaller) {
    Grid grid{(width + side - 1) / side, (height + side - 1) / side, {}};
    grid.cells.reserve(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height));
    for (int y = 0; y < height; y += side) {
      for (int x = 0; x < width; x += side) {
        Extent<glm::vec4> cell = smaller(x, y);
        for (int i = 0; i < side * side; ++i) {
          cell.include(smaller(std::min(x + i % side, width - 1), std::min(y + i / side, height - 1)));
        }
        grid.cells.push_back(cell);
      }
    }
    grids_.push_back(std::move(grid));
  };
  add(level.width, level.height, finest_cell, texel);
  while (grids_.back().cells.size() > 1) {
    const Grid last = grids_.back();
    add(last.width, last.height, 2, [&last](int x, int y) {
      return last.cells[static_cast<std::size_t>(y) * static_cast<std::size_t>(last.width) + static_cast<std::size_t>(x)];
    });
  }
}

TexelExtents::Parts TexelExtents::wrapped_parts(const Span& span, int size, scene::Wrap wrap) {
  const auto one = [](int first, int last) { return Parts{{Indices{first, last}, {}}, 1}; };
  const double count = span.last - span.first + 1.0;
  if (wrap == scene::Wrap::ClampToEdge && span.last >= span.first) {
    return one(wrapped(span.first, size, wrap), wrapped(span.last, size, wrap));
  }
  if (!(count < size)) {
    return one(0, size - 1);
  }
  const int first = wrapped(span.first, size, wrap);
  const int last = wrapped(span.last, size, wrap);
  if (wrap == scene::Wrap::Repeat) {
    return first <= last ? one(first, last) : Parts{{Indices{first, size - 1}, Indices{0, last}}, 2};
  }
  // Mirrored: in one direction, or there and back about either end.
  const int low = std::min(first, last);
  const int high = std::max(first, last);
  if (high - low + 1 == static_cast<int>(count)) {
    return one(low, high);
  }
  const double period = 2.0 * size;
  const bool turns_at_end = span.first - period * std::floor(span.first / period) < size;
  return turns_at_end ? one(low, size - 1) : one(0, high);
}

Extent<glm::vec4> TexelExtents::of_block(const Indices& columns, const Indices& rows) const {
  const auto cells = [](const Indices& along, int side) { return along.second / side - along.first / side + 1; };
  const auto too_many = [&](int side) {
    return static_cast<std::int64_t>(cells(columns, side)) * static_cast<std::int64_t>(cells(rows, side)) > most_cells;
  };
  if (!too_many(1)) {
    const auto row = [&](int y) { return level_.rgba.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(level_.width); };
    Extent<glm::vec4> out{row(rows.first)[columns.first], row(rows.first)[columns.first]};
    for (int y = rows.first; y <= rows.second; ++y) {
      std::for_each(row(y) + columns.first, row(y) + columns.second + 1, [&out](const glm::vec4& texel) { out.include(texel); });
    }
    return out;
  }
  int side = finest_cell;
  std::size_t k = 0;
  while (k + 1 < grids_.size() && too_many(side)) {
    side *= 2;
    ++k;
  }
  const auto cell = [&](int x, int y) {
    return grids_[k].cells[static_cast<std::size_t>(y) * static_cast<std::size_t>(grids_[k].width) + static_cast<std::size_t>(x)];
  };
  Extent<glm::vec4> out = cell(columns.first / side, rows.first / side);
  for (int y = rows.first / side; y <= rows.second / side; ++y) {
    for (int x = columns.first / side; x <= columns.second / side; ++x) {
      out.include(cell(x, y));
    }
  }
  return out;
}

Extent<glm::vec4> TexelExtents::over(const Span& columns, const Span& rows, const scene::Sampler& sampler) const {
  const Parts x = wrapped_parts(columns, level_.width, sampler.wrap_s);
  const Parts y = wrapped_parts(rows, level_.height, sampler.wrap_t);
  Extent<glm::vec4> out = of_block(x.at[0], y.at[0]);
  for (const Indices& row_part : y) {
    for (const Indices& column_part : x) {
      out.include(of_block(column_part, row_part));
    }
  }
  return out;
}

}  // namespace sheen::golden
