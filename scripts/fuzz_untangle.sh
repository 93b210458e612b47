#!/usr/bin/env bash
# Moves small meshes as random bytes say and repairs them, globally and seed by seed, under the address and
# undefined-behaviour sanitizers.
#   scripts/fuzz_untangle.sh [EXECUTIONS [SEED]]    of each, a million by default; seed 0 is a new one
# A finding is left in build/fuzz/findings; the corpus that grew, in build/fuzz/corpus.
set -euo pipefail
cd "$(dirname "$0")/.."
executions=${1:-1000000}
seed=${2:-0}

scripts/install_packages.sh
cmake --preset fuzz
cmake --build --preset fuzz --target fuzz_untangle fuzz_in_turn
findings=build/fuzz/findings
mkdir -p "$findings"
for target in untangle in_turn; do
  grown=build/fuzz/corpus/$target log=build/fuzz/$target.log
  mkdir -p "$grown"
  echo "fuzzing the repair, $target: $executions executions"
  "build/fuzz/tests/untangle/fuzz/fuzz_$target" "$grown" -runs="$executions" -seed="$seed" \
    -max_len=256 -timeout=20 -artifact_prefix="$findings/$target-" > "$log" 2>&1 || { cat "$log"; exit 1; }
done
