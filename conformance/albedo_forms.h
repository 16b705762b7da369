#pragma once

#include <algorithm>
#include <array>

#include "albedo/directional_albedo.h"
#include "albedo/table.h"
#include "brdf/albedo_scaling.h"
#include "number/bounded_functions.h"

// What a conforming implementation may read as the directional albedo E, from the renderer's table and from the fit, and scale by it.
// The shaders do this in highp, whatever the shading's precision.

namespace sheen::conformance::forms {

/// Error of the table's interpolation in exact arithmetic, of max(E, 1) (albedo/table.h), and of E's quadrature (directional_albedo.h).
inline constexpr double table_error = 2e-5;
inline constexpr double quadrature_error = 3e-7;

/// Lagrange weights of the nodes 0, 1, 2, 3 at t.
template <class Real>
std::array<Real, 4> cubic_weights(const Real& t) {
  const Real d1 = t - Real(1);
  const Real d2 = t - Real(2);
  const Real d3 = t - Real(3);
  return {-d1 * d2 * d3 / Real(6), t * d2 * d3 / Real(2), -t * d1 * d3 / Real(2), t * d1 * d2 / Real(6)};
}

/// The table as sheen_albedo.glsl reads it, at exact arguments.
/// The roundings of the two positions between the nodes are put where number::Bounded keeps a displacement: the weights share them, and
/// what they add to one they take from another. (The series left out of the logarithm changes E by less than 1e-9.) A rounding across a
/// node's edge changes the stencil; both stencils meet at the node.
/// @param cosine  [min_n_dot_v, 1]    @param sheen_roughness  (min_roughness, 1]
inline number::Bounded<number::Highp> table_lookup(const albedo::Table& table, double cosine, double sheen_roughness) {
  using H = number::Bounded<number::Highp>;
  using T = albedo::Table;
  const H mu(cosine);
  const H r(sheen_roughness);
  const H t = mu / (H(1) + sqrt(max((H(1) - mu) * (H(1) + mu), H(1e-30))));
  const H x = -log(t) / H(T::step_x);
  const H y = (H(T::density) * (H(1) - r) - log(r)) / H(T::step_y);
  const auto first_of = [](double position, int nodes) { return std::clamp(static_cast<int>(position) - 1, 0, nodes - 4); };
  const bool above_branch = x.center() < T::branch_column;
  const int column = above_branch ? std::min(first_of(x.center(), T::width), T::branch_column - 3)
                                  : std::max(first_of(x.center(), T::width), T::branch_column);
  const int row = first_of(y.center(), T::height);
  const H local_x = H::at_sample(x.center() - column, x.deviation(), 0, 1, number::ulp<number::Highp>(4));
  const H local_y = H::at_sample(y.center() - row, 0, y.deviation(), 1, number::ulp<number::Highp>(4));
  const auto wx = cubic_weights(local_x);
  const auto wy = cubic_weights(local_y);
  H h(0);
  for (std::size_t j = 0; j < 4; ++j) {
    H sum(0);
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t at = (static_cast<std::size_t>(row) + j) * T::width + static_cast<std::size_t>(column) + i;
      sum = sum + wx[i] * H(table.values[at]);
    }
    h = h + wy[j] * sum;
  }
  const H p = H(0.5) / (r * r);
  const H t2 = t * t;
  const H u = t2 / (H(2) + t2);
  const H u2 = u * u;
  H series(1.0 / 15.0);
  for (const double n : {13.0, 11.0, 9.0, 7.0, 5.0, 3.0, 1.0}) {
    series = H(1 / n) + u2 * series;
  }
  return exp(h - p * (H(2) * u * series));
}

/// E as the table gives it: the truth, and how far from it a conforming implementation may be.
struct TableAlbedo {
  double truth;
  double error;  ///< absolute
};

inline TableAlbedo table_albedo(const albedo::Table& table, double cosine, double sheen_roughness) {
  const double mu = std::clamp(cosine, albedo::min_n_dot_v, 1.0);
  const double truth = albedo::directional_albedo(table.visibility, mu, std::min(sheen_roughness, 1.0));
  const double granted = (table_error + quadrature_error) * std::max(truth, 1.0);
  if (!(sheen_roughness > albedo::Table::min_roughness)) {
    return {truth, granted};
  }
  const auto read = table_lookup(table, static_cast<double>(static_cast<float>(mu)), std::min(sheen_roughness, 1.0));
  return {truth, granted + read.deviation()};
}

/// Largest error of the analytic fit in exact arithmetic over N.X >= 0.005 and sheen_roughness >= 0.1 (shaders/sheen_albedo_fit.glsl).
inline constexpr double charlie_fit_error = 0.0205;
inline constexpr double ashikhmin_fit_error = 0.0150;

/// The fit as sheen_albedo_fit.glsl evaluates it.
/// @param cosine  [0.005, 1]
inline number::Bounded<number::Highp> fitted_albedo(brdf::Visibility visibility, double cosine, double sheen_roughness) {
  using H = number::Bounded<number::Highp>;
  const H x(cosine);
  const H r(sheen_roughness);
  const H z = -log(H(0.5) * (H(1) + sqrt(max(H(1) - x * x, H(1e-30))))) / (H(2) * r * r);
  const bool charlie = visibility == brdf::Visibility::Charlie;
  const H t = charlie ? log(x + H(2.88269) * r) : x / (x + H(1.25362) * r + H(0.0158812));
  const H s = charlie ? pow(r, H(0.744932)) : H(1) / (r + H(0.1));
  using Ten = std::array<double, 10>;
  const Ten c = charlie ? Ten{-3.13455, .163006, -.680986, -.728669, -2.8079, 12.3291, -.396477, 9.72261, -22.5119, 8.45563}
                        : Ten{-1.08842, -3.30651, .727668, 4.16853, .0313427, -.0714525, -3.94648, -1.66093, .179991, -.00242272};
  const H cubic = H(c[0]) + H(c[1]) * t + H(c[2]) * s + H(c[3]) * t * t + H(c[4]) * t * s + H(c[5]) * s * s + H(c[6]) * t * t * t +
                  H(c[7]) * t * t * s + H(c[8]) * t * s * s + H(c[9]) * s * s * s;
  return min(H(1), exp(cubic - z));
}

/// The scale of an implementation that reads E once, at the smaller of the two cosines (for View at N.V), about the truth, which takes the
/// larger E of both. Where E does not fall with its cosine that is off by more than the table is.
/// @param max_sheen_color  max3(sheenColor), exact    @param n_dot_l, n_dot_v  with what may be computed in their place
inline number::Bounded<number::Highp> read_albedo_scale(brdf::AlbedoScaling scaling, const albedo::Table& table, double max_sheen_color,
                                                        double sheen_roughness, const number::Bounded<number::Highp>& n_dot_l,
                                                        const number::Bounded<number::Highp>& n_dot_v) {
  using H = number::Bounded<number::Highp>;
  const bool view = scaling == brdf::AlbedoScaling::View;
  const TableAlbedo at_v = table_albedo(table, n_dot_v.center(), sheen_roughness);
  const TableAlbedo at_l = view ? at_v : table_albedo(table, n_dot_l.center(), sheen_roughness);
  const H& least = view || n_dot_v.center() < n_dot_l.center() ? n_dot_v : n_dot_l;
  const TableAlbedo& read = &least == &n_dot_v ? at_v : at_l;
  double moved = 0;
  if (!least.is_exact()) {
    for (const double end : {least.range().lower, least.range().upper}) {
      moved = std::max(moved, std::abs(table_albedo(table, end, sheen_roughness).truth - read.truth));
    }
  }
  const H e = H::within(read.truth, read.error + moved);
  const H computed = brdf::albedo_scale(scaling, H(max_sheen_color), e, e);
  const double truth = brdf::albedo_scale(scaling, max_sheen_color, at_v.truth, at_l.truth);
  return H::within(truth, std::abs(truth - computed.center()) + computed.deviation());
}

/// The renderer's table of a visibility, built when it is first asked for.
template <brdf::Visibility visibility>
const albedo::Table& shared_table() {
  static const albedo::Table built = albedo::build_table(visibility);
  return built;
}

}  // namespace sheen::conformance::forms
