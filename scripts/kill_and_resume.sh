#!/usr/bin/env bash
# Kills programs at random moments, starts them again, and compares what they leave with what undisturbed ones
# leave: half of the kills hit runs that are then resumed, the others all commands that write.
#   scripts/kill_and_resume.sh [KILLS]    1000 unless said otherwise
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_packages.sh
cmake --preset dev
cmake --build --preset dev --target test_cli
KINEMESH_KILLS="$((${1:-1000} / 2))" build/dev/tests/sim/cli/test_cli --gtest_filter='Kill.*'
