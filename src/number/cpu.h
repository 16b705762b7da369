#pragma once

namespace sheen::number {

/// Whether this processor runs the translation units compiled for number::Batch (AVX2 with FMA). Elsewhere they run one double at a time:
/// SSE2 builds of the same batches are slower than scalar code.
inline bool has_batch() {
#if defined(__x86_64__) || defined(__i386__)
  return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
#else
  return false;
#endif
}

}  // namespace sheen::number
