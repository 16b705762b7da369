#pragma once

#include <cstdint>

#include "golden/shade.h"

namespace sheen::golden {

/// Shades surfaces[order[0..count)] into results at the same indices, four at a time where the processor can; all have the same layers. A
/// surface's result does not depend on its neighbours in `order`.
void shade_all(const Surface<double>* surfaces, const std::uint32_t* order, std::size_t count, Layers layers, const Lighting& lighting,
               Shaded<double>* results);

/// The same, one at a time.
void shade_all_scalar(const Surface<double>* surfaces, const std::uint32_t* order, std::size_t count, Layers layers,
                      const Lighting& lighting, Shaded<double>* results);

/// The same in number::Batch. Only where number::has_batch().
void shade_all_batch(const Surface<double>* surfaces, const std::uint32_t* order, std::size_t count, Layers layers,
                     const Lighting& lighting, Shaded<double>* results);

}  // namespace sheen::golden
