#include "albedo/ggx_albedo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "albedo/coordinates.h"
#include "albedo/quadrature.h"
#include "albedo/split_sum.h"

// The loss 1 - E without the difference. Every half vector that faces the eye weighs D G1(v) (V.H) (Heitz 2014, equation 16: they project
// to the area seen), so over the whole sphere of L, below the horizon too,
//
//   integral of D G1(v) / (4 N.V) dL = 1,   E = integral over N.L > 0 of D G2 / (4 N.V) dL
//
// and with G2 / G1 = (1 + Lambda_v) / (1 + Lambda_v + Lambda_l) what is lost is what leaves downward and what is shadowed on its way out:
//
//   1 - E = integral of D G1(v) / (4 N.V) lost dL,   lost = Lambda_l / (1 + Lambda_v + Lambda_l) above the horizon, 1 below
//
// Coordinates as in split_sum.cpp: theta, theta' the polar angles of V and L, delta = theta' - theta, sigma = theta' + theta, and the
// azimuth in closed form: with u(x) = sin^2(x/2) + alpha^2 cos^2(x/2), K = 4 (1 - alpha^2) c, c = cos^2(sigma/2) cos^2(delta/2),
//
//   integral of D dpsi = 2 alpha^2 (1 + 2 K/s + K^2 p/s^3),   s = 4 sqrt(c u(delta) u(sigma)),
//   p = 2 (cos^2(sigma/2) u(delta) + cos^2(delta/2) u(sigma))
//
// tan(delta/2) = alpha sinh(x) takes the peak out. Panels end at the mirror angle and at the horizon, near which `lost` has the scale
// alpha.

namespace sheen::albedo {
namespace {

using brdf::square;

constexpr double lossless_alpha = 1e-10;  // below, nothing here has the digits

// mu Lambda(mu), which has a limit at mu = 0.
double shadow(double a2, double mu) {
  const double a = a2 * (1 - mu) * (1 + mu);
  return 0.5 * a / (std::abs(mu) + std::sqrt(mu * mu + a));
}

}  // namespace

double ggx_loss(double n_dot_v, double alpha) {
  if (!(alpha > lossless_alpha)) {
    return 0;
  }
  static const Rule rule = make_rule(72, 3.2, 1);
  const double mu = std::clamp(n_dot_v, 1e-12, 1.0), sin_v = std::sqrt((1 - mu) * (1 + mu));
  const double elevation = std::asin(mu), a2 = alpha * alpha;
  const double seen = mu + shadow(a2, mu);
  const auto x_of = [alpha](double delta) { return std::asinh(std::tan(0.5 * delta) / alpha); };
  const std::array<double, 4> ends{x_of(elevation - 0.5 * brdf::pi), 0, x_of(elevation), x_of(2 * elevation)};
  double sum = 0;
  for (std::size_t panel = 0; panel + 1 < ends.size(); ++panel) {
    const double a = ends[panel], b = ends[panel + 1];
    for (std::size_t i = 0; i < rule.left.size(); ++i) {
      const double x = rule.left[i] < 0.5 ? a + (b - a) * rule.left[i] : b - (b - a) * rule.right[i];
      const double e = std::exp(x), sinh = std::abs(x) < 1e-3 ? x * (1 + x * x / 6) : 0.5 * (e - 1 / e), cosh = 0.5 * (e + 1 / e);
      const double tangent = alpha * sinh;
      const double cos2_delta = 1 / (1 + tangent * tangent), cos_delta = std::sqrt(cos2_delta);  // of delta/2
      const double cos_sigma = cos_delta * (mu - sin_v * tangent), cos2_sigma = cos_sigma * cos_sigma;
      const double sine_l = cos2_delta * (sin_v * (1 - tangent * tangent) + 2 * mu * tangent);
      const double lambda = cos2_delta * (mu * (1 - tangent * tangent) - 2 * sin_v * tangent);
      const double u_delta = cos2_delta * square(alpha * cosh);
      const double u_sigma = square(cos_delta * (sin_v + mu * tangent)) + a2 * cos2_sigma;
      const double u = u_delta * u_sigma, k = 1 - a2;
      const double root = std::sqrt(cos2_delta * cos2_sigma / u);  // K/s = k root, K^2 p/s^3 = k^2 root p / (4 u)
      const double ring = 1 + 2 * k * root + 0.5 * k * k * root * (cos2_sigma * u_delta + cos2_delta * u_sigma) / u;
      const double dark = shadow(a2, lambda) * mu;
      const double lost = panel == 2 ? 1 : dark / (std::max(lambda, 0.0) * seen + dark);
      // dL = sin(theta') dtheta' dpsi, dtheta' = 2 alpha cosh(x) cos^2(delta/2) dx
      sum += rule.weight[i] * (b - a) * ring * lost * std::max(sine_l, 0.0) * cosh * cos2_delta;
    }
  }
  return sum * alpha * a2 / seen;
}

GgxAlbedo ggx_albedo(double n_dot_v, double alpha) {
  return {ggx_loss(n_dot_v, alpha), ggx_split_sum(n_dot_v, std::sqrt(alpha)).bias};
}

GgxAlbedo ggx_average_albedo(double alpha) {
  if (!(alpha > lossless_alpha)) {
    return {0, 1.0 / 21};
  }
  // Over y = ln T, T = tan(elevation / 2), in which both bend by the unit: 12 points of Gauss and Legendre to a panel. Below T = 1e-3 alpha
  // lies less than 1e-8 of the loss, below 1e-4 of the bias.
  static const GaussLegendre rule(12);
  constexpr double panel_length = 2.5;
  GgxAlbedo sum{0, 0};
  const double lowest = std::log(1e-3 * alpha);
  for (double top = 0; top > lowest; top -= panel_length) {
    for (std::size_t i = 0; i < rule.node.size(); ++i) {
      const double t = std::exp(top - panel_length * rule.node[i]);
      const double mu = cosine_of(t);
      const double weight = 2 * mu * mu * (1 - t * t) / (1 + t * t) * panel_length * rule.weight[i];
      sum.loss += weight * ggx_loss(mu, alpha);
      if (t > 1e-4) {
        sum.bias += weight * ggx_split_sum(mu, std::sqrt(alpha)).bias;
      }
    }
  }
  return sum;
}

}  // namespace sheen::albedo
