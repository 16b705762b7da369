#!/usr/bin/env bash
# Installs what is missing, builds everything and runs every test. Arguments go to ctest: tools/test.sh -R cli
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

tools/setup.sh
cmake --preset release
cmake --build --preset release
exec ctest --preset release --parallel "$(nproc)" "$@"
