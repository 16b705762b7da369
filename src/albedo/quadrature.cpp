#include "albedo/quadrature.h"

#include <algorithm>
#include <cmath>

namespace sheen::albedo {

// Zeros of the Legendre polynomial P_n by Newton's method from Tricomi's estimate, mapped to [0, 1].
GaussLegendre::GaussLegendre(int count) {
  const int n = count;
  for (int i = 0; i < n; ++i) {
    double x = std::cos(brdf::pi * (i + 0.75) / (n + 0.5));
    double derivative = 0;
    for (int step = 0; step < 8; ++step) {
      double p0 = 1, p1 = 0;
      for (int j = 0; j < n; ++j) {
        const double p2 = p1;
        p1 = p0;
        p0 = ((2 * j + 1) * x * p1 - j * p2) / (j + 1);
      }
      derivative = n * (x * p0 - p1) / (x * x - 1);
      x -= p0 / derivative;
    }
    node.push_back((1 - x) / 2);
    weight.push_back(1 / ((1 - x * x) * derivative * derivative));
  }
}

// Tanh-sinh: Takahasi and Mori 1974.
Rule make_rule(int lambda_nodes, double reach, int azimuth_nodes, int crowding) {
  Rule rule;
  const double step = 2 * reach / (lambda_nodes - 1);
  for (int i = 0; i < lambda_nodes; ++i) {
    const double t = -reach + i * step;
    const double s = brdf::pi / 2 * std::sinh(t);
    const double left = 1 / (1 + std::exp(-2 * s));
    const double right = 1 / (1 + std::exp(2 * s));
    rule.left.push_back(left);
    rule.right.push_back(right);
    rule.weight.push_back(step * brdf::pi * std::cosh(t) * left * right);
  }
  const auto [x, w] = GaussLegendre(azimuth_nodes);
  for (int j = 0; j < azimuth_nodes; ++j) {
    double power = x[j];  // x^(crowding - 1)
    for (int k = 2; k < crowding; ++k) {
      power *= x[j];
    }
    const double tangent = std::tan(brdf::pi / 2 * (1 - power * x[j]));
    rule.tan2.push_back(tangent * tangent);
    // Both halves of phi, dpsi = pi crowding x^(crowding - 1) dx, dphi/dpsi = epsilon (1 + tan^2) / (1 + epsilon^2 tan^2).
    rule.azimuth_weight.push_back(2 * crowding * brdf::pi * power * w[j] * (1 + tangent * tangent));
  }
  return rule;
}

const Rule& rule_for(double p, Effort effort) {
  // Each size is about the smallest that meets its Effort's error against a rule of 120 x 96 nodes at 1,500 random points
  // (directional_albedo_test.cpp holds them to it). Tanh-sinh to 2.6: what lies beyond weighs less than these errors, and costs a fifth of
  // the nodes.
  static const Rule fast_soft = make_rule(24, 2.6, 14, 3), fast_wide = make_rule(28, 2.6, 16), fast_narrow = make_rule(32, 2.6, 28);
  static const Rule full_soft = make_rule(28, 2.6, 16), full_wide = make_rule(32, 2.6, 18), full_narrow = make_rule(48, 3.4, 36);
  const bool fast = effort == Effort::Fast;
  if (p > 8) {
    return fast ? fast_narrow : full_narrow;
  }
  if (p > 2) {
    return fast ? fast_wide : full_wide;
  }
  return fast ? fast_soft : full_soft;
}

Integral prepare(Visibility visibility, double mu, double r, Effort effort) {
  Integral in{visibility, mu, r, 0.5 / (r * r), std::sqrt((1 - mu) * (1 + mu)), 0, {}, 0};
  in.log_peak = std::log1p(-mu * mu / (2 + 2 * in.sin_v));
  const double cos2_end = -std::expm1(in.log_peak - (effort == Effort::Fast ? 24 : 36) / in.p);  // (N.H)^2 at the end
  double end = 1;
  // theta_l = 2 theta_h - theta_v; beyond normal incidence there is nothing to cut.
  if (cos2_end < (1 + mu) / 2) {
    end = (2 * cos2_end - 1) * mu + 2 * std::sqrt(cos2_end * (1 - cos2_end)) * in.sin_v;
  }
  end = std::clamp(end, 0.0, 1.0);
  const auto add = [&in](double x) { in.breaks[in.break_count++] = x; };
  const bool conical = in.p <= 8 && mu < end;  // for larger p the conical point carries less than rounding
  add(0);
  if (conical && mu < 0.5) {
    add(mu);
  }
  if (end > 0.5) {
    add(0.5);
  }
  if (conical && mu > 0.5) {
    add(mu);
  }
  add(end);
  return in;
}

double scaled_integral_scalar(const Integral& in, const Rule& rule) {
  return scaled_integral<double>(in, rule);
}

}  // namespace sheen::albedo
