#include "albedo/split_sum.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <tbb/parallel_for.h>

#include "albedo/quadrature.h"
#include "brdf/ggx.h"

// The integral over L. With theta, theta' the polar angles of V and L, delta = theta' - theta, sigma = theta' + theta, and psi the azimuth
// of L from the mirror direction:
//
//   |L+V|^2 = Q = K + p - q cos(psi),   K = (1 - alpha^2) (N.V + N.L)^2,   D = alpha^2 / pi  (Q / (p - q cos(psi)))^2
//   p - q = 4 cos^2(sigma/2) (sin^2(delta/2) + alpha^2 cos^2(delta/2)),   p + q: the same with sigma and delta exchanged
//
// Both peaks, of width alpha, are taken out by substitution:
//  - tan(psi/2) = e tan(chi/2), e^2 = (p-q)/(p+q), makes p - q cos(psi) = (p-q)/m with m = cos^2(chi/2) + e^2 sin^2(chi/2);
//  - tan(delta/2) = alpha sinh(x): what remains falls like 1/cosh^2(x), so it is cut at |x| = 12; a panel on either side of the mirror
//    angle, by tanh-sinh, since Vis has its own scale alpha at N.L = 0.

namespace sheen::albedo {
namespace {

using brdf::square;

constexpr double alpha_of_a_mirror = 1e-8;  // below, the lobe differs from a mirror's by less than 1e-7 at n_dot_v = 1e-4
constexpr double cut = 12;                  // 1/cosh^2 is 1.5e-10 there

struct Sum {
  double all = 0;   ///< F = 1
  double bias = 0;  ///< F = w
};

/// One polar angle of the light, integrated over the azimuth: D of a unit Fresnel factor and weighted by w.
Sum azimuth(const Rule& rule, double alpha, double cosines, double cos2_half_delta, double half_sigma, double cosh2) {
  const double cos2_half_sigma = square(std::cos(half_sigma)), sin2_half_sigma = square(std::sin(half_sigma));
  const double near = 4 * cos2_half_sigma * cos2_half_delta * alpha * alpha * cosh2;             // p - q
  const double far = 4 * cos2_half_delta * (sin2_half_sigma + alpha * alpha * cos2_half_sigma);  // p + q
  const double k = (1 - alpha * alpha) * cosines * cosines;
  const double e2 = near / far;
  Sum sum;
  for (std::size_t j = 0; j < rule.tan2.size(); ++j) {
    const double cos2 = 1 / (1 + rule.tan2[j]);
    const double m = cos2 + e2 * (1 - cos2);
    const double q = k + near / m;
    const double lobe = rule.azimuth_weight[j] * cos2 * m * q * q;
    const double c = std::max(0.0, 1 - std::sqrt(q) / 2);
    sum.all += lobe;
    sum.bias += lobe * square(square(c)) * c;
  }
  const double factor = alpha * alpha / brdf::pi * std::sqrt(e2) / (near * near);
  return {sum.all * factor, sum.bias * factor};
}

}  // namespace

SplitSum ggx_split_sum(double n_dot_v, double roughness) {
  const double mu = std::clamp(n_dot_v, 1e-7, 1.0);
  const double alpha = square(std::clamp(roughness, 0.0, 1.0));
  if (!(alpha > alpha_of_a_mirror)) {
    const double bias = square(square(1 - mu)) * (1 - mu);
    return {1 - bias, bias};
  }
  // About the smallest rule that stays below 5e-7 of one of 200 x 100 nodes at 3,000 points down to n_dot_v 1e-4, roughness 1e-3.
  static const Rule rule = make_rule(48, 2.8, 24, 4);
  const double theta = std::acos(mu);
  const double ends[] = {std::max(-cut, -std::asinh(std::tan(theta / 2) / alpha)), 0,
                         std::min(cut, std::asinh(std::tan((brdf::pi / 2 - theta) / 2) / alpha))};
  Sum sum;
  for (int panel = 0; panel < 2; ++panel) {
    const double a = ends[panel], length = ends[panel + 1] - a;
    for (std::size_t i = 0; i < rule.left.size(); ++i) {
      const double x = rule.left[i] < 0.5 ? a + length * rule.left[i] : ends[panel + 1] - length * rule.right[i];
      const double tangent = alpha * std::sinh(x);
      const double half_delta = std::atan(tangent);
      const double lambda = std::cos(theta + 2 * half_delta), sin_l = std::sin(theta + 2 * half_delta);
      if (!(lambda > 0 && sin_l > 0)) {
        continue;  // rounding at the ends, where the integrand vanishes
      }
      const double cos2_half_delta = 1 / (1 + tangent * tangent);
      const double cosh2 = 1 + square(std::sinh(x));
      const Sum ring = azimuth(rule, alpha, mu + lambda, cos2_half_delta, theta + half_delta, cosh2);
      const double d_theta = 2 * alpha * std::sqrt(cosh2) * cos2_half_delta * rule.weight[i] * length;
      const double weight = brdf::smith_visibility(alpha, lambda, mu) * lambda * sin_l * d_theta;
      sum.all += weight * ring.all;
      sum.bias += weight * ring.bias;
    }
  }
  return {sum.all - sum.bias, sum.bias};
}

double diffuse_fresnel(double n_dot_v) {
  const double mu = std::clamp(n_dot_v, 0.0, 1.0), sin_v = std::sqrt((1 - mu) * (1 + mu));
  static const Rule rule = make_rule(48, 3.4, 1);
  constexpr int steps = 64;  // in azimuth, where the integrand is smooth and periodic
  double sum = 0;
  for (std::size_t i = 0; i < rule.left.size(); ++i) {
    const double lambda = rule.left[i], sin_l = std::sqrt(rule.right[i] * (1 + lambda));
    double ring = 0;
    for (int j = 0; j < steps; ++j) {
      const double v_dot_l = mu * lambda + sin_v * sin_l * std::cos(brdf::pi * (j + 0.5) / steps);
      const double c = 1 - std::sqrt(std::max(0.5 * (1 + v_dot_l), 0.0));
      ring += square(square(c)) * c;
    }
    sum += rule.weight[i] * lambda * ring;
  }
  return 2 * sum / steps;
}

std::vector<SplitSum> evaluate_split_sum_grid(const std::vector<double>& n_dot_v, const std::vector<double>& roughness) {
  std::vector<SplitSum> result(n_dot_v.size() * roughness.size());
  tbb::parallel_for(std::size_t{0}, result.size(),
                    [&](std::size_t k) { result[k] = ggx_split_sum(n_dot_v[k % n_dot_v.size()], roughness[k / n_dot_v.size()]); });
  return result;
}

}  // namespace sheen::albedo
