#pragma once

#include <cstddef>

#include "number/rounding_batch.h"
#include "number/truth.h"

namespace sheen::number {

/// Four of Truth.
class TruthBatch {
 public:
  TruthBatch(const BatchMask& at_center, const BatchMask& certain) : at_center_(at_center), certain_(certain) {}

  const BatchMask& at_center() const { return at_center_; }
  BatchMask is_true() const { return certain_ & at_center_; }
  BatchMask is_false() const { return certain_ & ~at_center_; }
  BatchMask is_either() const { return ~certain_; }
  Truth lane(std::size_t i) const { return {at_center_.get(i), certain_.get(i)}; }

 private:
  BatchMask at_center_, certain_;
};

/// Whether it may hold in any lane.
inline bool any(const TruthBatch& t) {
  return !xsimd::all(t.is_false());
}

/// select() of what two functions give; where all lanes choose alike for certain, one of them is called.
template <class A, class B>
auto select_of(const TruthBatch& condition, const A& a, const B& b) {
  if (xsimd::all(condition.is_true())) return a();
  if (xsimd::all(condition.is_false())) return b();
  return select(condition, a(), b());
}

}  // namespace sheen::number
