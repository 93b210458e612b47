#!/usr/bin/env bash
# Installs what is missing, builds, and runs all tests. Arguments go to ctest: scripts/test.sh -R untangle
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/install_packages.sh
cmake --preset dev
cmake --build --preset dev
ctest --preset dev --parallel "$(nproc)" "$@"
