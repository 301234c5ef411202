#!/usr/bin/env python3
"""fx render: files that are complete or not there, frame numbers, statistics, repeatability, Ctrl-C."""
import json
import os
import pty
import shutil
import signal
import struct
import subprocess
import time
import unittest
import zlib

from fx_program import FX, LIBRARY, PATIENCE, FxTest, fx

SMALL = ("--size", "48x32")
STATISTICS = {"time", "instances_active", "instances_dormant", "particles", "blobs", "passes", "programs_compiled", "gl_calls",
              "bytes_textures", "ms_simulate", "ms_render", "allocations", "nonfinite"}


def png_size(path):
    """Width and height; raises unless the file begins and ends as a PNG does."""
    data = path.read_bytes()
    if data[:8] != b"\x89PNG\r\n\x1a\n" or data[-8:-4] != b"IEND":
        raise ValueError(f"{path} is not a whole PNG")
    return struct.unpack(">II", data[16:24])


def png_of_one_texel(red, green, blue):
    """A PNG of 1 x 1 opaque texels."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 1, 1, 8, 6, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(bytes([0, red, green, blue, 255]))) + chunk(b"IEND", b""))


class FxRender(FxTest):
    def render(self, output, *arguments, scene="library:sparks"):
        outcome = fx("render", scene, "-o", self.folder / output, *SMALL, *arguments)
        self.assertEqual(outcome.code, 0, outcome.err)
        return outcome

    def interrupt(self, output, ready):
        """Starts a long job, waits until `ready()`, sends Ctrl-C; returns the exit code."""
        process = subprocess.Popen([FX, "render", "library:explosion", "-o", self.folder / output, "--size", "320x240",
                                    "--frames", "0:5000"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while not ready() and process.poll() is None:
            time.sleep(0.05)
        process.send_signal(signal.SIGINT)
        return process.wait(PATIENCE)

    def test_a_texture_beside_the_preset_is_what_sprites_show(self):
        preset = self.folder / "p.fx.json"
        preset.write_text("""{"version": 1, "emitters": [{"position": [0, 1, 0], "radius": 0.5, "forces": {"gravity": 0},
            "emission": {"bursts": [{"time": 0, "count": 1}]}, "lifetime": 9,
            "appearance": {"kind": "sprite", "texture": "t.png", "lit": 0, "luminance": 5000}}]}""")
        missing = fx("validate", preset)
        self.assertEqual(missing.code, 1)
        self.assertIn("/emitters/0/appearance/texture", missing.err + missing.out)
        pictures = []
        for color in ((255, 0, 0), (0, 0, 255)):
            (self.folder / "t.png").write_bytes(png_of_one_texel(*color))
            self.assertEqual(fx("validate", preset).code, 0)
            self.render("p.png", scene=preset)
            pictures.append((self.folder / "p.png").read_bytes())
        self.assertNotEqual(pictures[0], pictures[1])

    def test_a_preset_is_shown_at_the_time_from_the_place_and_in_the_light_of_its_preview(self):
        text = """{"version": 1, "emitters": [{"radius": 0.5, "forces": {"gravity": 0}, "lifetime": 0.4,
            "emission": {"bursts": [{"time": 0.9, "count": 1}]}, "appearance": {"kind": "sprite", "lit": 0, "luminance": 5000}}]%s}"""
        preset = self.folder / "p.fx.json"

        def picture(preview, *arguments):
            preset.write_text(text % preview)
            self.assertEqual(fx("validate", preset).code, 0)
            self.render("p.png", *arguments, scene=preset)
            return (self.folder / "p.png").read_bytes()

        camera = '"camera": {"position": [0, 1, 5], "target": [0, 1, 0]}'
        at_one = picture(', "preview": {"time": 1, %s}' % camera)
        self.assertEqual(at_one, picture(', "preview": {%s}' % camera, "--time", "1"))
        self.assertNotEqual(at_one, picture(', "preview": {"time": 1, %s}' % camera, "--time", "0.5"))
        self.assertNotEqual(at_one, picture(', "preview": {"time": 1, "exposureEv100": 10, %s}' % camera))
        self.assertNotEqual(at_one, picture(', "preview": {"time": 1, "instance": {"position": [1, 1, 0]}, %s}' % camera))

    def test_a_stage_replaces_the_surroundings_of_the_preview(self):
        preset = self.write("p.fx.json", """{"version": 1, "emitters": [{"emission": {"rate": 1}}], "preview": {"time": 0.5,
            "camera": {"position": [0, 1, 5], "target": [0, 1, 0]}, "background": {"color": [9000, 0, 0]}, "exposureEv100": 9}}""")
        pictures = {}
        for stage in ("ground", "courtyard", "night", "wall", "corridor", "water", "studio-gray"):
            self.render("p.png", "--stage", stage, scene=preset)
            pictures[stage] = (self.folder / "p.png").read_bytes()
        self.assertEqual(len(set(pictures.values())), 7)
        # The first stage is where presets without a preview stand.
        bare = self.write("bare.fx.json", """{"version": 1, "emitters": [{"emission": {"rate": 1}}], "preview": {"time": 0.5,
            "camera": {"position": [0, 1, 5], "target": [0, 1, 0]}}}""")
        self.render("p.png", scene=bare)
        self.assertEqual((self.folder / "p.png").read_bytes(), pictures["ground"])

    def test_a_stage_must_exist_and_needs_a_preset(self):
        wrong = fx("render", "library:sparks", "-o", self.folder / "p.png", "--stage", "wal")
        self.assertEqual(wrong.code, 2)
        self.assertIn("wall", wrong.err)
        scene = self.write("s.scene.json", '{"version": 1, "instances": []}')
        refused = fx("render", scene, "-o", self.folder / "p.png", "--stage", "wall")
        self.assertNotEqual(refused.code, 0)
        self.assertIn("--stage needs a preset", refused.err)

    def test_a_preset_stands_where_it_says_with_ground_and_without(self):
        text = """{"version": 1, %s "emitters": [{"position": [0, 1, 0], "radius": 0.5, "forces": {"gravity": 0}, "lifetime": 9,
            "emission": {"bursts": [{"time": 0, "count": 1}]}, "appearance": {"kind": "sprite", "lit": 0, "luminance": 5000}}],
            "preview": {"camera": {"position": [0, 1, 5], "target": [0, 1, 0]}}}"""
        preset = self.folder / "p.fx.json"
        pictures = []
        for ground in ("", '"ground": true,', '"ground": false,'):
            preset.write_text(text % ground)
            self.render("p.png", scene=preset)
            pictures.append((self.folder / "p.png").read_bytes())
        self.assertEqual(pictures[0], pictures[1])
        self.assertEqual(pictures[0], pictures[2])

    def test_options_place_the_camera_for_opengl_too(self):
        scene = self.folder / "campfire.scene.json" # with a camera, so that all pictures have its near plane
        scene.write_text(json.dumps({"version": 1, "camera": {"position": [0, 1, 4], "target": [0, 1, 0]},
                                     "instances": [{"preset": "library:campfire"}]}))

        def picture(name, *arguments):
            self.render(name, "--time", "0.5", *arguments, scene=scene)
            return (self.folder / name).read_bytes()

        given = picture("scene.png")
        left = picture("left.png", "--view", "-3,1,0,0,1,0,40")
        self.assertNotEqual(given, left)
        self.assertNotEqual(left, picture("right.png", "--view", "3,1,0,0,1,0,40"))
        path = self.folder / "camera.scene.json"
        path.write_text(json.dumps({"version": 1, "camera": {"position": [-3, 1, 0], "target": [0, 1, 0],
                                                             "fovYDegrees": 40}}))
        self.assertEqual(left, picture("file.png", "--camera", str(path)))

    def test_options_of_the_other_renderers_are_refused_with_opengl(self):
        for option in ("--samples", "2"), ("--detail", "off"), ("--threads", "1"), ("--resume",):
            outcome = fx("render", "library:sparks", "-o", self.folder / "no.png", *SMALL, *option)
            self.assertEqual(outcome.code, 2)
            self.assertIn(option[0] + " needs --renderer reference or path", outcome.err)
        self.assertFalse((self.folder / "no.png").exists())

    def test_a_still_is_one_png_of_the_size_asked_for(self):
        self.render("a.png")
        self.assertEqual(self.names(), ["a.png"])
        self.assertEqual(png_size(self.folder / "a.png"), (48, 32))

    def test_frames_are_numbered_as_asked_first_and_last_included(self):
        self.render("a.%03d.png", "--frames", "3:5")
        self.assertEqual(self.names(), ["a.003.png", "a.004.png", "a.005.png"])

    def test_the_same_command_gives_the_same_picture_and_another_seed_another_one(self):
        self.render("a.png", "--seed", "5")
        self.render("b.png", "--seed", "5")
        self.render("c.png", "--seed", "6")
        a, b, c = ((self.folder / name).read_bytes() for name in ("a.png", "b.png", "c.png"))
        self.assertEqual(a, b)
        self.assertNotEqual(a, c)

    def test_a_frame_of_a_sequence_shows_what_the_still_of_its_time_shows(self):
        alone = ("--no-dazzle", "--light-slices", "off")  # eyes adapt and planes fade over some frames
        self.render("a.%d.png", "--frames", "0:12", *alone, scene="library:explosion")
        self.render("still.png", "--time", "0.4", *alone, scene="library:explosion")
        still, frame = ((self.folder / name).read_bytes() for name in ("still.png", "a.12.png"))
        self.assertEqual(still, frame)

    def test_a_preset_is_drawn_in_the_composition_that_it_asks_for(self):
        def composition(scene, *arguments):
            self.render("a.png", "--time", "0.1", "--stats", self.folder / "s.json", *arguments, scene=scene)
            return json.loads((self.folder / "s.json").read_text())["composition"]
        self.assertEqual(composition("library:dust-burst"), "volume")
        self.assertEqual(composition("library:dust-burst", "--composition", "slabs"), "slabs")
        self.assertEqual(composition("library:sparks"), "sorted")
        scene = {"version": 1, "camera": {"position": [0, 1, 5], "target": [0, 1, 0]}, "instances": [{"preset": "library:dust-burst"}]}
        for member, expected in (({}, "sorted"), ({"composition": "automatic"}, "volume")):
            self.assertEqual(composition(self.write("s.scene.json", json.dumps(scene | member))), expected)

    def test_a_range_that_begins_late_shows_what_playing_shows_whatever_happens_to_an_instance(self):
        (self.folder / "s.fx.json").write_text("""{"version": 1, "emitters": [
            {"name": "a", "space": "world", "inheritVelocity": 0.5, "radius": 0.2, "lifetime": 1, "emission": {"rate": 60},
             "speed": {"min": 0, "max": 1}, "appearance": {"kind": "sprite", "luminance": 3000},
             "events": [{"on": "host", "name": "boom", "emit": "b", "count": 30}]},
            {"name": "b", "space": "world", "radius": 0.3, "lifetime": 1, "speed": 4, "emission": {"rate": 0},
             "appearance": {"kind": "sprite", "luminance": 5000}}]}""")
        scene = self.folder / "s.scene.json"
        text = """{"version": 1, "camera": {}, "instances": [{"preset": "s.fx.json", "start": 0.1,
            "keys": [{"time": 0, "position": [-3, 2, 0]}, {"time": 0.6, "position": [3, 2, 0]}, {"time": 1, "position": [0, 4, 0]}],
            "speed": {"steps": [[0.3, 2], [0.5, 0.5]]}, "emitting": {"steps": [[0.9, false]]}%s}]}"""
        scene.write_text(text % ', "triggers": [{"time": 0.4, "name": "boom"}]')
        self.render("all.%02d.png", "--frames", "0:20", "--fps", "24", "--no-dazzle", scene=scene)
        self.render("late.%02d.png", "--frames", "12:20", "--fps", "24", "--no-dazzle", scene=scene)
        self.render("times.%d.png", "--times", "0.5,0.75", "--no-dazzle", scene=scene)
        frames = [(self.folder / f"all.{n:02d}.png").read_bytes() for n in range(12, 21)]
        self.assertEqual(frames, [(self.folder / f"late.{n:02d}.png").read_bytes() for n in range(12, 21)])
        self.assertEqual([frames[0], frames[6]], [(self.folder / f"times.{n}.png").read_bytes() for n in (0, 1)])
        scene.write_text(text % "")
        self.render("silent.png", "--time", "0.5", "--no-dazzle", scene=scene)
        self.assertNotEqual((self.folder / "silent.png").read_bytes(), frames[0])

    def test_times_are_one_file_each_or_one_sheet(self):
        self.render("a.%d.png", "--times", "0.1,0.2,0.5")
        self.assertEqual(self.names(), ["a.0.png", "a.1.png", "a.2.png"])
        self.render("sheet.png", "--times", "0.1,0.2,0.5")
        self.assertEqual(png_size(self.folder / "sheet.png"), (96, 64))
        preset = self.folder / "p.fx.json" # whose preview is later than the times
        effect = json.loads(LIBRARY.joinpath("sparks.fx.json").read_text())
        effect["preview"] = {"time": 2}
        preset.write_text(json.dumps(effect))
        self.render("two.png", "--times", "0.1,0.2", "--stats", self.folder / "stats.json", scene=preset)
        shown = [json.loads(line)["time"] for line in (self.folder / "stats.json").read_text().splitlines()]
        self.assertEqual([round(time, 6) for time in shown], [0.1, 0.2])
        for wrong in ("0.2,0.1", "0.1,", "a", "-1", "0,nan", "0,9999"):
            self.assertEqual(fx("render", "library:sparks", "-o", self.folder / "a.png", f"--times={wrong}").code, 2, wrong)
        for output, more in (("a.mp4", ()), ("a.exr", ()), ("a.%d.png", ("--frames", "0:1")), ("a.png", ("--time", "1"))):
            self.assertEqual(fx("render", "library:sparks", "-o", self.folder / output, "--times", "0,1", *more).code, 2)

    def test_compute_moves_emitters_of_any_preset_with_their_files(self):
        (self.folder / "t.png").write_bytes(png_of_one_texel(255, 0, 0))
        preset = self.folder / "p.fx.json"
        preset.write_text("""{"version": 1, "emitters": [{"position": [0, 1, 0], "radius": 0.3, "speed": 1, "maxParticles": 50,
            "emission": {"rate": 40}, "lifetime": 1, "appearance": {"kind": "sprite", "texture": "t.png", "luminance": 5000}}]}""")
        on_gpu = 50 if os.environ.get("FX_GPU_PARTICLES", "1") == "1" else 0
        for where, computed in (("cpu", 0), ("gpu", on_gpu), ("auto", 0)):
            self.render(f"{where}.png", "--compute", where, "--stats", self.folder / "stats.json", scene=preset)
            self.assertEqual(json.loads((self.folder / "stats.json").read_text())["particles_gpu"], computed, where)
        self.assertEqual((self.folder / "cpu.png").read_bytes(), (self.folder / "auto.png").read_bytes())

    def test_statistics_have_every_promised_field_once_a_frame(self):
        self.render("a.%d.png", "--frames", "0:2", "--overdraw", "--stats", self.folder / "stats.json")
        lines = [json.loads(line) for line in (self.folder / "stats.json").read_text().strip().split("\n")]
        self.assertEqual([round(line["time"] * 30) for line in lines], [0, 1, 2])
        for line in lines:
            self.assertLessEqual(STATISTICS, set(line))
            self.assertEqual(line["nonfinite"], 0)
            self.assertEqual(line["programs_compiled"], 0)
        self.assertGreater(lines[-1]["blobs"], 0)
        self.assertGreaterEqual(lines[-1]["shaded_fragments"], lines[-1]["covered_pixels"])

    def test_programs_that_frames_compile_show_what_those_compiled_before_show(self):
        sprites = self.write("s.fx.json", """{"version": 1, "emitters": [{"position": [0, 1, 0], "speed": 1, "compute": "gpu",
            "maxParticles": 50, "emission": {"rate": 40}, "lifetime": 1, "appearance": {"kind": "sprite", "luminance": 5000}}]}""")
        for scene, composition in (("library:campfire", "sorted"), ("library:explosion", "volume"), (sprites, "sorted")):
            pictures = []
            for arguments in ((), ("--stats", self.folder / "s.json")): # which compiles all programs before
                self.render("a.png", "--time", "0.5", "--composition", composition, *arguments, scene=scene)
                pictures.append((self.folder / "a.png").read_bytes())
            self.assertEqual(pictures[0], pictures[1], scene)

    def test_json_is_one_object_a_frame_that_names_file_machine_and_seed(self):
        outcome = self.render("a.%d.png", "--frames", "1:2", "--json", "--seed", "9")
        lines = [json.loads(line) for line in outcome.out.strip().split("\n")]
        self.assertEqual([line["file"] for line in lines], [str(self.folder / f"a.{n}.png") for n in (1, 2)])
        for line in lines:
            self.assertEqual(line["seed"], 9)
            self.assertTrue(line["machine"]["gl_renderer"])
            self.assertTrue(line["version"])
        self.assertEqual(outcome.err, "")

    def test_interrupting_a_sequence_leaves_whole_files_only(self):
        code = self.interrupt("a.%04d.png", lambda: len(self.names()) >= 3)
        self.assertEqual(code, 130)
        self.assertGreaterEqual(len(self.names()), 3)
        for name in self.names():
            self.assertRegex(name, r"^a\.\d{4}\.png$")
            self.assertEqual(png_size(self.folder / name), (320, 240))

    def test_interrupting_a_video_leaves_nothing(self):
        if shutil.which("ffmpeg") is None:
            self.skipTest("ffmpeg is not installed")
        self.assertEqual(self.interrupt("a.mp4", lambda: len(self.names()) >= 1), 130)
        self.assertEqual(self.names(), [])

    def test_a_video_without_ffmpeg_is_refused_with_the_remedy(self):
        empty = self.folder / "empty"
        empty.mkdir()
        outcome = fx("render", "library:sparks", "-o", self.folder / "a.mp4", *SMALL, env={"PATH": str(empty)})
        self.assertEqual(outcome.code, 1)
        self.assertIn("apt-get install ffmpeg", outcome.err)
        self.assertEqual(self.names(), ["empty"])

    def test_a_full_disk_is_a_failure_wherever_it_shows(self):
        os.symlink("/dev/full", self.folder / "a.png")
        outcome = fx("render", "library:sparks", "-o", self.folder / "a.png", *SMALL)
        self.assertEqual(outcome.code, 1)
        self.assertIn("a.png", outcome.err)
        outcome = fx("render", "library:sparks", "-o", self.folder / "b.png", *SMALL, "--stats", "/dev/full")
        self.assertEqual(outcome.code, 1)
        self.assertIn("/dev/full", outcome.err)

    def test_progress_goes_to_terminals_only(self):
        self.assertEqual(self.render("a.png").err, "")
        reader, terminal = pty.openpty()
        subprocess.run([FX, "render", "library:sparks", "-o", self.folder / "b.png", *SMALL], stdout=subprocess.DEVNULL,
                       stderr=terminal, check=True)
        os.close(terminal)
        self.assertIn(b"frame 0/1", os.read(reader, 4096))
        os.close(reader)


if __name__ == "__main__":
    unittest.main()
