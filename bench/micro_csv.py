"""What Google Benchmark has written as JSON, as CSV: micro_csv.py RESULTS.json. Its own CSV cannot hold
differing counters."""

import csv
import json
import sys

COLUMNS = ["name", "iterations", "real_time", "cpu_time", "time_unit", "items_per_second", "bytes_per_second",
           "error_message"]

with open(sys.argv[1], encoding="utf-8") as file:
    rows = json.load(file)["benchmarks"]
writer = csv.DictWriter(sys.stdout, COLUMNS, extrasaction="ignore", lineterminator="\n")
writer.writeheader()
writer.writerows(rows)
