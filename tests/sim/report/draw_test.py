"""kinemesh draw: what is in its figures, and what it refuses."""

import json
import os
import random
import re
import shutil
import struct
import tempfile
import unittest
import xml.etree.ElementTree
import zlib
from pathlib import Path

from runs import program, run_rotor

N = 14  # cells a side


def tangled_grid():
    """A grid whose inner vertices are moved at random, as OFF."""
    at = random.Random(5).uniform
    points = []
    for j in range(N + 1):
        for i in range(N + 1):
            d = 0.9 if 0 < i < N and 0 < j < N else 0.0
            points.append((i + at(-d, d), j + at(-d, d)))
    lines = ["OFF", f"{len(points)} {2 * N * N} 0"] + [f"{x!r} {y!r} 0" for x, y in points]
    for j in range(N):
        for i in range(N):
            a = j * (N + 1) + i
            lines += [f"3 {a} {a + 1} {a + N + 2}", f"3 {a} {a + N + 2} {a + N + 1}"]
    return "\n".join(lines) + "\n"


def last_row(png):
    """Bytes of the lowest pixels."""
    width, height, _, kind = struct.unpack(">IIBB", png[16:26])
    size = {2: 3, 6: 4}[kind]
    packed, at = b"", 8
    while at < len(png):
        (length,) = struct.unpack(">I", png[at:at + 4])
        if png[at + 4:at + 8] == b"IDAT":
            packed += png[at + 8:at + 8 + length]
        at += length + 12
    data, row = zlib.decompress(packed), [0] * (width * size)
    for y in range(height):
        method, *coded = data[y * (len(row) + 1):(y + 1) * (len(row) + 1)]
        above, row = row, []
        for i, byte in enumerate(coded):
            a, b, c = row[i - size] if i >= size else 0, above[i], above[i - size] if i >= size else 0
            paeth = min((a, b, c), key=lambda x, p=a + b - c: abs(p - x))
            row.append((byte + (0, a, b, (a + b) // 2, paeth)[method]) % 256)
    return row


class Drawings(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp())
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        (cls.folder / "m.off").write_text(tangled_grid())
        for strategy in ("global", "local"):
            done = program("untangle", cls.folder / "m.off", "-o", cls.folder / f"{strategy}.off",
                           "--strategy", strategy, "--report", cls.folder / f"{strategy}.json")
            assert done.returncode == 0, done.stderr
        cls.report = json.loads((cls.folder / "local.json").read_text())
        cls.seed = cls.report["regions"][0]["seed"]
        done = program("untangle", cls.folder / "m.off", "-o", cls.folder / "seed.off", "--strategy", "local",
                       "--seed", cls.seed, "--report", cls.folder / "seed.json")
        assert done.returncode in (0, 1), done.stderr

    def draw(self, *arguments, out="f.svg", mesh="m.off"):
        done = program("draw", self.folder / mesh, "-o", self.folder / out, *arguments)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return (self.folder / out).read_bytes()

    def test_four_pictures_of_a_region(self):
        for report in ("seed", "local", "global"):
            regions = json.loads((self.folder / f"{report}.json").read_text())["regions"]
            largest = max(regions, key=lambda region: len(region["faces"]))
            svg = self.draw("--region", self.folder / f"{report}.json").decode()
            titles = re.findall(r"<text[^>]*>([^<]*)</text>", svg)
            self.assertEqual(len(titles), 4)
            n = len(largest["faces"]) + largest["padding_faces"]
            self.assertEqual(titles[2], f"R*: {n} triangles go, drawn over each other")
            self.assertIn("shadow X", titles[1])
            others = report == "seed" and len(self.report["regions"]) > 1
            self.assertEqual("elsewhere stay" in titles[3], others)
            self.assertEqual(svg.count('fill="#e69f00"'), n)
            self.assertEqual(svg.count('fill="#009e73"'), n)

    def test_png_is_the_drawing_at_its_size(self):
        png = self.draw("--region", self.folder / "seed.json", "--width", 400, out="f.PNG")
        self.assertEqual(png[:8], b"\x89PNG\r\n\x1a\n")
        width, height = struct.unpack(">II", png[16:24])
        self.assertEqual(width, 400)
        self.assertAlmostEqual(height, 2 * (192 + 16 + 24), delta=1)
        self.assertGreater(len(png), 3000)

    def test_a_height_that_is_no_whole_number_ends_white(self):
        png = self.draw("--zoom=-1,-1.003,15,15", "--width", 400, out="f.png")
        self.assertEqual(struct.unpack(">II", png[16:24]), (400, 441))
        self.assertEqual(set(last_row(png)), {255})

    def test_a_zoom_leaves_out_what_is_beyond(self):
        whole, part = self.draw("--title", "a < b"), self.draw("--zoom", "0,0,4,4")
        self.assertIn(b"a &lt; b", whole)
        self.assertLess(len(part), len(whole) / 2)

    def test_any_title_makes_a_well_formed_picture(self):
        wanted = [(bytes(range(1, 256)), r"\x01\x02\x03\x04\x05\x06\x07\x08\t\n\x0b"),
                  (b"\xff\xfe", r"\xff\xfe"),
                  (b"</text><script>alert(1)</script>", "</text><script>alert(1)</script>"),
                  (b"]]>&#0;<!-- &amp; %s", "]]>&#0;<!-- &amp; %s"),
                  ("\ufffe\uffff".encode(), r"\ufffe\uffff"),
                  ("\u202e\u2028\x85".encode(), r"\u202e\u2028\u0085"),
                  ("\xe9t\xe9 \u7ffc".encode(), "\xe9t\xe9 \u7ffc"),
                  (b"x" * 100_000, "x" * 1000 + "...")]
        for title, shown in wanted:
            svg = self.draw("--title", os.fsdecode(title))
            self.assertIn(shown, "".join(xml.etree.ElementTree.fromstring(svg).itertext()))
            picture = self.draw("--title", os.fsdecode(title), "--width", 100, out="f.png")
            self.assertEqual(picture[:4], b"\x89PNG")

    def test_a_region_of_any_shape_keeps_to_the_page(self):
        for zoom in ("0,0,1e-300,1", "-1e308,-1e308,1e308,1e308", "0,0,1e308,1e-308", "0,0,5e-324,5e-324"):
            svg = self.draw("--region", self.folder / "seed.json", f"--zoom={zoom}").decode()
            size = re.match(r'<svg [^>]*width="([^"]*)" height="([^"]*)"', svg)
            width, height = (float(n) for n in size.groups())
            self.assertEqual(width, 1000)
            self.assertLessEqual(height, 10 * width + 100)
            self.assertNotIn("nan", svg)
            self.assertNotIn("inf", svg)

    def test_a_step_of_a_run(self):
        run_rotor(self.folder, "run")
        svg = self.draw("--step", 3, mesh="run").decode()
        self.assertIn("step 3, time 0.06", svg)
        replaced = int(re.search(r"(\d+) replaced", svg).group(1))
        row = (self.folder / "run/steps.csv").read_text().split("\n")
        self.assertLessEqual(replaced, int(row[3].split(",")[row[0].split(",").index("replaced")]))
        self.assertGreater(replaced, 0)
        self.assertNotIn("inverted", svg)
        self.assertNotIn("replaced", self.draw("--step", 0, mesh="run").decode())

    def test_refusals_are_one_line_and_name_the_culprit(self):
        other = json.loads((self.folder / "seed.json").read_text())
        other["regions"][0]["faces"][0] += 1
        (self.folder / "other.json").write_text(json.dumps(other))
        (self.folder / "bad.json").write_text('{"schema": "kinemesh-untangle-1", "strategy": 1}')
        wanted = [(["-o", "f.gif"], "f.gif: .svg or .png expected"),
                  (["-o", "f.svg", "--zoom", "1,0,0,1"], "--zoom: X0,Y0,X1,Y1 expected"),
                  (["-o", "f.svg", "--region", "m.off"], "m.off: the report of kinemesh untangle expected"),
                  (["-o", "f.svg", "--region", "bad.json"], "bad.json: damaged: "),
                  (["-o", "f.svg", "--region", "other.json"],
                   "other.json: is not the report of untangling m.off"),
                  (["-o", "f.svg", "--region", "seed.json", "--number", "7"],
                   "--number 7: seed.json has regions 0 to 0"),
                  (["-o", "f.svg", "--number", "0"], "--number goes with --region"),
                  (["-o", "f.svg", "--step", "1"], "patches.bin expected"),
                  ([".", "-o", "f.svg"], ".: a folder: --step says which")]
        for arguments, words in wanted:
            done = program("draw", *([] if "." in arguments else ["m.off"]), *arguments, cwd=self.folder)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertIn(words, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1)
            self.assertFalse((self.folder / "f.gif").exists())


if __name__ == "__main__":
    unittest.main(verbosity=2)
