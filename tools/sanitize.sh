#!/usr/bin/env bash
# Builds with the address and undefined-behaviour sanitizers and runs the unit tests of the rooms that hold data and numbers, and of the GL
# objects, under them. Arguments go to ctest instead: tools/sanitize.sh -R cli
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

tools/setup.sh
cmake --preset asan
cmake --build --preset asan
export LSAN_OPTIONS="suppressions=$PWD/tools/lsan.supp:print_suppressions=0"
export UBSAN_OPTIONS="print_stacktrace=1"
[ $# -gt 0 ] || set -- -R '^(brdf|scene|image|albedo|golden|gles)\.'
exec ctest --preset asan --parallel "$(nproc)" "$@"
