#!/usr/bin/env bash
# Installs what is missing, builds everything and runs every test. Arguments go to ctest: tools/test.sh -R cli
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

tools/setup.sh
# Warnings are errors in CI alone: a newer compiler must not keep a user from the program.
cmake --preset release ${CI:+-DSHEEN_CTS_WERROR=ON}
cmake --build --preset release
exec ctest --preset release --parallel "$(nproc)" "$@"
