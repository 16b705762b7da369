#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "albedo/sheen_model.h"
#include "number/lanes.h"

// The integral behind E. With mu = N.V, lambda = N.L, phi the azimuth between V and L, p = 1 / (2 r^2):
//
//   E(mu, r) = integral over lambda in [0,1], phi in (-pi, pi] of  (1+p)/pi  (1 - (N.H)^2)^p  V(mu, lambda) lambda
//   (N.H)^2  = (mu + lambda)^2 / (C - B t),   t = sin^2(phi/2),   C = 2 + 2 mu lambda + B/2,   B = 4 s_v s_l,   s = sine of V, L
//
// The integrand peaks at phi = 0 (light and eye on one side: retro-reflection) and at lambda = 0, the more so the larger p:
//  - lambda ends where the integrand at phi = 0 has fallen by e^-24 (Fast) or e^-36 from its largest value, and is cut at 0.5, where the
//  second derivative
//    of Lambda jumps, and at mu, where for p of order 1 the integrand has a conical point (N.H = 1); each panel by tanh-sinh, whose nodes
//    crowd at both ends, because Charlie's V goes like lambda^0.2 at 0;
//  - phi = 2 atan(epsilon tan(psi/2)) widens the peak of width 1/sqrt(p kappa) to order 1, psi = pi (1 - x^2), or x^3, crowds nodes at the
//    conical point, and Gauss-Legendre integrates over x.

namespace sheen::albedo {

/// Gauss-Legendre over [0, 1]: exact for polynomials of degree 2 count - 1.
struct GaussLegendre {
  std::vector<double> node, weight;
  explicit GaussLegendre(int count);
};

/// Nodes of both one-dimensional rules for one size of p.
struct Rule {
  // Tanh-sinh over a panel [a, b]: node a + (b-a) left, or b - (b-a) right: whichever is the nearer end, so that no digits are lost.
  std::vector<double> left, right, weight;
  // Azimuth: tan^2(psi/2) and the weight including 2 dphi/dpsi's constant part.
  std::vector<double> tan2, azimuth_weight;
};

/// Fast: relative error below 1e-6, and below 4e-7 for N.V >= 0.004. Full: below 3e-7 everywhere.
enum class Effort { Fast, Full };

/// The rule for an exponent p: fewer nodes where the integrand is wide.
const Rule& rule_for(double p, Effort effort);

/// A rule of the given sizes; lambda_nodes is a multiple of the widest batch, `reach` ends tanh-sinh where its weights vanish.
/// Azimuth nodes crowd at pi as psi = pi (1 - x^crowding).
Rule make_rule(int lambda_nodes, double reach, int azimuth_nodes, int crowding = 2);

/// One evaluation, with everything that does not depend on the node found once.
struct Integral {
  Visibility visibility;
  double mu, r, p, sin_v;
  double log_peak;               ///< ln(1 - (N.H)^2) at lambda = 0, phi = 0
  std::array<double, 4> breaks;  ///< of lambda, ascending
  std::size_t break_count;
};

/// @param mu (0, 1], @param r (0, 1]
Integral prepare(Visibility visibility, double mu, double r, Effort effort);

/// E divided by exp(p log_peak), > 0: the part that neither overflows nor underflows.
template <class Real>
double scaled_integral(const Integral& in, const Rule& rule) {
  using brdf::exp;
  using brdf::log;
  using brdf::log1p;
  using brdf::min;
  using brdf::select;
  using brdf::sqrt;
  using L = number::Lanes<Real>;
  const brdf::SheenLobe<Real> lobe(in.visibility, Real(in.r), Real(in.mu));
  const Real p(in.p), mu(in.mu), sin_v(in.sin_v), log_peak(in.log_peak), one(1.0);
  Real sum(0.0);
  for (std::size_t k = 0; k + 1 < in.break_count; ++k) {
    const Real a(in.breaks[k]), b(in.breaks[k + 1]), length(in.breaks[k + 1] - in.breaks[k]);
    for (std::size_t i = 0; i < rule.left.size(); i += L::count) {
      const Real left = L::load(&rule.left[i]);
      const Real lambda = select(left < Real(0.5), a + length * left, b - length * L::load(&rule.right[i]));
      const Real sin_l = sqrt((one - lambda) * (one + lambda));
      const Real b4 = Real(4.0) * sin_v * sin_l;
      const Real c = Real(2.0) + Real(2.0) * mu * lambda + Real(0.5) * b4;
      const Real cos2 = (mu + lambda) * (mu + lambda);
      const Real sine_sum = (sin_v + sin_l) * (sin_v + sin_l);
      const Real sine_difference = (sin_v - sin_l) * (sin_v - sin_l);
      // -d ln(sin^2 theta_h) / dt at t = 0, times p; its root is one over the peak's width. Bounded below so that B = 0 makes no Inf.
      const Real kappa = p * b4 * cos2 / (sine_sum * c);
      const Real epsilon = one / sqrt(select(kappa > one, kappa, one));
      const Real epsilon2 = epsilon * epsilon;
      Real azimuth(0.0);
      // With x = epsilon^2 tan^2(psi/2), t = x / (1+x). For a large exponent sin^2 near 1 counts and is taken by log1p; for a small one
      // sin^2 near 0 does, where its numerator is a sum of squares and loses nothing.
      if (in.p > 8) {
        for (std::size_t j = 0; j < rule.tan2.size(); ++j) {
          const Real x = epsilon2 * Real(rule.tan2[j]);
          const Real inverse = one / (one + x);
          const Real d = c - b4 * x * inverse;
          azimuth += exp(p * (log1p(-cos2 / d) - log_peak)) * (Real(rule.azimuth_weight[j]) * inverse);
        }
      } else {
        for (std::size_t j = 0; j < rule.tan2.size(); ++j) {
          const Real x = epsilon2 * Real(rule.tan2[j]);
          const Real q = one + x;
          const Real d = c * q - b4 * x;
          const Real inverse = one / (d * q);
          azimuth += exp(p * (log((sine_difference * q + b4) * q * inverse) - log_peak)) * (Real(rule.azimuth_weight[j]) * d * inverse);
        }
      }
      sum += lobe.visibility_times_n_dot_l(lambda) * azimuth * epsilon * L::load(&rule.weight[i]) * length;
    }
  }
  return (1 + in.p) / brdf::pi * L::sum(sum);
}

/// scaled_integral for one double at a time, and for four (only where number::has_batch()).
double scaled_integral_scalar(const Integral& in, const Rule& rule);
double scaled_integral_batch(const Integral& in, const Rule& rule);

}  // namespace sheen::albedo
