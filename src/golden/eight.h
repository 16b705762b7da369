#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "golden/batches.h"
#include "golden/bound.h"
#include "number/bounded_batch_functions.h"
#include "number/float_batch.h"
#include "number/range_batch.h"

// Structs of number::Bounded as structs of number types that are eight floats wide, and back: by way of two of number::BoundedBatch.

namespace sheen::golden {

using Many = number::BoundedBatch<number::Highp>;
inline constexpr std::size_t eight = 2 * Many::lanes;

/// How many numbers a struct of them holds.
template <template <class> class Struct>
inline constexpr std::size_t numbers_of = sizeof(Struct<double>) / sizeof(double);

template <class Number, template <class> class Struct>
Number number_of(const Struct<Number>& numbers, std::size_t i) {
  static_assert(sizeof(numbers) == numbers_of<Struct> * sizeof(Number));
  Number one;
  std::memcpy(static_cast<void*>(&one), reinterpret_cast<const char*>(&numbers) + i * sizeof(Number), sizeof(one));
  return one;
}

template <class Number, template <class> class Struct>
void set_number(Struct<Number>& numbers, std::size_t i, const Number& one) {
  static_assert(sizeof(numbers) == numbers_of<Struct> * sizeof(Number));
  std::memcpy(reinterpret_cast<char*>(&numbers) + i * sizeof(Number), static_cast<const void*>(&one), sizeof(one));
}

/// Four lanes of each number. @param half  0 or 1
template <template <class> class Struct, class Eight>
Struct<Many> half_of(const Struct<Eight>& numbers, std::size_t half) {
  Struct<Many> out;
  for (std::size_t i = 0; i < numbers_of<Struct>; ++i) {
    set_number(out, i, number_of(numbers, i).bounds(half));
  }
  return out;
}

/// Where any of the numbers is lost.
template <template <class> class Struct, class Eight>
number::FloatMask lost(const Struct<Eight>& numbers) {
  number::FloatMask where = number_of(numbers, 0).is_lost();
  for (std::size_t i = 1; i < numbers_of<Struct>; ++i) {
    where = where | number_of(numbers, i).is_lost();
  }
  return where;
}

inline bool any_of_half(const number::FloatMask& lanes, std::size_t half) {
  bool any = false;
  for (std::size_t lane = half * Many::lanes; lane < (half + 1) * Many::lanes; ++lane) {
    any = any || lanes.get(lane);
  }
  return any;
}

/// The ranges of items[order[0..count)], at most eight of them; short of eight, the last again.
template <template <class> class Struct>
Struct<number::RangeBatch> gather_ranges(const Struct<Bound>* items, const std::uint32_t* order, std::size_t count) {
  using number::Batch;
  alignas(Batch) double lower[numbers_of<Struct>][eight];
  alignas(Batch) double upper[numbers_of<Struct>][eight];
  for (std::size_t lane = 0; lane < eight; ++lane) {
    const Struct<Bound>& item = items[order[std::min(lane, count - 1)]];
    for (std::size_t i = 0; i < numbers_of<Struct>; ++i) {
      const number::Range range = number_of(item, i).range();
      lower[i][lane] = range.lower;
      upper[i][lane] = range.upper;
    }
  }
  Struct<number::RangeBatch> out;
  for (std::size_t i = 0; i < numbers_of<Struct>; ++i) {
    const auto half = [](const double* ends, std::size_t first) { return Batch::load_aligned(ends + first); };
    set_number(out, i, number::RangeBatch(half(lower[i], 0), half(lower[i], Batch::size), half(upper[i], 0), half(upper[i], Batch::size)));
  }
  return out;
}

/// items[order[0..count)], likewise.
template <template <class> class Struct>
class EightOf {
 public:
  EightOf(const Struct<Bound>* items, const std::uint32_t* order, std::size_t count) {
    for (std::size_t half = 0; half < 2; ++half) {
      const std::size_t from = std::min(half * Many::lanes, count - 1);
      halves_[half] = gather<Struct<Many>>(items, order + from, std::min(count - from, Many::lanes));
    }
  }

  const Struct<Many>& half(std::size_t i) const { return halves_[i]; }
  template <class Eight>
  Struct<Eight> all() const {
    Struct<Eight> out;
    for (std::size_t i = 0; i < numbers_of<Struct>; ++i) {
      set_number(out, i, Eight(number_of(halves_[0], i), number_of(halves_[1], i)));
    }
    return out;
  }

 private:
  Struct<Many> halves_[2];
};

/// The first `count` lanes to results[order[0..count)].
template <template <class> class Result, class Eight>
void scatter_eight(const Result<Eight>& made, const std::uint32_t* order, std::size_t count, Result<Bound>* results) {
  for (std::size_t from = 0; from < count; from += Many::lanes) {
    scatter(half_of(made, from / Many::lanes), order + from, std::min(count - from, Many::lanes), results);
  }
}

}  // namespace sheen::golden
