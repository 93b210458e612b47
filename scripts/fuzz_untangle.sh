#!/usr/bin/env bash
# Moves small meshes as random bytes say and repairs them, globally and seed by seed, under the address and
# undefined-behaviour sanitizers.
#   scripts/fuzz_untangle.sh [EXECUTIONS [SEED]]    of each, a million unless said otherwise; seed 0 is a new one
# A finding is left in build/fuzz/findings; the corpus that grew, in build/fuzz/corpus.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_packages.sh
cmake --preset fuzz
cmake --build --preset fuzz --target fuzz_untangle fuzz_in_turn
for target in untangle in_turn; do
  mkdir -p "build/fuzz/corpus/$target" build/fuzz/findings
  "build/fuzz/tests/untangle/fuzz/fuzz_$target" "build/fuzz/corpus/$target" -runs="${1:-1000000}" -seed="${2:-0}" \
    -max_len=256 -timeout=20 -artifact_prefix="build/fuzz/findings/$target-" -verbosity=0
done
