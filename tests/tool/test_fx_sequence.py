#!/usr/bin/env python3
"""Sequences of volumes: fx export and fx import of numbered files, and pictures of them against those of the original."""
import json
import math
import os
import unittest

from exr_planes import read_planes
from fx_program import FxTest, fx

HAS_OPENVDB = os.environ.get("FX_HAS_OPENVDB", "1") == "1"
# for the figures of docs/howto/volumes.md see there
FRAMES = os.environ.get("FX_FRAMES", "14:17")
VOXELS = os.environ.get("FX_VOXELS", "400000")
VOXEL_SIZE = os.environ.get("FX_VOXEL_SIZE", "") # [m] of all frames; empty: of each its own
SIZE = os.environ.get("FX_SIZE", "64x48")
MEMORY = int(os.environ.get("FX_MEMORY", "48")) # [MiB] less than all frames need
SHOWN = [int(n) for n in os.environ.get("FX_SHOWN", "15").split(",")]
FPS = int(os.environ.get("FX_FPS", "24"))
BALLS_BELOW = os.environ.get("FX_BALLS_BELOW", "2") # [voxel] radius of balls that are played beside the voxels; 0: none
# Along the side of a pixel. A spark is a hundredth of a pixel wide: the same rays meet it in both pictures.
RAYS = int(os.environ.get("FX_RAYS", "4"))
MOST_SAMPLES = 16 # of fx render along a pixel
AT_FRAMES, HALFWAY = 0.03, 0.06 # relative errors that are allowed
LIGHT = float(os.environ.get("FX_LIGHT", "0.2")) # of emitted light
OWN_LIGHT = 0.02                # of emitted light alone, against voxels of the moment itself; halfway:
LIGHT_HALFWAY = float(os.environ.get("FX_LIGHT_HALFWAY", "0.04")) # light within a step is mixed from its ends
LIGHT_OFF = 0.05                # of the sum of light from that of the balls; 0.12 with voxels alone
DRAWN = 0.005                   # of OpenGL, in pixels of the size of a voxel
DISTANCE, FOV = 30.0, 40.0      # [m], [degrees] of the camera
HEADER = "x[m],y[m],z[m],radius[m],tau_area[m2],albedo,er,eg,eb"


def means(planes, width, height, side):
    """Of squares of side x side pixels."""
    def mean(plane, x, y):
        return sum(sum(plane[row * width + x:row * width + x + side]) for row in range(y, y + side)) / side**2
    return {name: [mean(plane, x, y) for y in range(0, height, side) for x in range(0, width, side)]
            for name, plane in planes.items() if name in "RGB" or name.endswith(".A")}


def error_of(planes, wanted):
    """Root mean square of the error over covered pixels, over that of the picture; of opacity, and of light."""
    opacity = [[sum(layers) for layers in zip(*(p[f"{name}.A"] for name in ("smoke", "fire", "dust")))] for p in (planes, wanted)]
    covered = [i for i, a in enumerate(opacity[1]) if a > 1e-3]
    errors = []
    for pairs in ([opacity], [(planes[c], wanted[c]) for c in "RGB"]):
        error = sum((a[i] - b[i]) ** 2 for a, b in pairs for i in covered)
        errors.append(math.sqrt(error / sum(b[i] ** 2 for _, b in pairs for i in covered)))
    return errors


@unittest.skipUnless(HAS_OPENVDB, "fx was built without OpenVDB")
class Sequence(FxTest):
    def scene(self, name, instance, camera):
        return self.write(name, json.dumps({
            "version": 1, "name": "a", "camera": camera, "exposureEv100": 14, "composition": "volume", "voxels": 256,
            "lighting": {"sunDirection": [-0.6, 0.5, 0.6], "sunIlluminance": [60000, 57000, 50000],
                         "skyLuminance": [0, 0, 0], "groundAlbedo": 0},
            "instances": [{"position": [0, 0, 0], **instance}]}))

    def planes(self, scene, time, renderer="reference", rays=1):
        """Of means over rays x rays rays of a pixel; of GL, each through a pixel of its own."""
        path = self.folder / "a.exr"
        side = rays if renderer == "gl" else max(1, rays // MOST_SAMPLES)
        width, height = (side * int(n) for n in SIZE.split("x"))
        exact = () if renderer == "gl" else ("--detail", "off", "--scattering", "none", "--samples", rays // side)
        outcome = fx("render", scene, "--renderer", renderer, "--size", f"{width}x{height}", "--time", time, "-o", path, *exact)
        self.assertEqual(outcome.code, 0, outcome.err)
        planes = read_planes(path)[2]
        return means(planes, width, height, side) if side > 1 else planes

    def sequence(self, source, frames, *arguments):
        outcome = fx("export", source, "-o", self.folder / "a.%04d.vdb", "--frames", frames, "--fps", FPS, "--balls-below", BALLS_BELOW,
                     "--json", *arguments)
        self.assertEqual(outcome.code, 0, outcome.err)
        self.exported = [json.loads(line) for line in outcome.out.splitlines()]
        outcome = fx("import", self.folder / "a.%04d.vdb", "-o", self.folder / "a.fx.json", "--fps", FPS, "--memory",
                     MEMORY, "--json")
        self.assertEqual(outcome.code, 0, outcome.err)
        return json.loads(outcome.out)

    def test_an_exported_effect_is_played_as_it_was(self):
        first = int(FRAMES.split(":")[0])
        line = self.sequence("library:explosion", FRAMES, "--voxels", VOXELS, *(("--voxel-size", VOXEL_SIZE) if VOXEL_SIZE else ()))
        sides = [frame["voxel_size"] for frame in self.exported]
        self.assertAlmostEqual(line["voxel_side"], max(sides), delta=1e-5)
        self.assertAlmostEqual(line["voxel_side_least"], min(sides), delta=1e-5)
        balls_below = float(BALLS_BELOW) * max(sides) # [m]
        self.assertTrue(line["velocities"])
        self.assertEqual(line["balls_beside"] > 0, float(BALLS_BELOW) > 0)
        camera = {"position": [0, 6, DISTANCE], "target": [0, 5, 0], "fovYDegrees": FOV}
        pixel = 2 * DISTANCE * math.tan(math.radians(FOV / 2)) / int(SIZE.split("x")[1]) # [m]
        original = self.scene("original.scene.json", {"preset": "library:explosion"}, camera)
        played = self.scene("played.scene.json", {"preset": "a.fx.json", "start": first / FPS}, camera)
        for frame in SHOWN:
            for part, allowed in ((0.0, AT_FRAMES), (0.5, HALFWAY)):
                time = (frame + part) / FPS
                found = self.planes(played, time, rays=RAYS)
                wanted = self.planes(original, time, rays=RAYS)
                opacity, light = error_of(found, wanted)
                sums = [sum(sum(p[c]) for c in "RGB") for p in (found, wanted)]
                side = min(sides[frame - first:frame - first + (2 if part > 0 else 1)]) # on which the moment is shown
                outcome = fx("export", "library:explosion", "-o", self.folder / "own.vdb", "--time", time, "--voxel-size",
                             side, "--balls-below", balls_below / side)
                self.assertEqual(outcome.code, 0, outcome.err)
                outcome = fx("import", self.folder / "own.vdb", "-o", self.folder / "own.fx.json", "--bricks")
                self.assertEqual(outcome.code, 0, outcome.err)
                own = error_of(found, self.planes(self.scene("own.scene.json", {"preset": "own.fx.json"}, camera), time, rays=RAYS))
                drawn, _ = error_of(self.planes(played, time, "gl", math.ceil(pixel / side)), found)
                print(f"frame {frame + part}: {side:.4f} m, opacity {opacity:.4f}, light {light:.4f} and its sum {sums[0] / sums[1]:.3f}; against voxels of the moment itself {own[0]:.4f}, "
                      f"light {own[1]:.4f}; opacity of GL against the reference {drawn:.4f}", flush=True)
                with self.subTest(frame=frame + part):
                    self.assertLess(opacity, allowed)
                    self.assertLess(light, LIGHT if part == 0 else max(LIGHT, HALFWAY))
                    self.assertLess(own[0], allowed)
                    self.assertLess(own[1], LIGHT_HALFWAY if part > 0 else OWN_LIGHT)
                    self.assertAlmostEqual(sums[0] / sums[1], 1.0, delta=LIGHT_OFF)
                    self.assertLess(drawn, DRAWN)
        outcome = fx("render", played, "--size", SIZE, "--frames", f"{first}:{int(FRAMES.split(':')[1])}", "--fps", FPS,
                     "-o", self.folder / "p.%04d.png", "--stats", self.folder / "s.json")
        self.assertEqual(outcome.code, 0, outcome.err)
        counts = [json.loads(text) for text in (self.folder / "s.json").read_text().splitlines()]
        peak, reads = max(c["volume_bytes_peak"] for c in counts), counts[-1]["volume_reads"]
        late = counts[-1]["volume_late"]
        print(f"{min(sides):.4f} m to {max(sides):.4f} m; {line['bytes'] / 2**20:.0f} MiB of files, at most {line['balls_beside']} balls; {len(counts)} pictures: {reads} frames read while playing, {late} late, at most {peak / 2**20:.1f} MiB of "
              f"{MEMORY} MiB", flush=True)
        self.assertLessEqual(peak, MEMORY * 2**20)
        self.assertGreater(reads, 0)
        self.assertEqual(late, 0)

    def test_the_first_and_the_last_frame_are_shown_at_their_moments(self):
        camera = {"position": [0, 2, 6], "target": [0, 2, 0], "fovYDegrees": 40}
        for spark in ("", "0,3,0,0.05,0.02,0.5,9000,9000,9000\n"):
            name = "s" if spark else "n"
            for number, x in enumerate((-0.5, 0.5)): # without velocities, voxels are cross-faded
                balls = self.write("a.blobs.csv", f"{HEADER}\n{x},2,0,0.5,2,0.5,900,900,900\n{spark.replace('0,', f'{x},', 1)}")
                file = self.folder / f"{name}.{number:04}.vdb"
                outcome = fx("export", balls, "-o", file, "--voxel-size", "0.1", "--balls-below", "2")
                self.assertEqual(outcome.code, 0, outcome.err)
                outcome = fx("import", file, "-o", self.folder / f"{name}{number}.fx.json", "--bricks")
                self.assertEqual(outcome.code, 0, outcome.err)
            outcome = fx("import", self.folder / f"{name}.%04d.vdb", "-o", self.folder / f"{name}.fx.json", "--fps", 24)
            self.assertEqual(outcome.code, 0, outcome.err)
            for start in (0.0, 0.05) if spark else (0.0, 0.05, 2.5 / 60): # between two steps of a 60th of a second, too
                for number in (0,) if spark else (0, 1):
                    wanted = self.planes(self.scene("w.scene.json", {"preset": f"{name}{number}.fx.json"}, camera), 1.0)
                    scene = self.scene("f.scene.json", {"preset": f"{name}.fx.json", "start": start}, camera)
                    found = self.planes(scene, start + number / 24)
                    with self.subTest(spark=bool(spark), start=start, number=number):
                        for error in error_of(found, wanted):
                            self.assertLess(error, 1e-3)

    def test_a_gap_is_named(self):
        balls = self.write("a.blobs.csv", f"{HEADER}\n0,2,0,0.5,2,0,0,0,0\n")
        for number in (3, 4, 6):
            outcome = fx("export", balls, "-o", self.folder / f"b.{number:04}.vdb", "--voxel-size", "0.1")
            self.assertEqual(outcome.code, 0, outcome.err)
        outcome = fx("import", self.folder / "b.%04d.vdb", "-o", self.folder / "b.fx.json")
        self.assertEqual(outcome.code, 1)
        self.assertIn("b.0005.vdb", outcome.err)
        self.assertFalse((self.folder / "b.fx.json").exists())
        outcome = fx("import", self.folder / "b.%04d.vdb", "-o", self.folder / "b.fx.json", "--frames", "3:4", "--end", "loop")
        self.assertEqual(outcome.code, 0, outcome.err)
        preset = json.loads((self.folder / "b.fx.json").read_text())["volumes"][0]
        self.assertEqual((preset["firstFrame"], preset["frames"], preset["end"]), (3, 2, "loop"))
        self.assertEqual(fx("validate", self.folder / "b.fx.json").code, 0)
        (self.folder / "b.0004.fxvolume").write_bytes((self.folder / "b.0004.fxvolume").read_bytes()[:-9])
        outcome = fx("validate", self.folder / "b.fx.json")
        self.assertEqual(outcome.code, 1)
        self.assertIn("b.0004.fxvolume", outcome.err + outcome.out)

    def test_small_balls_of_a_list_are_played_each_and_counted(self):
        balls = self.write("a.blobs.csv", f"{HEADER}\n0,2,0,0.5,2,0,0,0,0\n1,2,0,0.03,1,0.5,4,4,4\n2,2,0,0.03,1,0.5,4,4,4\n")
        for number in (0, 1):
            outcome = fx("export", balls, "-o", self.folder / f"d.{number:04}.vdb", "--voxel-size", "0.1", "--balls-below", "2")
            self.assertEqual(outcome.code, 0, outcome.err)
        outcome = fx("import", self.folder / "d.%04d.vdb", "-o", self.folder / "d.fx.json", "--json")
        self.assertEqual(outcome.code, 0, outcome.err)
        line = json.loads(outcome.out)
        files = [path for path in self.folder.iterdir() if path.suffix in (".fxvolume", ".fxballs")]
        self.assertEqual(len(files), 4)
        self.assertEqual(line["balls_beside"], 2)
        self.assertEqual(line["bytes"], sum(path.stat().st_size for path in files))
        self.assertEqual(fx("validate", self.folder / "d.fx.json").code, 0)

    def test_a_damaged_frame_is_named(self):
        balls = self.write("a.blobs.csv", f"{HEADER}\n0,2,0,0.5,2,0,0,0,0\n")
        for number in (0, 1):
            outcome = fx("export", balls, "-o", self.folder / f"c.{number}.vdb", "--voxel-size", "0.1")
            self.assertEqual(outcome.code, 0, outcome.err)
        whole = (self.folder / "c.1.vdb").read_bytes()
        (self.folder / "c.1.vdb").write_bytes(whole[:len(whole) // 2])
        outcome = fx("import", self.folder / "c.%d.vdb", "-o", self.folder / "c.fx.json")
        self.assertEqual(outcome.code, 1)
        self.assertIn("c.1.vdb", outcome.err)
        self.assertFalse((self.folder / "c.fx.json").exists())


if __name__ == "__main__":
    unittest.main()
