#!/usr/bin/env bash
# Installs the Debian 12 packages that building and running need and this machine lacks. With --sanitize also those of tools/sanitize.sh,
# with --lint those of tools/lint.sh, with --drivers those of tools/drivers.sh.
set -euo pipefail

packages=(
  cmake ninja-build g++ pkg-config
  python3-glad                                         # generates the GL loader at build time
  libglm-dev libtinygltf-dev nlohmann-json3-dev libxxhash-dev
  libspng-dev libturbojpeg0-dev libopenexr-dev libstb-dev
  libopenimageio-dev libembree-dev libtbb-dev libxsimd-dev
  libcli11-dev libfmt-dev
  libgtest-dev libgmock-dev libbenchmark-dev
  libosmesa6 libegl1 libegl-mesa0 libgl1-mesa-dri      # opened at run time, never linked
)
for argument in "$@"; do
  case $argument in
    --sanitize) packages+=(clang libclang-rt-dev llvm) ;;    # the sanitizers' runtime; llvm-symbolizer, which names what a suppression is of
    --lint) packages+=(clang-format clang-tidy git python3) ;;
    --drivers) packages+=(mesa-vulkan-drivers libvulkan1) ;;  # lavapipe, below zink
    *) echo "usage: tools/setup.sh [--sanitize] [--lint] [--drivers]" >&2; exit 2 ;;
  esac
done

if ! command -v dpkg-query > /dev/null; then
  echo "setup: no dpkg here; install what these Debian packages hold: ${packages[*]}" >&2
  exit 4
fi

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f '${db:Status-Status} ' "$package" 2> /dev/null || true)
  [[ " $status" == *" installed "* ]] || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo > /dev/null; then
    echo "setup: run as root: apt-get install ${missing[*]}" >&2
    exit 4
  fi
  as_root=(sudo)
fi
echo "setup: installing ${missing[*]}"
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update -q
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${missing[@]}"
