#!/bin/sh
# Compares the local exploration with brute force on many random tangles, and counts the rare paths:
#   scripts/sweep_local.sh [BUILD_DIR [TANGLES [FIRST_SEED]]]      default: build/dev 20000 1
# A chunk of 500 tangled meshes a process, as many processes as cores. Exit 1 if any differs; its mesh is
# left in the temporary folder as tangleSEED.off.
set -eu
build=${1:-build/dev}
tangles=${2:-20000}
first=${3:-1}
chunk=500
program=$(find "$build" -name test_local -type f | head -n 1)
[ -x "$program" ] || { echo "no test_local in $build: build it first" >&2; exit 2; }
logs=$(mktemp -d)
trap 'rm -rf "$logs"' EXIT

# Chunks are far enough apart never to share a seed.
export KINEMESH_TANGLES=$chunk
status=0
seq 0 $(((tangles + chunk - 1) / chunk - 1)) | xargs -P "$(nproc)" -I{} sh -c "
  KINEMESH_FIRST_TANGLE=\$(($first + {} * 10 * $chunk)) '$program' --gtest_filter='LocalSweep.*' \
    > '$logs/{}' 2>&1 || { grep -v '^\[' '$logs/{}' | head -n 40; exit 1; }" || status=1

cat "$logs"/* | awk '
  /^[0-9]+ / { n = $1; sub(/^[0-9]+ /, ""); if (!($0 in sum)) order[++k] = $0
               if (/largest/) { if (n > sum[$0]) sum[$0] = n } else sum[$0] += n }
  END { for (i = 1; i <= k; ++i) print sum[order[i]], order[i] }'
exit $status
