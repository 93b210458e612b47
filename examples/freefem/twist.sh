#!/usr/bin/env bash
# FreeFEM's movemesh stops with reversed triangles; kinemesh takes the step from the same mesh; FreeFEM goes
# on.
#   twist.sh FREEFEM KINEMESH FOLDER   e.g. twist.sh FreeFem++ build/release/kinemesh /tmp/twist
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
freefem=$(command -v "$1")
kinemesh=$(realpath "$2")
mkdir -p "$3"
cd "$3"

"$freefem" -nw -v 1 "$here/before.edp"
cp "$here/twist.toml" .
"$kinemesh" run twist.toml -o twisted --force
cp twisted/final.su2 twisted.su2
"$freefem" -nw -v 1 "$here/after.edp"
