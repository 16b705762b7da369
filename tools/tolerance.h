#pragma once

#include <cstdint>

#include "image/image.h"
#include "tools/options.h"

namespace sheen::tools {

/// How many values (channels R, G, B and, where both images have it, A, of the pixels that either covers) differ by more than
/// max(absolute, relative * |reference|). A NaN or Inf in either image counts as outside. Both images have one size.
/// An image without A covers all its pixels.
std::int64_t values_outside(const image::Image& candidate, const image::Image& reference, const Tolerance& tolerance);

}  // namespace sheen::tools
