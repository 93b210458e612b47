"""Reads a run's series with VTK's own reader, where python3-vtk9 is here."""

import sys
import tempfile
import unittest
import xml.etree.ElementTree as xml
from pathlib import Path

from runs import run_rotor

try:
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
except ImportError:
    print("skipped: python3-vtk9 is not here")
    sys.exit(77)


def read(path):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    assert reader.GetErrorCode() == 0
    return reader.GetOutput()


def values(data, name):
    array = data.GetArray(name)
    return [array.GetTuple(i) for i in range(array.GetNumberOfTuples())]


class Series(unittest.TestCase):
    def test_vtk_reads_what_paraview_shows(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = Path(folder)
            run_rotor(folder, "out", "output.every=1")
            sets = xml.parse(folder / "out/mesh.pvd").getroot().findall(".//DataSet")
            self.assertEqual([float(s.get("timestep")) for s in sets], [n * 0.02 for n in range(13)])
            rows = (folder / "out/regions.csv").read_text().split("\n")[1:-1]
            first = before = None
            n_replaced = 0
            for n, entry in enumerate(sets):
                grid = read(folder / "out" / entry.get("file"))
                self.assertAlmostEqual(grid.GetFieldData().GetArray("TimeValue").GetValue(0), n * 0.02)
                points = [grid.GetPoint(v) for v in range(grid.GetNumberOfPoints())]
                first = first or points
                cells = [tuple(grid.GetCell(f).GetPointId(k) for k in range(3))
                         for f in range(grid.GetNumberOfCells())]
                cell_data = grid.GetCellData()
                replaced = [v for v, in values(cell_data, "replaced")]
                regions = [v for v, in values(cell_data, "region")]
                self.assertEqual(set(values(cell_data, "label")), {(0.0,)})
                for p, q, d in zip(points, first, values(grid.GetPointData(), "displacement")):
                    self.assertEqual(tuple(a - b for a, b in zip(p, q)), d)
                for f, corners in enumerate(cells):
                    if before and corners != before[f]:
                        self.assertEqual(replaced[f], 1)
                    self.assertEqual(regions[f] >= 0, replaced[f] == 1)
                n_regions = sum(row.split(",")[0] == str(n) for row in rows)
                self.assertLess(max(regions), max(n_regions, 1))
                n_replaced += sum(replaced)
                before = cells
            self.assertGreater(n_replaced, 50)


if __name__ == "__main__":
    unittest.main(verbosity=2)
