#!/usr/bin/env bash
# Tries the properties of the repair on many seeds, longer than the tests do.
#   scripts/sweep.sh [SEEDS [FIRST]]    100,000 from 1 on unless said otherwise
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_packages.sh
cmake --preset release
cmake --build --preset release --target sweep_untangle
build/release/tests/untangle/sweep_untangle "$@"
