#!/usr/bin/env bash
# Kills runs at random moments, goes on with them, and compares what they leave with an undisturbed run.
#   scripts/kill_and_resume.sh [KILLS]    100 unless said otherwise
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_packages.sh
cmake --preset dev
cmake --build --preset dev --target test_cli
KINEMESH_KILLS="${1:-100}" build/dev/tests/sim/cli/test_cli --gtest_filter='Kill.*'
