#pragma once

#include <algorithm>
#include <array>

#include "albedo/sheen_model.h"
#include "brdf/math.h"

namespace sheen::albedo {

// Coordinates in which E is smooth enough to interpolate. With T = mu / (1 + sqrt(1 - mu^2)), the tangent of half the elevation angle,
//
//   ln E = h(x, y) - p ln(1 + T^2),   x = ln T,  y = ln r,  p = 1 / (2 r^2)
//
// The second term is the peak of sin^2(theta_h)^p over L, ((1 + s_v)/2)^p, and takes E through its hundreds of decades; what remains
// varies like powers of T and r, hence the logarithms. At normal incidence x is linear in the angle.

/// T of mu = N.V in (0, 1].
template <class Real>
Real half_elevation_tangent(Real mu) {
  using brdf::sqrt;
  return mu / (Real(1) + sqrt((Real(1) - mu) * (Real(1) + mu)));
}

/// mu of T in (0, 1].
inline double cosine_of(double t) {
  return std::min(1.0, 2 * t / (1 + t * t));
}

/// p ln(1 + T^2): minus the logarithm of the peak.
template <class Real>
Real log_peak_drop(Real t, Real r) {
  using brdf::log1p;
  return Real(0.5) / (r * r) * log1p(t * t);
}

/// x at mu = 0.5, where the two branches of Lambda meet and h has a jump in its second derivative: -ln(2 + sqrt(3)).
inline constexpr double branch_x = -1.3169578969248168;

/// Past this value of log_peak_drop E is below 1e-16 and counts as 0.
inline constexpr double negligible_drop = 45;

/// Lagrange weights of the nodes 0, 1, 2, 3 at t in [0, 3].
inline std::array<double, 4> cubic_weights(double t) {
  return {-(t - 1) * (t - 2) * (t - 3) / 6, t * (t - 2) * (t - 3) / 2, -t * (t - 1) * (t - 3) / 2, t * (t - 1) * (t - 2) / 6};
}

}  // namespace sheen::albedo
