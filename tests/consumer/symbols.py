"""symbols.py LIBRARY HEADER: the shared library shows what is declared for others, and nothing else."""

import re
import subprocess
import sys

library, header = sys.argv[1:]
listed = subprocess.run(["nm", "-D", "--defined-only", "-C", library], capture_output=True, text=True,
                        check=True)
shown = [line.split(maxsplit=2)[2] for line in listed.stdout.splitlines()]

with open(header, encoding="utf-8") as text:
    declared = set(re.findall(r"KINEMESH_API\s[^;(]*?\b(kinemesh_\w+)\(", text.read()))
functions = {name for name in shown if re.fullmatch(r"kinemesh_\w+", name)}
assert len(declared) > 30 and functions == declared, functions ^ declared

OF_OURS = re.compile(r"(typeinfo (name )?for |vtable for |guard variable for )?kinemesh::|\S.* kinemesh::|"
                     r"kinemesh_\w+$")
strange = [name for name in shown if not OF_OURS.match(name)]
assert not strange, strange
for name in ("kinemesh::build_mesh(", "kinemesh::Stepper::step(", "kinemesh::check_mesh(", "kinemesh::run("):
    assert any(name in symbol for symbol in shown), name

# Rooms' own classes stay inside.
for name in ("RegionMesher", "GlobalWalk", "FaceSets", "ChangeTracker", "Following", "TwoLevel", "Scanner"):
    inside = [symbol for symbol in shown if symbol.startswith(f"kinemesh::{name}::")]
    assert not inside, inside
