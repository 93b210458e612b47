#!/usr/bin/env bash
# clang-tidy over all sources of the library and the program, by .clang-tidy; exit code 1 if it says anything.
# Arguments: the files instead. Takes half an hour on two cores: beside the tests, not one of them.
set -euo pipefail
cd "$(dirname "$0")/.."

command -v clang-tidy >/dev/null || { echo "clang-tidy is missing: Debian's package clang-tidy" >&2; exit 1; }
cmake --preset dev >/dev/null
if (($# > 0)); then
  files=("$@")
else
  mapfile -t files < <(find core motion untangle sim c -name '*.cpp' | sort)
fi
# GCC's own flags mean nothing to clang.
printf '%s\n' "${files[@]}" |
  xargs -P "$(nproc)" -n 1 clang-tidy -p build/dev --quiet \
    --extra-arg=-Wno-unknown-warning-option --extra-arg=-Wno-ignored-optimization-argument
