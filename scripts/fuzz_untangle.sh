#!/usr/bin/env bash
# Moves small meshes as random bytes say and repairs them, under the address and undefined-behaviour sanitizers.
#   scripts/fuzz_untangle.sh [EXECUTIONS [SEED]]    a million unless said otherwise; seed 0 is a new one
# A finding is left in build/fuzz/findings; the corpus that grew, in build/fuzz/corpus/untangle.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_packages.sh
cmake --preset fuzz
cmake --build --preset fuzz --target fuzz_untangle
mkdir -p build/fuzz/corpus/untangle build/fuzz/findings
build/fuzz/tests/untangle/fuzz/fuzz_untangle build/fuzz/corpus/untangle -runs="${1:-1000000}" -seed="${2:-0}" \
  -max_len=256 -timeout=20 -artifact_prefix=build/fuzz/findings/untangle- -verbosity=0
