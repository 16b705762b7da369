#pragma once

#include <vector>

#include "conformance/relation.h"

namespace sheen::conformance {

/// What must be true of a weighted sum of a relation's pictures: of every pixel that it vanishes or is not positive, or of a share of them
/// that it is not 0 or is positive.
enum class Must { Vanish, NotBePositive, Differ, BePositive };

struct Demand {
  Must must = Must::Vanish;
  std::vector<double> weights;  ///< one a picture

  bool holds_everywhere() const { return must == Must::Vanish || must == Must::NotBePositive; }
  /// How much of a sum counts: against a demand on every pixel, for a demand on some.
  double counted(double sum) const;
};

/// The demands that a relation comes to. @param tone_mapped  what a tone mapping leaves of them; none where it leaves nothing
std::vector<Demand> demands_of(const Relation& relation, bool tone_mapped);

}  // namespace sheen::conformance
