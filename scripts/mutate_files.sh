#!/usr/bin/env bash
# Feeds every reader with mutants of its files that know tokens, counts and sections, under the address and
# undefined-behaviour sanitizers: none may end in anything but an error with file and line, or take much time
# or memory.
#   scripts/mutate_files.sh [MUTANTS [FORMAT [FIRST]]]    of every format, 100,000 unless said otherwise
# Mutants that do are left in build/asan/mutants.
set -euo pipefail
cd "$(dirname "$0")/.."

export ASAN_OPTIONS=detect_leaks=1:handle_abort=0:allocator_may_return_null=0:max_allocation_size_mb=4096
export LSAN_OPTIONS="suppressions=$PWD/scripts/lsan_suppressions.txt"
export UBSAN_OPTIONS=print_stacktrace=1

scripts/install_packages.sh
cmake --preset asan
cmake --build --preset asan --target mutate_files

mkdir -p build/asan/mutants
cd build/asan/mutants
../tests/fuzz/mutate_files "${1:-100000}" "${@:2}"
