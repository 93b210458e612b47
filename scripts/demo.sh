#!/usr/bin/env bash
# Installs what is missing, builds, and turns an airfoil a full revolution and back in a mesh whose far field stands
# still. Leaves the results in demo/.
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_packages.sh
cmake --preset release
cmake --build --preset release --target kinemesh_cli

build/release/kinemesh run examples/scenarios/airfoil-revolution.toml -o demo --force
