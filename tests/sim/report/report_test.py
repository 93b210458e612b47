"""Makes reports of runs of all kinds, checks what is in them, and opens them in Chromium where there is
one."""

import base64
import json
import math
import os
import re
import shutil
import subprocess
import tempfile
import time
import unittest
import zlib
from pathlib import Path

from runs import ROOT, program, run_body, run_rotor

WEB = ROOT / "sim/report/web"
CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser")
# Where node's packages for the tests are kept between runs.
MODULES = Path(os.environ["KINEMESH_TEST_DIR"])

def npm(*arguments, cwd):
    options = ["--no-audit", "--no-fund", "--fetch-retries=0"]
    done = subprocess.run(["npm", *arguments, *options], cwd=cwd, capture_output=True, text=True, check=False)
    return done.returncode == 0


def block(html, name):
    text = re.search(rf'<script type="application/octet-stream" id="{name}">([^<]*)</script>', html).group(1)
    return zlib.decompress(base64.b64decode(text, validate=True)) if text.strip() else b""


class Bytes:
    def __init__(self, data):
        self.data, self.at = data, 0

    def count(self):
        value = shift = 0
        while True:
            byte = self.data[self.at]
            self.at += 1
            value |= (byte & 127) << shift
            shift += 7
            if byte < 128:
                return value

    def signed(self):
        n = self.count()
        return -(n + 1) // 2 if n % 2 else n // 2


def decode(mesh, data):
    """The meshes of all frames: [(positions, faces)], as the page's player would show them."""
    bytes_, corner, faces = Bytes(data), 0, []
    for _ in range(3 * mesh["faces"]):
        corner += bytes_.signed()
        faces.append(corner)
    faces = [tuple(faces[3 * f : 3 * f + 3]) for f in range(mesh["faces"])]
    faces += [(0, 0, 0)] * (mesh["slots"] - mesh["faces"])
    for _ in range(mesh["faces"]):
        bytes_.signed()
    x, last, frames = [0] * (2 * mesh["vertices"]), [], []

    def change():
        face = 0
        n = bytes_.count()
        for _ in range(n):
            face += bytes_.signed()
            faces[face] = tuple(v + bytes_.signed() for v in faces[face])
        return n

    for _ in mesh["frames"]:
        mode = bytes_.data[bytes_.at]
        bytes_.at += 1
        before = x[:]
        for i in range(len(x)):
            if mode == 0:
                guess = x[i - 2] if i > 1 else 0
            else:
                guess = before[i] + (before[i] - last[i] if mode == 2 else 0)
            x[i] = guess + bytes_.signed()
        last = x[:] if mode == 0 else before
        replaced = change()
        for _ in range(bytes_.count()):
            for _ in range(bytes_.count()):
                bytes_.count()
            replaced += change()
        for _ in range(5 * bytes_.count()):
            bytes_.count()
        x0, y0, step = mesh["box"]
        points = [(x0 + step * a, y0 + step * b) for a, b in zip(x[::2], x[1::2])]
        frames.append((points, list(faces), replaced))
    assert bytes_.at == len(data)
    return frames


def read_vtu(path):
    off = path.with_suffix(".off")
    assert program("convert", path, off).returncode == 0
    numbers = off.read_text().split()[1:]
    n, m = int(numbers[0]), int(numbers[1])
    points = [tuple(map(float, numbers[3 + 3 * v : 5 + 3 * v])) for v in range(n)]
    rest = numbers[3 + 3 * n :]
    return points, [tuple(map(int, rest[4 * f + 1 : 4 * f + 4])) for f in range(m)]


class Reports(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp())
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        run_rotor(cls.folder)
        run_body(cls.folder)
        run_rotor(cls.folder, "one", "time.steps=1")
        run_rotor(cls.folder, "series", "output.patches=false")
        cls.copy("no_meshes", "run.json", "scenario.toml", "steps.csv", "regions.csv")
        cls.copy("none", "run.json", "steps.csv", "regions.csv", "mesh_000000.vtu")
        for name in ("steps.csv", "regions.csv"):
            path = cls.folder / "none" / name
            path.write_text(path.read_text().split("\n")[0] + "\n")
        cls.make_old()
        cls.make_many()
        cls.make_bench()

    @classmethod
    def copy(cls, name, *files):
        (cls.folder / name).mkdir()
        for file in files:
            shutil.copy(cls.folder / "rotor" / file, cls.folder / name)

    @classmethod
    def make_old(cls):
        """As earlier versions logged."""
        cls.copy("old", "run.json", "regions.csv", "patches.bin")
        rows = [line.split(",") for line in (cls.folder / "rotor/steps.csv").read_text().split("\n")[:-1]]
        newer = ("quality_flips", "interior_ms", "quality_moves")
        kept = [i for i, name in enumerate(rows[0]) if name not in newer]
        text = "".join(",".join(row[i] for i in kept) + "\n" for row in rows)
        (cls.folder / "old/steps.csv").write_text(text)

    @classmethod
    def make_many(cls):
        (cls.folder / "many").mkdir()
        header, row = (cls.folder / "rotor/steps.csv").read_text().split("\n")[:2]
        rest = row.split(",")[5:]
        rows = [header]
        for n in range(1, 10001):
            inverted = 1000 if n == 7777 else n % 10
            rows.append(",".join([str(n), repr(n * 0.01), "0.01", "600", "1150", str(inverted), *rest[1:]]))
        (cls.folder / "many/steps.csv").write_text("\n".join(rows) + "\n")

    @classmethod
    def make_bench(cls):
        (cls.folder / "bench").mkdir()
        header, *rows = (cls.folder / "rotor/steps.csv").read_text().split("\n")[:-1]
        lines = ["strategy," + header]
        lines += [f"{name}," + row for name in ("global", "remesh") for row in rows]
        (cls.folder / "bench/bench.csv").write_text("\n".join(lines) + "\n")
        (cls.folder / "sweep").mkdir()
        lines = ["strategy,time.dt," + header]
        lines += [f"{name},{dt}," + row
                  for dt in (0.01, 0.02, 0.04) for name in ("global", "remesh") for row in rows]
        (cls.folder / "sweep/bench.csv").write_text("\n".join(lines) + "\n")

    def report(self, name, *options, out=None):
        out = self.folder / f"{out or name}.html"
        done = program("report", self.folder / name, "-o", out, *options)
        self.assertEqual(done.returncode, 0, done.stderr)
        html = out.read_text()
        self.assertNotRegex(html.split("<script>")[0], r'(src|href)=')  # needs no other file
        return html, json.loads(block(html, "data"))

    def meshes(self, html, data):
        return decode(data["mesh"], block(html, "frames"))

    def test_frames_are_the_meshes_written(self):
        for name, step_of in (("rotor", lambda n: n), ("series", lambda n: 3 * n)):
            html, data = self.report(name)
            frames = self.meshes(html, data)
            self.assertEqual(len(frames), 13 if name == "rotor" else 5)
            for n, (points, faces, _) in enumerate(frames):
                path = self.folder / name / f"mesh_{step_of(n):06}.vtu"
                if not path.exists():
                    continue
                expected_points, expected_faces = read_vtu(path)
                self.assertEqual(faces, expected_faces)
                for p, q in zip(points, expected_points):
                    self.assertLess(math.dist(p, q), data["mesh"]["box"][2])
            self.assertGreater(sum(frame[2] for frame in frames), 50)

    def test_vertices_that_a_repair_has_moved_are_where_it_put_them(self):
        folder = run_rotor(self.folder, "optimized", 'repair.strategy="optimize"')
        html, data = self.report("optimized")
        frames = self.meshes(html, data)
        self.assertEqual(len(frames), 13)
        for step in (3, 6, 9, 12):
            points, faces, replaced = frames[step]
            expected_points, expected_faces = read_vtu(folder / f"mesh_{step:06}.vtu")
            self.assertEqual((faces, replaced), (expected_faces, 0))
            for p, q in zip(points, expected_points):
                self.assertLess(math.dist(p, q), data["mesh"]["box"][2])
        self.assertGreater(sum(data["steps"]["inverted"]), 5)

    def test_plots_hold_the_logs(self):
        _, data = self.report("rotor")
        text = (self.folder / "rotor/steps.csv").read_text()
        header, *rows = [line.split(",") for line in text.split("\n")[:-1]]
        for name in ("time", "inverted", "replaced", "min_angle_deg", "total_ms", "interior_ms",
                     "quality_moves"):
            self.assertEqual(data["steps"][name], [float(row[header.index(name)]) for row in rows])
        self.assertEqual(data["sizes"]["max"], [float(row[header.index("region_faces_max")]) for row in rows])
        self.assertEqual(data["sizes"]["count"], [float(row[header.index("regions")]) for row in rows])

    def test_bodies_show_what_was_done_for_quality(self):
        steps = self.report("body")[1]["steps"]
        self.assertEqual(sum(steps["inverted"]), 0)
        self.assertGreater(sum(steps["quality_moves"]) + sum(steps["quality_flips"]), 0)
        self.assertGreater(min(steps["interior_ms"]), 0)

    def test_logs_of_earlier_versions_have_fewer_columns(self):
        _, data = self.report("old")
        self.assertEqual(len(data["mesh"]["frames"]), 13)
        for name in ("quality_flips", "interior_ms", "quality_moves"):
            self.assertNotIn(name, data["steps"])

    def test_a_sweep_is_found_by_its_column(self):
        self.assertEqual(self.report("bench")[1]["bench"]["swept"], [])
        bench = self.report("sweep")[1]["bench"]
        self.assertEqual((bench["swept"], bench["strategies"]), (["time.dt"], ["global", "remesh"]))
        self.assertEqual(set(bench["rows"]["time.dt"]), {0.01, 0.02, 0.04})

    def test_a_sweep_may_be_of_lists_and_names(self):
        for key, values in (("motion.0.center", ("[0.5,0.5]", "[0.4,0.5]")),
                            ("repair.quality", ("none", "delaunay"))):
            done = program("bench", self.folder / "rotor.toml", "--strategies", "global,auto",
                           "--set", "time.steps=2", "--sweep", f"{key}={','.join(values)}",
                           "-o", self.folder / "lists", "--force")
            self.assertEqual(done.returncode, 0, done.stderr)
            bench = self.report("lists")[1]["bench"]
            self.assertEqual((bench["swept"], bench["strategies"]), ([key], ["global", "auto"]))
            self.assertEqual(bench["rows"][key], [values[0]] * 4 + [values[1]] * 4)

    def test_fields_in_quotes_hold_anything(self):
        header, row = (self.folder / "rotor/steps.csv").read_text().split("\n")[:2]
        (self.folder / "quoted").mkdir(exist_ok=True)
        file = self.folder / "quoted/bench.csv"
        file.write_bytes("\r\n".join(['strategy,"a ""b"", c",' + header, 'global,"x, ""y""\nz",' + row,
                                      'global,"",' + row, 'global,"half,' + row]).encode())
        bench = self.report("quoted")[1]["bench"]
        self.assertEqual(bench["swept"], ['a "b", c'])
        self.assertEqual(bench["rows"]['a "b", c'], ['x, "y"\nz', ""])
        file.write_text(f'strategy,{header}\nglobal,{row}\n"global,{row}\nglobal,{row}\n')
        done = program("report", self.folder / "quoted")
        self.assertEqual(done.returncode, 2)
        self.assertIn("bench.csv:3: a quote that does not end\n", done.stderr)

    def test_names_are_text_on_the_page(self):
        usual = self.report("bench")[0]
        tag = "<script>alert(1)<!--\u2028"
        folder = self.folder / tag
        folder.mkdir()
        header, row = (self.folder / "rotor/steps.csv").read_text().split("\n")[:2]
        end = "</script>" + tag + "\x1b\"\\"
        quoted = '"' + end.replace('"', '""') + '"'
        lines = [f"strategy,{header},{quoted}", f"{quoted},{row},{quoted}", f"{quoted},{row},x"]
        text = "\n".join([*lines, ""]).encode()
        (folder / "bench.csv").write_bytes(text + b"\xff," + row.encode() + b",\xff\n")
        (folder / "scenario.toml").write_text(end)
        (folder / "run.json").write_text(json.dumps({"stopped": end, "version": end}))
        html, data = self.report(tag, out="tag")
        for what in ("<script", "</script", "<!--", "\u2028", "\x1b"):
            self.assertEqual(html.count(what), usual.count(what), what)
        self.assertEqual(data["title"], "kinemesh: " + tag)
        self.assertEqual(data["scenario"], end)
        self.assertIn("The run stopped: " + end, data["notes"])
        self.assertEqual(data["bench"]["strategies"], [end, "\ufffd"])
        self.assertEqual(data["bench"]["swept"], [end])

    def test_of_a_long_sweep_some_values_are_shown(self):
        header, row = (self.folder / "rotor/steps.csv").read_text().split("\n")[:2]
        (self.folder / "long").mkdir()
        lines = ["strategy," + header + ",key"]
        lines += [f"{name},{row},{n}" for n in range(40_000) for name in ("global", "remesh")]
        (self.folder / "long/bench.csv").write_text("\n".join(lines) + "\n")
        start = time.monotonic()
        html, data = self.report("long")
        self.assertLess(time.monotonic() - start, 60)
        self.assertLess(len(html), 1_000_000)
        self.assertEqual(data["bench"]["rows"]["key"], [n for n in range(0, 40_000, 200) for _ in range(2)])
        self.assertIn("one of every 200 of its 40000 values", " ".join(data["notes"]))

    def test_of_a_long_benchmark_some_steps_are_shown(self):
        header, row = (self.folder / "rotor/steps.csv").read_text().split("\n")[:2]
        (self.folder / "steps").mkdir()
        lines = ["strategy," + header]
        lines += [f"{name},{n},{row.split(',', 1)[1]}"
                  for n in range(60_000) for name in ("global", "remesh")]
        (self.folder / "steps/bench.csv").write_text("\n".join(lines) + "\n")
        html, data = self.report("steps")
        self.assertEqual(data["bench"]["rows"]["step"], [n for n in range(0, 60_000, 3) for _ in range(2)])
        self.assertEqual(data["bench"]["rows"]["strategy"], ["global", "remesh"] * 20_000)
        self.assertIn("one of every 3 steps", " ".join(data["notes"]))

    def test_thinning_keeps_the_peak_and_is_told(self):
        _, data = self.report("many")
        self.assertEqual(len(data["steps"]["time"]), 5000)
        self.assertIn(1000, data["steps"]["inverted"])
        self.assertIn("one of every 2 steps", " ".join(data["notes"]))

    def test_a_page_keeps_to_its_size(self):
        html, data = self.report("rotor")
        whole = len(html)
        limit = (whole - 2000) / 1e6
        html, data = self.report("rotor", "--max-size", f"{limit:.4f}", out="thinned")
        self.assertLessEqual(len(html.encode()), limit * 1e6)
        self.assertLess(len(data["mesh"]["frames"]), 13)
        self.assertIn("frames, to keep the page below", " ".join(data["notes"]))
        frames = self.meshes(html, data)
        self.assertEqual(frames[-1][1], read_vtu(self.folder / "rotor/mesh_000012.vtu")[1])
        done = program("report", self.folder / "rotor", "-o", self.folder / "x.html", "--max-size", "0.05")
        self.assertEqual((done.returncode, (self.folder / "x.html").exists()), (2, False))
        self.assertIn("--max-size 0.05: the plots alone need 0.", done.stderr)

    def test_what_is_not_there_is_told(self):
        for name, word in (("none", "No step has been made"), ("no_meshes", "No meshes to play"),
                           ("series", "output.patches=true")):
            _, data = self.report(name)
            self.assertIn(word, " ".join(data["notes"]))
        (self.folder / "empty").mkdir(exist_ok=True)
        for folder, word in (("empty", "expected in this folder"), ("nowhere", "a folder expected")):
            done = program("report", self.folder / folder)
            self.assertEqual(done.returncode, 2)
            self.assertRegex(done.stderr, rf"^kinemesh: .*{folder}: .*{word}\n$")

    def test_damaged_files_are_named(self):
        for file, content, word in (("steps.csv", "step,time\n1,2\n", "steps.csv:1: a column faces expected"),
                                    ("steps.csv", None, "steps.csv:4: "),
                                    ("patches.bin", "no", "patches.bin: is no")):
            shutil.copytree(self.folder / "rotor", self.folder / "damaged", dirs_exist_ok=True)
            path = self.folder / "damaged" / file
            if content is None:
                lines = path.read_text().split("\n")
                content = "\n".join(lines[:3] + ["1,2"] + lines[3:])
            path.write_text(content)
            done = program("report", self.folder / "damaged")
            self.assertEqual(done.returncode, 2)
            self.assertIn(word, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1)

    def test_the_reader_in_examples_reads_patches(self):
        command = ["python3", ROOT / "examples/read_patches.py", self.folder / "rotor/patches.bin"]
        done = subprocess.run(command, capture_output=True, text=True, check=True)
        lines = done.stdout.splitlines()
        self.assertEqual(len(lines), 13)
        text = (self.folder / "rotor/steps.csv").read_text()
        header, *rows = [line.split(",") for line in text.split("\n")[:-1]]
        for line, row in zip(lines[1:], rows):
            inverted, left = re.search(r"(\d+) inverted.* (\d+) left", line).groups()
            self.assertEqual(left, "0")
            in_all = int(row[header.index("inverted")])  # that counts padding, too
            self.assertLessEqual(int(inverted), in_all)
        self.assertIn(" inverted", lines[-1])

    @unittest.skipUnless(shutil.which("npm"), "npm is not here")
    def test_the_page_is_what_its_sources_make(self):
        web = self.folder / "web"
        shutil.copytree(WEB, web, ignore=shutil.ignore_patterns("node_modules", "report.html"))
        if not npm("ci", cwd=web):
            self.skipTest("npm has no way to its packages")
        subprocess.run(["node", "build.mjs"], cwd=web, check=True)
        self.assertEqual((web / "report.html").read_bytes(), (WEB / "report.html").read_bytes())

    @unittest.skipUnless(CHROMIUM and shutil.which("npm"), "chromium, node and npm are not all here")
    def test_the_page_in_a_browser(self):
        MODULES.mkdir(parents=True, exist_ok=True)
        here = ROOT / "tests/sim/report"
        for name in ("package.json", "package-lock.json", "browser_test.mjs"):
            shutil.copy(here / name, MODULES)
        shutil.copytree(here / "reference", MODULES / "reference", dirs_exist_ok=True)
        if not npm("ci", "--prefer-offline", cwd=MODULES):
            self.skipTest("npm has no way to its packages")
        self.test_a_page_keeps_to_its_size()
        self.test_a_sweep_may_be_of_lists_and_names()
        for name in ("rotor", "body", "old", "one", "none", "many", "no_meshes", "series", "bench", "sweep",
                     "lists"):
            self.report(name)
        command = ["node", "browser_test.mjs", CHROMIUM, str(self.folder)]
        done = subprocess.run(command, cwd=MODULES, capture_output=True, text=True, check=False)
        if "KINEMESH_KEEP_PICTURES" in os.environ:
            shutil.copytree(self.folder, os.environ["KINEMESH_KEEP_PICTURES"], dirs_exist_ok=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
