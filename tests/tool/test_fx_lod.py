#!/usr/bin/env python3
"""fx bench lod: nothing pops in a flight, and the measure sees what does. No time decides."""
import json
import unittest

from fx_program import LONG, FxTest, fx


class FxLod(FxTest):
    def test_no_level_is_seen_to_change_in_a_gentle_flight_and_hard_switches_are(self):
        outcome = fx("bench", "lod", "--check", "--json", "--instances", "24", "--repeats", "1", "--flight", "16" if LONG else "10",
                     "--size", "128")
        self.assertEqual(outcome.code, 0, outcome.err)
        lines = [json.loads(line) for line in outcome.out.strip().split("\n")]
        full = lines[0]
        self.assertEqual((full["flight_pop_most"], full["flight_changed_frames"]), (0, 0))
        self.assertGreater(full["flight_motion_p99"], 0.05, "the flight shows something")
        for line in lines[1:]:
            self.assertEqual(line["flight_small"], not line["hard"])
            self.assertGreater(line["flight_changed_frames"], 0)
            self.assertLess(line["blobs"], full["blobs"])

    def test_a_flight_that_shows_nothing_fails_the_check(self):
        outcome = fx("bench", "lod", "--check", "--instances", "1", "--repeats", "1", "--flight", "0", "--size", "64")
        self.assertEqual(outcome.code, 1)
        self.assertIn("no level has changed", outcome.err)


if __name__ == "__main__":
    unittest.main()
