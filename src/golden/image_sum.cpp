#include "golden/image_sum.h"

#include "number/cpu.h"

namespace sheen::golden {

ImageSums image_sum_scalar(const ImageSumTask& task, const StrategyPoints& points) {
  return ImageSum<double>(task)(points);
}

ImageSums image_sum(const ImageSumTask& task, const StrategyPoints& points) {
#if defined(__x86_64__) || defined(__i386__)
  if (number::has_batch()) {
    return image_sum_batch(task, points);
  }
#endif
  return image_sum_scalar(task, points);
}

}  // namespace sheen::golden
