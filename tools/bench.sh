#!/usr/bin/env bash
# Builds and runs the benchmarks. Arguments go to Google Benchmark: tools/bench.sh --benchmark_filter=golden
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

tools/setup.sh
cmake --preset release
cmake --build --preset release --target sheen-cts-bench
exec build/release/sheen-cts-bench "$@"
