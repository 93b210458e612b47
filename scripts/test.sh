#!/usr/bin/env bash
# Installs what is missing, builds, fuzzes the readers for a moment, and runs all tests. Arguments go to ctest instead of
# the fuzzing: scripts/test.sh -R untangle
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_packages.sh
cmake --preset dev
cmake --build --preset dev
(($# > 0)) || scripts/fuzz_readers.sh 20000 1
ctest --preset dev --parallel "$(nproc)" "$@"
