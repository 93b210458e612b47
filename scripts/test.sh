#!/usr/bin/env bash
# Installs what is missing, builds, fuzzes the readers and the repair for a moment, and runs all tests.
# Arguments go to ctest instead of the fuzzing: scripts/test.sh -R untangle
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_packages.sh
cmake --preset dev
cmake --build --preset dev
if (($# == 0)); then
  scripts/fuzz_readers.sh 20000 1
  scripts/fuzz_untangle.sh 20000 1
fi
ctest --preset dev --parallel "$(nproc)" "$@"
