#pragma once

#include <algorithm>

#include "albedo/sheen_model.h"

namespace sheen::albedo {

// The warped layout of a table of E: corner-aligned nodes (u, r) with u = n_dot_v (1 + r) / (n_dot_v + r), which spreads the steep rise
// toward grazing angles over the columns.

/// Roughness of the first row; the last has 1.
inline constexpr double warped_min_roughness = 0.02;

/// r of a position in [0, 1] along the rows.
inline double warped_roughness(double position) {
  return position >= 1.0 ? 1.0 : warped_min_roughness + (1.0 - warped_min_roughness) * position;
}

/// n_dot_v of u in [0, 1] in the row of roughness r; at u = 0 it is min_n_dot_v, since E of Charlie has no limit at 0.
inline double warped_n_dot_v(double u, double r) {
  return u >= 1.0 ? 1.0 : std::max(u * r / (1.0 + r - u), min_n_dot_v);
}

}  // namespace sheen::albedo
