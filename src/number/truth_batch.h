#pragma once

#include <cstddef>

#include "number/rounding_batch.h"
#include "number/truth.h"

namespace sheen::number {

/// As many of Truth as a mask has lanes.
template <class Mask>
class Truths {
 public:
  Truths(const Mask& at_center, const Mask& certain) : at_center_(at_center), certain_(certain) {}

  const Mask& at_center() const { return at_center_; }
  Mask is_true() const { return certain_ & at_center_; }
  Mask is_false() const { return certain_ & ~at_center_; }
  Mask is_either() const { return ~certain_; }
  Truth lane(std::size_t i) const { return {at_center_.get(i), certain_.get(i)}; }
  Truths negated() const { return {~at_center_, certain_}; }

 private:
  Mask at_center_, certain_;
};

using TruthBatch = Truths<BatchMask>;

/// Whether it may hold in any lane.
template <class Mask>
bool any(const Truths<Mask>& t) {
  return !xsimd::all(t.is_false());
}

/// select() of what two functions give; where all lanes choose alike for certain, one of them is called.
template <class Mask, class A, class B>
auto select_of(const Truths<Mask>& condition, const A& a, const B& b) {
  if (xsimd::all(condition.is_true())) return a();
  if (xsimd::all(condition.is_false())) return b();
  return select(condition, a(), b());
}

}  // namespace sheen::number
