#pragma once

#include <vector>

#include "albedo/sheen_model.h"

namespace sheen::albedo {

/// E as the shader reads it: nodes of the smooth function h of coordinates.h, between which a bicubic (4 x 4 Lagrange) polynomial runs.
/// Column i lies at ln T = -i step_x: 0 is normal incidence. Row j lies where
/// density (1 - r) - ln r = j step_y: row 0 is sheen_roughness 1, near which Charlie's coefficients bend most and rows stand closest.
/// Rows end where E is negligible for every cosine from min_n_dot_v up; below min_roughness E is 0. No stencil reaches across
/// branch_column, where h has a jump in its second derivative. shaders/sheen_albedo.glsl states the same mapping; tests hold one to the
/// other.
struct Table {
  static constexpr int branch_column = 16;  ///< mu = 0.5
  static constexpr double step_x = 1.3169578969248168 / branch_column;
  static constexpr double step_y = 0.12;
  static constexpr double density = 3;
  static constexpr int width = 122;                 ///< down to mu = min_n_dot_v
  static constexpr int height = 128;                ///< down to r = min_roughness
  static constexpr double min_roughness = 4.84e-6;  ///< a little above the last row's

  // Where E is above 1e-10, so that log_peak_drop is below 25 (table_test.cpp holds the tables to these):
  static constexpr double largest_value = 8.0;         ///< of |h|
  static constexpr double largest_column_step = 1.12;  ///< between neighbouring columns
  static constexpr double largest_row_step = 0.37;     ///< between neighbouring rows

  Visibility visibility = Visibility::Charlie;
  std::vector<float> values;  ///< row-major: values[row * width + column]
};

/// Builds the renderer's table, on all threads.
Table build_table(Visibility visibility);

/// E read from the table with the interpolation that the shader does, in double; cosines below min_n_dot_v count as
/// min_n_dot_v. The error against E is below interpolation_error of max(E, 1) (table_test.cpp).
double lookup(const Table& table, double n_dot_v, double sheen_roughness);
inline constexpr double interpolation_error = 2e-5;

}  // namespace sheen::albedo
