#!/usr/bin/env bash
# Makes every table and plot of docs/performance.md anew, in less than half an hour on a machine with two
# quiet cores: CSV and tables in bench/results, plots in docs/images, all together in
# docs/performance_results.md.
#
#   bench/run_all.sh            all but the largest mesh
#   bench/run_all.sh --huge     only the largest mesh: 5 10^7 vertices in 16 GiB, some ten minutes more
#   bench/run_all.sh --quick    small meshes, to try the script; everything goes to build/quick
#
# PRESET=dev measures another build than `release`. Goes on where a part fails, and says so in the end.
set -uo pipefail
cd "$(dirname "$0")/.."

preset=${PRESET:-release}
quick=0 huge=0
for argument in "$@"; do
  case "$argument" in
    --quick) quick=1 ;;
    --huge) huge=1 ;;
    *) echo "run_all.sh: $argument: --quick or --huge expected" >&2; exit 2 ;;
  esac
done

results=bench/results images=docs/images page=docs/performance_results.md
if ((quick)); then
  results=build/quick/results images=build/quick/images page=build/quick/performance_results.md
fi
mkdir -p "$results/aims" "$images"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=()

# aims SUBJECT VERTICES QUICK_VERTICES: rows of the table of aims.
aims() {
  local n=$2 file=$results/aims/$1.csv
  ((quick)) && n=$3
  echo "== aims: $1 $n ($(date +%T))"
  echo 'what,kind,aim,measured,met,detail,command' >"$work/aims.csv"
  if "build/$preset/bench/kinemesh_aims" "$1" "$n" >"$work/rows.csv"; then
    sed "s|$|,build/release/bench/kinemesh_aims $1 $n|" "$work/rows.csv" >>"$work/aims.csv"
    cp "$work/aims.csv" "$file"
    cat "$work/rows.csv"
  else
    failed+=("aims $1")
  fi
}

# table NAME SCENARIO ARGUMENTS...: `kinemesh bench`, its table, its CSV and its plots.
table() {
  local name=$1 scenario=bench/scenarios/$2.toml
  shift 2
  echo "== table: $name ($(date +%T))"
  if "build/$preset/kinemesh" bench "$scenario" "$@" --threads 1 -o "$work/$name" >"$work/$name.txt"; then
    echo "kinemesh bench $scenario $* --threads 1" >"$results/$name.txt"
    grep -v "$work" "$work/$name.txt" | tee -a "$results/$name.txt"
    cp "$work/$name/bench.csv" "$results/$name.csv"
    [[ -e "$work/$name/bench_bound.csv" ]] && cp "$work/$name/bench_bound.csv" "$results/${name}_bound.csv"
    for plot in sweep $([[ $name == noise ]] && echo sizes explored bound); do
      [[ -e "$work/$name/plots/$plot.svg" ]] &&
        cp "$work/$name/plots/$plot.svg" "$images/bench_${name}_$plot.svg"
    done
  else
    failed+=("table $name")
  fi
}

has_strategy() { "build/$preset/kinemesh" list | grep -Eq "^ *$1( |$)"; }

# Names out of a list that there are, with commas.
strategies() {
  local names=()
  for name in "$@"; do has_strategy "$name" && names+=("$name"); done
  local IFS=,
  echo "${names[*]}"
}

cmake --preset "$preset" -DKINEMESH_BUILD_BENCH=ON >"$work/cmake.log" || { cat "$work/cmake.log"; exit 1; }
cmake --build --preset "$preset" --target kinemesh_cli kinemesh_aims kinemesh_bench || exit 1

if ((huge)); then
  aims huge 50000000 200000
else
  aims steps 1000000 20000
  aims detection 1000000 20000
  aims regions 1000000 20000
  aims fixed-tangle 10000000 100000
  aims explored 1000000 20000
  aims local-growth 400000 20000
  aims threads 1000000 20000
  aims interior 1000000 20000
  aims angles 10000 2000
  aims memory 1000000 100000
  aims file 1000000 20000

  small=1000,10000,100000 large=1000,10000,100000,1000000 step=100000 largest=10000000
  if ((quick)); then small=1000,2000 large=1000,2000 step=2000 largest=5000; fi
  others=$(strategies kinetic flips optimize)
  for regime in swirl taylor-green rotor jitter cylinder airfoil; do
    table "$regime" "$regime" --strategies global,local,auto,remesh --sweep "mesh.vertices=$large"
    [[ -n "$others" ]] &&
      table "${regime}_others" "$regime" --strategies "global,$others,remesh" --sweep "mesh.vertices=$small"
  done
  table noise jitter --strategies global,local,auto,remesh --set "mesh.vertices=$step" --bound \
    --sweep motion.0.amplitude=0.01,0.02,0.05,0.1,0.2,0.5,1.0
  table step_size swirl --strategies global,local,auto,remesh --set "mesh.vertices=$step" \
    --sweep time.dt=0.01,0.02,0.05,0.1,0.2,0.5
  table ten_million rotor --strategies global,remesh --set "mesh.vertices=$largest" --set time.steps=2
  echo "== micro-benchmarks ($(date +%T))"
  if "build/$preset/bench/kinemesh_bench" --benchmark_min_time=$( ((quick)) && echo 0.001 || echo 0.2) \
    --benchmark_out_format=json --benchmark_out="$work/micro.json"; then
    python3 bench/micro_csv.py "$work/micro.json" >"$results/micro.csv"
  else
    failed+=("micro-benchmarks")
  fi
fi

python3 bench/results_page.py "$results" "$images" "$page" || failed+=("the page")
echo "== done ($(date +%T)): $page"
for part in "${failed[@]}"; do echo "failed: $part" >&2; done
((${#failed[@]} == 0))
