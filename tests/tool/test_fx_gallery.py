#!/usr/bin/env python3
"""fx gallery: a page that has all it shows, or nothing at all."""
import html.parser
import json
import os
import pathlib
import pty
import re
import signal
import struct
import subprocess
import time
import unittest
import urllib.parse
import zlib

from fx_program import FX, PATIENCE, FxTest, fx

TINY = ("--size", "64x36", "--times", "2")
PRESET = """{"version": 1, "name": "glow", "description": "Balls <of> \\"light\\" & nothing else.", "duration": 2,
    "emitters": [{"position": [0, 1, 0], "radius": 0.4, "forces": {"gravity": 0}, "lifetime": 2, "maxParticles": 7,
    "emission": {"bursts": [{"time": 0, "count": 7}]}, "appearance": {"kind": "sprite", "lit": 0, "luminance": 5000}}],
    "preview": {"time": 0.4, "camera": {"position": [0, 1, 5], "target": [0, 1, 0]}, "figure": {"position": [-1.5, 0, 0]}}}"""


class Page(html.parser.HTMLParser):
    """Links, identifiers and texts of a page; elements must be closed in order."""

    def __init__(self, path):
        super().__init__()
        self.links, self.ids, self.text, self.elements, self._open = [], [], "", [], []
        self.feed(path.read_text(encoding="utf-8"))
        self.close()
        assert not self._open, self._open

    def handle_starttag(self, tag, attributes):
        self.elements.append(tag)
        if tag not in ("img", "meta"):
            self._open.append(tag)
        attributes = dict(attributes)
        self.links += [attributes[name] for name in ("href", "src") if name in attributes]
        self.ids += [attributes["id"]] if "id" in attributes else []

    def handle_endtag(self, tag):
        assert self._open.pop() == tag

    def handle_data(self, data):
        self.text += data


def pixels(path):
    """Width, height, and the rows of an RGB PNG of 8 bits."""
    data, at, packed = path.read_bytes(), 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        if kind == b"IHDR":
            width, height, depth, color = struct.unpack(">IIBB", body[:10])
            assert (depth, color) == (8, 2)
        elif kind == b"IDAT":
            packed += body
        at += 12 + length
    raw, above, rows = zlib.decompress(packed), bytes(3 * width), []
    for y in range(height):
        start = y * (3 * width + 1)
        method, row = raw[start], bytearray(raw[start + 1:start + 1 + 3 * width])
        for i in range(len(row)):
            left, up, corner = row[i - 3] if i > 2 else 0, above[i], above[i - 3] if i > 2 else 0
            if method == 4:
                guess = left + up - corner
                near = min((abs(guess - left), 0, left), (abs(guess - up), 1, up), (abs(guess - corner), 2, corner))[2]
            else:
                near = (0, left, up, (left + up) // 2)[method]
            row[i] = (row[i] + near) & 255
        rows.append(bytes(row))
        above = row
    return width, height, rows


class FxGallery(FxTest):
    def setUp(self):
        super().setUp()
        self.preset = self.write("glow.fx.json", PRESET)
        self.out = self.folder / "gallery"

    def gallery(self, *arguments, code=0, size=TINY):
        outcome = fx("gallery", "-o", self.out, *size, *arguments)
        self.assertEqual(outcome.code, code, outcome.err)
        return outcome

    def assert_nothing_written(self):
        self.assertEqual(self.names(), ["glow.fx.json"])

    def test_the_page_shows_every_preset_and_all_its_links_lead_somewhere(self):
        outcome = self.gallery("sparks", self.preset, "--json")
        files = sorted(path.name for path in self.out.iterdir())
        self.assertEqual(files, ["glow.png", "glow.strip.png", "index.html", "sparks.png", "sparks.strip.png"])
        page = Page(self.out / "index.html")
        self.assertEqual(page.ids, ["sparks", "glow"])
        self.assertNotIn("script", page.elements)
        for link in page.links:
            link = urllib.parse.unquote(link)
            self.assertTrue(link[1:] in page.ids if link.startswith("#") else (self.out / link).is_file(), link)
        for text in ('Balls <of> "light" & nothing else.', "fx render library:sparks -o sparks.png", "emitters 1", "2 s"):
            self.assertIn(text, page.text)

        lines = [json.loads(line) for line in outcome.out.splitlines()]
        self.assertEqual([line["preset"] for line in lines], ["library:sparks", str(self.preset)])
        self.assertIn(lines[0]["machine"]["gl_renderer"], page.text)
        glow = lines[1]
        self.assertEqual((glow["particles"], glow["time"]), (7, 0.4))
        for cost in ("bytes", "bytes_textures", "ms_frame", "ms_update", "frames_measured"):
            self.assertGreater(glow[cost], 0, cost)
        self.assertAlmostEqual(glow["times"][0], 0.2)
        self.assertAlmostEqual(glow["times"][-1], 1.2) # 0.6 of its duration
        for line in lines:
            for name in ("picture", "strip"):
                width, height, rows = pixels(pathlib.Path(line[name]))
                self.assertEqual((width, height), (64, 36) if name == "picture" else (64, 18))
                brightest = [max(row[3 * from_: 3 * to]) for row in rows for from_, to in ((0, 32), (32, 64))]
                self.assertGreater(max(brightest[::2]), 40, line[name]) # each half of a strip is a picture
                self.assertGreater(max(brightest[1::2]), 40, line[name])

    def test_the_picture_is_that_of_fx_render(self):
        self.gallery(self.preset)
        outcome = fx("render", self.preset, "-o", self.folder / "a.png", "--size", "64x36")
        self.assertEqual(outcome.code, 0, outcome.err)
        for ours, theirs in zip(pixels(self.out / "glow.png")[2], pixels(self.folder / "a.png")[2]):
            self.assertLessEqual(max(abs(a - b) for a, b in zip(ours, theirs)), 1)

    def test_equal_names_get_files_of_their_own_and_a_second_run_replaces_the_first(self):
        (self.folder / "other").mkdir()
        other = self.write("other/glow.fx.json", PRESET)
        for _ in range(2):
            self.gallery(self.preset, other, size=("--size", "32x16", "--times", "0"))
            self.assertEqual(sorted(path.name for path in self.out.iterdir()), ["glow-2.png", "glow.png", "index.html"])
        self.assertEqual(Page(self.out / "index.html").ids, ["glow", "glow-2"])

    def test_an_interrupted_run_leaves_nothing(self):
        reader, terminal = pty.openpty()
        process = subprocess.Popen([FX, "gallery", "-o", self.out, "--size", "640x360", "--times", "8", self.preset, "explosion"],
                                   stdout=subprocess.DEVNULL, stderr=terminal)
        os.close(terminal)
        shown = b""
        deadline = time.monotonic() + PATIENCE
        while not re.search(rb"picture [1-9]", shown) and time.monotonic() < deadline: # some are drawn
            shown += os.read(reader, 4096)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(PATIENCE), 130)
        os.close(reader)
        self.assert_nothing_written()

    def test_what_cannot_be_shown_is_refused_before_anything_is_drawn(self):
        for names, expected in ((("sparks", "campfir"), "campfire"), ((self.folder / "none.fx.json",), "none.fx.json"),
                                ((self.write("bad.fx.json", PRESET.replace('"time": 0.4', '"time": -1')),), "/preview/time")):
            self.assertIn(expected, self.gallery(*names, code=1).err)
            self.assertFalse(self.out.exists())
        for arguments in (("--size", "64"), ("--size", "9999x64"), ("--times", "9"), ("--times", "-1")):
            self.gallery("sparks", *arguments, code=2, size=())
        for folder, expected in ((self.preset, "it is a file"), (self.folder / "none/out", "create it first")):
            outcome = fx("gallery", "-o", folder, *TINY, "sparks")
            self.assertEqual(outcome.code, 1)
            self.assertIn(expected, outcome.err)

    def test_a_full_disk_leaves_nothing(self):
        self.out.mkdir()
        os.symlink("/dev/full", self.out / "index.html")
        outcome = self.gallery(self.preset, code=1)
        self.assertIn("index.html", outcome.err)
        self.assertEqual([path.name for path in self.out.iterdir()], ["index.html"])


if __name__ == "__main__":
    unittest.main()
