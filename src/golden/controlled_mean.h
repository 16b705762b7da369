#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace sheen::golden {

/// A mean over independent replicas, improved by a control variate whose mean is known: m_y - b (m_x - known), b by least squares over the
/// replicas themselves, so that a control that tells nothing does no harm. The standard error is that of a regression's prediction at
/// `known` (Lavenberg and Welch 1981, equations 10 to 14): exact for replicas that are normal, with two degrees of freedom fewer than
/// there are replicas.
struct ControlledMean {
  struct Pair {
    double value, control;  // y, x
  };

  double value = 0.0;
  double standard_error = 0.0;  ///< as found; Student's distribution is the caller's

  ControlledMean(std::span<const Pair> replicas, double known);
};

}  // namespace sheen::golden
