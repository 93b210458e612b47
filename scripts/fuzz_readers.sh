#!/bin/sh
# Fuzzes every reader of mesh files, under the address and undefined-behaviour sanitizers.
#   scripts/fuzz_readers.sh [executions per reader, default 1000000]
# Fails on the first finding; the input that made it is kept in build/fuzz/findings.
set -eu
cd "$(dirname "$0")/.."
runs=${1:-1000000}

cmake --preset fuzz
cmake --build --preset fuzz --target fuzz_readers
mkdir -p build/fuzz/findings
for format in off obj ply su2 gmsh vtu; do
  corpus=build/fuzz/corpus/$format
  mkdir -p "$corpus"
  echo "== $format: $runs executions"
  build/fuzz/tests/fuzz/fuzz_$format -runs="$runs" -max_len=4096 -timeout=10 -rss_limit_mb=1024 -seed=1 -close_fd_mask=1 \
    -verbosity=0 -print_final_stats=1 -artifact_prefix="build/fuzz/findings/$format-" \
    -dict="tests/fuzz/$format.dict" "$corpus" "tests/fuzz/corpus/$format"
done
echo "no findings"
