#pragma once

#include "number/bounded.h"
#include "number/precision.h"

namespace sheen::golden {

/// What a shader's variables of highp may hold.
using Bound = number::Bounded<number::Highp>;
/// An ulp of theirs at the most, relative to the number.
inline constexpr double epsilon = number::epsilon<number::Highp>;

}  // namespace sheen::golden
