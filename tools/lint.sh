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
  if [[ $file == *.cpp ]]; then sources+=("$file"); fi
done
python3 tools/lint.py build/release "${sources[@]}"
echo "clang-tidy: ${#sources[@]} files without a warning"
