#!/usr/bin/env python3
"""fx calibrate and fx bench budget: files, fields, refusals. No time decides."""
import json
import unittest

from fx_program import FxTest, fx

BENCH_FIELDS = {
    "benchmark", "quality", "clock", "budget_ms", "frames", "over_share", "longest_over_frames", "switch_share",
    "median_ms", "largest_ms", "estimated_error", "measured_error", "saturated_frames", "machine", "version",
}


class FxBudget(FxTest):
    def test_a_calibration_is_measured_written_and_used(self):
        target = self.folder / "mine.json"
        outcome = fx("calibrate", "-o", target, "--repeat", "1", "--size", "48x32", "--json")
        self.assertEqual(outcome.code, 0, outcome.err)
        lines = [json.loads(line) for line in outcome.out.strip().split("\n")]
        self.assertEqual({line["technique"] for line in lines}, {"media", "media slabs", "media volume", "light slices", "shimmer", "dazzle"})
        file = json.loads(target.read_text())
        self.assertIn("fx ", file["origin"])
        for technique in file["techniques"]:
            steps = technique["steps"]
            self.assertEqual((steps[-1]["cost"], steps[-1]["error"]), (1, 0))
            for low, high in zip(steps, steps[1:]):
                self.assertLess(low["cost"], high["cost"])
                self.assertGreater(low["error"], high["error"])
        outcome = fx("bench", "budget", "--calibration", target, "--frames", "2", "--size", "48x32", "--json")
        self.assertEqual(outcome.code, 0, outcome.err)
        lines = [json.loads(line) for line in outcome.out.strip().split("\n")]
        self.assertEqual([line["quality"] for line in lines], ["controller", "fixed", "naive"])
        for line in lines:
            self.assertEqual(BENCH_FIELDS - set(line), set())
            self.assertEqual(line["frames"], 22)
        self.assertEqual((lines[1]["measured_error"], lines[1]["switch_share"]), (0, 0))

    def test_what_makes_no_sense_is_refused(self):
        for arguments in (["calibrate", "--size", "big"], ["calibrate", "--clock", "sun"], ["calibrate", "--repeat", "0"],
                          ["bench"], ["bench", "budget", "--frames", "0"], ["bench", "budget", "--budget", "-1"]):
            outcome = fx(*arguments)
            self.assertEqual((outcome.code, outcome.out), (2, ""), outcome.err)
            self.assertTrue(outcome.err)

    def test_a_wrong_calibration_is_refused_by_place(self):
        wrong = self.write("wrong.json", '{"version": 1,\n "techniques": [{"name": "media", "steps": []}]}')
        outcome = fx("bench", "budget", "--calibration", wrong)
        self.assertEqual(outcome.code, 1)
        self.assertIn("wrong.json:2:", outcome.err)
        outcome = fx("calibrate", "-o", self.folder / "nowhere" / "file.json")
        self.assertEqual(outcome.code, 1, outcome.err)


if __name__ == "__main__":
    unittest.main()
