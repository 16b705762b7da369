#!/usr/bin/env bash
# clang-format and clang-tidy over our own sources; any complaint is an error. With file names: over those alone.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

tools/setup.sh --lint
[ -f build/release/compile_commands.json ] || cmake --preset release
# Generated headers must be there before a source that includes them is read.
cmake --build --preset release --target sheen_glad > /dev/null

if [ $# -gt 0 ]; then
  files=("$@")
else
  mapfile -t files < <(git ls-files --cached --others --exclude-standard -- 'src/*.cpp' 'src/*.h' 'conformance/*.cpp' 'conformance/*.h' \
                         'tools/*.cpp' 'tools/*.h')
fi
clang-format --dry-run -Werror "${files[@]}"
echo "clang-format: ${#files[@]} files are as they should be"

sources=()
for file in "${files[@]}"; do
  # Tests are held to the compiler's warnings alone: GoogleTest's macros make most of what clang-tidy would say and of the time it takes.
  if [[ $file == *.cpp && ($file != *_test.cpp || $# -gt 0) ]]; then sources+=("$file"); fi
done
# A source that the build does not know is an error too: nothing would check it.
for source in "${sources[@]}"; do
  grep -qF "$PWD/$source" build/release/compile_commands.json || { echo "lint: in no target: $source" >&2; exit 1; }
done
printf '%s\0' "${sources[@]}" | xargs -0 -n 1 -P "$(nproc)" clang-tidy -p build/release --quiet
echo "clang-tidy: ${#sources[@]} files without a warning"
