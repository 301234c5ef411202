#!/usr/bin/env python3
"""fx import: volumes of OpenVDB, whole and damaged ones."""
import collections
import json
import os
import random
import struct
import unittest

from exr_planes import read_planes
from fx_program import FxTest, fx

HAS_OPENVDB = os.environ.get("FX_HAS_OPENVDB", "1") == "1"
TRIES = int(os.environ.get("FX_DAMAGES", "40")) # 2000 and 4096 for the figures of docs/howto/volumes.md
CUT = int(os.environ.get("FX_CUT", "65536"))    # [byte] between two truncations
SECONDS = 20                                    # [s] of processor time that a file may take
PEAK = 1 << 30                                  # [byte] that a file may take
CHILD_LIMITS = ("--max-memory", "512", "--max-seconds", "5")
HEADER = "x[m],y[m],z[m],radius[m],tau_area[m2],albedo,er,eg,eb"


@unittest.skipIf(HAS_OPENVDB, "fx has OpenVDB")
class WithoutOpenVdb(FxTest):
    def test_the_missing_package_is_named(self):
        outcome = fx("import", self.write("a.vdb", "x"))
        self.assertEqual(outcome.code, 1)
        self.assertIn("libopenvdb-dev", outcome.err)


@unittest.skipUnless(HAS_OPENVDB, "fx was built without OpenVDB")
class Import(FxTest):
    def export(self, name, source="library:explosion", *arguments):
        path = self.folder / name
        outcome = fx("export", source, "-o", path, *arguments)
        self.assertEqual(outcome.code, 0, outcome.err)
        return path

    def test_an_exported_volume_has_the_mass_and_the_place_of_its_balls(self):
        balls = self.write("a.blobs.csv", f"{HEADER}\n1,2,-3,0.5,2,0,0,0,0\n2,2,-3,0.3,1,0,0,0,0\n")
        outcome = fx("import", self.export("a.vdb", balls, "--voxel-size", "0.05"), "--json")
        self.assertEqual(outcome.code, 0, outcome.err)
        line = json.loads(outcome.out)
        self.assertAlmostEqual(line["cross_section"], 3.0, delta=3e-5)
        for at, center in zip(line["center"], (4 / 3, 2, -3)):
            self.assertAlmostEqual(at, center, delta=1e-3)
        self.assertEqual(line["grids"], ["density", "temperature", "flame", "flame_rate", "color", "velocity"])
        for low, high, a, b in zip(line["low"], line["high"], (0.5, 1.5, -3.5), (2.3, 2.5, -2.5)):
            self.assertTrue(a - 0.1 <= low <= a + 0.15 and b - 0.15 <= high <= b + 0.1, (low, high, a, b))

    def test_names_that_do_not_fit_are_answered_with_those_that_are_there(self):
        balls = self.write("a.blobs.csv", f"{HEADER}\n1,2,-3,0.5,2,0,0,0,0\n")
        outcome = fx("import", self.export("a.vdb", balls, "--voxel-size", "0.1"), "--density", "smoke")
        self.assertEqual(outcome.code, 1)
        for name in ('"smoke"', '"density"', '"temperature"', '"flame"', '"v"'):
            self.assertIn(name, outcome.err)

    def test_a_fitted_preset_has_the_mass_and_the_light_of_the_volume(self):
        volume = self.export("a.vdb", "library:explosion", "--time", "0.6", "--voxels", "60000")
        preset = self.folder / "cloud.fx.json"
        outcome = fx("import", volume, "-o", preset, "--fit", "500", "--iterations", "8", "--json")
        self.assertEqual(outcome.code, 0, outcome.err)
        line = json.loads(outcome.out)
        self.assertLessEqual(line["balls"], 500)
        self.assertLess(abs(line["mass_error"]), 1e-3)
        self.assertLess(max(line["view_errors"]), 0.2)
        self.assertEqual(self.names(), ["a.vdb", "cloud.fx.json", "cloud.fxballs"])
        self.assertEqual(fx("validate", preset).code, 0)
        again = fx("import", self.export("b.vdb", preset, "--time", "0", "--voxels", "60000"), "--json")
        self.assertEqual(again.code, 0, again.err)
        back = json.loads(again.out)
        self.assertAlmostEqual(back["cross_section"], line["cross_section"], delta=1e-3 * line["cross_section"])
        # An export leaves out the light that the medium holds back, and large balls hold back more than voxels.
        self.assertLess(back["flame_volume"], 1.02 * line["flame_volume"])
        self.assertGreater(back["flame_volume"], 0.6 * line["flame_volume"])
        for a, b in zip(back["center"], line["center"]):
            self.assertAlmostEqual(a, b, delta=0.02)

    def light(self, instance):
        """Sum of what a picture shows of a medium that the sun lights from behind the eye."""
        scene = self.write("l.scene.json", json.dumps({
            "version": 1, "name": "l", "camera": {"position": [0, 0, 4], "target": [0, 0, 0], "fovYDegrees": 30},
            "exposureEv100": 14, "lighting": {"sunDirection": [0, 0.5, 0.87], "sunIlluminance": [60000, 60000, 60000],
                                              "skyLuminance": [0, 0, 0], "groundAlbedo": 0},
            "instances": [{"position": [0, 0, 0], **instance}]}))
        picture = self.folder / "l.exr"
        outcome = fx("render", scene, "--renderer", "reference", "--size", "32x24", "--scattering", "single", "--samples", "4", "-o", picture)
        self.assertEqual(outcome.code, 0, outcome.err)
        planes = read_planes(picture)[2]
        return sum(sum(planes[c]) for c in "RGB")

    def test_the_mean_cosine_of_scattering_is_kept(self):
        rows = {g: f"0,0,0,0.5,0.2,0.8,0,0,0,{g}\n" for g in (-0.4, 0.0, 0.5)}
        light = {}
        for g, row in rows.items():
            balls = self.write("a.blobs.csv", f"{HEADER},g\n{row}")
            volume = self.export("a.vdb", balls, "--voxel-size", "0.06")
            for kind, arguments in (("volumes", ("--bricks",)), ("clouds", ("--fit", "1"))):
                outcome = fx("import", volume, "-o", self.folder / "a.fx.json", "--json", *arguments)
                self.assertEqual(outcome.code, 0, outcome.err)
                self.assertAlmostEqual(json.loads(outcome.out)["anisotropy"], g)
                preset = json.loads((self.folder / "a.fx.json").read_text())
                self.assertEqual(preset[kind][0].get("anisotropy", 0), g)
                if kind == "volumes":
                    light[g] = self.light({"preset": "a.fx.json"})
        cosine = -0.87 # of the angle by which light is turned, that of the picture's middle
        phase = {g: (1 - g * g) / (1 + g * g - 2 * g * cosine) ** 1.5 for g in rows}
        for g in rows:
            self.assertAlmostEqual(light[g] / light[0.0], phase[g], delta=0.05 * phase[g])
        mixed = self.write("a.blobs.csv", f"{HEADER},g\n{rows[-0.4]}0,0,0,0.5,0.4,0.4,0,0,0,0.5\n")
        outcome = fx("import", self.export("a.vdb", mixed, "--voxel-size", "0.06"), "--json")
        self.assertAlmostEqual(json.loads(outcome.out)["anisotropy"], 0.05) # both scatter as much
        outcome = fx("import", self.folder / "a.vdb", "--json", "--anisotropy", "0.3")
        self.assertEqual(json.loads(outcome.out)["anisotropy"], 0.3)

    def test_a_sequence_has_the_mean_of_the_cosines_of_its_frames(self):
        for number, g in enumerate((0.2, 0.6)):
            balls = self.write("a.blobs.csv", f"{HEADER},g\n0,0,0,0.5,0.2,0.8,0,0,0,{g}\n")
            self.export(f"s.{number:04}.vdb", balls, "--voxel-size", "0.1")
        outcome = fx("import", self.folder / "s.%04d.vdb", "-o", self.folder / "s.fx.json", "--json")
        self.assertEqual(outcome.code, 0, outcome.err)
        self.assertAlmostEqual(json.loads(outcome.out)["anisotropy"], 0.4)
        self.assertEqual(json.loads((self.folder / "s.fx.json").read_text())["volumes"][0]["anisotropy"], 0.4)

    def small_balls(self, volume, *arguments):
        """Of the file beside the voxels that an import writes: 20 numbers a ball and its number, by the numbers."""
        preset = self.folder / "small.fx.json"
        outcome = fx("import", volume, "-o", preset, "--bricks", "--json", *arguments)
        self.assertEqual(outcome.code, 0, outcome.err)
        self.assertEqual(fx("validate", preset).code, 0)
        head, data = (self.folder / "small.0000.fxballs").read_bytes().split(b"data\n", 1)
        self.assertEqual(int(head.split()[-1]), json.loads(outcome.out)["balls_beside"])
        return list(struct.iter_unpack("<20fQ", data))

    def test_small_balls_have_the_scales_of_the_voxels(self):
        balls = self.write("a.blobs.csv", f"{HEADER}\n1,2,-3,0.9,2,0,0,0,0\n2,2,-3,0.03,1,0.5,4,4,4\n3,2,-3,0.03,1,0.5,4,4,4\n")
        volume = self.export("a.vdb", balls, "--voxel-size", "0.1", "--balls-below", "2")
        given = self.small_balls(volume)
        self.assertEqual(len({ball[20] for ball in given}), 2)
        self.assertEqual(sorted(round(ball[0], 4) for ball in given), [2, 3])
        scaled = self.small_balls(volume, "--density-scale", "2", "--flame-scale", "6")
        for before, after in zip(given, scaled):
            self.assertAlmostEqual(after[4], 2 * before[4], delta=1e-5)       # cross section
            self.assertGreater(before[9], 0)
            for a, b in zip(before[9:12], after[9:12]):
                self.assertAlmostEqual(b, 3 * a, delta=1e-4 * a + 1e-12)     # light as opaque medium: flame over density
            self.assertEqual(before[:4] + before[12:], after[:4] + after[12:])

    def test_a_volume_of_small_balls_alone_is_refused_with_the_remedy(self):
        balls = self.write("a.blobs.csv", f"{HEADER}\n2,2,-3,0.03,1,0,0,0,0\n3,2,-3,0.03,1,0,0,0,0\n")
        volume = self.export("a.vdb", balls, "--voxel-size", "0.1", "--balls-below", "2")
        for words in (("--bricks",), ("--fit", "10")):
            outcome = fx("import", volume, "-o", self.folder / "a.fx.json", *words)
            self.assertEqual(outcome.code, 1)
            self.assertIn("--balls-below 0", outcome.err)
            self.assertIn("balls", outcome.err)
        self.assertEqual(self.names(), ["a.blobs.csv", "a.vdb"])

    def test_the_name_of_a_preset_with_small_balls_has_no_percent_sign(self):
        balls = self.write("a.blobs.csv", f"{HEADER}\n1,2,-3,0.9,2,0,0,0,0\n2,2,-3,0.03,1,0,0,0,0\n")
        volume = self.export("a.vdb", balls, "--voxel-size", "0.1", "--balls-below", "2")
        outcome = fx("import", volume, "-o", self.folder / "50%.fx.json", "--bricks")
        self.assertEqual(outcome.code, 1)
        self.assertIn("'%'", outcome.err)
        self.assertEqual(self.names(), ["a.blobs.csv", "a.vdb"])

    def test_names_of_presets_are_checked(self):
        volume = self.export("a.vdb", "library:explosion", "--time", "0.6", "--voxels", "60000")
        self.assertEqual(fx("import", volume, "-o", self.folder / "cloud.json").code, 1)
        self.assertEqual(self.names(), ["a.vdb"])

    def test_damaged_files_are_errors_that_name_the_file(self):
        whole = self.export("whole.vdb", "library:explosion", "--time", "0.6", "--voxels", "60000").read_bytes()
        rng = random.Random(23)

        def damages():
            for size in range(0, len(whole), CUT):
                yield "cut", whole[:size]
            for _ in range(TRIES):
                at = rng.randrange(len(whole) - 16)
                yield "damage", whole[:at] + rng.randbytes(16) + whole[at + 16:]

        counts = collections.Counter()
        peak = 0
        for kind, content in damages():
            path = self.write("damaged.vdb", content)
            outcome = fx("import", path, *CHILD_LIMITS, cpu_seconds=SECONDS)
            counts["tries of " + kind] += 1
            counts["errors of " + kind] += outcome.code == 1
            counts["killed"] += "was stopped by the signal" in outcome.err
            counts["out of time"] += "took more than" in outcome.err
            self.assertIn(outcome.code, (0, 1), outcome.err)
            self.assertTrue(outcome.code == 0 or "damaged.vdb: " in outcome.err, outcome.err)
            self.assertTrue(kind == "damage" or outcome.code == 1, "a truncated file was read")
            self.assertLess(outcome.peak, PEAK)
            peak = max(peak, outcome.peak)
        print(f"{len(whole)} bytes; " + ", ".join(f"{name} {count}" for name, count in sorted(counts.items())) +
              f"; largest memory {peak / 2**20:.0f} MiB")


if __name__ == "__main__":
    unittest.main()
