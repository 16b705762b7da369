#include "albedo/table.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/parallel_for.h>

#include "albedo/coordinates.h"
#include "albedo/directional_albedo.h"

namespace sheen::albedo {
namespace {

// The table serves 32-bit floats: E below 1e-10 is 0 to every use of it.
constexpr double negligible_drop_in_table = 30;

// sheen_roughness of a row: the root of density (1 - r) - ln r = v by Newton's method on ln r, which is monotone and convex.
double roughness_of(double v) {
  double y = -v;
  for (int step = 0; step < 50; ++step) {
    y -= (Table::density * (1 - std::exp(y)) - y - v) / (-Table::density * std::exp(y) - 1);
  }
  return std::exp(y);
}

}  // namespace

Table build_table(Visibility visibility) {
  Table table;
  table.visibility = visibility;
  table.values.resize(static_cast<std::size_t>(Table::width) * Table::height);
  tbb::parallel_for(0, Table::height, [&](int row) {
    const double r = roughness_of(row * Table::step_y);
    float* values = &table.values[static_cast<std::size_t>(row) * Table::width];
    for (int column = Table::width - 1; column >= 0; --column) {
      const double t = std::exp(-column * Table::step_x);
      const double drop = log_peak_drop(t, r);
      // Where E is negligible h only has to stay near its neighbours.
      values[column] = drop < negligible_drop_in_table || column > Table::width - 3
                           ? static_cast<float>(log_directional_albedo_fast(visibility, cosine_of(t), r) + drop)
                           : 2 * values[column + 1] - values[column + 2];
    }
  });
  return table;
}

double lookup(const Table& table, double n_dot_v, double sheen_roughness) {
  if (!(sheen_roughness > Table::min_roughness)) {
    return 0;
  }
  const double r = std::min(sheen_roughness, 1.0);
  const double t = half_elevation_tangent(std::clamp(n_dot_v, min_n_dot_v, 1.0));
  const double position_x = -std::log(t) / Table::step_x;
  const double position_y = (Table::density * (1 - r) - std::log(r)) / Table::step_y;
  int first_x = std::clamp(static_cast<int>(position_x) - 1, 0, Table::width - 4);
  first_x = position_x < Table::branch_column ? std::min(first_x, Table::branch_column - 3) : std::max(first_x, Table::branch_column);
  const int first_y = std::clamp(static_cast<int>(position_y) - 1, 0, Table::height - 4);
  const auto weights_x = cubic_weights(position_x - first_x), weights_y = cubic_weights(position_y - first_y);
  double h = 0;
  for (int j = 0; j < 4; ++j) {
    const float* row = &table.values[static_cast<std::size_t>(first_y + j) * Table::width];
    double sum = 0;
    for (int i = 0; i < 4; ++i) {
      sum += weights_x[i] * row[first_x + i];
    }
    h += weights_y[j] * sum;
  }
  return std::exp(h - log_peak_drop(t, r));
}

}  // namespace sheen::albedo
