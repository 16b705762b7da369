#include "albedo/table_reading.h"

#include <algorithm>
#include <cmath>

#include "albedo/warped.h"

namespace sheen::albedo {
namespace {

/// Position of texel k of n along an axis; [0, 1] unless shifted past an end.
double position(TableTexels texels, double shift, int k, int n) {
  return texels == TableTexels::Centre ? (k + 0.5 + shift) / n : (k + shift) / std::max(n - 1, 1);
}

}  // namespace

TablePoint point_of(const TableReading& reading, int width, int height, int column, int row) {
  const int n_cosine = reading.transposed ? height : width, n_roughness = reading.transposed ? width : height;
  int i = reading.transposed ? row : column, j = reading.transposed ? column : row;
  i = reading.n_dot_v_flipped ? n_cosine - 1 - i : i;
  j = reading.roughness_flipped ? n_roughness - 1 - j : j;
  const double u = position(reading.texels, reading.column_shift, i, n_cosine);
  const double v = position(reading.texels, reading.row_shift, j, n_roughness);
  const double u_end = std::clamp(u, 0.0, 1.0), v_end = std::clamp(v, 0.0, 1.0);
  const bool inside = u == u_end && v == v_end;
  if (reading.form != TableForm::Plain) {
    const double r = warped_roughness(v_end);
    return {warped_n_dot_v(u_end, r), r, inside};
  }
  return {u_end, reading.axis == TableAxis::Alpha ? std::sqrt(v_end) : v_end, inside};
}

}  // namespace sheen::albedo
