"""Replays the patches.bin of a run and checks every step: python3 examples/read_patches.py DIR/patches.bin"""

import struct
import sys


def blocks(path):
    with open(path, "rb") as file:
        if file.read(12) != b"KMPATCH\n" + struct.pack("<I", 1):
            sys.exit(f"{path}: patches.bin, version 1, expected")
        while len(head := file.read(8)) == 8:
            content = file.read(struct.unpack("<Q", head)[0])
            if file.read(1) != b"\n":
                return  # a killed run's last step
            yield Reader(content)


class Reader:
    def __init__(self, content):
        self.content, self.at = content, 0

    def number(self, kind):  # i: int32, q: int64, d: float64
        return self.tuples(kind, 1, 1)[0][0]

    def tuples(self, kind, each, count=None):  # a list, its length in front
        count = self.number("q") if count is None else count
        form = struct.Struct("<" + kind * each)
        start, self.at = self.at, self.at + count * form.size
        return list(form.iter_unpack(self.content[start : self.at]))


def area(a, b, c):
    return 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))


steps = blocks(sys.argv[1])
start = next(steps)
points, faces, labels = start.tuples("d", 2), start.tuples("i", 3), start.tuples("i", 1)
print(f"{len(points)} vertices, {len(faces)} faces")
for block in steps:
    step, time = block.number("i"), block.number("d")
    moved, positions = block.tuples("i", 1), block.tuples("d", 2)
    for vertex, position in zip((v for v, in moved) if moved else range(len(points)), positions):
        points[vertex] = position
    inverted = sum(area(*(points[v] for v in face)) < 0 for face in faces)
    replaced = 0
    for _ in range(block.number("q")):
        regions, numbers = block.tuples("i", 1), block.tuples("i", 1)
        before, after = block.tuples("i", 3), block.tuples("i", 3)
        before_label, after_label = block.tuples("i", 1), block.tuples("i", 1)
        for (face,), corners in zip(numbers, after):  # without escaped vertices: all are the domain's
            faces[face] = corners
        replaced += len(numbers)
    left = sum(area(*(points[v] for v in face)) <= 0 for face in faces)
    print(f"step {step}, time {time:g}: {inverted} inverted, {replaced} replaced, {left} left")
