#!/usr/bin/env bash
# Installs what is missing, builds, and turns an airfoil a full revolution and back in a mesh whose far field
# stands still. Leaves the results in demo/.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_packages.sh
cmake --preset release
cmake --build --preset release --target kinemesh_cli

scenario=examples/scenarios/airfoil-revolution.toml
build/release/kinemesh run "$scenario" -o demo --force
build/release/kinemesh draw demo --step 50 --zoom=-1.6,-1.6,2.6,1.6 -o demo/step_50.svg
build/release/kinemesh report demo
