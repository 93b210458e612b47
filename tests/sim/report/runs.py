"""What the tests in this folder share: the program, and a scenario whose steps tangle."""

import os
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
PROGRAM = os.environ["KINEMESH_PROGRAM"]

ROTOR = """[mesh]
shape = "square"
vertices = 600
[[motion]]
field = "rotor"
center = [0.5, 0.5]
radius = 0.3
rate = 6.0
[time]
dt = 0.02
steps = 12
[output]
every = 3
patches = true
"""


# Turns nothing over, but needs its vertices moved.
BODY = """[mesh]
shape = "annulus"
vertices = 600
seed = 2
[[body]]
on = "marker:inner"
motion = [{ field = "rigid", x = "0.2 * sin(6 * t)", angle = "9 * t" }]
[time]
dt = 0.02
steps = 12
[output]
patches = true
"""


def program(*arguments, cwd=None):
    command = [PROGRAM, *map(str, arguments)]
    return subprocess.run(command, capture_output=True, text=True, check=False, cwd=cwd)


def run_body(folder):
    return run_of(BODY, folder, "body")


def run_rotor(folder, name="rotor", *overrides):
    return run_of(ROTOR, folder, name, *overrides)


def run_of(text, folder, name, *overrides):
    """The folder of a run: its results are in folder/name."""
    scenario = folder / ("body.toml" if text is BODY else "rotor.toml")
    scenario.write_text(text)
    sets = [word for key in overrides for word in ("--set", key)]
    done = program("run", scenario, "-o", folder / name, "-q", *sets)
    assert done.returncode == 0, done.stderr
    return folder / name
