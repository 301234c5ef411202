#!/usr/bin/env python3
"""fx render --renderer reference: lists of blobs and presets to EXR, resumed after being killed, on a full disk."""
import json
import math
import os
import random
import resource
import signal
import subprocess
import time
import unittest

from exr_planes import read_planes
from fx_program import FX, PATIENCE, FxTest, fx

HEADER = "x[m],y[m],z[m],radius[m],tau_area[m2],albedo,er,eg,eb\n"
VIEW = ("--renderer", "reference", "--view", "0,0,4,0,0,0,40")


def blobs(count, radius=0.3, seed=1, shift=0.0):
    chance = random.Random(seed)
    lines = [HEADER]
    for _ in range(count):
        # places on a grid of 2^-20 m, which numbers of 1e5 m hold as well
        place = [round(chance.uniform(-1, 1) * 2**20) / 2**20 + shift for _ in range(3)]
        light = [chance.random() for _ in range(3)]
        lines.append(",".join(repr(v) for v in [*place, radius, 4.0 / count, 0.0, *light]) + "\n")
    return "".join(lines)


class FxReference(FxTest):
    def test_a_list_of_blobs_becomes_one_exr_and_nothing_else_stays(self):
        self.write("a.blobs.csv", blobs(20))
        outcome = fx("render", self.folder / "a.blobs.csv", "-o", self.folder / "a.exr", *VIEW, "--size", "64x48", "--json")
        self.assertEqual(outcome.code, 0, outcome.err)
        self.assertEqual(self.names(), ["a.blobs.csv", "a.exr"])
        line = json.loads(outcome.out)
        self.assertEqual((line["blobs"], line["rays"], line["integrator"]), (20, 64 * 48, "gauss-5"))
        self.assertGreater(line["hits"], 1000)

    def test_a_preset_is_rendered_without_a_gpu(self):
        outcome = fx("render", "library:sparks", "-o", self.folder / "a.exr", "--renderer", "reference", "--size", "48x32")
        self.assertEqual(outcome.code, 0, outcome.err)
        self.assertEqual(self.names(), ["a.exr"])

    def test_a_tinted_instance_keeps_red_and_gives_no_light_of_other_colors(self):
        preset = {"version": 1, "ground": False, "emitters": [
            {"emission": {"bursts": [{"time": 0, "count": 12}]}, "shape": "sphere", "size": 0.5, "lifetime": 5, "radius": 0.4,
             "temperature": 1500, "albedoOverLife": [0.3, 0.3, 0.3], "emissionOverLife": [10, 20, 30], "forces": {"gravity": 0}}]}
        self.write("glow.fx.json", json.dumps(preset))
        pictures = {}
        for name, tint in (("plain", [1, 1, 1]), ("red", [1, 0, 0])):
            scene = {"version": 1, "camera": {"position": [0, 0, 4], "target": [0, 0, 0], "fovYDegrees": 40},
                     "instances": [{"preset": "glow.fx.json", "tint": tint}]}
            path = self.write(f"{name}.scene.json", json.dumps(scene))
            outcome = fx("render", path, "-o", self.folder / f"{name}.exr", "--renderer", "reference", "--time", "0.5",
                         "--size", "24x16", "--scattering", "none")
            self.assertEqual(outcome.code, 0, outcome.err)
            pictures[name] = read_planes(self.folder / f"{name}.exr")[2]
        plain, red = pictures["plain"], pictures["red"]
        self.assertGreater(max(plain["R"]), 1.0)
        self.assertGreater(max(plain["G"]), 0.1)
        for a, b in zip(plain["R"], red["R"]):
            self.assertAlmostEqual(a, b, delta=1e-4 * max(plain["R"]))
        self.assertLess(max(red["G"]), 1e-6 * max(plain["G"]))
        self.assertLess(max(red["B"]), 1e-6 * max(plain["B"]))
        self.assertEqual(plain["A"], red["A"])

    def test_detail_of_fields_is_there_where_the_composition_draws_it(self):
        def picture(name, *arguments):
            path = self.folder / f"{name}.exr"
            outcome = fx("render", "library:explosion", "-o", path, "--renderer", "reference", "--scattering", "none",
                         "--time", "0.4", "--size", "32x18", *arguments)
            self.assertEqual(outcome.code, 0, outcome.err)
            return path.read_bytes()
        smooth, detailed = picture("off", "--detail", "off"), picture("on", "--detail", "on")
        self.assertNotEqual(smooth, detailed)
        self.assertEqual(picture("sorted", "--composition", "sorted"), smooth)
        self.assertEqual(picture("volume", "--composition", "volume"), detailed)
        self.assertEqual(picture("preset"), detailed) # the preset asks for volume

    def test_threads_do_not_change_a_bit(self):
        self.write("a.blobs.csv", blobs(20))
        for threads in (1, 3):
            outcome = fx("render", self.folder / "a.blobs.csv", "-o", self.folder / f"{threads}.exr", *VIEW, "--size", "70x50",
                         "--threads", threads)
            self.assertEqual(outcome.code, 0, outcome.err)
        self.assertEqual((self.folder / "1.exr").read_bytes(), (self.folder / "3.exr").read_bytes())

    def test_usage_errors_are_told_before_any_work(self):
        path = self.write("a.blobs.csv", blobs(3))
        for arguments in (("--renderer", "gl"), ("--renderer", "reference"), ("--renderer", "reference", "--view", "1,2"),
                          ("--renderer", "reference", "--view", "1e200,0,0,0,0,0,40"),
                          (*VIEW, "--integrator", "magic"), (*VIEW, "--samples", "0")):
            outcome = fx("render", path, "-o", self.folder / "a.exr", *arguments)
            self.assertEqual(outcome.code, 2, outcome.err)
        self.assertEqual(fx("render", path, "-o", self.folder / "a.png", *VIEW).code, 2)
        self.assertEqual(self.names(), ["a.blobs.csv"])

    def test_a_folder_in_place_of_the_picture_is_told_before_any_work(self):
        path = self.write("a.blobs.csv", blobs(3))
        (self.folder / "a.exr").mkdir()
        outcome = fx("render", path, "-o", self.folder / "a.exr", *VIEW)
        self.assertEqual(outcome.code, 1)
        self.assertIn("it is a folder", outcome.err)
        self.assertEqual(self.names(), ["a.blobs.csv", "a.exr"])

    def test_adaptive_splitting_ends_where_floats_do_not_suffice(self):
        path = self.write("a.blobs.csv", HEADER + "0,0,0,1,1e12,0,1,1,1\n0.1,0,0,1e6,1e12,1,1,0,0\n")
        outcome = fx("render", path, "-o", self.folder / "a.exr", *VIEW, "--size", "9x9", "--precision", "float",
                     "--integrator", "adaptive-0.001")
        self.assertEqual(outcome.code, 0, outcome.err)

    def test_small_and_dense_blobs_beside_large_ones_leave_no_value_that_is_no_number(self):
        extreme = {"beside": "0,0,0,1,1e12,0,1,1,1\n0.1,0,0,1e6,1e12,1,1,0,0\n",
                   "tiny": "0,0,0,1e-150,1e12,0,1,1,1\n0,0,0,1e-100,1e12,0,1e12,0,0\n0,0,-1e12,1e-150,1e12,0,1,1,1\n"}
        for name, lines in extreme.items():
            path = self.write(name + ".blobs.csv", HEADER + lines)
            for scheme in ("gauss-5", "paper-4", "march-0.01", "simpson-4", "positive-4", "adaptive-0.001"):
                for more in ((), ("--precision", "float"), ("--source", "product"), ("--precision", "float", "--source", "product")):
                    size = "9x9" if scheme == "march-0.01" else "33x33" # which takes a million steps
                    outcome = fx("render", path, "-o", self.folder / "a.exr", *VIEW, "--size", size, "--integrator", scheme,
                                 "--json", *more)
                    self.assertEqual((outcome.code, outcome.err), (0, ""))
                    self.assertEqual(json.loads(outcome.out)["nonfinite"], 0, (name, scheme, more))
                    planes = read_planes(self.folder / "a.exr")[2]
                    for channel, values in planes.items():
                        if channel != "depth.Z":
                            self.assertTrue(all(map(math.isfinite, values)), (channel, scheme, more))
                    if name == "beside" and scheme != "march-0.01":
                        self.assertGreater(planes["A"][33 * 16 + 16], 0.999, (scheme, more))

    def test_a_picture_that_memory_cannot_hold_is_refused_before_anything_is_made(self):
        needed = 16384 * 16384 * 256
        if os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") >= needed:
            self.skipTest("this machine has the memory")
        path = self.write("a.blobs.csv", blobs(3))
        outcome = fx("render", path, "-o", self.folder / "a.exr", *VIEW, "--size", "16384x16384")
        self.assertEqual(outcome.code, 1)
        self.assertIn(f"needs {needed} bytes", outcome.err)
        self.assertIn("choose a smaller one", outcome.err)
        self.assertEqual(self.names(), ["a.blobs.csv"])

    def test_a_faulty_list_is_refused_with_file_line_and_column(self):
        path = self.write("a.blobs.csv", HEADER + "0,0,0,1,1,0,1,1,1\n0,0,zero,1,1,0,1,1,1\n")
        outcome = fx("render", path, "-o", self.folder / "a.exr", *VIEW)
        self.assertEqual(outcome.code, 1)
        self.assertIn(f"{path}:3:5:", outcome.err)
        self.assertEqual(self.names(), ["a.blobs.csv"])

    def picture(self, name, text, view, *arguments):
        self.write(name + ".blobs.csv", text)
        outcome = fx("render", self.folder / (name + ".blobs.csv"), "-o", self.folder / (name + ".exr"), "--renderer",
                     "reference", "--view", view, "--size", "96x64", *arguments)
        self.assertEqual(outcome.code, 0, outcome.err)
        return read_planes(self.folder / (name + ".exr"))[2]

    def changes(self, *arguments):
        """Relative change of every pixel when scene and camera move by 1e5 m along each axis, in order."""
        here = self.picture("here", blobs(270), "0.5,0.25,4,0,0,0,40", *arguments)
        there = self.picture("there", blobs(270, shift=1e5), "100000.5,100000.25,100004,1e5,1e5,1e5,40", *arguments)
        return sorted(abs(b - a) / a for channel in "RGB" for a, b in zip(here[channel], there[channel]) if a > 1e-6)

    def test_a_hundred_kilometres_away_it_is_the_same_picture(self):
        for precision in ("double", "float"):
            changes = self.changes("--precision", precision)
            self.assertGreater(len(changes), 5000)
            self.assertLessEqual(changes[len(changes) // 2], 1e-6, precision)
            self.assertLessEqual(changes[len(changes) * 99 // 100], 1e-4, precision)

    def test_a_scene_is_lit_by_its_sky_unless_scattering_is_off(self):
        light = {}
        for mode in ("none", "centers", "single"):
            path = self.folder / f"{mode}.exr"
            outcome = fx("render", "library:smoke-column", "-o", path, "--renderer", "reference", "--size", "64x48", "--time",
                         "2", "--scattering", mode)
            self.assertEqual(outcome.code, 0, outcome.err)
            planes = read_planes(path)[2]
            light[mode] = sum(planes["smoke.G"])
            for i in range(64 * 48): # layers and what is behind them make the picture
                behind = 1 - sum(planes[layer + ".A"][i] for layer in ("fire", "smoke", "dust"))
                sum_ = sum(planes[layer + ".G"][i] for layer in ("fire", "smoke", "dust"))
                self.assertAlmostEqual(planes["G"][i], sum_ + behind * planes["background.G"][i],
                                       delta=1e-3 * (planes["G"][i] + planes["background.G"][i]))
        self.assertEqual(light["none"], 0.0)
        self.assertGreater(light["centers"], 0.0)
        self.assertGreater(light["single"], light["centers"]) # dense blobs get less at their centers than at their rims

    def test_lights_of_a_scene_are_those_of_both_renderers(self):
        path = self.write("a.blobs.csv", HEADER.strip() + ",g\n0,0,0,1,3,0.9,0,0,0,0.5\n")
        lights = self.folder / "lights.scene.json"
        light = {"type": "spot", "position": [0, 3, 1], "intensity": [9e5, 6e5, 3e5], "direction": [0, -3, -1]}
        lights.write_text(json.dumps({"version": 1, "camera": {}, "lights": [light]}))
        sums = []
        for arguments in (("--renderer", "path", "--bounces", 1, "--spp", 256),
                          ("--renderer", "reference", "--scattering", "single", "--samples", 3)):
            outcome = fx("render", path, "-o", self.folder / "a.exr", "--view", "0,0,4,0,0,0,40", "--size", "24x16", "--lights",
                         lights, *arguments)
            self.assertEqual(outcome.code, 0, outcome.err)
            planes = read_planes(self.folder / "a.exr")[2]
            sums.append(sum(planes["G"]))
            self.assertAlmostEqual(sum(planes["R"]), 1.5 * sums[-1], delta=1e-4 * sums[-1])
        self.assertGreater(sums[1], 0.0)
        self.assertAlmostEqual(sums[0], sums[1], delta=0.02 * sums[1])

    def test_particles_that_shine_light_the_ground_in_both_renderers(self):
        sums = []
        for arguments in (("--renderer", "path", "--bounces", 1, "--spp", 16, "--sun-angle", 0),
                          ("--renderer", "reference", "--scattering", "single", "--samples", 4)):
            outcome = fx("render", "library:magic-trail", "-o", self.folder / "a.exr", "--size", "48x32", "--time", 1, *arguments)
            self.assertEqual(outcome.code, 0, outcome.err)
            sums.append(sum(read_planes(self.folder / "a.exr")[2]["G"]))
        self.assertAlmostEqual(sums[0], sums[1], delta=0.01 * sums[1])

    def test_paths_write_light_variance_and_samples(self):
        path = self.write("a.blobs.csv", HEADER.strip() + ",g\n0,0,0,1,6,0.9,0,0,0,0.5\n")
        lights = self.folder / "lights.scene.json"
        lights.write_text(json.dumps({"version": 1, "name": "lights", "camera": {"position": [0, 0, 4], "target": [0, 0, 0]},
                                      "lighting": {"sunDirection": [0, 1, 0], "sunIlluminance": [30000, 30000, 30000]},
                                      "exposureEv100": 12, "instances": []}))
        outcome = fx("render", path, "-o", self.folder / "a.exr", "--renderer", "path", "--view", "0,0,4,0,0,0,40", "--size", "24x16",
                     "--spp", 32, "--lights", lights, "--json")
        self.assertEqual(outcome.code, 0, outcome.err)
        line = json.loads(outcome.out)
        self.assertEqual((line["renderer"], line["paths"], line["nonfinite"]), ("path", 24 * 16 * 32, 0))
        self.assertGreater(line["efficiency"], 0.0)
        planes = read_planes(self.folder / "a.exr")[2]
        self.assertEqual(set(planes), {"R", "G", "B", "A", "variance.R", "variance.G", "variance.B", "samples.Y"})
        middle = 24 * 8 + 12
        self.assertGreater(planes["G"][middle], 0.0)
        self.assertGreater(planes["variance.G"][middle], 0.0)
        self.assertEqual(set(planes["samples.Y"]), {32.0})

    def test_options_of_paths_need_the_path_tracer(self):
        path = self.write("a.blobs.csv", blobs(3))
        for option in (("--spp", "4"), ("--error", "0.1"), ("--bounces", "1")):
            outcome = fx("render", path, "-o", self.folder / "a.exr", *VIEW, *option)
            self.assertEqual(outcome.code, 2, outcome.err)
            self.assertIn("--renderer path", outcome.err)

    def start(self, output, *arguments, size="320x240", before_start=None):
        return subprocess.Popen([FX, "render", str(self.folder / "a.blobs.csv"), "-o", str(self.folder / output), *VIEW,
                                 "--size", size, *arguments], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                preexec_fn=before_start)

    def finish(self, output, *arguments, size="320x240"):
        self.assertEqual(self.start(output, *arguments, size=size).wait(PATIENCE), 0)

    def wait_for_growth(self, process, path, least):
        """Until the file has so many bytes, or the process has ended."""
        while process.poll() is None and not (path.exists() and path.stat().st_size >= least):
            time.sleep(0.01)

    def kill_at_growth(self, output, growth, limit, size):
        """Renders on until the journal has `growth` bytes more, then kills; the system does so at `limit` bytes more.

        @return the size of the journal
        """
        journal = self.folder / (output + ".journal")
        size_of = lambda: journal.stat().st_size if journal.exists() else 0
        before = size_of()

        def limited():
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            resource.setrlimit(resource.RLIMIT_FSIZE, (before + limit, before + limit))

        process = self.start(output, "--resume", size=size, before_start=limited)
        while size_of() < before + growth and process.poll() is None:
            time.sleep(0.001)
        process.kill()
        self.assertIn(process.wait(PATIENCE), (-signal.SIGKILL, -signal.SIGXFSZ))
        return size_of()

    def test_a_render_that_is_killed_twenty_times_gives_the_same_bits(self):
        self.write("a.blobs.csv", blobs(3000, 0.12))
        self.finish("whole.exr", size="800x600")
        bytes_of_tiles = 800 * 600 * 22 * 4
        chance = random.Random(7)
        sizes = set()
        for kill in range(20):
            # at once, or within a tile or a record; never so late that the picture is done after twenty times
            growth = 0 if kill % 7 == 0 else chance.randint(1, bytes_of_tiles // 40)
            sizes.add(self.kill_at_growth("a.exr", growth, bytes_of_tiles // 25, "800x600"))
            self.assertNotIn("a.exr", self.names())
        self.assertGreaterEqual(len(sizes), 17) # every kill that waited found the journal longer
        self.finish("a.exr", "--resume", size="800x600")
        self.assertEqual((self.folder / "a.exr").read_bytes(), (self.folder / "whole.exr").read_bytes())
        self.assertEqual(self.names(), ["a.blobs.csv", "a.exr", "whole.exr"])

    def test_ctrl_c_keeps_the_journal_and_another_picture_does_not_take_it(self):
        self.write("a.blobs.csv", blobs(3000, 0.12))
        process = self.start("a.exr")
        self.wait_for_growth(process, self.folder / "a.exr.journal", 20_000)
        process.send_signal(signal.SIGINT)
        self.assertEqual(process.wait(PATIENCE), 130)
        self.assertEqual(self.names(), ["a.blobs.csv", "a.exr.journal"])
        other = fx("render", self.folder / "a.blobs.csv", "-o", self.folder / "a.exr", *VIEW, "--size", "320x240", "--resume",
                   "--integrator", "paper-1")
        self.assertEqual(other.code, 1)
        self.assertIn("a.exr.journal", other.err)
        self.assertEqual(self.names(), ["a.blobs.csv", "a.exr.journal"])

    def render_on_a_disk_of(self, size, *arguments):
        """Files can grow to `size` bytes: what is beyond fails as on a full disk."""

        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))

        return subprocess.run([FX, "render", str(self.folder / "a.blobs.csv"), "-o", str(self.folder / "a.exr"), *VIEW,
                               "--size", "320x240", *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              preexec_fn=limit)

    def test_a_full_disk_names_the_file_and_leaves_no_half_picture(self):
        self.write("a.blobs.csv", blobs(20))
        self.finish("whole.exr")
        for size, file in ((100_000, b"a.exr.journal"), (0, b"a.exr.journal")):
            process = self.render_on_a_disk_of(size, "--resume")
            self.assertEqual(process.returncode, 1)
            self.assertIn(file, process.stderr)
            self.assertNotIn("a.exr", self.names())
        self.finish("a.exr", "--resume")
        self.assertEqual((self.folder / "a.exr").read_bytes(), (self.folder / "whole.exr").read_bytes())
        self.assertEqual(self.names(), ["a.blobs.csv", "a.exr", "whole.exr"])

    def test_a_disk_that_is_full_for_the_picture_alone_keeps_the_journal(self):
        self.write("a.blobs.csv", blobs(20))
        self.finish("whole.exr")
        journal = self.folder / "a.exr.journal"
        process = self.start("a.exr")
        self.wait_for_growth(process, journal, 320 * 240 * 22 * 4 * 9 // 10)
        process.send_signal(signal.SIGINT)
        process.wait(PATIENCE)
        if process.returncode == 0: # too fast to be caught
            return
        size = (self.folder / "whole.exr").stat().st_size
        self.assertGreater(journal.stat().st_size, 0)
        process = self.render_on_a_disk_of(min(size - 1, journal.stat().st_size - 1), "--resume")
        self.assertEqual(process.returncode, 1)
        self.assertIn(b"a.exr", process.stderr)
        self.assertEqual(self.names(), ["a.blobs.csv", "a.exr.journal", "whole.exr"])


if __name__ == "__main__":
    unittest.main()
