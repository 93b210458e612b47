"""What the C interface tells of a step, and what it makes of values of faces, against the slow and obvious
way to find out."""

import ctypes
import math
import random
import unittest
from array import array
from concurrent.futures import ThreadPoolExecutor
from ctypes import c_double, c_int32
from fractions import Fraction

from interface import (BAD_INPUT, BUSY, LIBRARY, NO_VALID_MESH, NOT_VALID, OBSERVER, OK, Defect, Interface,
                       Options, Region, Step, address, area, grid)

INVERTED_FACE, ESCAPED = 3, 10


def lower_and_upper(n):
    """Labels 1 and 2 for the halves of a grid."""
    return array("i", (1 if f < n * n else 2 for f in range(2 * n * n)))


def faces_of(listed):
    """number -> (corners, label), of a kinemesh_faces."""
    return {listed.faces[i]: (listed.triangles[3 * i:3 * i + 3], listed.labels[i]) for i in range(listed.n)}


class Patch:
    """A copy of what is gone when the observer returns."""

    def __init__(self, patch):
        self.before, self.after = faces_of(patch.before), faces_of(patch.after)
        self.vertices = patch.vertices[:patch.n_vertices]
        self.regions = patch.regions[:patch.n_regions]


class Recorded:
    """Everything an observer was shown last, and what `during` made of it."""

    def __init__(self, test, stepper, during=lambda changes: None):
        def observe(changes, _):
            shown = changes.contents
            self.changes = {name: getattr(shown, name) for name in
                            ("step", "time", "dt", "n_vertices_before", "n_vertices_after", "n_faces_before",
                             "n_faces_after")}
            self.patches = [Patch(shown.patches[p].contents) for p in range(shown.n_patches)]
            self.before = shown.xy_before[:2 * shown.n_vertices_before]
            self.after = shown.xy_after[:2 * shown.n_vertices_after]
            self.made = during(changes)
            return 0

        self.observer = OBSERVER(observe)
        test.call("stepper_observe", stepper, self.observer, None)


class Changes(Interface):
    def setUp(self):
        self.n, self.source = 8, random.Random(5)
        self.points, self.triangles = grid(self.n)
        self.labels = lower_and_upper(self.n)

    def shaken_within_halves(self):
        """Vertices of the interface between the labels stay."""
        moved = self.shaken(self.points, self.n, self.source)
        row, half = 2 * (self.n + 1), self.n // 2
        moved[half * row:(half + 1) * row] = self.points[half * row:(half + 1) * row]
        for v in range(1, len(moved), 2):
            lower = v < half * row
            moved[v] = min(moved[v], 0.49) if lower else max(moved[v], 0.51) if v > (half + 1) * row else 0.5
        moved[1:row:2] = self.points[1:row:2]
        moved[1 - row::2] = self.points[1 - row::2]
        return moved

    def step(self, stepper, moved):
        record = Step()
        self.call("stepper_step", stepper, address(moved, c_double), c_double(1), ctypes.byref(record))
        return record

    def regions(self, stepper, record):
        regions = []
        for number in range(record.regions):
            region = Region()
            self.call("stepper_get_region", stepper, number, ctypes.byref(region), None)
            faces = array("i", bytes(4 * region.n_faces))
            self.call("stepper_get_region", stepper, number, None, address(faces, c_int32) if faces else None)
            regions.append((region, list(faces)))
        return regions

    def test_structs_are_as_large_as_in_c(self):
        stepper = self.stepper(self.points, self.triangles)
        moved = self.shaken_within_halves()
        roomy = ctypes.create_string_buffer(ctypes.sizeof(Options) + 64)
        options = Options.from_buffer(roomy)
        options.size = len(roomy)
        self.assertEqual(LIBRARY.kinemesh_set_default_options(ctypes.byref(options)), OK)
        self.assertEqual(options.size, ctypes.sizeof(Options))
        for kind, fill in ((Step, lambda to: LIBRARY.kinemesh_stepper_step(
                               stepper, address(moved, c_double), c_double(1), to)),
                           (Region, lambda to: LIBRARY.kinemesh_stepper_get_region(stepper, 0, to, None))):
            beyond = b"\xa5" * 64
            roomy = ctypes.create_string_buffer(b"\xa5" * ctypes.sizeof(kind) + beyond)
            self.assertEqual(fill(ctypes.byref(kind.from_buffer(roomy))), OK)
            self.assertEqual(roomy.raw[ctypes.sizeof(kind):-1], beyond, kind)
            self.assertNotEqual(roomy.raw[ctypes.sizeof(kind) - 8:ctypes.sizeof(kind)], b"\xa5" * 8, kind)
        self.assertEqual(LIBRARY.kinemesh_culprits().contents.size, ctypes.sizeof(Defect))

    def test_names_are_those_that_options_take(self):
        for option in ("strategy", "quality"):
            names, name_of = [], getattr(LIBRARY, f"kinemesh_{option}_name")
            while (name := name_of(len(names))) is not None:
                names.append(name)
                self.stepper(self.points, self.triangles, **{option: name})
            self.assertTrue({"strategy": {b"global", b"local"}, "quality": {b"none", b"angles"}}[option]
                            <= set(names))
            self.assertEqual(len(set(names)), len(names))

    def test_counts_and_regions(self):
        for strategy in (b"global", b"local"):
            stepper, inverted = self.stepper(self.points, self.triangles, self.labels, strategy=strategy), 0
            seen, faces = Recorded(self, stepper), self.triangles
            for _ in range(5):
                moved = self.shaken_within_halves()
                areas = [area(moved, faces[f:f + 3]) for f in range(0, len(faces), 3)]
                record = self.step(stepper, moved)
                inverted += record.inverted
                self.assertEqual((record.vertices, record.faces, record.escaped), (81, 128, 0))
                self.assertEqual(record.inverted, sum(a < 0 for a in areas))
                self.check_regions(record, self.regions(stepper, record), areas, seen.patches)
                faces = self.faces(stepper)
                self.assertTrue(math.isclose(self.area(moved, faces), 1.0))
                self.assertAlmostEqual(record.min_area, min(area(moved, faces[f:f + 3])
                                                            for f in range(0, len(faces), 3)))
            self.assertGreater(inverted, 50)

    def check_regions(self, record, regions, areas, patches):
        self.assertEqual(len(regions), record.regions)
        sizes = [region.n_faces + region.padding_faces for region, _ in regions]
        self.assertEqual((sum(sizes), max(sizes)), (record.region_faces, record.region_faces_max))
        for name in ("inverted", "components", "explored", "crease_edges", "retries"):
            of_regions = sum(getattr(region, name) for region, _ in regions)
            self.assertEqual(of_regions, getattr(record, name), name)
        for region, faces in regions:
            self.assertEqual(faces, sorted(set(faces)))
            self.assertTrue(region.seed in faces or region.seed == -1)
            self.assertEqual((region.gamma, region.kept), (1, 0))
        self.assertLessEqual({f for f, a in enumerate(areas) if a < 0}, {f for _, fs in regions for f in fs})
        for patch in patches:
            self.assertLessEqual(set(patch.before), {f for r in patch.regions for f in regions[r][1]})

    def transfer(self, name, values, changes):
        """To another array, and in place."""
        function = getattr(LIBRARY, "kinemesh_" + name)
        other, own = array("d", bytes(8 * len(values))), array("d", values)
        statuses = [function(changes, address(values, c_double), address(other, c_double)),
                    function(changes, address(own, c_double), address(own, c_double))]
        return statuses, other, own

    def test_values_of_faces(self):
        names = ("remap_amounts", "remap_averages", "copy_nearest")
        values = array("d", (self.source.uniform(1, 2) for _ in range(128)))
        constant = array("d", [3.5]) * 128
        stepper = self.stepper(self.points, self.triangles, self.labels)
        seen = Recorded(self, stepper, lambda changes: (
            {name: self.transfer(name, values, changes) for name in names},
            self.transfer("remap_averages", constant, changes)))
        for _ in range(3):
            faces, record = self.faces(stepper), self.step(stepper, self.shaken_within_halves())
            self.assertGreater(record.replaced, 20)
            made, kept_constant = seen.made
            for statuses, other, own in (*made.values(), kept_constant):
                self.assertEqual(statuses, [OK, OK])
                self.assertEqual(other, own)
            rewritten = {f for patch in seen.patches for f in patch.after}
            for _, other, _ in made.values():
                self.assertTrue(all(other[f] == values[f] for f in range(128) if f not in rewritten))
            self.check_sums(values, made["remap_amounts"][1], lambda _: 1.0, lambda _: 1.0)
            now = self.faces(stepper)
            self.check_sums(values, made["remap_averages"][1],
                            lambda f: area(seen.after, faces[3 * f:3 * f + 3]),
                            lambda f: area(seen.after, now[3 * f:3 * f + 3]))
            self.assertTrue(all(math.isclose(u, 3.5, rel_tol=1e-6) for u in kept_constant[1]))
            self.check_nearest(seen, values, made["copy_nearest"][1])

    def check_sums(self, before, after, weight_before, weight_after):
        """Labels of faces stay where they are."""
        for label in (1, 2):
            of_label = [f for f in range(128) if self.labels[f] == label]
            self.assertTrue(math.isclose(sum(before[f] * weight_before(f) for f in of_label),
                                         sum(after[f] * weight_after(f) for f in of_label), rel_tol=1e-12))

    def check_nearest(self, seen, values, after):
        def centre(corners):
            return [sum(seen.after[2 * v + k] for v in corners) / 3 for k in (0, 1)]

        for patch in seen.patches:
            for face, (corners, label) in patch.after.items():
                at = centre(corners)
                ways = {f: math.dist(at, centre(old)) for f, (old, of) in patch.before.items() if of == label}
                near = [values[f] for f, way in ways.items() if way <= min(ways.values()) + 1e-12]
                self.assertIn(after[face], near)

    def test_vertices_that_escape(self):
        v = 3 * (self.n + 1) + 4  # below the interface, and now above it, or out of the domain
        for to, gone in (((0.85, 0.85), 0), ((0.5, 1.08), 2)):
            moved = array("d", self.points)
            moved[2 * v:2 * v + 2] = array("d", to)
            stepper = self.stepper(self.points, self.triangles, self.labels)
            self.assertEqual(LIBRARY.kinemesh_stepper_step(stepper, address(moved, c_double), c_double(1),
                                                           None), NO_VALID_MESH)
            culprits = LIBRARY.kinemesh_culprits().contents
            self.assertEqual((culprits.kind, culprits.vertices[:culprits.n_vertices], tuple(culprits.where)),
                             (ESCAPED, [v], to))
            self.assertEqual(self.faces(stepper), self.triangles)

            stepper = self.stepper(self.points, self.triangles, self.labels, allow_escaped=1)
            ones = array("d", [1.0]) * 128
            seen = Recorded(self, stepper, lambda changes: self.transfer("remap_amounts", ones, changes))
            record = self.step(stepper, moved)
            self.assertEqual((record.escaped, record.faces), (1, 128 - gone))
            self.assertEqual((seen.changes["n_faces_before"], seen.changes["n_faces_after"]),
                             (128, 128 - gone))
            before = {f: t for patch in seen.patches for f, t in patch.before.items()}
            after = {f: t for patch in seen.patches for f, t in patch.after.items()}
            self.assertEqual(len(before) - len(after), gone)
            self.check_listed(stepper, before, after)
            self.assertEqual(seen.made[0], [OK if gone == 0 else BAD_INPUT] * 2)
            self.assertEqual(seen.made[2] == ones, gone != 0)

            again = self.step(stepper, moved)  # as it is
            self.assertEqual((again.replaced, again.faces), (0, 128 - gone))
            self.assertEqual(seen.made[0], [OK if gone == 0 else BAD_INPUT] * 2)

    def check_listed(self, stepper, before, after):
        """All faces, by number: those of the start, less those before, and those after."""
        n = LIBRARY.kinemesh_stepper_n_faces(stepper)
        numbers, faces, labels = (array("i", bytes(4 * k * n)) for k in (1, 3, 1))
        self.call("stepper_face_numbers", stepper, address(numbers, c_int32))
        self.call("stepper_get", stepper, None, address(faces, c_int32), address(labels, c_int32))
        listed = {f: (list(faces[3 * i:3 * i + 3]), labels[i]) for i, f in enumerate(numbers)}
        wanted = {f: (list(self.triangles[3 * f:3 * f + 3]), self.labels[f])
                  for f in range(len(self.labels)) if f not in before}
        self.assertEqual(listed, wanted | after)

    def test_validation_names_a_culprit(self):
        tangled = self.shaken_within_halves()
        mesh = self.mesh(tangled, self.triangles, self.labels)
        self.assertEqual(LIBRARY.kinemesh_mesh_validate(mesh), NOT_VALID)
        culprits = LIBRARY.kinemesh_culprits().contents
        self.assertEqual((culprits.kind, culprits.n_faces, culprits.n_vertices), (INVERTED_FACE, 1, 3))
        face = culprits.faces[0]
        self.assertLess(area(tangled, self.triangles[3 * face:3 * face + 3]), 0)
        self.assertEqual(set(culprits.vertices[:3]), set(self.triangles[3 * face:3 * face + 3]))
        self.call("mesh_untangle", mesh, None)
        self.call("mesh_validate", mesh)

    def safe_step(self, moved):
        share, face = c_double(), c_int32()
        self.call("max_safe_step", len(moved) // 2, address(self.points, c_double), address(moved, c_double),
                  len(self.triangles) // 3, address(self.triangles, c_int32), ctypes.byref(share),
                  ctypes.byref(face))
        return share.value, face.value

    def test_safe_step(self):
        self.assertEqual(self.safe_step(self.points), (1.0, -1))
        x0 = [Fraction(x) for x in self.points]
        for _ in range(10):
            moved = self.shaken(self.points, self.n, self.source)
            x1 = [Fraction(x) for x in moved]
            share, first = self.safe_step(moved)

            def areas(s):
                x = [(1 - s) * a + s * b for a, b in zip(x0, x1)]
                return [area(x, self.triangles[f:f + 3]) for f in range(0, len(self.triangles), 3)]

            self.assertGreater(min(areas(Fraction(share) - Fraction(1, 10**15))), 0)
            self.assertGreaterEqual(min(areas(Fraction(share))), 0)
            self.assertLessEqual(areas(Fraction(math.nextafter(share, 2)))[first], 0)

    def test_one_handle_in_many_threads(self):
        """Who comes in between is told so, and nothing happens twice; reading goes together."""
        stepper, mesh = self.stepper(self.points, self.triangles), self.mesh(self.points, self.triangles)
        moved = [self.shaken(self.points, self.n, self.source) for _ in range(4)]

        def work(number):
            xy, told = array("d", self.points), []
            for _ in range(30):
                told.append(LIBRARY.kinemesh_stepper_step(stepper, address(moved[number], c_double),
                                                          c_double(1), None))
                self.assertEqual(LIBRARY.kinemesh_mesh_get(mesh, address(xy, c_double), None, None), OK)
            return told

        with ThreadPoolExecutor(4) as pool:
            told = [status for statuses in pool.map(work, range(4)) for status in statuses]
        self.assertLessEqual(set(told), {OK, BUSY})
        self.assertEqual(LIBRARY.kinemesh_stepper_time(stepper), told.count(OK))
        self.assertGreater(told.count(OK), 0)


if __name__ == "__main__":
    unittest.main()
