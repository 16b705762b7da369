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
  /// From values at the nodes to the coefficients of the powers of t. At degree 11 powers lose four digits of sixteen.
  std::array<Nodes, count> powers{};

  Chebyshev() {
    for (int i = 0; i < count; ++i) {
      const double angle = brdf::pi * (i + 0.5) / count;
      node[i] = std::cos(angle);
      weight[i] = (i % 2 == 0 ? 1 : -1) * std::sin(angle);
    }
    find_powers();
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

 private:
  // The Chebyshev coefficients by their discrete orthogonality, then T_k+1 = 2 t T_k - T_k-1.
  void find_powers() {
    Nodes before{};  // the powers in T_k-1 and T_k
    Nodes current{};
    current[0] = 1;
    for (int k = 0; k < count; ++k) {
      for (int i = 0; i < count; ++i) {
        const double share = (k == 0 ? 1.0 : 2.0) / count * std::cos(brdf::pi * k * (i + 0.5) / count);
        for (int power = 0; power < count; ++power) {
          powers[power][i] += current[power] * share;
        }
      }
      Nodes next{};
      for (int power = 0; power + 1 < count; ++power) {
        next[power + 1] = (k == 0 ? 1.0 : 2.0) * current[power];
      }
      for (int power = 0; power < count; ++power) {
        next[power] -= before[power];
      }
      before = current;
      current = next;
    }
  }
};

}  // namespace sheen::albedo
