#include "golden/shade_all.h"

#include "number/cpu.h"

namespace sheen::golden {

void shade_all_scalar(const Surface<double>* surfaces, const std::uint32_t* order, std::size_t count, Layers layers,
                      const Lighting& lighting, Shaded<double>* results) {
  for (std::size_t i = 0; i < count; ++i) {
    results[order[i]] = shade(surfaces[order[i]], layers, lighting, NoListener{});
  }
}

void shade_all(const Surface<double>* surfaces, const std::uint32_t* order, std::size_t count, Layers layers, const Lighting& lighting,
               Shaded<double>* results) {
#if defined(__x86_64__) || defined(__i386__)
  if (number::has_batch()) {
    shade_all_batch(surfaces, order, count, layers, lighting, results);
    return;
  }
#endif
  shade_all_scalar(surfaces, order, count, layers, lighting, results);
}

}  // namespace sheen::golden
