#!/usr/bin/env bash
# Installs what is missing, builds, runs the suite "core" against our own renderer and says where the report lies.
# Arguments go to `sheen-cts run`: tools/run.sh --context egl --filter 'sheen.*'
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

tools/setup.sh
cmake --preset release
cmake --build --preset release --target sheen-cts
exec build/release/sheen-cts run --suite core --report build/report "$@"
