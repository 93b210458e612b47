"""The C interface in ctypes, and what its tests in Python begin with. Any buffer of doubles will do; nothing
but Python's own library."""

import ctypes
import os
import unittest
from array import array
from ctypes import POINTER, c_char_p, c_double, c_int, c_int32, c_size_t, c_void_p

LIBRARY = ctypes.CDLL(os.environ["KINEMESH_LIBRARY"])
LIBRARY.kinemesh_error.restype = ctypes.c_char_p
LIBRARY.kinemesh_stepper_positions.restype = POINTER(c_double)
LIBRARY.kinemesh_stepper_time.restype = c_double
LIBRARY.kinemesh_mesh_marker_name.restype = ctypes.c_char_p
LIBRARY.kinemesh_strategy_name.restype = ctypes.c_char_p
LIBRARY.kinemesh_quality_name.restype = ctypes.c_char_p
(OK, NO_VALID_MESH, BAD_INPUT, OUT_OF_MEMORY, VETOED, BUG, NO_RESOURCES, STUCK, REGIONS_TOO_LARGE, BUSY,
 NOT_VALID) = range(11)


def members(kind, names):
    return [(name, kind) for name in names.split()]


class Sized(ctypes.Structure):
    """Begins with its size; what it is made of comes with the first use of the others."""

    def __init__(self):
        super().__init__(size=ctypes.sizeof(self))


class Options(Sized):
    _fields_ = [("size", c_size_t), *members(c_char_p, "strategy quality"), *members(c_double, "angle frame"),
                *members(c_int32, "allow_escaped retain"), ("max_region_share", c_double)]


class Step(ctypes.Structure):
    _fields_ = [*members(c_int32, "step vertices faces"), *members(c_double, "time dt"),
                *members(c_int32, "inverted degenerate components regions replaced escaped doubled_edges "
                                  "quality_flips quality_moves region_faces region_faces_max explored "
                                  "crease_edges retries"),
                *members(c_double, "region_share min_angle_deg min_area move_ms interior_ms detect_ms "
                                   "explore_ms triangulate_ms splice_ms quality_ms measure_ms total_ms")]


class Region(ctypes.Structure):
    _fields_ = [*members(c_int32, "seed n_faces padding_faces kept inverted degenerate components explored "
                                  "crease_edges retries border_edges gamma_first_stable gamma rounds grown "
                                  "self_overlap fallback"),
                ("centre", c_double * 2)]


class Faces(ctypes.Structure):
    _fields_ = [("n", c_int32), *members(POINTER(c_int32), "faces triangles labels")]


class Patch(Sized):
    _fields_ = [("size", c_size_t), *members(Faces, "before after"), ("n_vertices", c_int32),
                ("vertices", POINTER(c_int32)), ("n_regions", c_int32), ("regions", POINTER(c_int32))]


class Changes(Sized):
    _fields_ = [("size", c_size_t), ("step", c_int32), *members(c_double, "time dt"),
                *members(c_int32, "n_vertices_before n_vertices_after n_faces_before n_faces_after"),
                *members(POINTER(c_int32), "vertex_map face_map"), ("n_patches", c_int32),
                ("patches", POINTER(POINTER(Patch))), *members(POINTER(c_double), "xy_before xy_after"),
                ("n_moved", c_int32), ("moved", POINTER(c_int32)), ("xy_moved", POINTER(c_double))]


class Defect(Sized):
    _fields_ = [("size", c_size_t), ("kind", c_int32), ("n_vertices", c_int32),
                ("vertices", POINTER(c_int32)), ("n_faces", c_int32), ("faces", POINTER(c_int32)),
                ("n_edges", c_int32), ("edges", POINTER(c_int32)), ("where", c_double * 2)]


LIBRARY.kinemesh_culprits.restype = POINTER(Defect)

OBSERVER = ctypes.CFUNCTYPE(c_int, POINTER(Changes), c_void_p)


def address(buffer, kind):
    """Of an array, a numpy array or any other writable buffer: nothing is copied."""
    return (kind * (len(memoryview(buffer).cast("B")) // ctypes.sizeof(kind))).from_buffer(buffer)


def grid(n):
    points = array("d", (c / n for j in range(n + 1) for i in range(n + 1) for c in (i, j)))
    triangles = array("i")
    for j in range(n):
        for i in range(n):
            a = j * (n + 1) + i
            b, c, d = a + 1, a + n + 2, a + n + 1
            triangles.extend((a, b, c, a, c, d))
    return points, triangles


def area(points, corners):
    (ax, ay), (bx, by), (cx, cy) = (points[2 * v:2 * v + 2] for v in corners)
    return ((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)) / 2


class Interface(unittest.TestCase):
    def call(self, function, *arguments):
        status = getattr(LIBRARY, "kinemesh_" + function)(*arguments)
        self.assertEqual(status, OK, LIBRARY.kinemesh_error())

    def mesh(self, points, triangles, labels=None):
        mesh = c_void_p()
        self.call("mesh_create", len(points) // 2, address(points, c_double), len(triangles) // 3,
                  address(triangles, c_int32), labels and address(labels, c_int32), ctypes.byref(mesh))
        self.addCleanup(LIBRARY.kinemesh_mesh_destroy, mesh)
        return mesh

    def stepper(self, points, triangles, labels=None, **options):
        """options: of kinemesh_options."""
        asked, stepper = Options(), c_void_p()
        self.call("set_default_options", ctypes.byref(asked))
        for name, value in options.items():
            setattr(asked, name, value)
        mesh = self.mesh(points, triangles, labels)
        self.call("stepper_create", mesh, ctypes.byref(asked), ctypes.byref(stepper))
        self.addCleanup(LIBRARY.kinemesh_stepper_destroy, stepper)
        return stepper

    def faces(self, stepper):
        triangles = array("i", bytes(12 * LIBRARY.kinemesh_stepper_n_faces(stepper)))
        self.call("stepper_get", stepper, None, address(triangles, c_int32), None)
        return triangles

    def area(self, points, triangles):
        areas = [area(points, triangles[f:f + 3]) for f in range(0, len(triangles), 3)]
        self.assertGreater(min(areas), 0)
        return sum(areas)

    def shaken(self, points, n, source):
        moved = array("d", points)
        for j in range(1, n):
            for i in range(1, n):
                v = 2 * (j * (n + 1) + i)
                for k in (v, v + 1):
                    moved[k] = min(max(moved[k] + source.uniform(-1, 1) / n, 0.01), 0.99)
        return moved
