#!/usr/bin/env bash
# Lets every call of a run that changes a file fail, meet a full disk, or kill the program, one after the
# other, and goes on from what is left.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_packages.sh
cmake --preset dev
cmake --build --preset dev --target test_cli
KINEMESH_ALL_FAULTS=1 build/dev/tests/sim/cli/test_cli --gtest_filter='Faults.*'
