#pragma once

#include <vector>

#include "albedo/ggx_albedo.h"

namespace sheen::albedo {

/// Albedo of the GGX lobe as the shader reads it: logarithms of the loss 1 - E and of the scale E - bias, at nodes between which a bicubic
/// (4 x 4 Lagrange) polynomial runs. Toward grazing both vanish, and with them all that a dielectric lets through: hence no bias.
/// Column i lies at ln T = -i step_x, T = tan(elevation / 2): 0 is normal incidence. The last column holds the averages over the
/// hemisphere. Row j lies at ln alpha = -j step_y; up to mirror_alpha the lobe is a mirror's. shaders/ggx_albedo.glsl states the same
/// mapping; tests hold one to the other.
struct GgxTable {
  static constexpr double step_x = 0.165;
  static constexpr double step_y = 0.2;
  static constexpr int columns = 62;         ///< of cosines: down to min_n_dot_v and one beyond
  static constexpr int width = columns + 1;  ///< with the averages
  static constexpr int height = 94;          ///< down to mirror_alpha and one beyond

  std::vector<float> values;  ///< row-major pairs: values[2 (row * width + column)] is ln(1 - E), the next one ln(scale)
};

/// Builds the renderer's table, on all threads.
GgxTable build_ggx_table();

/// Read with the interpolation that the shader does, in double; cosines below min_n_dot_v count as min_n_dot_v. Loss and scale to a
/// relative ggx_table_error (ggx_albedo_test.cpp).
GgxAlbedo lookup(const GgxTable& table, double n_dot_v, double alpha);
GgxAlbedo lookup_average(const GgxTable& table, double alpha);
inline constexpr double ggx_table_error = 2e-4;

}  // namespace sheen::albedo
