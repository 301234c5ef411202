#!/usr/bin/env python3
"""fx render --outputs: instance, motion and depths in EXR files, by OpenGL as by the reference renderer."""
import json
import math
import unittest

from exr_planes import read_planes
from fx_program import FxTest, fx

SMALL = ("--size", "64x48", "--time", "1.5", "--fps", "30")
OUTPUTS = ("id", "motion.X", "motion.Y", "firstDepth.Z", "meanDepth.Z")


def quantile(values, share):
    return sorted(values)[int(share * (len(values) - 1))]


class FxOutputs(FxTest):
    def setUp(self):
        super().setUp()
        self.scene = self.folder / "two.scene.json"
        self.scene.write_text(json.dumps({
            "version": 1, "name": "two", "description": "Two fires, one half behind the other.",
            "camera": {"position": [0, 1, 6], "target": [0, 1, 0], "fovYDegrees": 40},
            "instances": [{"preset": "library:gas-fire", "position": [-0.6, 0, 0], "seed": 1},
                          {"preset": "library:gas-fire", "position": [0.5, 0, -0.7], "seed": 2}]}))

    def planes(self, name, *arguments):
        path = self.folder / f"{name}.exr"
        outcome = fx("render", self.scene, "-o", path, *SMALL, *arguments)
        self.assertEqual(outcome.code, 0, outcome.err)
        return read_planes(path)[2]

    def test_opengl_and_the_reference_agree_in_all_compositions(self):
        exact = self.planes("exact", "--renderer", "reference", "--scattering", "none", "--detail", "off", "--outputs", "id")
        self.assertEqual(set(exact["id"]), {0, 1, 2}, "numbers of the scene's instances")
        seen = [i for i, depth in enumerate(exact["opticalDepth.Y"]) if depth > 0.05]
        self.assertGreater(len(seen), 60)
        for composition in ("sorted", "slabs", "volume"):
            with self.subTest(composition):
                drawn = self.planes(composition, "--composition", composition, "--outputs", "id,motion,depth")
                same = sum(drawn["id"][i] == exact["id"][i] for i in range(len(exact["id"])))
                self.assertGreater(same, 0.97 * len(exact["id"]))
                for name, bound in (("motion.X", 0.1), ("motion.Y", 0.1), ("firstDepth.Z", 0.02), ("meanDepth.Z", 0.02)):
                    errors = [abs(drawn[name][i] - exact[name][i]) for i in seen if math.isfinite(exact[name][i])]
                    self.assertLess(quantile(errors, 0.95), bound, name)
                self.assertGreater(max(abs(v) for v in exact["motion.Y"]), 0.5, "fire rises")

    def test_only_what_is_asked_for_is_written(self):
        plain = self.planes("plain")
        self.assertFalse(set(OUTPUTS) & set(plain))
        motion = self.planes("motion", "--outputs", "motion")
        self.assertEqual(set(motion) - set(plain), {"motion.X", "motion.Y"})
        self.assertEqual(plain["R"], motion["R"], "the picture is the same")

    def test_wrong_names_and_files_are_usage_errors(self):
        for output, names, more in (("a.exr", "ids", ()), ("a.png", "id", ()), ("a.exr", "id", ("--renderer", "path"))):
            outcome = fx("render", self.scene, "-o", self.folder / output, *SMALL, "--outputs", names, *more)
            self.assertEqual(outcome.code, 2, outcome.err)
            self.assertEqual(self.names(), ["two.scene.json"])


if __name__ == "__main__":
    unittest.main()
