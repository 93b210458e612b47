"""The page of results: results_page.py RESULTS IMAGES PAGE.md, from what bench/run_all.sh has left in the two
folders."""

import csv
import os
import platform
import subprocess
import sys
from pathlib import Path

# In the order of the table.
SUBJECTS = ("steps detection regions fixed-tangle explored local-growth threads interior angles memory huge "
            "file").split()


def machine():
    cpu = next(
        (line.split(":")[1].strip()
         for line in Path("/proc/cpuinfo").read_text().splitlines() if "model name" in line),
        platform.machine(),
    )
    memory = int(Path("/proc/meminfo").read_text().split()[1]) / 2**20
    told = subprocess.run(["g++", "--version"], capture_output=True, text=True, check=False).stdout
    compiler = told.split("\n")[0]
    return f"{cpu}, {os.cpu_count()} cores, {memory:.0f} GiB; {compiler}"


def cell(text):
    return text.replace("|", "\\|")


def aims(results):
    yield "## Aims\n"
    yield "| what | aim | measured | | made of | command |"
    yield "|---|---|---|---|---|---|"
    for subject in SUBJECTS:
        path = results / "aims" / f"{subject}.csv"
        if not path.exists():
            continue
        with path.open() as file:
            for row in csv.DictReader(file):
                aim = f"{row['kind']} {row['aim']}"
                met = "met" if row["met"] == "met" else "**missed**"
                cells = [row["what"], aim, row["measured"], met, row["detail"], f"`{row['command']}`"]
                yield "| " + " | ".join(map(cell, cells)) + " |"
    yield ""


def tables(results, images, page):
    yield "## Strategies, regime by regime\n"
    for path in sorted(results.glob("*.txt")):
        command, _, table = path.read_text().partition("\n")
        yield f"### {path.stem}\n\n`{command}`\n\n```\n{table.strip()}\n```\n"
        for image in sorted(images.glob(f"bench_{path.stem}_*.svg")):
            # bench_rotor_* are also those of rotor_others.
            if f"{path.stem}_others" in image.stem:
                continue
            yield f"![{image.stem}]({os.path.relpath(image, page.parent)})\n"


def per_item(row):
    rate = float(row["items_per_second"] or 0)
    return f"{1e9 / rate:.4g} ns" if rate else ""


def micro(results):
    path = results / "micro.csv"
    if not path.exists():
        return
    yield "## Micro-benchmarks\n"
    yield "`build/release/bench/kinemesh_bench`; an item is a face, a call or a point, as the name says.\n"
    yield "| what | time | per item |"
    yield "|---|---|---|"
    with path.open() as file:
        for row in csv.DictReader(file):
            time = row["error_message"] or f"{float(row['real_time']):.4g} {row['time_unit']}"
            yield f"| `{row['name']}` | {cell(time)} | {per_item(row)} |"
    yield ""


def main():
    results, images, page = map(Path, sys.argv[1:4])
    lines = ["# Results\n"]
    lines += ["Made by `bench/run_all.sh`; what is measured, and how: [performance.md](performance.md).\n"]
    lines += [f"Machine: {machine()}.\n"]
    lines += [*aims(results), *tables(results, images, page), *micro(results)]
    page.write_text("\n".join(lines).rstrip() + "\n")


main()
