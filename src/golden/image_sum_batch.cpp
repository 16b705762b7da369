#include "golden/image_sum.h"
#include "number/batch.h"

namespace sheen::golden {

ImageSums image_sum_batch(const ImageSumTask& task, const StrategyPoints& points) {
  return ImageSum<number::Batch>(task)(points);
}

}  // namespace sheen::golden
