#!/usr/bin/env python3
"""fx bench particles, sort, emit: fields, hashes and refusals. No time decides."""
import json
import unittest

from fx_program import FxTest, fx


def rows(*arguments):
    outcome = fx("bench", *arguments, "--json")
    assert outcome.code == 0, outcome.err
    return [json.loads(line) for line in outcome.out.splitlines()]


class Bench(FxTest):
    def test_all_orders_of_the_same_distances_have_the_same_hash(self):
        found = {row["variant"]: row for row in rows("sort", "--count", "3000", "--steps", "2")}
        self.assertEqual(found["standard"]["hash"], found["random"]["hash"])
        self.assertEqual(found["radix"]["hash"], found["random"]["hash"])
        self.assertEqual(found["standard"]["hash"], found["same"]["hash"])
        self.assertNotEqual(found["standard"]["hash"], found["hundredth-moved"]["hash"])
        self.assertNotEqual(int(found["standard"]["hash"], 16), 0)
        wrong = fx("bench", "sort", "--count", "300", "--steps", "1", "--variant", "standard", "--validate-hash", "0")
        self.assertEqual(wrong.code, 1)

    def test_bytes_are_told_and_compared_with_a_copy_of_as_many(self):
        for name in ("particles", "emit", "sort"):
            for row in rows(name, "--count", "2000", "--steps", "20"):
                self.assertGreater(row["bytes_per_particle"], 0, row)
                self.assertGreater(row["bandwidth_fraction"], 0, row)

    def test_frames_have_bytes_and_a_hash_that_can_be_validated(self):
        arguments = ("frame", "--count", "500", "--steps", "2", "--variant", "unsorted")
        (row,) = rows(*arguments)
        self.assertGreater(row["bytes_per_particle"], 0)
        self.assertEqual(fx("bench", *arguments, "--validate-hash", row["hash"]).code, 0)
        self.assertEqual(fx("bench", *arguments, "--validate-hash", "1").code, 1)

    def test_blocks_in_parts_of_a_picture_look_as_their_balls_in_the_light_of_the_whole_picture(self):
        # Without the shadows of what is beside the parts, PSNR is 32 dB, and the light differs by 2 %.
        outcome = fx("bench", "blocks", "--small", "--crops", "8", "--block-error", "0", "--json")
        self.assertEqual(outcome.code, 0, outcome.err)
        row = json.loads(outcome.out)
        self.assertEqual((row["crops"], row["crop_width"], row["crop_height"]), (8, 8, 5))
        self.assertGreater(row["count"], 65536)  # so many that blocks beside the parts cast shadows of single balls
        self.assertGreater(row["crop_balls"], 0)
        self.assertLess(row["crop_balls"], 8 * row["count"] // 20)
        self.assertGreater(row["psnr_whole"], 60.0)
        self.assertGreater(row["psnr"], 37.0)
        self.assertLess(abs(row["brighter"]), 0.01)
        for name in ("blocks", "particles_per_block", "ms_blocks", "ms_single", "ms_blocks_animated", "bytes"):
            self.assertGreater(row[name], 0, name)

    def test_options_without_effect_are_refused(self):
        picture = self.folder / "a.svg"
        for arguments in (["sort", "--threads", "2"], ["frame", "--threads", "2"], ["emit", "--gpu"],
                          ["--threads", "2", "emit"], ["--plot", picture, "emit"], ["--plot", self.folder / "a.png"],
                          ["--threads", "2"], ["--most", "3000"], ["--plot", picture, "--most", "10"]):
            self.assertEqual(fx("bench", *arguments).code, 2, arguments)
        self.assertEqual(self.names(), [])


if __name__ == "__main__":
    unittest.main()
