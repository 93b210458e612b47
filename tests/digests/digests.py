#!/usr/bin/env python3
"""What the shipped scenarios come to, byte for byte: each with each strategy and quality, on one thread and
on two.

    digests.py PROGRAM              compares with digests.csv; exit code 1 where something differs
    digests.py --update PROGRAM     writes digests.csv anew

A digest is of steps.csv and regions.csv without the times that clocks tell, of the last mesh, and of how the
run ended.
Whoever changes one on purpose says in CHANGELOG.md what has become different, and why.
"""

import concurrent.futures
import csv
import hashlib
import itertools
import os
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
TABLE = HERE / "digests.csv"
FOLDERS = ("examples/scenarios", "examples/gallery", "bench/scenarios")
STRATEGIES = ("global", "local", "remesh", "kinetic", "auto", "flips", "optimize")
QUALITIES = ("none", "delaunay", "smooth", "angles")
VERTICES, STEPS = 500, 6

# The C library and the linear algebra choose among functions by the processor they run on; these exist on
# all.
sys.path.insert(0, str(HERE.parent))
from same_everywhere import SAME_EVERYWHERE  # noqa: E402

ENVIRONMENT = dict(os.environ, GLIBC_TUNABLES=SAME_EVERYWHERE, OPENBLAS_CORETYPE="Prescott")


def scenarios():
    return sorted(path for folder in FOLDERS for path in (ROOT / folder).glob("*.toml"))


def cases():
    """A wanted angle has a meaning with one quality only."""
    for scenario in scenarios():
        wants_angle = "angle" in tomllib.loads(scenario.read_text()).get("repair", {})
        yield from itertools.product([scenario], STRATEGIES, ["angles"] if wants_angle else QUALITIES)


def overrides(scenario):
    """A small mesh and a few steps of it, as long as its own."""
    told = tomllib.loads(scenario.read_text())
    time = told["time"]
    if "vertices" in told["mesh"]:
        yield f"mesh.vertices={VERTICES}"
    if "steps" in time:
        yield f"time.steps={min(time['steps'], STEPS)}"
    else:
        yield f"time.end={min(time['end'], STEPS * time['dt'])}"
    yield "output.every=0"


def without_times(table):
    """The columns that do not end in _ms."""
    rows = list(csv.reader(table.read_text().splitlines()))
    kept = [i for i, name in enumerate(rows[0]) if not name.endswith("_ms")]
    return "\n".join(",".join(row[i] for i in kept if i < len(row)) for row in rows)


def digest(program, scenario, strategy, quality, threads):
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "run"
        told = (*overrides(scenario), f"repair.strategy={strategy}", f"repair.quality={quality}")
        done = subprocess.run([program, "run", scenario, "-o", out, "-q", "--threads", str(threads),
                               *(word for change in told for word in ("--set", change))],
                              env=ENVIRONMENT, cwd=folder, capture_output=True, text=True,
                              check=False)  # fmt: skip
        if done.returncode not in (0, 1):
            sys.exit(f"{scenario}: {done.stderr}")
        whole = hashlib.sha256(str(done.returncode).encode())
        for name in ("steps.csv", "regions.csv"):
            whole.update(without_times(out / name).encode())
        for mesh in sorted(out.glob("final.*")):
            whole.update(mesh.read_bytes())
    return whole.hexdigest()[:16]


def case(program, scenario, strategy, quality):
    one, two = (digest(program, scenario, strategy, quality, threads) for threads in (1, 2))
    name = str(scenario.relative_to(ROOT).with_suffix(""))
    return (name, strategy, quality), one, two


def main(arguments):
    update = arguments[:1] == ["--update"]
    program = Path(arguments[-1]).resolve()
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        done = list(pool.map(lambda c: case(program, *c), cases()))
    if not done:
        sys.exit("no scenarios found")
    wrong = [f"{' '.join(key)}: one thread and two differ" for key, one, two in done if one != two]
    if update and not wrong:
        with TABLE.open("w", newline="") as file:
            csv.writer(file, lineterminator="\n").writerows(
                [("scenario", "strategy", "quality", "digest"), *((*key, one) for key, one, _ in done)])
    known = {tuple(row[:3]): row[3] for row in csv.reader(TABLE.read_text().splitlines()[1:])}
    found = {key: one for key, one, _ in done}
    wrong += [f"{' '.join(key)}: {known.get(key, 'unknown')} has become {found.get(key, 'nothing')}"
              for key in sorted(known.keys() | found.keys()) if known.get(key) != found.get(key)]
    print("\n".join(wrong) or f"{2 * len(done)} runs as ever")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
