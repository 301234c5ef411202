#!/usr/bin/env python3
"""The Python package against what it must agree with: the C API's own figures, and physics."""
import ctypes
import gc
import math
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy

import fxsdk


class Simulation(unittest.TestCase):
    def setUp(self):
        self.context = fxsdk.Context(workers=1)
        self.addCleanup(self.context.close)

    def test_columns_hold_every_particle(self):
        scene = self.context.scene()
        scene.add("explosion")
        scene.update(0.3)
        groups = scene.groups("blob")
        self.assertGreater(sum(len(group.ids) for group in groups), 100)
        for group in groups:
            self.assertEqual({len(column) for column in group.columns.values()}, {len(group.ids)})
            self.assertEqual(group.units["radius"], "m")
            self.assertTrue((group.ids[1:] > group.ids[:-1]).all())

    def test_equal_calls_give_equal_bits(self):
        hashes = []
        for _ in range(2):
            scene = self.context.scene()
            scene.add("campfire", seed=5)
            scene.update(0.5)
            hashes.append(scene.hash())
        self.assertEqual(hashes[0], hashes[1])

    def test_positions_follow_the_placement(self):
        quarter = math.sqrt(0.5)
        place = {"position": (10.0, 2.0, -3.0), "rotation": (0.0, quarter, 0.0, quarter), "scale": 2.0}
        here, there = self.context.scene(), self.context.scene()
        here.add("explosion")
        there.add("explosion", **place)
        for scene in (here, there):
            scene.update(0.05)
        compared = 0
        for a, b in zip(here.groups("blob"), there.groups("blob")):
            if len(a.ids) == 0 or not numpy.array_equal(a.columns["x"], b.columns["x"]):
                continue  # steps in the world's axes, such as those of gravity, may differ between turned effects
            x, y, z = a.positions.T  # a quarter turn around +Y takes x to -z and z to x
            expected = numpy.stack([10.0 + 2.0 * z, 2.0 + 2.0 * y, -3.0 - 2.0 * x], axis=1)
            self.assertLess(numpy.abs(b.positions - expected).max(), 1e-5)
            compared += len(a.ids)
        self.assertGreater(compared, 50)

    def test_a_world_in_centimeters_with_z_up_is_the_same(self):
        x, y, z = range(3)  # FxAxis
        unreal = fxsdk.Context(workers=1, unitsPerMeter=100.0, rightAxis=y, upAxis=z, forwardAxis=x)
        self.addCleanup(unreal.close)
        here, there = self.context.scene(), unreal.scene()
        here.add("campfire", position=(1.0, 2.0, -3.0))
        there.add("campfire", position=(300.0, 100.0, 200.0))
        for scene in (here, there):
            scene.update(0.5)
        self.assertEqual(there.hash(), here.hash())
        compared = 0
        for a, b in zip(here.groups("blob"), there.groups("blob")):
            right, up, back = a.positions.T
            expected = 100.0 * numpy.stack([-back, right, up], axis=1)
            self.assertLess(numpy.abs(b.positions - expected).max(initial=0.0), 1e-2)
            compared += len(a.ids)
        self.assertGreater(compared, 20)

    def test_updates_of_any_length_take_their_steps(self):
        scene = self.context.scene()
        scene.update(1.0)
        self.assertEqual(scene.statistics().steps, 60)
        self.assertEqual(scene.statistics().droppedTicks, 0)

    def test_errors_are_those_of_the_library(self):
        with self.assertRaises(fxsdk.Error) as raised:
            self.context.load("explosiom")
        self.assertEqual(raised.exception.name, "not-found")
        self.assertIn('did you mean "explosion"', str(raised.exception))
        with self.assertRaises(fxsdk.Error):
            self.context.scene().update(-1.0)
        with self.assertRaises(TypeError):
            self.context.scene(stepTick=1)
        with self.assertRaises(ValueError):
            self.context.scene(gravity=(0.0, 1.0))

    def test_closed_scenes_are_forgotten(self):
        for _ in range(20):
            self.context.scene().close()
        self.assertEqual(len(self.context._owned), 0)
        self.assertEqual(self.context.memory().scenes, 0)

    def test_callbacks_live_as_long_as_their_context(self):
        messages = []
        log = fxsdk.default("FxContextDef").log
        log.write = dict(log._fields_)["write"](lambda user, level, code, message: messages.append(message))
        context = fxsdk.Context(workers=1, log=log)
        scene = context.scene()
        del context, log
        gc.collect()
        with self.assertRaises(fxsdk.Error):
            scene.update(-1.0)
        self.assertTrue(any(b"dtSeconds" in message for message in messages))
        scene._context.close()

    def test_what_is_closed_says_so(self):
        context = fxsdk.Context(workers=1)
        scene = context.scene()
        other = context.scene()
        other.close()
        with self.assertRaisesRegex(ValueError, "^the scene is closed"):
            other.update(0.1)
        context.close()
        for call in (lambda: scene.update(0.1), lambda: context.load("sparks"), context.scene, context.memory):
            with self.assertRaisesRegex(ValueError, "^the context is closed"):
                call()

    def test_failures_of_a_loader_of_gl_are_raised(self):
        asked = []

        def loader(name):
            asked.append(name)
            raise KeyError(name)

        with self.assertRaises(KeyError) as raised:
            fxsdk.Context(gl=loader)
        self.assertEqual(raised.exception.args[0], asked[0])
        with self.assertRaises(TypeError):
            fxsdk.Context(gl=lambda: 0)
        with self.assertRaisesRegex(fxsdk.Error, "does not find gl\\w+(, gl\\w+)* and \\d+ more functions; a current OpenGL"):
            fxsdk.Context(gl=lambda name: None)

    def test_previews_are_those_of_the_presets(self):
        preview = self.context.preview("campfire")
        self.assertAlmostEqual(preview.exposureEv100, 9.2, places=6)
        self.assertEqual((preview.time, preview.hasCamera), (3.0, 1))
        self.assertAlmostEqual(math.hypot(*preview.sunDirection), 1.0, places=6)

    def test_settings_and_cameras_are_those_of_the_c_api(self):
        preview, light = self.context.preview("campfire"), self.context.preview_settings("campfire")
        self.assertEqual(light["composition"], fxsdk.constants.FX_COMPOSITION_AUTOMATIC)
        self.assertEqual(light["exposureEv100"], preview.exposureEv100)
        self.assertEqual(list(light["skyLuminance"]), list(preview.skyLuminance))
        camera = self.context.camera((0, 0, 5), (0, 0, 0), 64, 32, math.pi / 2, 0.5)
        self.assertEqual((list(camera["origin"]), camera["width"]), ([0, 0, 5], 64))
        self.assertEqual(list(camera["view"]), [float(i % 5 == 0) for i in range(16)])
        for element, value in ((0, 0.5), (5, 1.0), (10, -1.0), (11, -1.0), (14, -1.0)):
            self.assertAlmostEqual(camera["projection"][element], value, places=6)
        reversed_depth = self.context.camera((0, 9, 0), (0, 0, 0), 64, 32, near=0.5, depthConvention=1, zeroToOne=1)
        self.assertAlmostEqual(reversed_depth["projection"][14], 0.5, places=6)
        scene = self.context.scene()
        fire = scene.add("campfire", position=(100, 0, 0))
        camera = scene.camera(fire, 64, 32)
        self.assertAlmostEqual(camera["origin"][0], 100 + preview.cameraPosition[0], places=5)
        with self.assertRaisesRegex(fxsdk.Error, "fxScene_Update before"):
            scene.camera(scene.add("explosion"), 64, 32)
        with self.assertRaisesRegex(fxsdk.Error, "at the place at which it looks"):
            self.context.camera((0, 0, 5), (0, 0, 5), 64, 32)

    def test_a_member_that_is_mistyped_gets_a_suggestion(self):
        with self.assertRaisesRegex(TypeError, "no member depthTextur; did you mean depthTexture"):
            self.context.camera((0, 0, 5), (0, 0, 0), 64, 32, depthTextur=3)

    def test_an_eye_without_a_target_is_refused(self):
        with self.assertRaisesRegex(ValueError, "belong together"):
            fxsdk.render("sparks", eye=(0, 1, 5))

    def test_the_sky_of_a_picture_has_the_exposure_of_its_light(self):
        pixels = fxsdk.render("sparks", time=0, size=(32, 16), eye=(0, 1, 5), target=(0, 6, 0),
                              exposure=math.log2(1000.0 / 1.2), skyLuminance=(36, 36, 36))  # 1000 cd/m2 are stored as 1
        exposed = 0.036 * (1.2 - 0.7 * math.sqrt(0.8))  # about the middle of the picture
        curve = 1.055 * exposed ** (1 / 2.4) - 0.055  # of sRGB; the tone curve is straight near 0
        self.assertLess(abs(float(pixels[8, 16].mean()) / 255 - curve), 0.02)

    def test_pictures_of_no_size_are_refused(self):
        for size in ((0, 5), (5, -1), (5,), (2.5, 5), (5, 20000)):
            with self.assertRaisesRegex(ValueError, "size is"):
                fxsdk.render("sparks", size=size)

    def test_structs_are_laid_out_as_by_the_compiler(self):
        headers = os.environ.get("FX_INCLUDE")
        if not headers:
            self.skipTest("FX_INCLUDE names no folder of headers")
        lines = ["#include <fxsdk/fxsdk.h>", "#include <stddef.h>", "#include <stdio.h>", "int main(void) {"]
        expected = []
        for name in (name for name in dir(fxsdk.structs) if name.startswith("Fx")):
            struct = getattr(fxsdk.structs, name)
            lines.append(f'printf("{name} %zu\\n", sizeof({name}));')
            expected.append(f"{name} {ctypes.sizeof(struct)}")
            for member, _ in struct._fields_:
                lines.append(f'printf("{name}.{member} %zu\\n", offsetof({name}, {member}));')
                expected.append(f"{name}.{member} {getattr(struct, member).offset}")
        with tempfile.TemporaryDirectory() as folder:
            source = pathlib.Path(folder) / "layout.c"
            source.write_text("\n".join([*lines, "return 0; }", ""]))
            subprocess.run(["cc", "-I", headers, source, "-o", source.with_suffix("")], check=True)
            printed = subprocess.run([source.with_suffix("")], check=True, capture_output=True, text=True).stdout
        self.assertEqual(printed.split("\n")[:-1], expected)


class Pictures(unittest.TestCase):
    def test_png_files_hold_their_pixels(self):
        pixels = (numpy.arange(5 * 7 * 3) % 256).astype(numpy.uint8).reshape(5, 7, 3)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "a.png"
            fxsdk.write_png(path, pixels)
            data = path.read_bytes()
        import struct
        import zlib
        self.assertEqual(struct.unpack(">II", data[16:24]), (7, 5))
        start = data.index(b"IDAT")
        length, = struct.unpack(">I", data[start - 4:start])
        rows = numpy.frombuffer(zlib.decompress(data[start + 4:start + 4 + length]), numpy.uint8).reshape(5, 22)
        self.assertTrue((rows[:, 1:].reshape(5, 7, 3) == pixels).all())


if __name__ == "__main__":
    unittest.main()
