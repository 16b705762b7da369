#include "albedo/directional_albedo.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <tbb/parallel_for.h>

#include "albedo/quadrature.h"
#include "number/cpu.h"

namespace sheen::albedo {

namespace {

double log_albedo(Visibility visibility, double n_dot_v, double sheen_roughness, Effort effort) {
  // 1 / (2 r^2) overflows below; E has long been 0 there.
  if (!(sheen_roughness > 1e-150)) {
    return -std::numeric_limits<double>::infinity();
  }
  const Integral in = prepare(visibility, std::clamp(n_dot_v, 1e-7, 1.0), std::min(sheen_roughness, 1.0), effort);
  const Rule& rule = rule_for(in.p, effort);
  static const bool batch = number::has_batch();
  const double scaled = batch ? scaled_integral_batch(in, rule) : scaled_integral_scalar(in, rule);
  return std::log(scaled) + in.p * in.log_peak;
}

}  // namespace

double log_directional_albedo(Visibility visibility, double n_dot_v, double sheen_roughness) {
  return log_albedo(visibility, n_dot_v, sheen_roughness, Effort::Full);
}

double log_directional_albedo_fast(Visibility visibility, double n_dot_v, double sheen_roughness) {
  return log_albedo(visibility, n_dot_v, sheen_roughness, Effort::Fast);
}

double directional_albedo(Visibility visibility, double n_dot_v, double sheen_roughness) {
  return std::exp(log_directional_albedo(visibility, n_dot_v, sheen_roughness));
}

std::vector<double> evaluate_grid(Visibility visibility, const std::vector<double>& n_dot_v, const std::vector<double>& sheen_roughness) {
  std::vector<double> result(n_dot_v.size() * sheen_roughness.size());
  tbb::parallel_for(std::size_t{0}, result.size(), [&](std::size_t k) {
    const double mu = n_dot_v[k % n_dot_v.size()], r = sheen_roughness[k / n_dot_v.size()];
    // The fast way's 4e-7 of an E up to 2 is below 1e-6; beyond, and nearer to grazing, the full way's 3e-7.
    const double fast = mu >= 0.004 ? std::exp(log_directional_albedo_fast(visibility, mu, r)) : 3.0;
    result[k] = fast <= 2.0 ? fast : directional_albedo(visibility, mu, r);
  });
  return result;
}

}  // namespace sheen::albedo
