#!/usr/bin/env python3
"""Volumes on voxels: fx import --bricks, and pictures by OpenGL against the ray integral of the same voxels."""
import json
import os
import unittest

from exr_planes import read_planes
from fx_program import FxTest, fx

HAS_OPENVDB = os.environ.get("FX_HAS_OPENVDB", "1") == "1"
VOLUME = os.environ.get("FX_VOLUME") # a *.vdb; for the figures of docs/howto/volumes.md
SCALES = os.environ.get("FX_DENSITY_SCALES", "1").split(",")
SIZE = os.environ.get("FX_SIZE", "64x96") # pixels are no larger than voxels, which would be replaced by coarser ones
VIEWS = {"front": (0, 0, 1), "side": (1, 0, 0), "above": (0.6, 0.6, 0.53)}
HEADER = "x[m],y[m],z[m],radius[m],tau_area[m2],albedo,er,eg,eb"
LIT = {"sunDirection": [-0.9, 0.35, 0.1], "sunIlluminance": [60000, 57000, 50000], "skyLuminance": [0, 0, 0], "groundAlbedo": 0}
DARK = {"sunDirection": [0, 1, 0], "sunIlluminance": [0, 0, 0], "skyLuminance": [0, 0, 0], "groundAlbedo": 0}


def percentile(values, share):
    return sorted(values)[min(int(share * len(values)), len(values) - 1)]


@unittest.skipUnless(HAS_OPENVDB, "fx was built without OpenVDB")
class Volume(FxTest):
    def export(self, source, *arguments):
        path = self.folder / "a.vdb"
        outcome = fx("export", source, "-o", path, *arguments)
        self.assertEqual(outcome.code, 0, outcome.err)
        return path

    def bricks(self, volume, *arguments):
        preset = self.folder / "bricks.fx.json"
        outcome = fx("import", volume, "-o", preset, "--bricks", "--json", *arguments)
        self.assertEqual(outcome.code, 0, outcome.err)
        return preset, json.loads(outcome.out)

    def scene(self, line, lighting, direction=(0, 0, 1), rotation=None):
        """The volume alone, seen along a direction from 1.6 times its size."""
        middle = [0.5 * (a + b) for a, b in zip(line["low"], line["high"])]
        size = max(b - a for a, b in zip(line["low"], line["high"]))
        eye = [m + 1.6 * size * d for m, d in zip(middle, direction)]
        instance = {"preset": "bricks.fx.json", "position": [0, 0, 0]}
        if rotation:
            instance["rotation"] = rotation
        return self.write("a.scene.json", json.dumps({
            "version": 1, "name": "a", "camera": {"position": eye, "target": middle, "fovYDegrees": 42},
            "exposureEv100": 13, "lighting": lighting, "composition": "volume", "instances": [instance]}))

    def planes(self, scene, renderer, *arguments):
        path = self.folder / f"{renderer}.exr"
        outcome = fx("render", scene, "--renderer", renderer, "--size", SIZE, "--time", 0, "-o", path, *arguments)
        self.assertEqual(outcome.code, 0, outcome.err)
        _, _, planes = read_planes(path)
        return planes

    def test_bricks_have_the_mass_of_the_volume(self):
        balls = self.write("a.blobs.csv", f"{HEADER}\n1,2,-3,0.5,2,0,0,0,0\n2,2,-3,0.3,1,0,0,0,0\n")
        _, line = self.bricks(self.export(balls, "--voxel-size", "0.05"))
        self.assertLess(abs(line["mass_error"]), 1e-4)
        self.assertAlmostEqual(line["voxel_side"], 0.05, delta=1e-6)
        self.assertFalse(line["resampled"])
        self.assertEqual(self.names(), ["a.blobs.csv", "a.vdb", "bricks.fx.json", "bricks.fxvolume"])

    def test_opacity_is_the_integral_through_the_voxels(self):
        for scale in SCALES:
            volume = VOLUME or self.export("library:smoke-column", "--time", "4", "--voxels", "40000")
            _, line = self.bricks(volume, "--density-scale", scale)
            for name, direction in VIEWS.items():
                scene = self.scene(line, DARK, direction)
                exact = self.planes(scene, "reference", "--scattering", "none")
                drawn = self.planes(scene, "gl")
                errors = [abs(a - b) for a, b in zip(drawn["smoke.A"], exact["smoke.A"])]
                p99, largest = percentile(errors, 0.99), max(exact["smoke.A"])
                print(f"density {scale}, {name}: largest {largest:.3f}, p99 {p99 / largest:.5f}, "
                      f"mean {sum(errors) / len(errors):.6f}, largest error {max(errors):.4f}", flush=True)
                self.assertLess(p99, 0.01 * largest)

    def test_a_damaged_file_is_named(self):
        balls = self.write("a.blobs.csv", f"{HEADER}\n1,2,-3,0.5,2,0,0,0,0\n")
        preset, _ = self.bricks(self.export(balls, "--voxel-size", "0.1"))
        path = self.folder / "bricks.fxvolume"
        data = bytearray(path.read_bytes())
        data[-1] ^= 1
        path.write_bytes(data)
        outcome = fx("validate", preset)
        self.assertNotEqual(outcome.code, 0)
        self.assertIn("bricks.fxvolume", outcome.err + outcome.out)
        self.assertIn("damaged", outcome.err + outcome.out)


if __name__ == "__main__":
    unittest.main()
