"""Counts the instructions of the key loops and holds them against bench/results/instructions.csv.

instructions.py PROGRAM BUILD COUNTS.csv [--update]

BUILD says what the program was built by: another one than in COUNTS.csv has other counts, and is skipped.
Fails where a loop takes more than 5 % more instructions than it took; --update writes the counts of now.
glibc is told to use the same functions on every processor.
"""

import csv
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from same_everywhere import SAME_EVERYWHERE  # noqa: E402

TOLERANCE = 0.05
SKIPPED = 77


def has_avx():
    """The sweep over all faces has a loop of its own for it."""
    return re.search(r"\bavx\b", Path("/proc/cpuinfo").read_text()) is not None


def count(program):
    """{loop: instructions}"""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(
            ["valgrind", "--tool=callgrind", "--collect-atstart=no", "-q",
             f"--callgrind-out-file={folder}/out", program],
            check=True, env={"PATH": os.environ["PATH"], "GLIBC_TUNABLES": SAME_EVERYWHERE})  # fmt: skip
        counts = {}
        dumps = sorted(Path(folder).glob("out.*"), key=lambda path: int(path.suffix[1:]))
        for path in dumps:
            text = path.read_text()
            name = re.search(r"^desc: Trigger: Client Request: (.+)$", text, re.MULTILINE)
            total = re.search(r"^(?:summary|totals): (\d+)", text, re.MULTILINE)
            if name and total:
                counts[name.group(1)] = int(total.group(1))
        return counts


def read(path):
    with open(path, encoding="utf-8") as file:
        rows = list(csv.reader(file))
    return rows[0][1], {name: int(number) for name, number in rows[1:]}


def write(path, build, counts):
    with open(path, "w", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["loop", build])
        writer.writerows(counts.items())


def grown(before, now):
    """Loops that take more, or are not counted any more."""
    for name, number in before.items():
        change = now.get(name, float("inf")) / number - 1
        print(f"{name:20} {number:12} -> {now.get(name, 'not counted'):>12} {100 * change:+7.2f} %")
        if change > TOLERANCE:
            yield name


def main():
    program, build, path = sys.argv[1:4]
    build += " with AVX" if has_avx() else ""
    if sys.argv[4:] == ["--update"]:
        write(path, build, count(program))
        return 0
    of, before = read(path)
    if of != build:
        print(f"counts are known for {of}, not for {build}")
        return SKIPPED
    now = count(program)
    worse = list(grown(before, now))
    new = sorted(set(now) - set(before))
    if worse:
        print(f"more than {100 * TOLERANCE:.0f} % more instructions, or none: {', '.join(worse)}")
    if new:
        print(f"not counted before: {', '.join(new)}")
    if worse or new:
        print("if that is wanted: scripts/count_instructions.sh")
    return 1 if worse or new else 0


sys.exit(main())
