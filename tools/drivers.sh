#!/usr/bin/env bash
# Installs what is missing, builds, runs suites on Mesa's software drivers, each in processes of its own, and lays the results side by side.
#   tools/drivers.sh [--suite NAME]... [--driver NAME]... [--filter GLOB] [--case-limit SECONDS] [--report DIR] [--program FILE]
# Without --suite: core, function and extremes, as far as this build has them. With --program nothing is installed or built: that sheen-cts
# runs. Exit codes are those of sheen-cts: 0 all passed on every driver, 1 something failed, 2 usage, 4 a driver is missing.
set -euo pipefail

drivers=(llvmpipe-osmesa llvmpipe-egl softpipe zink)
suites=(core function extremes)

usage() {
  echo "usage: tools/drivers.sh [--suite NAME]... [--driver NAME]... [--filter GLOB] [--case-limit SECONDS] [--report DIR]" \
    "[--program FILE]" >&2
  echo "  suites: ${suites[*]}, or any that 'sheen-cts list --json' names; drivers: ${drivers[*]}" >&2
  exit 2
}

chosen_suites=()
chosen_drivers=()
filter='*'
# What one picture may take: softpipe interprets a shader pixel by pixel.
case_limit=600
report=
program=
while [ $# -gt 0 ]; do
  [ $# -ge 2 ] || usage
  case $1 in
    --suite) chosen_suites+=("$2") ;;
    --driver) [[ " ${drivers[*]} " == *" $2 "* ]] || usage; chosen_drivers+=("$2") ;;
    --filter) filter=$2 ;;
    --case-limit) case_limit=$2 ;;
    --report) report=$(realpath -m -- "$2") ;;
    --program) program=$(realpath -- "$2") ;;
    *) usage ;;
  esac
  shift 2
done
[ ${#chosen_drivers[@]} -gt 0 ] && drivers=("${chosen_drivers[@]}")

cd "$(dirname "${BASH_SOURCE[0]}")/.."
report=${report:-build/drivers}
if [ -z "$program" ]; then
  tools/setup.sh --drivers
  cmake --preset release
  cmake --build --preset release --target sheen-cts
  program=build/release/sheen-cts
fi

# How a driver is asked for, what its GL_RENDERER must begin with (zink's names the Vulkan driver below it), and the package it comes with.
# Mesa takes another driver without a word where the one asked for is missing.
choose() {
  context=egl
  package=libgl1-mesa-dri
  case $1 in
    llvmpipe-osmesa) context=osmesa package=libosmesa6 renderer=llvmpipe settings=(GALLIUM_DRIVER=llvmpipe) ;;
    llvmpipe-egl) renderer=llvmpipe settings=(GALLIUM_DRIVER=llvmpipe) ;;
    softpipe) renderer=softpipe settings=(GALLIUM_DRIVER=softpipe) ;;
    zink)
      package=mesa-vulkan-drivers renderer='zink (llvmpipe'
      settings=(GALLIUM_DRIVER=zink MESA_LOADER_DRIVER_OVERRIDE=zink)
      ;;
  esac
}
on_driver() { env -u MESA_LOADER_DRIVER_OVERRIDE LIBGL_ALWAYS_SOFTWARE=1 "${settings[@]}" "$@"; }
renderer_in() { sed -n 's/.*"renderer": *"\([^"]*\)".*/\1/p' "$@"; }

for driver in "${drivers[@]}"; do
  choose "$driver"
  words=$(on_driver "$program" serve --context "$context" --json 2>&1) || true
  found=$(renderer_in <<< "$words")
  if [[ $found != "$renderer"* ]]; then
    echo "drivers: $driver is missing, install its package: apt-get install $package" >&2
    echo "drivers: asked for it, the context is ${found:-not there: $words}" >&2
    exit 4
  fi
  echo "drivers: $driver is $found"
done

# The suites to run: those asked for, which must be there, or the default ones that are; of these, the ones with a case to run.
[ ${#chosen_suites[@]} -gt 0 ] && suites=("${chosen_suites[@]}")
wanted=("${suites[@]}")
suites=()
known=$("$program" list --json | tr -d ' \n' | sed 's/.*"suites":\[\([^]]*\)\].*/\1/')
for suite in "${wanted[@]}"; do
  if [[ ,$known, != *",\"$suite\","* ]]; then
    [ ${#chosen_suites[@]} -eq 0 ] && continue
    echo "drivers: unknown suite '$suite'; known: $known" >&2
    exit 2
  fi
  [ -z "$("$program" list --suite "$suite" --filter "$filter")" ] || suites+=("$suite")
done
if [ ${#suites[@]} -eq 0 ]; then
  echo "drivers: no case of ${wanted[*]} matches the filter '$filter'" >&2
  exit 2
fi

code=0
folders=()
for driver in "${drivers[@]}"; do
  choose "$driver"
  for suite in "${suites[@]}"; do
    folder=$report/$driver/$suite
    echo "drivers: $suite on $driver"
    ended=0
    on_driver "$program" run --suite "$suite" --filter "$filter" --context "$context" --case-limit "$case_limit" --strict \
      --report "$folder" || ended=$?
    # 1 is a case that failed, which the joint report shows; anything else left no results.
    [ "$ended" -le 1 ] || exit "$ended"
    [ "$ended" -eq 0 ] || code=1
    found=$(renderer_in "$folder/results.json")
    if [[ $found != "$renderer"* ]]; then
      echo "drivers: $suite was drawn by '$found', not by $driver" >&2
      exit 4
    fi
    folders+=("$driver=$folder")
  done
done

"$program" join "${folders[@]}" -o "$report" || code=$?
exit "$code"
