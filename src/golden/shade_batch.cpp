#include "golden/batches.h"
#include "golden/shade_all.h"

namespace sheen::golden {

void shade_all_batch(const Surface<double>* surfaces, const std::uint32_t* order, std::size_t count, Layers layers,
                     const Lighting& lighting, Shaded<double>* results) {
  using number::Batch;
  for (std::size_t i = 0; i < count; i += Batch::size) {
    const std::size_t here = count - i < Batch::size ? count - i : Batch::size;
    scatter(shade(gather<Surface<Batch>>(surfaces, order + i, here), layers, lighting, NoListener{}), order + i, here, results);
  }
}

}  // namespace sheen::golden
