#!/usr/bin/env python3
"""Volumes that fx exports, opened and rendered by Blender; Cycles against the path tracer."""
import json
import os
import shutil
import subprocess
import unittest
from pathlib import Path

from exr_planes import read_planes
from fx_program import FxTest, fx

HAS_OPENVDB = os.environ.get("FX_HAS_OPENVDB", "1") == "1"
SCRIPT = Path(__file__).resolve().parents[2] / "scripts" / "blender_volume.py"
SAMPLES = int(os.environ.get("FX_SAMPLES", "64"))
HEADER = "x[m],y[m],z[m],radius[m],tau_area[m2],albedo,er,eg,eb"
VIEW = (0, 0.3, 5, 0, 0, 0, 40)
SUN = (-0.9, 0.35, 0.1)


def mean(values):
    return sum(values) / len(values)


@unittest.skipUnless(HAS_OPENVDB, "fx was built without OpenVDB")
@unittest.skipUnless(shutil.which("blender"), "Blender is not installed")
class Blender(FxTest):
    def rendered(self, volume, *arguments):
        output = self.folder / "cycles.exr"
        words = ["blender", "--background", "--factory-startup", "--python-exit-code", "1", "--python", SCRIPT, "--", volume, output, *arguments]
        done = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False, timeout=1200)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return json.loads(next(line for line in done.stdout.splitlines() if line.startswith("{")))

    def cloud(self):
        """Twelve balls, not even, with a depth of some 3 through the middle."""
        rows = [f"{0.45 * (i % 3 - 1) + 0.1 * (i % 2)},{0.4 * (i // 3 % 2) - 0.2},{0.5 * (i // 6) - 0.25},{0.4 + 0.02 * (i % 5)},0.55,0.95,0,0,0"
                for i in range(12)]
        balls = self.write("cloud.blobs.csv", "\n".join([HEADER, *rows]) + "\n")
        volume = self.folder / "cloud.vdb"
        outcome = fx("export", balls, "-o", volume, "--voxel-size", "0.06", "--json")
        self.assertEqual(outcome.code, 0, outcome.err)
        return volume

    def test_cycles_and_the_path_tracer_see_the_same_light(self):
        volume = self.cloud()
        outcome = fx("import", volume, "-o", self.folder / "bricks.fx.json", "--bricks", "--albedo", "0.95")
        self.assertEqual(outcome.code, 0, outcome.err)
        scene = self.write("a.scene.json", json.dumps({
            "version": 1, "name": "a", "camera": {"position": VIEW[:3], "target": VIEW[3:6], "fovYDegrees": VIEW[6]}, "exposureEv100": 13,
            "lighting": {"sunDirection": SUN, "sunIlluminance": [60000] * 3, "skyLuminance": [0, 0, 0], "groundAlbedo": 0},
            "composition": "volume", "instances": [{"preset": "bricks.fx.json", "position": [0, 0, 0]}]}))
        outcome = fx("render", scene, "--renderer", "path", "--size", "64x48", "--time", 0, "--spp", SAMPLES, "-o", self.folder / "path.exr")
        self.assertEqual(outcome.code, 0, outcome.err)
        _, _, ours = read_planes(self.folder / "path.exr")
        line = self.rendered(volume, "--view", ",".join(map(str, VIEW)), "--size", "64x48", "--samples", SAMPLES, "--albedo", "0.95", "--step", "0.25",
                             f"--sun-direction={','.join(map(str, SUN))}", "--sun-illuminance", "60000,60000,60000")
        own = mean(ours["G"])
        noise = (mean(ours["variance.G"]) / len(ours["G"])) ** 0.5 / own
        print(f"path tracer {own:.5f}, Cycles {line['mean'][1]:.5f}, ratio {line['mean'][1] / own:.4f}, standard error of ours {noise:.4f}", flush=True)
        self.assertAlmostEqual(line["mean"][1] / own, 1.0, delta=0.02 + 3 * noise)

    def test_a_sphere_of_sky_is_seen_through_a_white_medium(self):
        # A medium that absorbs nothing in light that is the same from everywhere is invisible.
        volume = self.cloud()
        line = self.rendered(volume, "--view", "0,0,1.2,0,0,0,20", "--size", "16x16", "--samples", 64, "--albedo", "1", "--bounces", "1024",
                             "--sky-luminance", "5000,5000,5000", "--exposure", "12")
        white = 5000 / (1.2 * 2 ** 12)
        self.assertGreater(line["opacity"], 0.9)
        self.assertAlmostEqual(line["mean"][1] / (white * line["opacity"]), 1.0, delta=0.03)

    def test_blender_has_the_grids_and_the_box_of_the_export(self):
        volume = self.folder / "explosion.vdb"
        outcome = fx("export", "library:explosion", "-o", volume, "--time", "0.3", "--voxels", "40000")
        self.assertEqual(outcome.code, 0, outcome.err)
        outcome = fx("import", volume, "--json")
        self.assertEqual(outcome.code, 0, outcome.err)
        box = json.loads(outcome.out)
        line = self.rendered(volume, "--view", "0,3,20,0,3,0,40", "--size", "16x12", "--samples", 1, "--bounces", 4)
        self.assertTrue({"density", "temperature", "flame", "v"} <= set(line["grids"]))
        side = box["voxel_volume"] ** (1 / 3)
        for axis in range(3): # Blender's box is that of the tree's nodes of 8 voxels
            self.assertLessEqual(line["low"][axis], box["low"][axis] + 0.51 * side)
            self.assertGreater(line["low"][axis], box["low"][axis] - 9 * side)
            self.assertGreaterEqual(line["high"][axis], box["high"][axis] - 0.51 * side)
            self.assertLess(line["high"][axis], box["high"][axis] + 9 * side)
        self.assertGreater(line["mean"][0], 0) # it glows

    def test_a_file_without_densities_is_an_error_that_names_it(self):
        path = self.write("no.vdb", "nothing")
        words = ["blender", "--background", "--factory-startup", "--python-exit-code", "1", "--python", str(SCRIPT), "--", str(path),
                 str(self.folder / "o.exr"), "--view", "0,0,1,0,0,0,20"]
        done = subprocess.run(words, capture_output=True, text=True, check=False, timeout=300)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("no.vdb", done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main()
