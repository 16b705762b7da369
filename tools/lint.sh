#!/usr/bin/env bash
# clang-format and clang-tidy over our own sources; any complaint is an error. With file names: over those alone, each by itself, so that
# a missing include shows; else as they are built, several as one.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

tools/setup.sh --lint
preset=release
[ $# -eq 0 ] || preset=debug
build=build/$preset
[ -f $build/compile_commands.json ] || cmake --preset $preset > /dev/null
# Generated headers must be there before a source that includes them is read.
cmake --build $build --target sheen_glad > /dev/null

if [ $# -gt 0 ]; then
  files=("$@")
else
  mapfile -t files < <(git ls-files --cached --others --exclude-standard -- 'src/*.cpp' 'src/*.h' 'conformance/*.cpp' 'conformance/*.h' \
                         'tools/*.cpp' 'tools/*.h')
fi
clang-format --dry-run -Werror "${files[@]}"
echo "clang-format: ${#files[@]} files are as they should be"

# Each source, or the one that CMake wrote to include it.
listed=$(python3 - $build "$PWD" "${files[@]}" <<'PYTHON'
import json
import os
import re
import sys

build, root = sys.argv[1:3]
files = [os.path.relpath(file, root) for file in sys.argv[3:]]
unit_of = {}
for command in json.load(open(f"{build}/compile_commands.json")):
    unit = command["file"]
    joined = re.findall(r'#include "(.*)"', open(unit).read()) if "/Unity/" in unit else []
    for source in joined or [unit]:
        unit_of.setdefault(source, unit)

units = []
for file in files:
    # Without names tests are left out, and held to the compiler's warnings alone: GoogleTest's macros make most of what clang-tidy would
    # say and of the time it takes.
    if not file.endswith(".cpp") or build.endswith("release") and file.endswith("_test.cpp"):
        continue
    # A source that the build does not know is an error too: nothing would check it.
    if f"{root}/{file}" not in unit_of:
        sys.exit(f"lint: in no target: {file}")
    units.append(unit_of[f"{root}/{file}"])
print(*dict.fromkeys(units), sep="\n")
PYTHON
)
mapfile -t units < <(printf '%s' "${listed:+$listed$'\n'}")
[ ${#units[@]} -eq 0 ] || printf '%s\0' "${units[@]}" | xargs -0 -n 1 -P "$(nproc)" clang-tidy -p $build --quiet --extra-arg=-Wno-unknown-warning-option
echo "clang-tidy: ${#units[@]} units without a warning"
