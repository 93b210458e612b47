"""Runs a scenario and looks at the smallest angle of each step.

check.py PROGRAM SCENARIO OUT ANGLE [ARGUMENTS OF run]
"""

import csv
import subprocess
import sys
from pathlib import Path

program, scenario, out, angle, *arguments = sys.argv[1:]
subprocess.run([program, "run", scenario, "-o", out, "--force", "-q", *arguments], check=True)
with open(Path(out) / "steps.csv", encoding="utf-8") as file:
    smallest = min(float(step["min_angle_deg"]) for step in csv.DictReader(file))
print(f"smallest angle {smallest:.3f} degrees")
sys.exit(0 if smallest >= float(angle) else 1)
