#pragma once

#include <optional>

#include "albedo/sheen_model.h"

namespace sheen::albedo {

/// What a table's roughness axis is linear in: sheen roughness r, or alpha = r^2.
enum class TableAxis { Roughness, Alpha };

/// Where along an axis of n texels texel i lies: at (i + 1/2) / n, or at i / (n - 1), so that the first and the last lie on the ends.
enum class TableTexels { Centre, Edge };

/// What texels hold: E over (N.V, axis), or over the nodes of warped.h, there E or E r.
enum class TableForm { Plain, Warped, WarpedTimesRoughness };

/// How a table of E is to be read. As it stands, with everything default, columns run over rising N.V and rows over rising roughness.
struct TableReading {
  Visibility visibility = Visibility::Charlie;
  TableForm form = TableForm::Plain;
  TableAxis axis = TableAxis::Roughness;
  TableTexels texels = TableTexels::Centre;
  /// In texels, along each axis toward its larger end: texel k of the axis, counted from its smaller end, holds what belongs to k + shift.
  double row_shift = 0;     ///< of the roughness axis
  double column_shift = 0;  ///< of the N.V axis
  bool transposed = false;  ///< N.V runs down the columns, roughness along the rows
  bool n_dot_v_flipped = false;
  bool roughness_flipped = false;
  bool clamped = false;  ///< min(E, 1)

  bool operator==(const TableReading&) const = default;
};

/// What a texel stands for.
struct TablePoint {
  double n_dot_v;
  double sheen_roughness;
  bool inside;  ///< false where a shift leads past an end of an axis; the coordinates then are the end's
};

/// @param column, row  from the picture's top left corner
TablePoint point_of(const TableReading& reading, int width, int height, int column, int row);

/// The value that the texel should hold, given the true E at its point; not clamped.
inline double stored_value(const TableReading& reading, const TablePoint& point, double directional_albedo) {
  return reading.form == TableForm::WarpedTimesRoughness ? directional_albedo * point.sheen_roughness : directional_albedo;
}

}  // namespace sheen::albedo
