#!/usr/bin/env bash
# Makes the pictures of the documentation with the program. Pictures depend a little on the fonts of the machine. Needs
# ImageMagick (Debian's imagemagick), which nothing else here does.
# scripts/figures.sh [PRESET]
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${1:-release}

cmake --preset "$preset"
cmake --build --preset "$preset" --target kinemesh_cli example_make_tangle
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
kinemesh() { build/$preset/kinemesh "$@"; }

for kind in jitter umbilic; do
  seed=$(build/$preset/examples/example_make_tangle $kind "$work/$kind.off")
  # 1: tangles elsewhere remain.
  kinemesh untangle "$work/$kind.off" -o "$work/out.off" --strategy local --seed "$seed" --report "$work/$kind.json" ||
    (($? == 1))
  kinemesh draw "$work/$kind.off" --region "$work/$kind.json" -o "$work/local_$kind.png"
  convert "$work/local_$kind.png" -colors 64 -define png:exclude-chunks=date,time PNG8:docs/images/local_$kind.png
done

kinemesh run examples/scenarios/airfoil-revolution.toml -o "$work/airfoil" -q

for step in $(seq 4 4 100); do
  kinemesh draw "$work/airfoil" --step "$step" --zoom=-0.9,-1.1,1.9,1.1 --width 480 \
    -o "$work/frame_$(printf %03d "$step").png" >"$work/log"
done
convert -delay 12 -loop 0 "$work"/frame_*.png -resize 420x +dither -colors 12 -layers optimize docs/images/airfoil.gif
ls -l docs/images
