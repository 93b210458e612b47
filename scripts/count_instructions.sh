#!/usr/bin/env bash
# Counts the instructions of the key loops anew, for the test `instructions`: bench/results/instructions.csv.
set -euo pipefail
cd "$(dirname "$0")/.."
cmake --preset dev
cmake --build --preset dev --target key_loops update_instructions
git diff --stat bench/results/instructions.csv
