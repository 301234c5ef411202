#!/usr/bin/env python3
"""fx export: OpenVDB files, read back with OpenVDB's own Python module where one is installed (python3-openvdb)."""
import json
import math
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time
import unittest

from exr_planes import read_planes
from fx_program import FX, FxTest, fx, wait_until_it_heeds_interrupts

HAS_OPENVDB = os.environ.get("FX_HAS_OPENVDB", "1") == "1"
HEADER = "x[m],y[m],z[m],radius[m],tau_area[m2],albedo,er,eg,eb"
BALLS = ((0.3, -1.2, 2.05, 0.9, 2.0), (0.41, 0.2, 0.0, 0.01, 0.5), (-2.0, 0.0, 0.0, 0.25, 1.0))  # the second is far below a voxel

# Prints what a file has, as one JSON object. Runs in an interpreter that has the module.
READER = """
import json, sys
import pyopenvdb as vdb
grids, metadata = vdb.readAll(sys.argv[1])
out = {"metadata": {name: value for name, value in metadata.items() if isinstance(value, (str, int, float))}, "grids": {}}
for grid in grids:
    facts = {"type": grid.valueTypeName, "voxels": grid.activeVoxelCount(), "unit": grid.metadata.get("unit"),
             "half": grid.saveFloatAsHalf, "voxel_size": grid.transform.voxelSize()[0]}
    if grid.valueTypeName == "float":
        total, moment, most = 0.0, [0.0, 0.0, 0.0], 0.0
        for item in grid.citerOnValues():
            volume = item.count * grid.transform.voxelSize()[0] ** 3
            place = grid.transform.indexToWorld([(a + b) / 2 for a, b in zip(item.min, item.max)])
            total += item.value * volume
            most = max(most, item.value)
            moment = [m + item.value * volume * p for m, p in zip(moment, place)]
        facts |= {"sum": total, "moment": moment, "most": most}
        low, high = grid.evalActiveVoxelBoundingBox()
        facts |= {"low": grid.transform.indexToWorld(low), "high": grid.transform.indexToWorld(high)}
    elif grid.name == "Cd":
        facts["values"] = sorted({tuple(round(c, 3) for c in item.value) for item in grid.citerOnValues()})
    out["grids"][grid.name] = facts
print(json.dumps(out))
"""


def reader():
    """An interpreter that can import pyopenvdb; None: there is none."""
    for program in (sys.executable, "/usr/bin/python3", shutil.which("python3")):
        if program and pathlib.Path(program).exists() and \
                subprocess.run([program, "-c", "import pyopenvdb"], capture_output=True).returncode == 0:
            return program
    return None


READER_PROGRAM = reader() if HAS_OPENVDB else None


def read(path):
    ran = subprocess.run([READER_PROGRAM, "-c", READER, str(path)], capture_output=True, text=True, check=True)
    return json.loads(ran.stdout)


class WithoutOpenVdb(FxTest):
    @unittest.skipIf(HAS_OPENVDB, "fx has OpenVDB")
    def test_the_missing_package_is_named(self):
        outcome = fx("export", "library:explosion", "-o", self.folder / "a.vdb")
        self.assertEqual(outcome.code, 1)
        self.assertIn("libopenvdb-dev", outcome.err)
        self.assertEqual(self.names(), [])

    def test_doctor_says_whether_the_module_is_there(self):
        check = {check["name"]: check for check in json.loads(fx("doctor", "--json").out)["checks"]}["OpenVDB"]
        self.assertEqual((check["ok"], check["required"]), (HAS_OPENVDB, False))
        if not HAS_OPENVDB:
            self.assertIn("libopenvdb-dev", check["remedy"])


class CommandLine(FxTest):
    def test_what_makes_no_sense_is_exit_code_2(self):
        out, sequence = self.folder / "a.vdb", self.folder / "a.%03d.vdb"
        for arguments in (["library:sparks"], ["library:sparks", "-o", self.folder / "a.exr"],
                          ["library:sparks", "-o", out, "--frames", "0:3"], ["library:sparks", "-o", sequence, "--time", "1"],
                          ["library:sparks", "-o", out, "--voxel-size", "0"], ["library:sparks", "-o", out, "--voxels", "10"],
                          ["library:sparks", "-o", out, "--voxel-size", "nan"],
                          ["library:sparks", "-o", sequence, "--frames", "5:2"], ["library:sparks", "-o", out, "--quality", "best"]):
            outcome = fx("export", *arguments)
            self.assertEqual(outcome.code, 2, arguments)
            self.assertTrue(outcome.err.strip(), arguments)
        self.assertEqual(self.names(), [])


@unittest.skipUnless(HAS_OPENVDB, "fx was built without OpenVDB")
class Export(FxTest):
    def list_of_balls(self):
        lines = [",".join(map(str, (*ball, 0.5, 4, 4, 4))) for ball in BALLS]
        return self.write("balls.blobs.csv", "\n".join([HEADER, *lines]) + "\n")

    def export(self, *arguments):
        outcome = fx("export", *arguments, "--json")
        self.assertEqual(outcome.code, 0, outcome.err)
        return [json.loads(line) for line in outcome.out.splitlines()]

    def test_the_report_has_the_mass_of_the_balls(self):
        for size in ("0.05", "0.3", "2"):
            report, = self.export(self.list_of_balls(), "-o", self.folder / "a.vdb", "--voxel-size", size)
            self.assertEqual(report["cross_section"], 3.5)
            self.assertAlmostEqual(report["density_volume"], 3.5, delta=1e-5)
            self.assertEqual(report["voxel_size"], float(size))

    def test_the_budget_of_voxels_is_kept_and_used(self):
        report, = self.export(self.list_of_balls(), "-o", self.folder / "a.vdb", "--voxels", 200000)
        self.assertLess(report["voxels"], 200000)
        self.assertGreater(report["voxels"], 60000)

    def test_too_many_voxels_are_refused_with_a_voxel_size_that_works(self):
        balls = self.list_of_balls()
        outcome = fx("export", balls, "-o", self.folder / "a.vdb", "--voxel-size", "0.001", cpu_seconds=60)
        self.assertEqual(outcome.code, 1)
        self.assertEqual(self.names(), ["balls.blobs.csv"])
        words = outcome.err.split()
        remedy = words[words.index("--voxel-size") + 1]
        fits = fx("export", balls, "-o", self.folder / "a.vdb", "--voxel-size", remedy, "--voxels", 64000, "--json")
        self.assertEqual(fits.code, 1)  # of another budget
        outcome = fx("export", balls, "-o", self.folder / "a.vdb", "--voxel-size", "0.01", "--voxels", 64000)
        words = outcome.err.split()
        self.export(balls, "-o", self.folder / "a.vdb", "--voxel-size", words[words.index("--voxel-size") + 1], "--voxels", 64000)

    def test_files_that_cannot_be_read_or_written_are_named(self):
        for name in ("missing.scene.json", "missing.fx.json", "library:missing", "missing.blobs.csv", "missing.txt"):
            outcome = fx("export", name, "-o", self.folder / "a.vdb")
            self.assertEqual(outcome.code, 1)
            self.assertIn("missing", outcome.err)
        outcome = fx("export", self.list_of_balls(), "-o", self.folder / "none" / "a.vdb")
        self.assertEqual(outcome.code, 1)
        self.assertIn("there is no folder", outcome.err)

    def test_each_frame_of_a_sequence_has_its_own_voxels_and_the_values_of_single_files(self):
        reports = self.export("library:dust-burst", "-o", self.folder / "a.%03d.vdb", "--frames", "3:5", "--fps", 10, "--voxels", 50000)
        self.assertEqual(self.names(), ["a.003.vdb", "a.004.vdb", "a.005.vdb"])
        self.assertEqual([pathlib.Path(report["file"]).name for report in reports], self.names())
        sizes = [report["voxel_size"] for report in reports]
        self.assertGreater(sizes[2], 1.02 * sizes[0]) # the dust spreads
        for before, behind in zip(sizes, sizes[1:]):
            self.assertLess(abs(math.log(behind / before)), math.log(1.2501))
        for report, size in zip(reports, sizes):
            single, = self.export("library:dust-burst", "-o", self.folder / "b.vdb", "--time", report["time"], "--voxels", 50000)
            self.assertGreater(size, 0.98 * single["voxel_size"]) # keeps to the budget
        self.assertLess(sizes[2], 1.02 * single["voxel_size"])
        single, = self.export("library:dust-burst", "-o", self.folder / "b.vdb", "--time", 0.4, "--voxel-size", repr(sizes[1]))
        for name in ("time", "voxels", "blobs", "cross_section", "density_volume", "density_max"):
            self.assertEqual(single[name], reports[1][name], name)
        self.assertGreater(single["voxels"], 10000)

    def test_one_voxel_size_is_that_of_all_frames(self):
        reports = self.export("library:dust-burst", "-o", self.folder / "a.%03d.vdb", "--frames", "3:5", "--fps", 10, "--voxel-size", 0.4)
        self.assertEqual({report["voxel_size"] for report in reports}, {0.4})

    def test_points_are_the_same_balls_in_all_frames(self):
        reports = self.export("library:explosion", "-o", self.folder / "a.%03d.vdb", "--frames", "3:9", "--fps", 24, "--voxels", 60000,
                              "--balls-below", 2)
        sizes = [report["voxel_size"] for report in reports]
        self.assertLess(sizes[0], 0.9 * sizes[-1])
        for report, size in zip(reports, sizes):
            single, = self.export("library:explosion", "-o", self.folder / "b.vdb", "--time", report["time"], "--voxel-size", repr(size),
                                  "--voxels", 60000, "--balls-below", repr(2 * max(sizes) / size))
            self.assertEqual(single["balls"], report["balls"])

    def test_effects_without_media_give_empty_grids(self):
        sprites = {"maxParticles": 20, "emission": {"rate": 40}, "lifetime": 1, "radius": 0.3, "speed": 1,
                   "appearance": {"kind": "sprite"}}
        preset = self.write("sprites.fx.json", json.dumps({"version": 1, "emitters": [sprites]}))
        report, = self.export(preset, "-o", self.folder / "a.vdb", "--time", 0.4)
        self.assertEqual((report["voxels"], report["blobs"], report["density_volume"]), (0, 0, 0))

    def test_the_same_command_writes_the_same_bytes(self):
        written = []
        for cores in ({0}, None):
            limit = "taskset -c 0 " if cores else ""
            subprocess.run(f"{limit}{FX} export library:dust-burst -o {self.folder}/a.vdb --time 0.3 --voxels 100000", shell=True,
                           check=True, capture_output=True)
            written.append((self.folder / "a.vdb").read_bytes())
        self.assertEqual(written[0], written[1])

    def opacity(self, scene, time, *arguments):
        path = self.folder / "a.exr"
        outcome = fx("render", scene, "--renderer", "reference", "--size", "32x24", "--time", time, "--scattering", "none", "--view",
                     "0,4,24,0,5,0,40", "-o", path, *arguments)
        self.assertEqual(outcome.code, 0, outcome.err)
        planes = read_planes(path)[2]
        return [sum(values) for values in zip(*(planes[f"{name}.A"] for name in ("smoke", "fire", "dust")))]

    def test_detail_is_that_of_pictures(self):
        exact = self.opacity("library:explosion", "0.6", "--detail", "on", "--samples", "4")
        errors = []
        for words in ((), ("--detail",)):
            outcome = fx("export", "library:explosion", "-o", self.folder / "a.vdb", "--time", "0.6", "--voxels", "400000", *words)
            self.assertEqual(outcome.code, 0, outcome.err)
            self.assertEqual("warning: media are smooth" in outcome.err, not words)
            outcome = fx("import", self.folder / "a.vdb", "-o", self.folder / "a.fx.json", "--bricks")
            self.assertEqual(outcome.code, 0, outcome.err)
            found = self.opacity(self.folder / "a.fx.json", "0", "--samples", "2")
            errors.append((sum((a - b) ** 2 for a, b in zip(found, exact)) / sum(b * b for b in exact)) ** 0.5)
        print(f"error of opacity without detail {errors[0]:.3f}, with detail {errors[1]:.3f}", flush=True)
        self.assertGreater(errors[0], 0.3)
        self.assertLess(errors[1], 0.1)

    def test_balls_without_detail_are_the_same_with_it(self):
        balls = self.list_of_balls()
        for name, words in (("a.vdb", ()), ("b.vdb", ("--detail",))):
            outcome = fx("export", balls, "-o", self.folder / name, "--voxel-size", "0.2", *words)
            self.assertEqual(outcome.code, 0, outcome.err)
            self.assertNotIn("warning", outcome.err)
        self.assertEqual((self.folder / "a.vdb").read_bytes(), (self.folder / "b.vdb").read_bytes())

    def test_small_balls_of_a_list_are_a_point_each(self):
        balls = self.list_of_balls()
        report, = self.export(balls, "-o", self.folder / "a.vdb", "--voxel-size", "0.2", "--balls-below", "2")
        self.assertEqual((report["blobs"], report["balls"]), (3, 2))
        self.assertEqual(report["cross_section"], 2.0)  # of the voxels
        report, = self.export(balls, "-o", self.folder / "b.vdb", "--voxel-size", "1", "--balls-below", "2")
        self.assertEqual((report["balls"], report["voxels"]), (3, 0))

    def test_an_interruption_leaves_whole_files_only(self):
        process = subprocess.Popen([FX, "export", "library:campfire", "-o", str(self.folder / "a.%03d.vdb"), "--frames", "0:999",
                                    "--voxel-size", "0.05"], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        wait_until_it_heeds_interrupts(process)
        while process.poll() is None and not (self.folder / "a.001.vdb").exists():
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        process.communicate()
        self.assertEqual(process.returncode, 130)
        self.assertFalse([name for name in self.names() if not name.startswith("a.")])

    @unittest.skipUnless(READER_PROGRAM, "python3-openvdb is not installed")
    def test_openvdb_reads_names_units_mass_center_and_light(self):
        self.export(self.list_of_balls(), "-o", self.folder / "a.vdb", "--voxel-size", "0.1")
        found = read(self.folder / "a.vdb")
        grids = found["grids"]
        self.assertEqual({name: grids[name]["unit"] for name in ("density", "temperature", "flame", "flame_rate", "v", "Cd")},
                         {"density": "1/m", "temperature": "K", "flame": "cd/m3", "flame_rate": "1/s", "v": "m/s", "Cd": "1"})
        self.assertEqual((grids["v"]["type"], grids["Cd"]["type"]), ("vec3s", "vec3s"))
        self.assertEqual(grids["Cd"]["values"], [[0.5, 0.5, 0.5]])
        density = grids["density"]
        self.assertAlmostEqual(density["voxel_size"], 0.1, delta=1e-12)
        self.assertAlmostEqual(density["sum"], 3.5, delta=3.5 * 0.005)
        for axis in range(3):
            low, high = min(b[axis] - b[3] for b in BALLS), max(b[axis] + b[3] for b in BALLS)
            self.assertLess(abs(density["low"][axis] - low), 0.11)
            self.assertLess(abs(density["high"][axis] - high), 0.11)
            exact = sum(ball[axis] * ball[4] for ball in BALLS)
            self.assertAlmostEqual(density["moment"][axis], exact, delta=1e-4)
        all_light = 3.5 * 0.5 * 4  # (1 - albedo) e cross section; the small ball of depth 5570 hides nearly all of its own
        self.assertAlmostEqual(grids["flame"]["sum"], 0.769 * all_light, delta=0.01 * all_light)
        self.assertEqual(found["metadata"]["length_unit"], "m")
        thin = self.write("thin.blobs.csv", f"{HEADER}\n" + "".join(
            ",".join(map(str, (*ball[:4], 1e-3 * ball[3] ** 2, 0.5, 4, 4, 4))) + "\n" for ball in BALLS))
        self.export(thin, "-o", self.folder / "thin.vdb", "--voxel-size", "0.1")
        light = read(self.folder / "thin.vdb")["grids"]["flame"]["sum"]
        self.assertAlmostEqual(light / (0.5 * 4 * 1e-3 * sum(ball[3] ** 2 for ball in BALLS)), 1.0, delta=2e-3)

    @unittest.skipUnless(READER_PROGRAM, "python3-openvdb is not installed")
    def test_points_are_a_grid_beside_the_others(self):
        # Python's module has no points; tests/rendering/voxelization reads them.
        self.export(self.list_of_balls(), "-o", self.folder / "a.vdb", "--voxel-size", "0.1", "--points")
        self.assertIn(b"ptdataidx32", (self.folder / "a.vdb").read_bytes())
        density = "import sys, pyopenvdb as vdb; print(vdb.read(sys.argv[1], 'density').activeVoxelCount())"
        ran = subprocess.run([READER_PROGRAM, "-c", density, str(self.folder / "a.vdb")], capture_output=True, text=True)
        report, = self.export(self.list_of_balls(), "-o", self.folder / "b.vdb", "--voxel-size", "0.1")
        self.assertEqual(ran.stdout.strip(), str(report["voxels"]), ran.stderr)
        self.assertNotIn(b"ptdataidx32", (self.folder / "b.vdb").read_bytes())

    @unittest.skipUnless(READER_PROGRAM, "python3-openvdb is not installed")
    def test_an_effect_has_its_mass_and_says_where_it_comes_from(self):
        for half in (False, True):
            report, = self.export("library:explosion", "-o", self.folder / "a.vdb", "--time", "0.1", "--quality", "low",
                                  "--voxels", "60000", "--seed", "7", *(["--half"] if half else []))
            found = read(self.folder / "a.vdb")
            density = found["grids"]["density"]
            self.assertEqual(density["voxels"], report["voxels"])
            self.assertEqual(density["half"], half)
            self.assertGreater(report["cross_section"], 0)
            self.assertAlmostEqual(density["sum"] / report["cross_section"], 1, delta=0.005)
            self.assertGreater(found["grids"]["temperature"]["most"], 1000)
            self.assertGreater(found["grids"]["flame"]["most"], 0)
            metadata = found["metadata"]
            self.assertEqual((metadata["source"], metadata["seed"], metadata["time"]), ("library:explosion", 7, 0.1))
            self.assertTrue(metadata["fxsdk_version"])


if __name__ == "__main__":
    if HAS_OPENVDB and not READER_PROGRAM:
        print("python3-openvdb is not installed: files are not read back", file=sys.stderr)
    unittest.main()
