#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace sheen::golden {

/// Hands the indices of `materials` to f(order, count, material), those of one material together.
template <class Function>
void by_material(const std::vector<int>& materials, const Function& f) {
  std::vector<std::uint32_t> order(materials.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return materials[a] < materials[b]; });
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin;
    const int material = materials[order[begin]];
    while (end < order.size() && materials[order[end]] == material) {
      ++end;
    }
    f(order.data() + begin, end - begin, material);
    begin = end;
  }
}

}  // namespace sheen::golden
