#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace sheen::conformance {

/// The smallest of the values that at least this share of them do not exceed; 0 when there are none. Reorders them.
/// @param share  in (0, 1]: 0.99 gives the 99th percentile
inline double nearest_rank(std::vector<double>& values, double share) {
  if (values.empty()) {
    return 0;
  }
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(std::clamp<std::size_t>(rank, 1, values.size()) - 1);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace sheen::conformance
