#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "number/batch.h"

namespace sheen::golden {

// A struct of doubles and the same struct of batches: the second is the first's numbers, each as many times as a batch has lanes.

/// items[order[0..count)], one a lane. A short last group repeats its last item, so that every item meets the same instructions.
template <class Many, class One>
Many gather(const One* items, const std::uint32_t* order, std::size_t count) {
  using number::Batch;
  constexpr std::size_t numbers = sizeof(One) / sizeof(double);
  static_assert(sizeof(Many) == numbers * sizeof(Batch));
  alignas(Batch) double values[numbers][Batch::size];
  for (std::size_t lane = 0; lane < Batch::size; ++lane) {
    double one[numbers];
    std::memcpy(one, static_cast<const void*>(items + order[lane < count ? lane : count - 1]), sizeof(one));
    for (std::size_t i = 0; i < numbers; ++i) {
      values[i][lane] = one[i];
    }
  }
  Many many;
  std::memcpy(static_cast<void*>(&many), values, sizeof(values));
  return many;
}

/// Its first `count` lanes to items[order[0..count)].
template <class Many, class One>
void scatter(const Many& many, const std::uint32_t* order, std::size_t count, One* items) {
  using number::Batch;
  constexpr std::size_t numbers = sizeof(One) / sizeof(double);
  static_assert(sizeof(Many) == numbers * sizeof(Batch));
  alignas(Batch) double values[numbers][Batch::size];
  std::memcpy(values, static_cast<const void*>(&many), sizeof(values));
  for (std::size_t lane = 0; lane < count; ++lane) {
    double one[numbers];
    for (std::size_t i = 0; i < numbers; ++i) {
      one[i] = values[i][lane];
    }
    std::memcpy(static_cast<void*>(items + order[lane]), one, sizeof(one));
  }
}

}  // namespace sheen::golden
