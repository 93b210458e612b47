#!/usr/bin/env bash
# Two long runs, a turning disc and Brownian motion: every mesh validated, and both once more, killed again
# and again and gone on with, to the same files.
#   scripts/endurance.sh [STEPS [VERTICES [KILLS]]]    5000, 20000, 20 unless said otherwise
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_packages.sh
cmake --preset release
cmake --build --preset release --target endurance
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# scenario NAME: what moves is read from the standard input
scenario() {
  {
    printf '[mesh]\nshape = "square"\n[[motion]]\n'
    cat
    printf '[time]\ndt = 0.01\nsteps = 1\n[repair]\nquality = "delaunay"\n'
  } > "$folder/$1.toml"
}

scenario rotor <<TOML
field = "rotor"
center = [0.5, 0.5]
radius = 0.3
rate = 6.283185307179586
TOML
scenario brownian <<TOML
field = "brownian"
diffusion = 2e-5
TOML
for name in rotor brownian; do
  echo "$name"
  build/release/tests/sim/endurance "$folder/$name.toml" "${2:-20000}" "${1:-5000}" "${3:-20}" "$folder/$name"
done
