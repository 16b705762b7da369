#include "albedo/ggx_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <tbb/parallel_for.h>

#include "albedo/coordinates.h"

namespace sheen::albedo {
namespace {

// The four nodes around a position, in nodes.
struct Stencil {
  int first;
  std::array<double, 4> weights;

  Stencil(double position, int count)
      : first(std::clamp(static_cast<int>(position) - 1, 0, count - 4)), weights(cubic_weights(position - first)) {}
};

// A column of rows, interpolated.
template <class Read>
GgxAlbedo along_rows(double alpha, const Read& read) {
  const Stencil rows(-std::log(std::min(alpha, 1.0)) / GgxTable::step_y, GgxTable::height);
  double log_loss = 0, log_scale = 0;
  for (int j = 0; j < 4; ++j) {
    const auto [l, s] = read(rows.first + j);
    log_loss += rows.weights[j] * l;
    log_scale += rows.weights[j] * s;
  }
  const double loss = std::exp(log_loss);
  return {loss, 1 - loss - std::exp(log_scale)};
}

}  // namespace

GgxTable build_ggx_table() {
  GgxTable table;
  table.values.resize(std::size_t{2} * GgxTable::width * GgxTable::height);
  tbb::parallel_for(0, GgxTable::height, [&](int row) {
    const double alpha = std::exp(-row * GgxTable::step_y);
    float* values = &table.values[std::size_t{2} * GgxTable::width * static_cast<std::size_t>(row)];
    for (int column = 0; column < GgxTable::width; ++column) {
      const GgxAlbedo albedo =
          column == GgxTable::columns ? ggx_average_albedo(alpha) : ggx_albedo(cosine_of(std::exp(-column * GgxTable::step_x)), alpha);
      *values++ = static_cast<float>(std::log(albedo.loss));
      *values++ = static_cast<float>(std::log(1 - albedo.loss - albedo.bias));
    }
  });
  return table;
}

GgxAlbedo lookup(const GgxTable& table, double n_dot_v, double alpha) {
  const double mu = std::clamp(n_dot_v, min_n_dot_v, 1.0);
  if (!(alpha > mirror_alpha)) {
    return ggx_albedo(mu, 0);
  }
  const Stencil columns(-std::log(half_elevation_tangent(mu)) / GgxTable::step_x, GgxTable::columns);
  return along_rows(alpha, [&](int row) {
    std::array<double, 2> sum{0, 0};
    const float* values = &table.values[2 * (static_cast<std::size_t>(row) * GgxTable::width + static_cast<std::size_t>(columns.first))];
    for (int i = 0; i < 4; ++i) {
      sum[0] += columns.weights[i] * values[2 * i];
      sum[1] += columns.weights[i] * values[2 * i + 1];
    }
    return sum;
  });
}

GgxAlbedo lookup_average(const GgxTable& table, double alpha) {
  if (!(alpha > mirror_alpha)) {
    return ggx_average_albedo(0);
  }
  return along_rows(alpha, [&](int row) {
    const float* values = &table.values[2 * (static_cast<std::size_t>(row) * GgxTable::width + GgxTable::columns)];
    return std::array<double, 2>{values[0], values[1]};
  });
}

}  // namespace sheen::albedo
