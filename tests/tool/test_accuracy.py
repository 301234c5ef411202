#!/usr/bin/env python3
"""fx accuracy of the techniques that need no gas: what they promise, the files they write, what they refuse."""
import json
import os
import shutil
import subprocess
import unittest

from fx_program import FxTest, fx

FIELDS = {"technique", "scene", "setting", "tier", "parameters", "error_p50", "error_p99", "error_max", "bias", "time_ratio",
          "baseline", "ns_per_item", "instructions", "work", "machine", "version", "commit", "threads", "calibration"}
QUICK = ["--repeat", "1", "--no-callgrind", "--json"]


def valgrind_runs_fx():
    """On processors with instructions that it does not know it cannot."""
    command = ["valgrind", "--tool=none", os.environ["FX_PROGRAM"], "--version"]
    return shutil.which("valgrind") is not None and subprocess.run(command, capture_output=True).returncode == 0


def lines_of(*arguments):
    outcome = fx("accuracy", *arguments)
    assert outcome.code == 0, outcome.err
    return [json.loads(line) for line in outcome.out.strip().split("\n")]


def by_setting(lines):
    return {line["setting"]: line for line in lines}


class FxAccuracyOfFits(FxTest):
    def test_steps_make_errors_smaller_and_mass_is_kept(self):
        lines = by_setting(lines_of("fit", *QUICK))
        self.assertEqual(len(lines), 12)
        for line in lines.values():
            self.assertLess(abs(line["work"]["mass_error"]), 1e-9)
            self.assertLessEqual(line["work"]["balls"], line["parameters"]["balls"])
        for count in (100, 1000, 10000):
            errors = {form: lines[f"{form}-{count}"]["error_mean"] for form in ("uniform", "adaptive", "optimized-8", "optimized-24")}
            self.assertLess(errors["optimized-24"], errors["optimized-8"], count)
            self.assertLess(errors["optimized-24"], 0.5 * min(errors["uniform"], errors["adaptive"]), count)
        self.assertLess(lines["optimized-24-10000"]["error_mean"], 0.05)


class FxAccuracyOfGrids(FxTest):
    def test_voxels_are_exact_and_coarser_ones_are_not(self):
        lines = by_setting(lines_of("grid", "--scene", "tau-5-small", *QUICK))
        exact = lines["volume"]["error_p99"]
        self.assertLess(exact, 0.02)
        for control in ("volume-half", "volume-quarter", "sorted", "slabs-6", "slabs-16"):
            self.assertGreater(lines[control]["error_p99"], 10 * exact, control)
        for line in lines.values():
            self.assertGreater(line["work"]["covered"], 400)


class FxAccuracyOfImpostors(FxTest):
    def test_usual_tiles_are_within_a_level_of_gray_and_coarse_ones_are_not(self):
        lines = by_setting(lines_of("impostors", "--scene", "size-48-small", *QUICK))
        self.assertLess(lines["balls"]["error_max"], 1e-4)  # the reference and the view draw the same balls
        self.assertEqual(lines["balls"]["work"]["impostors"], 0)
        self.assertEqual(lines["default"]["work"]["impostors"], 1)
        self.assertEqual(lines["default"]["work"]["share_within_limit"], 1.0)
        self.assertEqual(lines["parallax-2"]["work"]["share_within_limit"], 0.0)
        self.assertGreater(lines["resolution-0.5"]["work"]["rmse"], 1.5 * lines["default"]["work"]["rmse"])

    def test_random_blocks_are_impostors_where_these_are_within_a_level_of_gray(self):
        lines = by_setting(lines_of("impostors", "--scene", "cases", "--cases", "100", *QUICK))
        for line in lines.values():
            self.assertEqual((line["parameters"]["cases"], line["work"]["pictures"]), (100, 100))
        chosen, any_error = lines["error-1"]["work"], lines["any-error"]["work"]
        self.assertGreaterEqual(chosen["impostor_pictures"], 40)
        self.assertGreaterEqual(chosen["impostor_share_within_error"], 0.99)
        self.assertGreaterEqual(lines["default"]["work"]["impostor_pictures"], chosen["impostor_pictures"] + 20)
        self.assertEqual(any_error["impostor_pictures"], 100)  # a control: the error is not limited
        self.assertLess(any_error["impostor_share_within_error"], 0.5)


class FxAccuracyOfLightSlices(FxTest):
    @classmethod
    def setUpClass(cls):
        cls.lines = lines_of("light-slices", *QUICK)

    def test_parameters_name_light_depth_and_planes(self):
        planes = [line for line in self.lines if line["setting"].startswith("planes-")]
        self.assertEqual(len(planes), 6 * 6)
        for line in planes:
            parameters = line["parameters"]
            self.assertEqual(line["setting"], "planes-%d" % parameters["planes"])
            self.assertEqual(line["scene"], "%s-tau-%g" % (parameters["light"], parameters["tau"]))
            self.assertLessEqual(line["error_p50"], line["error_max"])

    def test_32_planes_are_exact_enough(self):
        for line in self.lines:
            if line["setting"] == "planes-32":
                self.assertLessEqual(line["error_mean"], {1: 1e-3, 10: 1e-2}[line["parameters"]["tau"]], line["scene"])

    def test_errors_fall_with_the_square_of_the_number_of_planes(self):
        for line in self.lines:
            if line["setting"] == "planes-32":
                self.assertAlmostEqual(line["work"]["order_mean"], 2.0, delta=0.2, msg=line["scene"])
                self.assertAlmostEqual(line["work"]["order_max"], 2.0, delta=0.2, msg=line["scene"])

    def test_texels_have_no_part_in_the_error_of_planes(self):
        for line in self.lines:
            if line["setting"].startswith("planes-"):
                self.assertLess(line["work"]["change_with_half_texels"], 0.1, line["scene"] + " " + line["setting"])


class FxAccuracyOfNetworks(FxTest):
    def test_light_in_cells_is_nearer_to_paths_than_the_closed_form(self):
        settings = by_setting(lines_of("network", "--scene", "side-5-small", *QUICK))
        closed, network = settings["closed-form"]["work"], settings["network-48-26-9"]["work"]
        for case in (name for name in closed if name.startswith("rmse")):
            self.assertLess(network[case], closed[case] / 2, case)
            self.assertLess(network[case], 0.08, case)
        self.assertLess(settings["moving-2-sweeps"]["error_mean"], 1.2 * settings["network-32-26-9"]["error_mean"] + 0.01)
        self.assertGreater(settings["cold-2-sweeps"]["error_mean"], 0.2)
        for name in ("particles-64", "particles-64-segments", "particles-128-segments"):
            particles = settings[name]["work"]
            for case in (case for case in closed if case.startswith("rmse")):
                self.assertLess(particles[case], 0.85 * closed[case], name + " " + case)
        self.assertGreater(settings["particles-64-segments"]["work"]["links"], 2 * settings["particles-64"]["work"]["links"])
        # paths take longer for a smaller error
        self.assertGreater(network["seconds_paths"], 10 * settings["single"]["work"]["seconds_paths"]) # of errors 10 times as large
        self.assertAlmostEqual(network["times_faster"], network["seconds_paths"] / network["seconds_pictures"], 6)


class FxAccuracyOfLitMedia(FxTest):
    def test_light_that_is_scattered_once_is_that_of_exact_shadow_rays(self):
        names = by_setting(lines_of("light", "--scene", "blobs-270-small", *QUICK))
        error = {name: line["work"]["error_rms"] for name, line in names.items()}
        self.assertLess(error["single-sun"], 0.012) # 0.02 if each blob is lit as if it were alone at its place
        self.assertLess(error["single-sun-fine"], 0.012)
        self.assertLess(error["single-sun-slabs"], 0.006) # balls are summed before they are lit
        self.assertLess(error["single-sun-slabs-64"], 0.006)
        self.assertLess(error["single"], 0.07) # 0.13 if light of the sky were scattered alike in all directions
        self.assertLess(error["multiple"], 0.15)
        self.assertGreater(error["single-sun-no-slices"], 0.5) # the shadow matters
        self.assertGreater(error["single-no-slices"], 0.5)

    def test_the_light_of_clouds_is_that_of_paths_on_all_sides(self):
        lines = lines_of("light", "--scene", "clouds-small", *QUICK)
        self.assertEqual(len(lines), 4)
        for line in lines:
            self.assertLess(line["error_max"], 0.25, line["setting"])
            self.assertGreater(line["work"]["sunward"], 0)


class FxAccuracyOfFlights(FxTest):
    def flight(self, scene, *arguments):
        outcome = fx("accuracy", "flights", "--scene", scene, *QUICK, *arguments)
        return outcome.code, by_setting([json.loads(line) for line in outcome.out.strip().split("\n")])

    def test_sums_change_no_more_than_the_scene_and_balls_one_over_the_other_jump(self):
        code, names = self.flight("balls-orbit", "--frames", "40", "--size", "48x27")
        for setting in ("slabs-6", "slabs-16", "volume-64", "volume-128"):
            self.assertEqual(names[setting]["work"]["pairs_beyond"], 0)
            # 64 voxels are coarse for these balls: rays step over their rims at places that differ from frame to frame
            self.assertAlmostEqual(names[setting]["work"]["change_ratio"], 1.0, delta=0.15 if setting == "volume-64" else 0.05)
            self.assertAlmostEqual(names[setting]["work"]["brightness_ratio"], 1.0, delta=0.05)
        self.assertGreater(names["sorted"]["work"]["pairs_beyond"], 0) # the control
        self.assertEqual(code, 0)

    def test_light_slices_change_no_more_than_exact_light_and_without_snapping_they_do(self):
        for scene in ("light-sweep", "light-dolly-across", "light-dolly-into"):
            code, names = self.flight(scene, "--frames", "40", "--size", "48x27")
            self.assertEqual(names["slices"]["work"]["pairs_beyond"], 0, scene)
            self.assertLess(names["slices"]["error_max"], 1.0, scene)
            self.assertAlmostEqual(names["slices"]["work"]["brightness_ratio"], 1.0, delta=0.03, msg=scene)
            self.assertGreater(names["slices-not-snapped"]["work"]["pairs_beyond"], 10, scene) # the control
            self.assertEqual(code, 0, scene)

    def block_flight(self, scene, *arguments):
        outcome = fx("accuracy", "block-flights", "--scene", scene, *QUICK, *arguments)
        return outcome.code, by_setting([json.loads(line) for line in outcome.out.strip().split("\n")])

    def test_impostors_around_which_an_eye_flies_change_no_more_than_their_balls_and_drawn_in_turn_they_do(self):
        code, names = self.block_flight("cumulus-orbit", "--frames", "3", "--size", "96x54")
        self.assertEqual(names["impostors"]["work"]["pairs_beyond"], 0)
        self.assertLess(names["impostors"]["work"]["jump"], 0.02)
        self.assertGreater(names["impostors"]["work"]["impostors_per_frame"], 50)
        self.assertGreater(names["in-turn"]["work"]["pairs_beyond"], 0) # the control
        self.assertEqual(code, 0)

    def test_blocks_through_which_an_eye_flies_become_balls_unseen_and_all_at_once_they_do_not(self):
        code, names = self.block_flight("cumulus-through", "--frames", "8")
        impostors, control = names["impostors"]["work"], names["at-once"]["work"]
        self.assertEqual(impostors["pairs_beyond"], 0)
        self.assertLess(max(impostors["jump"], impostors["switch"]), 0.02)
        self.assertGreater(impostors["switch"], 0.002) # blocks pass the switch in these frames
        self.assertLess(impostors["impostors_last"], impostors["impostors_first"])
        self.assertGreater(control["pairs_beyond"], 0)
        self.assertGreater(min(control["jump"], control["switch"]), 0.02)
        self.assertEqual(code, 0)

    def test_blocks_in_each_other_look_the_same_in_both_orders_and_balls_one_over_the_other_do_not(self):
        code, names = self.block_flight("twins-order")
        for setting in ("impostors", "any-error", "balls"):
            self.assertLess(names[setting]["error_max"], 1 / 1023, setting)
        for setting in ("impostors", "any-error"):
            self.assertGreater(names[setting]["work"]["impostors_per_view"], 20, setting)
        self.assertGreater(names["sorted"]["error_max"], 0.1) # the control
        self.assertEqual(code, 0)

    def test_a_control_that_keeps_a_generous_bound_is_a_failure(self):
        code, names = self.flight("light-sweep", "--frames", "10", "--size", "32x18", "--bound", "50")
        self.assertEqual(code, 1)
        self.assertFalse(names["slices-not-snapped"]["as_promised"])
        self.assertTrue(names["slices"]["as_promised"])


class FxAccuracyOfLight(FxTest):
    @classmethod
    def setUpClass(cls):
        cls.integral = lines_of("ray-integral", *QUICK)
        cls.billboards = lines_of("billboards", *QUICK)

    def at_depth(self, tau):
        return [line for line in self.integral if line["parameters"]["tau"] == tau]

    def test_the_ray_integral_runs_at_four_depths_with_every_field(self):
        lines = self.integral
        self.assertEqual({line["parameters"]["tau"] for line in lines}, {0.1, 1, 10, 100})
        for line in lines:
            self.assertEqual(FIELDS - set(line), set())
            self.assertEqual(line["baseline"], "paper-1")
            self.assertLessEqual(line["error_p50"], line["error_p99"])
            self.assertLessEqual(line["error_p99"], line["error_max"])
        for tau in (0.1, 1, 10, 100):
            names = by_setting(self.at_depth(tau))
            self.assertLessEqual({"paper-1", "paper-4", "simpson-4", "march-0.01", "gauss-5", "gauss-8"}, set(names))
            self.assertEqual((names["gauss-5"]["tier"], names["gauss-8"]["tier"]), ("default", "high"))

    def test_the_default_is_a_hundred_times_better_than_the_paper_and_a_thousand_where_it_is_thick(self):
        for tau, factor in ((1, 100), (100, 1000)):
            names = by_setting(self.at_depth(tau))
            self.assertGreater(names["paper-1"]["error_p99"], factor * names["gauss-5"]["error_p99"])

    @unittest.skipUnless(valgrind_runs_fx(), "valgrind is missing, or cannot run fx on this processor")
    @unittest.skipIf("ASAN_OPTIONS" in os.environ, "valgrind cannot run programs with the address sanitizer")
    def test_instructions_are_counted_where_valgrind_is_there(self):
        names = by_setting(lines_of("ray-integral", "--scene", "tau-1", "--repeat", "1", "--json"))
        self.assertIn(names["paper-1"]["instructions_by"], ("perf", "callgrind"))
        self.assertGreater(names["paper-1"]["instructions"], 1e6)
        self.assertLess(names["gauss-5"]["instructions"], 1.3 * names["paper-1"]["instructions"])
        self.assertGreater(names["paper-16"]["instructions"], 4 * names["paper-1"]["instructions"]) # sees the work

    def test_the_furnace_keeps_its_light(self):
        lines = lines_of("furnace", *QUICK)
        for precision, setting, limit in (("float", "gauss-5", 1e-3), ("float", "gauss-8", 1e-4), ("double", "gauss-8", 2e-5)):
            line = by_setting([l for l in lines if l["scene"] == precision])[setting]
            self.assertLessEqual(line["error_max"], limit, (precision, setting))
            self.assertLessEqual(line["work"]["excess"], 2e-4)
        paper = by_setting([l for l in lines if l["scene"] == "double"])["paper-1"]
        self.assertGreater(paper["error_max"], 0.5) # the sweep is hard enough to tell

    def test_kernel_billboards_are_exact_alone_and_wrong_where_they_overlap(self):
        error = {(line["scene"], line["setting"]): line["error_p99"] for line in self.billboards}
        for count in (1, 10, 270):
            self.assertLess(error[f"isolated-{count}", "kernel"], 1e-4)
            self.assertGreater(error[f"isolated-{count}", "constant"], 0.1)
        self.assertGreater(error["isolated-10", "planar"], 0.01) # cards meet the ground
        for count in (10, 270):
            self.assertGreater(error[f"overlapping-{count}", "kernel"], 0.01)
            self.assertGreater(error[f"sorted-wrong-{count}", "kernel"], 2 * error[f"overlapping-{count}", "kernel"])
            self.assertLess(error[f"overlapping-{count}", "gauss-5"], 1e-3)
            self.assertLess(error[f"sorted-wrong-{count}", "gauss-5"], 1e-3) # the integral knows no order

    def test_slabs_are_the_integral_in_any_order(self):
        error = {(line["scene"], line["setting"]): line["error_p99"] for line in self.billboards}
        for scene in {line["scene"] for line in self.billboards}:
            self.assertLessEqual(error[scene, "slabs-16"], 0.03 if scene.startswith("explosion") else 1e-3)
        for scene in ("overlapping-270", "sorted-wrong-270"):
            self.assertLessEqual(error[scene, "slabs-6"], 0.02)
            self.assertGreater(error[scene, "sorted"], 0.05) # the control

    def test_only_integers_keep_the_light_of_the_dazzle(self):
        lines = lines_of("dazzle", *QUICK)
        created = {(line["scene"], line["setting"]): abs(line["work"]["light_created_per_overflow"]) for line in lines}
        for scene in ("explosion", "gray"):
            self.assertLess(created[scene, "integers"], 1e-4) # parts of a quantum are dropped
            self.assertLess(by_setting([l for l in lines if l["scene"] == scene])["integers"]["error_max"], 1e-6)
        self.assertGreater(created["gray", "paper8-printed"], 0.1)

    def test_paths_by_the_inverse_of_the_depth_have_less_noise_and_the_error_falls_with_their_root(self):
        lines = lines_of("path", "--scene", "blobs-270-small", *QUICK)
        names = by_setting(lines)
        self.assertEqual(lines[0]["baseline"], "delta-64")
        self.assertEqual(names["delta-64"]["efficiency_ratio"], 1.0)
        self.assertGreater(names["delta-64"]["variance"], 2 * names["forced-64"]["variance"])
        self.assertGreater(names["local-64"]["variance"], names["depth-64"]["variance"])
        self.assertGreater(names["delta-64"]["work"]["collisions"], 5 * names["depth-64"]["work"]["collisions"])
        self.assertGreater(names["forced-64"]["efficiency_ratio"], 0) # how large is a matter of time
        self.assertAlmostEqual(names["forced-256"]["work"]["slope"], -0.5, delta=0.08)
        for line in lines:
            self.assertEqual(FIELDS - set(line), set())
            self.assertLess(abs(line["bias"]), 3 * line["error_mean"])

    def test_reports_have_every_curve(self):
        csv, svg, html = (self.folder / name for name in ("a.csv", "a.svg", "a.html"))
        lines = lines_of("furnace", *QUICK, "--csv", csv, "--svg", svg, "--html", html)
        self.assertEqual(len(csv.read_text().strip().split("\n")), len(lines) + 2)
        self.assertEqual(svg.read_text().count("<circle"), len(lines))
        page = html.read_text()
        self.assertTrue(page.startswith("<!DOCTYPE html>") and page.endswith("</html>\n"))
        self.assertIn(lines[0]["commit"], page)
        self.assertIn(lines[0]["machine"]["cpu"].split("(")[0], page)

    def test_work_that_is_the_same_is_reported_the_same(self):
        again = lines_of("ray-integral", "--scene", "tau-10", *QUICK)
        for a, b in zip(self.at_depth(10), again, strict=True):
            self.assertEqual((a["error_p99"], a["error_max"], a["work"]), (b["error_p99"], b["error_max"], b["work"]))

    def test_what_makes_no_sense_is_refused(self):
        for arguments, expected in [(["ray"], "ray-integral"), (["ray-integral", "--scene", "tau-2"], "tau-1"),
                                    (["all", "--scene", "tau-1"], "--scene"), (["furnace", "--threads", "2"], "--threads"),
                                    (["dazzle", "--particles", "4096"], "--particles"), (["dazzle", "--repeat", "0"], "--repeat"),
                                    (["dazzle", "--frames", "9"], "--frames"), (["dazzle", "--cases", "9"], "--cases"), (["flights", "--size", "9"], "--size"),
                                    (["flights", "--bound", "1"], "--bound"), (["flights", "--scene", "smoke-orbi"], "smoke-orbit")]:
            outcome = fx("accuracy", *arguments)
            self.assertEqual((outcome.code, outcome.out), (2, ""), arguments)
            self.assertIn(expected, outcome.err)


if __name__ == "__main__":
    unittest.main()
