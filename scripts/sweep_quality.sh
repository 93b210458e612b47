#!/usr/bin/env bash
# `quality = "delaunay"` for longer than the tests: a rotor against a full re-mesh, and random scenarios
# against CGAL, at every step.
#   scripts/sweep_quality.sh [STEPS [SCENARIOS]]    1000 and 1000 unless said otherwise
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_packages.sh
cmake --preset dev
cmake --build --preset dev --target test_sim
KINEMESH_ROTOR_STEPS="${1:-1000}" KINEMESH_RANDOM_SCENARIOS="${2:-1000}" build/dev/tests/sim/test_sim \
  --gtest_filter='DelaunaySteps.KeepTheAnglesOfAFullRemesh:DelaunaySteps.AreDelaunayInRandomScenarios' \
  --gtest_output=xml:build/dev/sweep_quality.xml
grep -o '<property [^/]*' build/dev/sweep_quality.xml
