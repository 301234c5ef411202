#!/usr/bin/env python3
"""scripts/make_textures.py: images that hold what presets rely on, the same as those of the build."""
import math
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "make_textures.py"


def pixels(path):
    """Rows of (r, g, b, a) of a PNG whose rows are all stored as differences from the one above."""
    data, at, packed = path.read_bytes(), 8, b""
    while at < len(data):
        (size,) = struct.unpack(">I", data[at : at + 4])
        kind, body = data[at + 4 : at + 8], data[at + 8 : at + 8 + size]
        if kind == b"IHDR":
            width, height = struct.unpack(">II", body[:8])
        if kind == b"IDAT":
            packed += body
        at += size + 12
    raw, above, rows = zlib.decompress(packed), bytes(4 * width), []
    for y in range(height):
        line = raw[y * (4 * width + 1) : (y + 1) * (4 * width + 1)]
        assert line[0] == 2
        above = bytes((a + b) & 255 for a, b in zip(line[1:], above))
        rows.append([tuple(above[4 * x : 4 * x + 4]) for x in range(width)])
    return rows


def correlation(a, b):
    ma, mb = sum(a) / len(a), sum(b) / len(b)
    product = sum((x - ma) * (y - mb) for x, y in zip(a, b))
    return product / math.sqrt(sum((x - ma) ** 2 for x in a) * sum((y - mb) ** 2 for y in b))


class Textures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.path = pathlib.Path(cls.folder.name)
        subprocess.run([sys.executable, SCRIPT, cls.path], check=True)
        cls.images = {path.name: pixels(path) for path in cls.path.glob("*.png")}

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_every_frame_ends_before_its_rim(self):
        tiles = {"flakes.png": (3, 2), "smoke.png": (8, 8), "streak.png": None}
        for name, rows in self.images.items():
            if name == "smoke-motion.png":
                continue
            across, down = tiles.get(name, (1, 1)) or (1, 1)
            width, height = len(rows[0]) // across, len(rows) // down
            sides = [(x, y) for y in range(len(rows)) for x in range(len(rows[0])) if x % width in (0, width - 1)]
            ends = [(x, y) for y in range(len(rows)) for x in range(len(rows[0])) if y % height in (0, height - 1)]
            for x, y in sides + ([] if tiles.get(name, 1) is None else ends):
                self.assertLess(rows[y][x][3], 24, (name, x, y))

    def test_every_image_shows_something(self):
        for name, rows in self.images.items():
            self.assertGreater(max(texel[3] for row in rows for texel in row), 200, name)

    def test_motion_vectors_lead_from_a_frame_of_the_smoke_to_later_ones(self):
        smoke, motion, side, scale, later = self.images["smoke.png"], self.images["smoke-motion.png"], 64, 0.005, 8

        def opacity(frame, x, y):
            """Between texels; `x` and `y` count within the frame."""
            i, j = math.floor(x), math.floor(y)
            rows = smoke[frame // 8 * side + j : frame // 8 * side + j + 2]
            (a, b), (c, d) = ([row[frame % 8 * side + i + k][3] for k in (0, 1)] for row in rows)
            fx, fy = x - i, y - j
            return (a * (1 - fx) + b * fx) * (1 - fy) + (c * (1 - fx) + d * fx) * fy

        said, seen = [], []
        for frame in (4, 16, 32):
            for y in range(14, 50):
                for x in range(14, 50):
                    red, green = motion[frame // 8 * 32 + y // 2][frame % 8 * 32 + x // 2][:2]
                    dx, dy = ((c - 128) / 127 * scale * side * later for c in (red, green))
                    before = opacity(frame, x, y)
                    said.append(opacity(frame, x - dx, y - dy) - before)
                    seen.append(opacity(frame + later, x, y) - before)
        self.assertGreater(correlation(said, seen), 0.6) # not 1: the puff wears away, too


if __name__ == "__main__":
    unittest.main()
