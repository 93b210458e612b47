"""The C interface from Python: ctypes and any buffer of doubles; nothing but Python's own library, numpy
where it is."""

import ctypes
import math
import random
import unittest
from array import array
from concurrent.futures import ThreadPoolExecutor
from ctypes import c_double, c_int32, c_void_p

from interface import (BAD_INPUT, LIBRARY, NO_VALID_MESH, OBSERVER, STUCK, VETOED, Interface, Step, address,
                       grid)

try:
    import numpy
except ImportError:
    numpy = None


class Steps(Interface):
    def test_steps_and_observers(self):
        n, source = 10, random.Random(3)
        points, triangles = grid(n)
        stepper = self.stepper(points, triangles)
        told, wrong = array("i", triangles), []  # what a callback raises is lost

        def observe(changes, _):
            for p in range(changes.contents.n_patches):
                patch = changes.contents.patches[p].contents
                before, after = patch.before, patch.after
                wrong.extend(before.faces[i] for i in range(before.n)
                             if list(told[3 * before.faces[i]:3 * before.faces[i] + 3])
                             != before.triangles[3 * i:3 * i + 3])
                for i in range(after.n):
                    face = after.faces[i]
                    told[3 * face:3 * face + 3] = array("i", after.triangles[3 * i:3 * i + 3])
            return 0

        observer = OBSERVER(observe)  # has to live as long as the stepper
        self.call("stepper_observe", stepper, observer, None)
        replaced, record = 0, Step()
        for step in range(1, 9):
            points = self.shaken(points, n, source)
            self.call("stepper_step", stepper, address(points, c_double), c_double(0.5), ctypes.byref(record))
            self.assertEqual((record.step, record.time, record.faces), (step, step / 2, 2 * n * n))
            replaced += record.replaced
            self.assertEqual(wrong, [])
            self.assertEqual(self.faces(stepper), told)
            self.assertTrue(math.isclose(self.area(points, told), 1.0))
        self.assertGreater(replaced, 500)

    def test_veto_and_failure_change_nothing(self):
        points, triangles = grid(4)
        stepper = self.stepper(points, triangles)
        veto = OBSERVER(lambda changes, _: 1)
        self.call("stepper_observe", stepper, veto, None)
        moved = self.shaken(points, 4, random.Random(1))
        step = LIBRARY.kinemesh_stepper_step
        self.assertEqual(step(stepper, address(moved, c_double), c_double(1), None), VETOED)
        moved[24:26] = moved[22:24]  # vertex 12 onto 11
        self.assertEqual(step(stepper, address(moved, c_double), c_double(1), None), NO_VALID_MESH)
        self.assertIn(b"11", LIBRARY.kinemesh_error())
        self.assertEqual(step(stepper, address(moved, c_double), c_double(-1), None), BAD_INPUT)
        moved[24] = math.nan
        self.assertEqual(step(stepper, address(moved, c_double), c_double(1), None), BAD_INPUT)
        self.assertEqual(self.faces(stepper), triangles)

    def test_stuck_is_not_impossible(self):
        """A triangle turned inside out, its sides to be kept: no edge may flip, but there is a mesh."""
        xy = array("d", (0, 0, 3, 0, 3, 3, 0, 3, 1, 1, 2, 1, 1.5, 0.5))
        triangles = array("i", (4, 5, 6, 0, 1, 5, 0, 5, 4, 1, 2, 5, 2, 6, 5, 2, 3, 6, 3, 0, 4, 3, 4, 6))
        mesh, lines = self.mesh(xy, triangles), array("i", (4, 5, 5, 6, 6, 4))
        self.call("mesh_add_marker", mesh, b"line", 3, address(lines, c_int32))
        self.assertEqual(LIBRARY.kinemesh_mesh_untangle(mesh, b"flips"), STUCK)
        self.call("mesh_untangle", mesh, b"global")

    def test_positions_in_place(self):
        points, triangles = grid(4)
        stepper = self.stepper(points, triangles)
        own = LIBRARY.kinemesh_stepper_positions(stepper)
        all_of_it = (c_double * len(points)).from_address(ctypes.addressof(own.contents))
        view = memoryview(all_of_it).cast("B").cast("d")
        view[24], view[25] = 0.8, 0.55  # vertex 12, through a neighbour's edges
        self.call("stepper_repair", stepper, c_double(0.0), None)
        self.assertTrue(math.isclose(self.area(list(view), self.faces(stepper)), 1.0))
        self.assertNotEqual(self.faces(stepper), triangles)

    def piston(self):
        """A square whose right side pushes in and pulls back; the lower and the upper one slide."""
        n = 8
        points, triangles = grid(n)
        mesh, stepper = self.mesh(points, triangles), c_void_p()
        sides = {b"bottom": range(n + 1), b"right": range(n, (n + 1) ** 2, n + 1),
                 b"top": range(n * (n + 1), (n + 1) ** 2)}
        for name, side in sides.items():
            edges = array("i", (v for edge in zip(side, side[1:]) for v in edge))
            self.call("mesh_add_marker", mesh, name, len(side) - 1, address(edges, c_int32))
        scenario = b"""
            [[body]]
            on = "marker:right"
            motion = [{ field = "rigid", x = "-0.8 * sin(t)" }]
            [border]
            bottom = "slide"
            top = "slide"
            """
        self.call("stepper_create_scenario", mesh, scenario, c_double(0.25), ctypes.byref(stepper))
        self.addCleanup(LIBRARY.kinemesh_stepper_destroy, stepper)
        return stepper

    def advance(self, stepper, steps):
        """Every step's positions."""
        seen, record, xy = [], Step(), array("d", bytes(16 * LIBRARY.kinemesh_stepper_n_vertices(stepper)))
        for _ in range(steps):
            self.call("stepper_advance", stepper, c_double(0.1), ctypes.byref(record))
            self.call("stepper_get", stepper, address(xy, c_double), None, None)
            seen.append((record.time, array("d", xy)))
        return seen

    def test_bodies(self):
        stepper = self.piston()
        for time, xy in self.advance(stepper, 15):
            side = 1.0 - 0.8 * math.sin(time)
            self.assertTrue(all(math.isclose(xy[2 * v], side, abs_tol=1e-15) for v in range(8, 81, 9)))
            self.assertEqual({xy[2 * v + 1] for v in range(9)}, {0.0})
        self.assertTrue(math.isclose(self.area(xy, self.faces(stepper)), side))

    def test_bodies_in_threads(self):
        alone = self.advance(self.piston(), 10)
        with ThreadPoolExecutor(4) as pool:
            steppers = [self.piston() for _ in range(4)]
            for seen in pool.map(lambda stepper: self.advance(stepper, 10), steppers):
                self.assertEqual(seen, alone)

    @unittest.skipUnless(numpy, "numpy is not here")
    def test_numpy(self):
        points, triangles = grid(6)
        stepper = self.stepper(numpy.array(points), numpy.array(triangles, dtype=numpy.int32))
        own = numpy.ctypeslib.as_array(LIBRARY.kinemesh_stepper_positions(stepper), shape=(49, 2))
        self.assertTrue((own == numpy.array(points).reshape(-1, 2)).all())
        own[24] = (0.9, 0.55)
        self.call("stepper_repair", stepper, c_double(0.0), None)
        self.assertTrue(math.isclose(self.area(list(own.flat), self.faces(stepper)), 1.0))


if __name__ == "__main__":
    unittest.main()
