"""Reads a mesh with meshio and prints it, numbers in hexadecimal, for the tests to compare.

    read_with_meshio.py FILE                  print FILE
    read_with_meshio.py FILE OUT FORMAT [k=v] write FILE to OUT with meshio's writer FORMAT
"""
import sys

import meshio
import numpy


def print_values(kind, name, values):
    flat = numpy.asarray(values).reshape(-1)
    print(kind, name.replace(" ", "_"), len(flat), *(float(v).hex() for v in flat))


def print_mesh(mesh):
    print("points", len(mesh.points))
    for p in mesh.points:
        print(*(float(x).hex() for x in (*p, 0.0)[:3]))
    for cells in mesh.cells:
        print("cells", cells.type, len(cells.data))
        for cell in cells.data:
            print(*(int(v) for v in cell))
    for name, values in (mesh.point_data or {}).items():
        print_values("point_data", name, values)
    for name, blocks in (mesh.cell_data or {}).items():
        print_values("cell_data", name, numpy.concatenate(blocks))
    for name, values in (mesh.field_data or {}).items():
        print_values("field_data", name, values)


def value(text):
    return {"True": True, "False": False, "None": None}.get(text, text)


def main():
    mesh = meshio.read(sys.argv[1])
    if len(sys.argv) == 2:
        print_mesh(mesh)
        return
    options = {k: value(v) for k, v in (a.split("=") for a in sys.argv[4:])}
    mesh.field_data = {}
    mesh.write(sys.argv[2], file_format=sys.argv[3], **options)


main()
