#pragma once

#include "number/bounded.h"

namespace sheen::golden {

/// What a shader's variables of highp may hold.
using Bound = number::Bounded<number::Highp>;

}  // namespace sheen::golden
