#pragma once

#include <cstddef>

#include "number/batch.h"

// Eight floats and the two batches of doubles that they are.

namespace sheen::number {

/// Its first four, or its last. @param half  0 or 1
inline Batch widened(const FloatBatch& x, std::size_t half) {
  return _mm256_cvtps_pd(half == 0 ? _mm256_castps256_ps128(x) : _mm256_extractf128_ps(x, 1));
}

/// To the nearest floats.
inline FloatBatch narrowed(const Batch& first, const Batch& last) {
  return _mm256_set_m128(_mm256_cvtpd_ps(last), _mm256_cvtpd_ps(first));
}

/// What a function of BoundedBatch makes of both halves of a type that is eight floats wide.
template <class Eight, class Function, class... Others>
Eight by_halves(const Function& f, const Eight& x, const Others&... others) {
  return Eight(f(x.bounds(0), others.bounds(0)...), f(x.bounds(1), others.bounds(1)...));
}

}  // namespace sheen::number
