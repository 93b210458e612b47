#!/usr/bin/env bash
# Installs what kinemesh needs to be built, run and tested on Debian 12, and nothing else. Needs neither
# network nor rights where everything is already there.
set -euo pipefail

build=(
  g++ cmake ninja-build ccache
  libboost-dev      # R-tree
  libcgal-dev       # exact predicates, triangulations
  libcli11-dev      # command line
  libfmt-dev
  libglm-dev        # vectors
  libmuparser-dev   # formulas in scenarios
  libopenmesh-dev   # the mesh of solvers that embed it
  libpugixml-dev    # VTU
  librsvg2-dev      # figures as PNG
  libsuitesparse-dev # CHOLMOD: sparse Cholesky factorization
  libtbb-dev        # threads
  libtomlplusplus-dev
  nlohmann-json3-dev
  pkgconf           # finds librsvg
  zlib1g-dev        # compressed VTU
)
tests=(
  gnuplot-nox       # plots of benchmarks
  libbenchmark-dev
  libgmock-dev libgtest-dev
  librapidcheck-dev # properties over random cases
  python3-meshio    # reads what we write
  clang libclang-rt-14-dev  # libFuzzer
  clang-format      # .clang-format is the law
  valgrind          # counts instructions
)

is_installed() {
  [[ "$(dpkg-query --show --showformat='${db:Status-Status}' "$1" 2>/dev/null)" == installed ]]
}

missing=()
for package in "${build[@]}" "${tests[@]}"; do
  is_installed "$package" || missing+=("$package")
done
((${#missing[@]} > 0)) || exit 0

as_root=()
if ((EUID != 0)); then
  command -v sudo >/dev/null || { echo "to be installed, as root: ${missing[*]}" >&2; exit 1; }
  as_root=(sudo)
fi
echo "installing ${missing[*]}"
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install -y -qq --no-install-recommends "${missing[@]}"
