#pragma once

#include "golden/vec3.h"
#include "number/range_batch.h"

namespace sheen::golden {

// Products of vectors of ranges, whose roundings are enclosed all at once: a good part of what a lobe costs.

inline number::RangeBatch dot(const Vec3<number::RangeBatch>& a, const Vec3<number::RangeBatch>& b) {
  return &a == &b ? sum_of_squares(a.x, a.y, a.z) : sum_of_products(a.x, b.x, a.y, b.y, a.z, b.z);
}

inline Vec3<number::RangeBatch> cross(const Vec3<number::RangeBatch>& a, const Vec3<number::RangeBatch>& b) {
  return {difference_of_products(a.y, b.z, a.z, b.y), difference_of_products(a.z, b.x, a.x, b.z),
          difference_of_products(a.x, b.y, a.y, b.x)};
}

}  // namespace sheen::golden
