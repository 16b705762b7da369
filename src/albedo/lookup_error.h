#pragma once

#include "albedo/coordinates.h"
#include "albedo/table.h"
#include "brdf/math.h"

namespace sheen::albedo {

/// How far from E what a shader reads from the table may lie, by interpolation and by roundings in highp (number/precision.h states the
/// rules), both arguments being exact.
///
/// In units of highp's epsilon, relative unless said otherwise. T: 6 for the root of a product of two sums (its inverse root 2, the
/// quotient 2.5, half of 3), 1 for the sum, 2.5 for the quotient: 9.5. log_peak_drop: T^2 20, the sum and the quotient of its logarithm's
/// argument 3.5, the series 4.5, 0.5 / r^2 and the product 5: 33. A position: its logarithm's 4 ulp or absolute 2^-21, T's 9.5, and 3.5 of
/// its own. The polynomial: 9 a product of weights, 1 for its product with a value and 5 for sums, of values whose weights' magnitudes add
/// up to at most 1.631^2 (in a corner's cell). exp: 4 + 2 |x| ulp of its result, and x's own error is relative in its result.
/// @param e  E at the arguments
template <class Real>
Real lookup_error(Real e, Real n_dot_v, Real sheen_roughness) {
  using brdf::abs;
  using brdf::any;
  using brdf::log;
  using brdf::max;
  using brdf::min;
  using brdf::select;
  const Real epsilon(0x1p-23);
  const Real logarithm(0x1p-21);
  const Real beyond_rounding = Real(interpolation_error) * max(e, Real(1));
  const Real r = min(sheen_roughness, Real(1));
  const Real t = half_elevation_tangent(min(max(n_dot_v, Real(min_n_dot_v)), Real(1)));
  const Real drop = log_peak_drop(t, r);
  // E is below 1e-7 of what interpolation leaves; and up to min_roughness neither reads a table.
  const auto counts = drop <= Real(25);
  if (!any(counts)) {
    return select(r > Real(Table::min_roughness), beyond_rounding, Real(0));
  }
  const Real x = abs(log(t));
  const Real y = abs(log(r));
  const Real column = (max(Real(4) * epsilon * x, logarithm) + Real(9.5) * epsilon + Real(3.5) * epsilon * x) * Real(1 / Table::step_x);
  const Real along = Real(Table::density) * (Real(1) - r) + y;
  const Real row =
      (max(Real(4) * epsilon * y, logarithm) + Real(2 * Table::density) * epsilon + Real(4.5) * epsilon * along) * Real(1 / Table::step_y);
  const Real h =
      Real(40 * Table::largest_value) * epsilon + column * Real(Table::largest_column_step) + row * Real(Table::largest_row_step);
  const Real log_e = abs(log(e));
  const Real exponent = h + Real(33) * epsilon * drop + epsilon * log_e;
  const Real rounding = e * (exponent + (Real(4) + Real(2) * log_e) * epsilon);
  const Real rounding_that_counts = select(counts, rounding, Real(0));
  return select(r > Real(Table::min_roughness), beyond_rounding + rounding_that_counts, Real(0));
}

}  // namespace sheen::albedo
