#include <cstring>

#include "golden/shade_all.h"
#include "number/batch.h"

namespace sheen::golden {
namespace {

using number::Batch;
constexpr std::size_t lanes = Batch::size;

// A struct of doubles and the same struct of batches: the second is the first's numbers, each `lanes` times.
template <template <class> class Struct>
constexpr std::size_t numbers = sizeof(Struct<double>) / sizeof(double);
static_assert(sizeof(Surface<Batch>) == numbers<Surface> * sizeof(Batch));
static_assert(sizeof(Shaded<Batch>) == numbers<Shaded> * sizeof(Batch));

Surface<Batch> gather(const Surface<double>* surfaces, const std::uint32_t* order, std::size_t count) {
  alignas(Batch) double values[numbers<Surface>][lanes];
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    double one[numbers<Surface>];
    // A short last group repeats its last surface, so that every surface meets the same instructions.
    std::memcpy(one, surfaces + order[lane < count ? lane : count - 1], sizeof(one));
    for (std::size_t i = 0; i < numbers<Surface>; ++i) {
      values[i][lane] = one[i];
    }
  }
  Surface<Batch> surface;
  std::memcpy(static_cast<void*>(&surface), values, sizeof(values));
  return surface;
}

void scatter(const Shaded<Batch>& shaded, const std::uint32_t* order, std::size_t count, Shaded<double>* results) {
  alignas(Batch) double values[numbers<Shaded>][lanes];
  std::memcpy(values, static_cast<const void*>(&shaded), sizeof(values));
  for (std::size_t lane = 0; lane < count; ++lane) {
    double one[numbers<Shaded>];
    for (std::size_t i = 0; i < numbers<Shaded>; ++i) {
      one[i] = values[i][lane];
    }
    std::memcpy(results + order[lane], one, sizeof(one));
  }
}

}  // namespace

void shade_all_batch(const Surface<double>* surfaces, const std::uint32_t* order, std::size_t count, Layers layers,
                     const Lighting& lighting, Shaded<double>* results) {
  for (std::size_t i = 0; i < count; i += lanes) {
    const std::size_t here = count - i < lanes ? count - i : lanes;
    scatter(shade(gather(surfaces, order + i, here), layers, lighting, NoListener{}), order + i, here, results);
  }
}

}  // namespace sheen::golden
