#!/usr/bin/env bash
# Builds with the address and undefined-behaviour sanitizers and runs every test under them. Arguments go to ctest: tools/sanitize.sh -R cli
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

tools/setup.sh --sanitize
# Afresh: where a folder was built by another compiler, CMake would drop it along with the preset's settings.
cmake --fresh --preset asan
cmake --build --preset asan
export LSAN_OPTIONS="suppressions=$PWD/tools/lsan.supp:print_suppressions=0"
export UBSAN_OPTIONS="print_stacktrace=1"
exec ctest --preset asan --parallel "$(nproc)" "$@"
