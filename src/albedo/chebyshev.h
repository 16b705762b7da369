#pragma once

#include <array>
#include <cmath>

#include "brdf/math.h"

namespace sheen::albedo {

/// Chebyshev nodes of the first kind on [-1, 1] and their barycentric weights (Berrut and Trefethen 2004, section 5.3).
template <int count>
struct Chebyshev {
  using Nodes = std::array<double, count>;
  Nodes node, weight;

  Chebyshev() {
    for (int i = 0; i < count; ++i) {
      const double angle = brdf::pi * (i + 0.5) / count;
      node[i] = std::cos(angle);
      weight[i] = (i % 2 == 0 ? 1 : -1) * std::sin(angle);
    }
  }

  /// The share each node's value has at t: weights that sum to 1.
  Nodes shares(double t) const {
    Nodes s;
    double sum = 0;
    for (int i = 0; i < count; ++i) {
      const double distance = t - node[i];
      if (distance == 0) {
        s.fill(0);
        s[i] = 1;
        return s;
      }
      s[i] = weight[i] / distance;
      sum += s[i];
    }
    for (double& v : s) {
      v /= sum;
    }
    return s;
  }

  static const Chebyshev& instance() {
    static const Chebyshev c;
    return c;
  }
};

}  // namespace sheen::albedo
