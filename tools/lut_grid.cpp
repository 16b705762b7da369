#include "tools/lut_grid.h"

#include <cstddef>

#include "albedo/directional_albedo.h"
#include "albedo/warped.h"

namespace sheen::tools {
namespace {

/// One row of a table.
struct Row {
  std::vector<double> n_dot_v;
  double sheen_roughness = 0.0;
};

Row warped_row(int row, int size) {
  const double last = size - 1;
  Row result;
  result.n_dot_v.reserve(static_cast<std::size_t>(size));
  result.sheen_roughness = albedo::warped_roughness(row / last);
  for (int column = 0; column < size; ++column) {
    result.n_dot_v.push_back(albedo::warped_n_dot_v(column / last, result.sheen_roughness));
  }
  return result;
}

std::vector<double> texel_centres(int size) {
  std::vector<double> centres;
  centres.reserve(static_cast<std::size_t>(size));
  for (int i = 0; i < size; ++i) {
    centres.push_back((i + 0.5) / size);
  }
  return centres;
}

void append(std::vector<double>& all, const std::vector<double>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

}  // namespace

LutGrid lut_grid(albedo::Visibility visibility, LutLayout layout, int size) {
  LutGrid grid;
  const std::vector<double> centres = texel_centres(size);
  if (layout == LutLayout::Plain) {
    grid.directional_albedo = albedo::evaluate_grid(visibility, centres, centres);
  }
  for (int i = 0; i < size; ++i) {
    const Row row = layout == LutLayout::Plain ? Row{centres, centres[static_cast<std::size_t>(i)]} : warped_row(i, size);
    append(grid.n_dot_v, row.n_dot_v);
    grid.sheen_roughness.insert(grid.sheen_roughness.end(), row.n_dot_v.size(), row.sheen_roughness);
    // The cosines of a warped table differ from row to row, so each row is a grid of its own.
    if (layout == LutLayout::Warped) {
      append(grid.directional_albedo, albedo::evaluate_grid(visibility, row.n_dot_v, {row.sheen_roughness}));
    }
  }
  return grid;
}

std::vector<double> stored_values(LutLayout layout, const LutGrid& grid) {
  std::vector<double> stored = grid.directional_albedo;
  if (layout == LutLayout::Warped) {
    for (std::size_t i = 0; i < stored.size(); ++i) {
      stored[i] *= grid.sheen_roughness[i];
    }
  }
  return stored;
}

std::vector<albedo::SplitSum> split_sum_grid(int size) {
  const std::vector<double> centres = texel_centres(size);
  return albedo::evaluate_split_sum_grid(centres, centres);
}

const char* describe(LutLayout layout) {
  if (layout == LutLayout::Plain) {
    return "E at texel centres (n_dot_v, sheen_roughness)";
  }
  return "E * r at corner-aligned nodes (u, r), u = n_dot_v (1 + r) / (n_dot_v + r), r from 0.02 to 1, n_dot_v = 1e-4 at u = 0";
}

}  // namespace sheen::tools
