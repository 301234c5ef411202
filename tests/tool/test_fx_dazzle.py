#!/usr/bin/env python3
"""fx dazzle: from EXR to EXR, exit codes, what it refuses."""
import json
import unittest

from fx_program import FxTest, fx


class FxDazzle(FxTest):
    def setUp(self):
        super().setUp()
        self.picture = self.write("balls.exr", b"")
        blobs = self.write("balls.blobs.csv", "x[m],y[m],z[m],radius[m],tau_area[m2],albedo,er,eg,eb\n"
                                              "0,0,0,1,6,0,3,1,0.2\n")
        outcome = fx("render", blobs, "--renderer", "reference", "-o", self.picture, "--size", "48x32", "--view",
                     "0,0,5,0,0,0,40")
        self.assertEqual(outcome.code, 0, outcome.err)
        self.out = self.folder / "out.exr"

    def test_light_above_white_becomes_glare(self):
        outcome = fx("dazzle", self.picture, "-o", self.out, "--sensor", "1,0,1", "--white", "0.5", "--json")
        self.assertEqual(outcome.code, 0, outcome.err)
        line = json.loads(outcome.out)
        self.assertEqual((line["width"], line["height"], line["sensor"], line["white"]), (48, 32, [1, 0, 1], 0.5))
        self.assertGreater(line["overflow"][0], line["overflow"][2])
        again = json.loads(fx("dazzle", self.out, "-o", self.folder / "2.exr", "--white", "0.5", "--json").out)
        self.assertEqual(again["overflow"], [0, 0, 0]) # nothing is above white any more

    def test_the_same_twice_is_the_same_file(self):
        for name in ("1.exr", "2.exr"):
            self.assertEqual(fx("dazzle", self.picture, "-o", self.folder / name, "--sensor", "0.3,0.5,2", "--white", "1").code, 0)
        self.assertTrue((self.folder / "1.exr").read_bytes() == (self.folder / "2.exr").read_bytes())

    def test_the_papers_levels_are_an_algorithm_of_their_own(self):
        both = [fx("dazzle", self.picture, "-o", self.folder / f"{name}.exr", "--algorithm", name, "--white", "0.5").code
                for name in ("exact", "paper8")]
        self.assertEqual(both, [0, 0])
        self.assertTrue((self.folder / "exact.exr").read_bytes() != (self.folder / "paper8.exr").read_bytes())

    def test_nonsense_is_refused_and_leaves_nothing(self):
        before = self.names()
        for arguments, expected, code in [
                (["--sensor", "1,2"], "--sensor", 2), (["--sensor", "0,1,1"], "less glare", 2), (["--white", "-1"], "white", 2),
                (["--algorithm", "paper9"], "paper8", 2)]:
            outcome = fx("dazzle", self.picture, "-o", self.out, *arguments)
            self.assertEqual(outcome.code, code, arguments)
            self.assertIn(expected, outcome.err)
        self.assertEqual(fx("dazzle", self.picture, "-o", self.folder / "out.png").code, 2)
        self.assertEqual(fx("dazzle", self.folder / "none.exr", "-o", self.out).code, 1)
        self.assertEqual(fx("dazzle", self.write("bad.exr", "no picture"), "-o", self.out).code, 1)
        self.assertEqual(self.names(), sorted(before + ["bad.exr"]))

    def test_a_folder_that_is_not_there_is_named(self):
        outcome = fx("dazzle", self.picture, "-o", self.folder / "missing" / "out.exr")
        self.assertEqual(outcome.code, 1)
        self.assertIn("out.exr", outcome.err)


if __name__ == "__main__":
    unittest.main()
