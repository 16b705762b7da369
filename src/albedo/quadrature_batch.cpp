#include "albedo/quadrature.h"
#include "number/batch.h"

namespace sheen::albedo {

double scaled_integral_batch(const Integral& in, const Rule& rule) {
  return scaled_integral<number::Batch>(in, rule);
}

}  // namespace sheen::albedo
