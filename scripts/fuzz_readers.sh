#!/usr/bin/env bash
# Feeds the readers of mesh files broken input, under the address and undefined-behaviour sanitizers.
#   scripts/fuzz_readers.sh [EXECUTIONS [SEED]]    of each reader, a million by default; seed 0 is a new one
# What a reader stumbles over is left in build/fuzz/findings; the corpus that grew, in build/fuzz/corpus.
set -euo pipefail
cd "$(dirname "$0")/.."
executions=${1:-1000000}
seed=${2:-0}

scripts/install_packages.sh
cmake --preset fuzz
cmake --build --preset fuzz --target fuzz_readers

findings=build/fuzz/findings
mkdir -p "$findings"
for format in off obj ply su2 gmsh vtu; do
  grown=build/fuzz/corpus/$format log=build/fuzz/$format.log
  mkdir -p "$grown"
  echo "fuzzing the reader of $format: $executions executions"
  "build/fuzz/tests/fuzz/fuzz_$format" "$grown" "tests/fuzz/corpus/$format" -dict="tests/fuzz/$format.dict" \
    -runs="$executions" -seed="$seed" -max_len=4096 -timeout=20 -artifact_prefix="$findings/$format-" \
    > "$log" 2>&1 || { cat "$log"; exit 1; }
done
