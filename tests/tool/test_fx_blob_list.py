#!/usr/bin/env python3
"""fx render of lists of blobs by OpenGL: the same view, light and medium as the renderers without a GPU have."""
import json
import unittest

from exr_planes import read_planes
from fx_program import FxTest, fx

HEADER = "x[m],y[m],z[m],radius[m],tau_area[m2],albedo,er,eg,eb,g\n"
CAMERA = {"position": [0.5, 1.0, 5.0], "target": [0, 0, 0], "fovYDegrees": 35}


class FxBlobList(FxTest):
    def picture(self, name, rows, *arguments, camera=("--view", "0.5,1,5,0,0,0,35")):
        path = self.write(name + ".blobs.csv", HEADER + rows)
        outcome = fx("render", path, "-o", self.folder / (name + ".exr"), *camera, "--size", "60x40", *arguments)
        self.assertEqual(outcome.code, 0, outcome.err)
        return read_planes(self.folder / (name + ".exr"))[2]

    def scene(self, **members):
        path = self.folder / "stage.scene.json"
        path.write_text(json.dumps({"version": 1, "camera": CAMERA, **members}))
        return path

    def difference(self, a, b, channel):
        """Largest of a channel, relative to its largest value."""
        most = max(b[channel])
        self.assertGreater(most, 0.0)
        return max(abs(x - y) for x, y in zip(a[channel], b[channel])) / most

    def test_one_blob_is_that_of_the_reference_renderer(self):
        for name, row in {"thin": "0.3,-0.2,0.1,1.2,0.4,0,4,2,1,0\n", "dense": "-0.2,0.1,0.3,0.9,9,0,4,2,1,0\n"}.items():
            drawn = self.picture(name, row)
            exact = self.picture(name, row, "--renderer", "reference", "--integrator", "gauss-8", "--scattering", "none")
            self.assertEqual(set(drawn), set(exact))
            for channel in "RGB":
                self.assertLess(self.difference(drawn, exact, channel), 1e-3, (name, channel))
            for channel in ("A", "opticalDepth.Y", "smoke.A"):
                self.assertLess(self.difference(drawn, exact, channel), 1e-4, (name, channel))
            self.assertGreater(max(exact["A"]), 0.2)

    def test_far_from_the_world_s_origin_it_is_the_same_picture(self):
        here = self.picture("here", "0.25,0,0,1,3,0,4,2,1,0\n-0.5,0,-0.5,0.5,1,0,1,2,3,0.5\n")
        there = self.picture("there", "1e6,1e6,1e6,1,3,0,4,2,1,0\n999999.25,1e6,999999.5,0.5,1,0,1,2,3,0.5\n",
                             camera=("--view", "1000000.25,1000001,1000005,999999.75,1e6,1e6,35"))
        self.assertLess(self.difference(there, here, "R"), 1e-5)

    def test_the_camera_of_a_scene_is_that_of_view(self):
        rows = "0.3,-0.2,0.1,1.2,0.4,0,4,2,1,0\n"
        by_view = self.picture("view", rows)
        by_scene = self.picture("scene", rows, camera=("--camera", self.scene()))
        self.assertLess(self.difference(by_scene, by_view, "R"), 1e-6)

    def test_exposure_divides_by_the_luminance_of_white(self):
        rows = "0.3,-0.2,0.1,1.2,0.4,0,4,2,1,0\n"
        plain = self.picture("plain", rows)
        exposed = self.picture("exposed", rows, "--exposure", 3)
        self.assertAlmostEqual(max(exposed["R"]) * 1.2 * 8, max(plain["R"]), delta=1e-4 * max(plain["R"]))

    def test_looking_into_the_sun_media_that_scatter_forwards_are_brighter(self):
        light = {}
        for side in (-1, 1): # of the sun: behind the blob, behind the eye
            sun = self.scene(exposureEv100=3, lighting={"sunDirection": [0.1 * side, 0.2 * side, side], "sunIlluminance": 5000})
            for g in (-0.5, 0, 0.7):
                drawn = self.picture("sun", f"0,0,0,1,0.01,1,0,0,0,{g}\n", "--lights", sun)
                light[side, g] = max(drawn["G"])
        self.assertGreater(light[-1, 0.7], 1.2 * light[-1, 0])
        self.assertGreater(light[-1, 0], 1.02 * light[-1, -0.5])
        self.assertGreater(light[1, -0.5], 1.02 * light[1, 0])
        self.assertGreater(light[1, 0], 1.02 * light[1, 0.7])

    def test_sky_and_exposure_of_lights_are_used(self):
        row = "0,0,0,1,1,1,0,0,0,0\n"
        dark = self.picture("dark", row)
        self.assertEqual(max(dark["G"]), 0.0)
        sky = {"skyLuminance": 5000}
        bright = self.picture("bright", row, "--lights", self.scene(exposureEv100=10, lighting=sky))
        half = self.picture("half", row, "--lights", self.scene(exposureEv100=11, lighting=sky))
        self.assertGreater(max(bright["G"]), 0.1)
        self.assertAlmostEqual(max(bright["G"]), 2 * max(half["G"]), delta=1e-3)

    def test_pictures_and_sequences_are_written_as_of_a_scene(self):
        path = self.write("a.blobs.csv", HEADER + "0,0,0,1,3,0,4,2,1,0\n")
        camera = self.scene(lights=[{"position": [0, 3, 0], "intensity": 5}])
        for output, arguments in (("a.png", ()), ("b.%d.exr", ("--frames", "0:1"))):
            outcome = fx("render", path, "-o", self.folder / output, "--camera", camera, "--lights", camera, "--size", "24x16",
                         "--json", *arguments)
            self.assertEqual(outcome.code, 0, outcome.err)
            self.assertIn('leaves out the 1 "lights"', outcome.err)
            line = json.loads(outcome.out.splitlines()[0])
            self.assertEqual((line["renderer"], line["blobs"], line["nonfinite"]), ("gl", 1, 0))
        self.assertEqual(self.names(), ["a.blobs.csv", "a.png", "b.0.exr", "b.1.exr", "stage.scene.json"])

    def test_a_faulty_list_or_no_camera_writes_nothing(self):
        path = self.write("a.blobs.csv", HEADER + "0,0,zero,1,1,0,1,1,1,0\n")
        outcome = fx("render", path, "-o", self.folder / "a.png", "--view", "0,0,4,0,0,0,40")
        self.assertEqual(outcome.code, 1)
        self.assertIn(f"{path}:2:5:", outcome.err)
        self.assertEqual(fx("render", path, "-o", self.folder / "a.png").code, 2)
        self.assertEqual(self.names(), ["a.blobs.csv"])


if __name__ == "__main__":
    unittest.main()
