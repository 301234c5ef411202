#!/usr/bin/env python3
"""fx render --renderer path: killed and resumed, on several threads, and against the reference renderer."""
import json
import random
import resource
import signal
import subprocess
import time
import unittest

from exr_planes import read_planes
from fx_program import FX, PATIENCE, FxTest, fx

HEADER = "x[m],y[m],z[m],radius[m],tau_area[m2],albedo,er,eg,eb,g\n"
VIEW = ("--view", "0.5,0.3,4,0,0,0,40")
SUN_ALONE = {"sunDirection": [0.4, 0.8, 0.3], "sunIlluminance": [30000, 28000, 25000], "skyLuminance": [0, 0, 0], "groundAlbedo": 0}


def ball_of_blobs(count, emission=0.0):
    chance = random.Random(1)
    lines = [HEADER]
    while len(lines) <= count:
        place = [chance.uniform(-1, 1) for _ in range(3)]
        if sum(x * x for x in place) <= 1:
            lines.append(",".join(map(repr, [*place, 0.3, 4.0 / count, 0.9, emission, emission, emission, 0.4])) + "\n")
    return "".join(lines)


def scene(instances, camera):
    return json.dumps({"version": 1, "name": "test", "camera": camera, "lighting": SUN_ALONE, "exposureEv100": 12,
                       "instances": instances})


class FxPath(FxTest):
    def setUp(self):
        super().setUp()
        self.blobs = self.write("a.blobs.csv", ball_of_blobs(270, emission=100.0))
        self.lights = self.write("lights.scene.json", scene([], {"position": [0, 0, 4], "target": [0, 0, 0]}))

    def arguments(self, output, *more):
        return ["render", str(self.blobs), "-o", str(self.folder / output), "--renderer", "path", *VIEW, "--lights", str(self.lights),
                *map(str, more)]

    def bytes_of(self, output, *more):
        outcome = fx(*self.arguments(output, *more))
        self.assertEqual(outcome.code, 0, outcome.err)
        return (self.folder / output).read_bytes()

    def test_threads_do_not_change_a_bit(self):
        size = ("--size", "64x48", "--spp", 8)
        one = self.bytes_of("1.exr", *size, "--threads", 1)
        for threads in (2, 4):
            self.assertEqual(self.bytes_of(f"{threads}.exr", *size, "--threads", threads), one)

    def kill_at_growth(self, size, growth, limit):
        """Renders on until the journal has `growth` bytes more, then kills; the system does so at `limit` bytes more.

        @return the size of the journal
        """
        journal = self.folder / "a.exr.journal"
        size_of = lambda: journal.stat().st_size if journal.exists() else 0
        before = size_of()

        def limited():
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            resource.setrlimit(resource.RLIMIT_FSIZE, (before + limit, before + limit))

        process = subprocess.Popen([FX, *self.arguments("a.exr", *size, "--resume")], stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL, preexec_fn=limited)
        while size_of() < before + growth and process.poll() is None:
            time.sleep(0.001)
        process.kill()
        self.assertIn(process.wait(PATIENCE), (-signal.SIGKILL, -signal.SIGXFSZ))
        return size_of()

    def test_a_render_that_is_killed_twenty_times_gives_the_same_bits(self):
        size = ("--size", "256x192", "--spp", 4)
        whole = self.bytes_of("whole.exr", *size)
        bytes_of_tiles = 256 * 192 * 8 * 4
        chance = random.Random(7)
        sizes = set()
        for kill in range(20):
            # at once, or within a tile or a record; never so late that the picture is done after twenty times
            growth = 0 if kill % 7 == 0 else chance.randint(1, bytes_of_tiles // 40)
            sizes.add(self.kill_at_growth(size, growth, bytes_of_tiles // 25))
            self.assertNotIn("a.exr", self.names())
        self.assertGreaterEqual(len(sizes), 17) # every kill that waited found the journal longer
        self.assertEqual(self.bytes_of("a.exr", *size, "--resume"), whole)
        self.assertNotIn("a.exr.journal", self.names())

    def assert_one_bounce_is_single_scattering(self, *arguments):
        planes = {}
        for name, more in (("path", ("--bounces", 1, "--sun-angle", 0, "--spp", 48)), ("reference", ("--scattering", "single", "--samples", 3))):
            path = self.folder / (name + ".exr")
            outcome = fx("render", *arguments, "-o", path, "--renderer", name, "--size", "48x36", *more)
            self.assertEqual(outcome.code, 0, outcome.err)
            planes[name] = read_planes(path)[2]
        found, expected = planes["path"], planes["reference"]
        compared = agreeing = 0
        for channel in "RGB":
            darkest = 1e-3 * max(expected[channel])
            for i, depth in enumerate(expected["opticalDepth.Y"]):
                # where next to no path collides or finds light, its error is not known either
                if depth > 0.02 and expected[channel][i] > darkest:
                    error = found["variance." + channel][i] ** 0.5
                    compared += 1
                    agreeing += abs(found[channel][i] - expected[channel][i]) <= 3 * error
        self.assertGreater(compared, 500)
        self.assertGreaterEqual(agreeing, 0.99 * compared)
        self.assertAlmostEqual(sum(found["G"]) / sum(expected["G"]), 1.0, delta=0.01)

    def test_one_bounce_is_the_reference_renderers_single_scattering_of_270_blobs(self):
        blobs = self.write("dark.blobs.csv", ball_of_blobs(270))
        self.assert_one_bounce_is_single_scattering(blobs, *VIEW, "--lights", self.lights)

    def test_one_bounce_is_the_reference_renderers_single_scattering_of_a_smoke_column(self):
        smoke = self.write("smoke.scene.json", scene([{"preset": "library:smoke-column"}], {"position": [0, 2, 9], "target": [0, 2, 0]}))
        self.assert_one_bounce_is_single_scattering(smoke, "--time", "2")


if __name__ == "__main__":
    unittest.main()
