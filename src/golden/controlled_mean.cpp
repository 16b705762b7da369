#include "golden/controlled_mean.h"

#include <algorithm>
#include <cmath>

namespace sheen::golden {

ControlledMean::ControlledMean(std::span<const Pair> replicas, double known) {
  const auto n = static_cast<double>(replicas.size());
  double y = 0.0;
  double x = 0.0;
  for (const Pair& p : replicas) {
    y += p.value / n;
    x += p.control / n;
  }
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (const Pair& p : replicas) {
    xx += (p.control - x) * (p.control - x);
    xy += (p.control - x) * (p.value - y);
    yy += (p.value - y) * (p.value - y);
  }
  const double b = xx > 0.0 ? xy / xx : 0.0;
  const double off = x - known;
  const double residual = std::max(yy - b * xy, 0.0) / (n - 2.0);
  value = y - b * off;
  standard_error = std::sqrt(residual * (1.0 / n + (xx > 0.0 ? off * off / xx : 0.0)));
}

}  // namespace sheen::golden
