#pragma once

#include <cmath>

#include "albedo/sheen_model.h"

namespace sheen::albedo {

/// With its cosine E rises to one peak about here or below, or to none, and falls from there, for every visibility and roughness
/// (KHR_materials_sheen leaves that unsaid; directional_albedo_test holds it).
inline constexpr double decreasing_from = 0.008;

/// Where E of one roughness is largest.
struct Peak {
  double from, to;  ///< n_dot_v, between which it lies
  double e;         ///< no less than E of any cosine; where E only falls, of `to` and larger ones

  /// About `e_inside`, E of a cosine between the two: E falls from its peak by less than a tenth of the squared logarithm of their ratio.
  static Peak around(double from, double to, double e_inside) {
    const double ratio = std::log(to / from);
    return {from, to, (1 + 1e-6 + 0.1 * ratio * ratio) * e_inside};
  }
};

/// By golden sections of ln n_dot_v, Kiefer 1953.
/// @param e         E of a cosine
/// @param sections  16 find the place to 1/500 of it, 8 to a tenth, each with an evaluation
template <class E>
Peak peak_of(const E& e, int sections) {
  constexpr double section = 0.6180339887498949;
  double from = std::log(min_n_dot_v);
  double to = std::log(1.1 * decreasing_from);
  double first = to - section * (to - from);
  double second = from + section * (to - from);
  double at_first = e(std::exp(first));
  double at_second = e(std::exp(second));
  for (int i = 0; i < sections; ++i) {
    if (at_first < at_second) {
      from = first;
      first = second;
      at_first = at_second;
      second = from + section * (to - from);
      at_second = e(std::exp(second));
    } else {
      to = second;
      second = first;
      at_second = at_first;
      first = to - section * (to - from);
      at_first = e(std::exp(first));
    }
  }
  return Peak::around(std::exp(from), std::exp(to), at_first > at_second ? at_first : at_second);
}

}  // namespace sheen::albedo
