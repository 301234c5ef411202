#!/usr/bin/env python3
"""fx verify and fx accuracy: fields, exit codes, files, refusals, interruption."""
import csv
import json
import signal
import subprocess
import unittest

from fx_program import FX, PATIENCE, FxTest, fx, wait_until_it_heeds_interrupts

CASES = ["sod", "sedov", "noh", "evrard", "kelvin-helmholtz", "blast-wave"]
FIELDS = {
    "case", "particles", "neighbors", "kernel", "precision", "steps_mode", "time", "l1_density", "l1_velocity",
    "l1_pressure", "shock_radius", "shock_radius_exact", "energy_drift", "momentum_drift", "steps", "pairs",
    "ns_per_particle_step", "ns_per_pair", "wall_s", "hash", "machine", "version", "threads", "calibration",
}
ACCURACY_FIELDS = {
    "technique", "scene", "setting", "tier", "parameters", "error_p50", "error_p99", "error_max", "bias", "time_ratio",
    "baseline", "ns_per_item", "instructions", "work", "machine", "version", "threads", "calibration",
}
SMALL = ["sedov", "--particles", "10^3", "--time", "0.01"]


class FxVerify(FxTest):
    def verify(self, *arguments):
        outcome = fx("verify", *arguments, "--json")
        self.assertEqual(outcome.code, 0, outcome.err)
        lines = outcome.out.strip().split("\n")
        self.assertEqual(len(lines), 1)
        return json.loads(lines[0])

    def check_usage(self, *arguments, expected):
        outcome = fx(*arguments)
        self.assertEqual((outcome.code, outcome.out), (2, ""), outcome.err)
        self.assertIn(expected, outcome.err)

    def test_the_report_has_every_field(self):
        report = self.verify(*SMALL)
        self.assertEqual(FIELDS - set(report), set())
        self.assertEqual((report["case"], report["particles"], report["steps_mode"]), ("sedov", 1000, "block"))
        self.assertAlmostEqual(report["time"], 0.01)
        self.assertGreater(report["ns_per_particle_step"], report["ns_per_pair"])
        self.assertRegex(report["hash"], "^0x[0-9a-f]{16}$")

    def test_options_are_told_and_obeyed(self):
        report = self.verify(*SMALL, "--steps", "global", "--precision", "double", "--kernel", "wendland-c4",
                             "--neighbors", "90", "--courant", "0.15", "--threads", "1")
        self.assertEqual([report[key] for key in ("steps_mode", "precision", "kernel", "neighbors", "courant", "threads")],
                         ["global", "double", "wendland-c4", 90, 0.15, 1])
        self.assertEqual(report["particle_steps"], report["steps"] * report["particles"])
        self.assertLess(report["momentum_drift"], 1e-12)

    def test_every_case_runs_a_little(self):
        for case in CASES:
            with self.subTest(case):
                report = self.verify(case, "--particles", "2000", "--time", "1e-5")
                self.assertEqual(report["case"], case)

    def test_the_state_does_not_depend_on_threads(self):
        hashes = {self.verify(*SMALL, "--threads", threads)["hash"] for threads in (1, 2, 3)}
        self.assertEqual(len(hashes), 1)

    def test_the_profile_is_one_row_a_particle(self):
        path = self.folder / "profile.csv"
        self.verify(*SMALL, "--csv", path)
        with open(path, newline="") as file:
            rows = list(csv.reader(file))
        self.assertEqual(rows[0], ["r[m]", "rho[kg/m3]", "v[m/s]", "p[Pa]"])
        self.assertEqual(len(rows), 1001)
        self.assertTrue(all(float(row[1]) > 0 for row in rows[1:]))
        self.assertEqual(self.names(), ["profile.csv"])

    def test_the_text_is_a_table(self):
        outcome = fx("verify", *SMALL)
        self.assertEqual(outcome.code, 0)
        for word in ("L1 density", "shock radius", "energy drift", "ns per particle step"):
            self.assertIn(word, outcome.out)
        self.assertEqual(outcome.err, "") # no progress bar without a terminal

    def test_a_misspelt_case_is_told_the_nearest(self):
        self.check_usage("verify", "sedv", expected="did you mean \"sedov\"")
        self.check_usage("verify", "sedov", "--kernel", "wendland-c3", expected="did you mean \"wendland-c2\"")

    def test_nonsense_is_refused(self):
        for option, value in [("--particles", "many"), ("--particles", "7"), ("--particles", "9999^3"),
                              ("--neighbors", "3"), ("--neighbors", "nan"), ("--courant", "0"), ("--time", "-1"),
                              ("--time", "inf"), ("--gamma", "1"), ("--steps", "some"), ("--precision", "half"),
                              ("--threads", "100000")]:
            with self.subTest(f"{option} {value}"):
                self.check_usage("verify", "sedov", option, value, expected=option)
        self.check_usage("verify", expected="CASE")

    def test_an_unwritable_profile_fails(self):
        outcome = fx("verify", *SMALL, "--csv", self.folder / "missing" / "p.csv")
        self.assertEqual(outcome.code, 1)
        self.assertIn("p.csv", outcome.err)

    def test_check_fails_beyond_a_limit(self):
        # Ten particles a side and long steps keep no energy to 2e-4.
        coarse = ["sedov", "--particles", "10^3", "--courant", "1"]
        self.assertEqual(fx("verify", *coarse).code, 0)
        outcome = fx("verify", *coarse, "--check")
        self.assertEqual(outcome.code, 1)
        self.assertIn("BEYOND", outcome.out)

    def test_an_interrupted_run_ends_soon_and_leaves_nothing(self):
        path = self.folder / "profile.csv"
        process = subprocess.Popen([FX, "verify", "noh", "--particles", "64^3", "--csv", str(path)],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        wait_until_it_heeds_interrupts(process)
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=PATIENCE)
        self.assertEqual(process.returncode, 130)
        self.assertIn(b"interrupted", err)
        self.assertEqual(self.names(), [])


class FxAccuracy(FxTest):
    def test_every_setting_is_measured_against_the_first(self):
        table, plot = self.folder / "curve.csv", self.folder / "curve.svg"
        outcome = fx("accuracy", "sph", "--particles", "2048", "--repeat", "1", "--csv", table, "--svg", plot, "--json")
        self.assertEqual(outcome.code, 0, outcome.err)
        lines = [json.loads(line) for line in outcome.out.strip().split("\n")]
        self.assertGreaterEqual(len(lines), 10)
        for line in lines:
            self.assertEqual(ACCURACY_FIELDS - set(line), set())
            self.assertLessEqual(line["error_p50"], line["error_p99"])
            self.assertLessEqual(line["error_p99"], line["error_max"])
        self.assertEqual((lines[0]["setting"], lines[0]["time_ratio"]), (lines[0]["baseline"], 1))
        self.assertTrue(any(line["front"] for line in lines))
        work = {line["setting"]: line["work"]["particle_steps"] for line in lines}
        self.assertGreater(work["global steps"], work["default"])
        self.assertEqual(len(table.read_text().strip().split("\n")), len(lines) + 2)
        self.assertTrue(plot.read_text().startswith("<svg") and plot.read_text().endswith("</svg>\n"))

    def test_unknown_names_are_refused(self):
        for arguments, expected in [(["spf"], "did you mean \"sph\""), (["sph", "--scene", "sedof"], "did you mean \"sedov\""),
                                    (["sph", "--repeat", "0"], "--repeat"), (["sph", "--particles", "3"], "--particles")]:
            outcome = fx("accuracy", *arguments)
            self.assertEqual((outcome.code, outcome.out), (2, ""))
            self.assertIn(expected, outcome.err)


if __name__ == "__main__":
    unittest.main()
