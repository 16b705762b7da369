#include "golden/control_variate.h"
#include "number/batch.h"

namespace sheen::golden {

NodeValues node_values_batch(const Surface<double>& surface, Layers layers, const Lighting& lighting) {
  return node_values<number::Batch>(surface, layers, lighting);
}

brdf::Rgb<double> integral_batch(const ControlVariate& control, const BandLimited& light, const SpherePoints& points) {
  return integral<number::Batch>(control, light, points);
}

}  // namespace sheen::golden
