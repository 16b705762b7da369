#pragma once

#include <cstdint>

#include <xsimd/xsimd.hpp>

#include "number/lanes.h"

// Four doubles at once. Only translation units compiled for AVX2 and FMA may include this; the choice between them and a scalar build of
// the same templates is made at run time by has_batch() of number/cpu.h.
#if !defined(__AVX2__) || !defined(__FMA__)
#error "number/batch.h needs -mavx2 -mfma"
#endif

namespace sheen::number {

using Batch = xsimd::batch<double, xsimd::fma3<xsimd::avx2>>;
/// Eight floats.
using FloatBatch = xsimd::batch<float, xsimd::fma3<xsimd::avx2>>;
using FloatMask = FloatBatch::batch_bool_type;
using FloatBits = xsimd::batch<std::uint32_t, FloatBatch::arch_type>;

template <>
struct Lanes<Batch> {
  static constexpr std::size_t count = Batch::size;
  static Batch load(const double* values) { return Batch::load_unaligned(values); }
  static void store(double* values, const Batch& x) { x.store_unaligned(values); }
  static double sum(const Batch& x) { return xsimd::hadd(x); }
  static Batch pick(const double* values, const std::size_t* offsets) {
    return {values[offsets[0]], values[offsets[1]], values[offsets[2]], values[offsets[3]]};
  }
};

}  // namespace sheen::number
