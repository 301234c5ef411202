#!/usr/bin/env python3
"""fx stability: its lines, its maps, what it refuses, how it stops."""
import os
import signal
import subprocess
import time
import unittest

from fx_program import FX, PATIENCE, FxTest, fx


class FxStability(FxTest):
    def test_all_rows_keep_their_limits_and_their_controls_do_not(self):
        outcome = fx("stability", "-o", self.folder, "--quick", cpu_seconds=PATIENCE)
        lines = outcome.out.strip().split("\n")
        self.assertEqual(outcome.code, 0, outcome.out + outcome.err)
        self.assertEqual([line for line in lines[:-1] if line.split()[1] != "ok" or "control breaks" not in line], [])
        self.assertIn("79 of 79 rows", lines[-1])
        names = self.names()
        self.assertEqual({n[:-4] for n in names if n.endswith(".csv")}, {n[:-4] for n in names if n.endswith(".png")})
        self.assertGreaterEqual(len(names), 2 * 2 * 50) # a sweep and a control each
        for line in lines[:-1]:
            self.assertTrue(any(name.startswith(line.split()[0]) for name in names), line)

    def test_maps_have_axes_and_a_number_for_every_place(self):
        self.assertEqual(fx("stability", "B-06", "-o", self.folder / "new", "--quick").code, 0)
        names = sorted(path.name for path in (self.folder / "new").iterdir())
        self.assertEqual(names, ["B-06-chords-at-the-rim.csv", "B-06-chords-at-the-rim.png",
                                 "B-06-root-of-r-2-h-2.csv", "B-06-root-of-r-2-h-2.png"])
        lines = (self.folder / "new" / names[0]).read_text().strip().split("\n")
        self.assertEqual(lines[3], '"gap / radius","radius [m]","error"')
        self.assertTrue(all(len([float(v) for v in line.split(",")]) == 3 for line in lines[4:]))
        self.assertEqual((self.folder / "new" / names[1]).read_bytes()[:8], b"\x89PNG\r\n\x1a\n")

    def test_rows_are_chosen_by_name_or_kind(self):
        outcome = fx("stability", "H", "R-13", "-o", self.folder, "--quick")
        self.assertEqual([line.split()[0] for line in outcome.out.strip().split("\n")[:-1]],
                         ["R-13", "H-01", "H-02", "H-05", "H-06"])

    def test_the_same_work_gives_the_same_maps(self):
        for name in ("a", "b"):
            self.assertEqual(fx("stability", "R-05", "R-06", "-o", self.folder / name, "--quick").code, 0)
        for path in (self.folder / "a").iterdir():
            self.assertEqual(path.read_bytes(), (self.folder / "b" / path.name).read_bytes(), path.name)

    def test_what_makes_no_sense_is_refused(self):
        for arguments, expected in [(["R-99", "-o", self.folder], "R-16"), (["R-01"], "output"), (["-o"], "output")]:
            outcome = fx("stability", *arguments)
            self.assertEqual((outcome.code, outcome.out), (2, ""), arguments)
            self.assertIn(expected, outcome.err)
        self.assertEqual(self.names(), [])

    def test_a_folder_that_cannot_be_made_is_named(self):
        file = self.write("file", "x")
        outcome = fx("stability", "R-13", "-o", file / "maps", "--quick")
        self.assertEqual(outcome.code, 1)
        self.assertIn(str(file / "maps"), outcome.err)

    def test_an_interrupt_ends_it_and_leaves_whole_files(self):
        process = subprocess.Popen([FX, "stability", "R", "-o", self.folder], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        while not any(name.startswith("R-02") for name in self.names()) and process.poll() is None:
            time.sleep(0.01)
        os.kill(process.pid, signal.SIGINT)
        process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, 130)
        names = self.names()
        files = lambda row, among: sorted(name for name in among if name.startswith(row))
        begun = sorted({name[:4] for name in names})
        whole = self.folder / "whole"
        self.assertEqual(fx("stability", *begun, "-o", whole, "--quick").code, 0)
        for row in begun: # a row has all of its files or none
            self.assertEqual(files(row, names), files(row, (path.name for path in whole.iterdir())))


if __name__ == "__main__":
    unittest.main()
