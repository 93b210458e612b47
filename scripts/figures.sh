#!/usr/bin/env bash
# Makes the pictures of the documentation with the program. Pictures depend a little on the fonts of the
# machine. Needs ImageMagick (Debian's imagemagick), which nothing else here does.
# scripts/figures.sh [PRESET]
set -euo pipefail
cd "$(dirname "$0")/.."
preset=${1:-release}

cmake --preset "$preset"
cmake --build --preset "$preset" --target kinemesh_cli example_make_tangle example_pendulum
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
kinemesh() { build/$preset/kinemesh "$@"; }
undated=(-define png:exclude-chunks=date,time)

for kind in jitter umbilic; do
  seed=$(build/$preset/examples/example_make_tangle $kind "$work/$kind.off")
  # 1: tangles elsewhere remain.
  kinemesh untangle "$work/$kind.off" -o "$work/out.off" --strategy local --seed "$seed" \
    --report "$work/$kind.json" || (($? == 1))
  kinemesh draw "$work/$kind.off" --region "$work/$kind.json" -o "$work/local_$kind.png"
  convert "$work/local_$kind.png" -colors 64 "${undated[@]}" PNG8:docs/images/local_$kind.png
done

# picture RUN STEP [ARGUMENTS OF draw]
picture() {
  kinemesh draw "$work/$1" --step "$2" "${@:3}" -o "$work/$1.png" >"$work/log"
  convert "$work/$1.png" +dither -colors 32 "${undated[@]}" PNG8:docs/images/gallery_$1.png
}

# The colours of `draw` and some between, for all frames.
convert xc:white xc:'#e6edf5' xc:'#ccd5e0' xc:'#b2becc' xc:'#97a6b8' xc:'#7d8ea3' xc:'#4d5a6b' xc:'#1d2733' \
  xc:'#ffcf5c' xc:'#cbb578' +append "$work/palette.png"

# animation RUN "STEPS" FILE [ARGUMENTS OF draw]
animation() {
  for step in $2; do
    kinemesh draw "$work/$1" --step "$step" "${@:4}" -o "$work/frame_$(printf %03d "$step").png" >"$work/log"
  done
  convert -delay 12 -loop 0 "$work"/frame_*.png +dither -remap "$work/palette.png" -layers optimize \
    "docs/images/$3"
  rm "$work"/frame_*.png
}

kinemesh run examples/scenarios/airfoil-revolution.toml -o "$work/airfoil" -q
animation airfoil "$(seq 4 4 100)" airfoil.gif --zoom=-0.9,-1.1,1.9,1.1 --width 420

for scenario in examples/gallery/*.toml; do
  kinemesh run "$scenario" -o "$work/$(basename "$scenario" .toml)" -q
done
picture foil 195 --zoom=-5.9,-1.5,-2.6,1.2
picture shuttle 463 --zoom=-0.02,-0.02,2.4,1.02
picture bubble 50 --zoom=0,-0.02,2.4,1.02
picture piston 50 --zoom=-0.02,-0.02,1.02,1.02
picture ice 60
picture valve 50 --zoom=1.0,-0.01,1.4,0.19
animation passing "$(seq 2 2 50)" gallery_passing.gif --width 420
animation tank "$(seq 2 2 50)" gallery_tank.gif --width 420
animation flap "$(seq 4 4 100)" gallery_flap.gif --width 420

# notion EXAMPLE NAME STEP TITLE "ARGUMENTS OF draw" [ARGUMENTS OF run]: of the example of that number in
# docs/scenarios.md
notion() {
  awk -v n="$1" '/^```toml/ { k++; on = (k == n); next } /^```/ { on = 0 } on' docs/scenarios.md \
    >"$work/example.toml"
  [[ $* == *'quality="none"'* ]] && sed -i '/^angle/d' "$work/example.toml"
  kinemesh run "$work/example.toml" -o "$work/example" --force -q --set output.patches=true "${@:6}"
  # shellcheck disable=SC2086
  kinemesh draw "$work/example" --step "$3" --title "$4" $5 -o "$work/notion_$2.png" >"$work/log"
}

# notions FILE NAMES...: side by side
notions() {
  local files=() name
  for name in "${@:2}"; do files+=("$work/notion_$name.png"); done
  convert "${files[@]}" +append +dither -colors 32 "${undated[@]}" "PNG8:docs/images/$1.png"
}

channel="--zoom=0.2,0,1.8,1 --width 520" small="--set mesh.vertices=700"
notion 2 body_start 0 "t = 0" "--zoom=-1.7,-0.9,1.3,0.9 --width 520"
notion 2 body 40 "t = 0.4" "--zoom=-1.7,-0.9,1.3,0.9 --width 520"
notion 1 harmonic 50 harmonic "$channel" $small
notion 1 elastic 50 elastic "$channel" $small --set 'interior.follow="elastic"'
notion 1 none 30 none "$channel" $small --set 'repair.quality="none"'
notion 1 angles 30 "angles, 25 degrees" "$channel" $small
notion 3 slide_start 0 "t = 0" "--zoom=-0.02,-0.02,1.02,1.02 --width 420" --set mesh.vertices=300
notion 3 slide 50 "t = 1" "--zoom=-0.02,-0.02,1.02,1.02 --width 420" --set mesh.vertices=300
notion 4 motion_start 0 "t = 0" "--width 420" $small
notion 4 motion 30 "t = 0.6" "--width 420" $small
notions scenario_body body_start body
notions scenario_interior harmonic elastic
notions scenario_angles none angles
notions scenario_slide slide_start slide
notions scenario_motion motion_start motion

build/$preset/examples/example_pendulum "$work/pendulum.su2"
kinemesh draw "$work/pendulum.su2" --zoom=0,-0.02,2.4,1.02 -o "$work/pendulum.png"
convert "$work/pendulum.png" +dither -colors 32 "${undated[@]}" PNG8:docs/images/gallery_pendulum.png
ls -l docs/images
