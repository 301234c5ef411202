#!/usr/bin/env python3
"""fx link and fx edit --link change a preset of a game that runs: examples/04_live_link, and with a picture
examples/05_live_picture. FX_LINK_SHOTS: a folder for its pictures before and after the edit."""
import json
import os
import re
import shutil
import signal
import subprocess
import time
import unittest

from fx_program import LIBRARY, PATIENCE, FxTest, fx
from png_pixels import Pixels

HOST = os.environ.get("FX_LIVE_LINK_HOST", "build/bin/04_live_link")
PICTURE_HOST = os.environ.get("FX_LIVE_PICTURE_HOST", "build/bin/05_live_picture")
SHOTS = os.environ.get("FX_LINK_SHOTS")

PRESET = """{"version": 1, "name": "fountain", "ground": false, "emitters": [{
  "maxParticles": 300, "position": [0, %g, 0], "emission": {"rate": 60}, "lifetime": 3, "speed": 0.2,
  "radius": 0.1, "forces": {"gravity": 0}}]}
"""


def edit_in_editor(test, game, axis, value):
    """Types a component of the position of the first emitter into an editor that is linked to a game."""
    script = test.write("events.txt", f"""
click select/emitters/0
click /emitters/0/position/{axis}
type {value}
key enter
linked
""")
    outcome = fx("edit", test.preset, "--headless", "--width", 960, "--height", 640, "--script", script,
                 "--recovery", test.folder / "recovery", "--link", game, env=test.env)
    if "has no editor" in outcome.err:
        test.skipTest(outcome.err)
    test.assertEqual(outcome.code, 0, outcome.err)
    test.assertIn("shown by 1 instance", outcome.out)


class Link(FxTest):
    def setUp(self):
        super().setUp()
        self.runtime = self.folder / "run"
        self.runtime.mkdir(mode=0o700)
        self.env = dict(os.environ, XDG_RUNTIME_DIR=str(self.runtime))
        self.preset = self.write("fountain.fx.json", PRESET % 1)
        self.host = subprocess.Popen([HOST, str(self.preset), "--link", "test-game"], env=self.env,
                                     stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    def tearDown(self):
        self.host.kill()
        self.host.wait()
        self.host.stdout.close()
        super().tearDown()

    def height(self):
        """Mean height in the next line of the game."""
        line = self.host.stdout.readline()
        return float(re.search(r"mean height (\S+) m", line).group(1))

    def wait_for_height(self, wanted):
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            if abs(self.height() - wanted) < 0.6:
                return
        self.fail("the game does not show the edit")

    def link(self, *arguments):
        return fx("link", *arguments, env=self.env)

    def test_a_preset_is_listed_and_replaced_while_the_game_runs(self):
        self.wait_for_height(1)
        listed = self.link("list", "--json")
        self.assertEqual(listed.code, 0, listed.err)
        game = json.loads(listed.out)
        self.assertEqual([p["name"] for p in game["presets"]], ["fountain"])
        self.assertEqual(game["presets"][0]["instances"], 1)
        self.assertIn("fountain.fx.json", self.link("list").out)

        self.preset.write_text(PRESET % 50)
        sent = self.link("send", self.preset, "--to", "test-game")
        self.assertEqual(sent.code, 0, sent.err)
        self.assertIn("shown by 1 instances", sent.out)
        self.wait_for_height(50)

        self.preset.write_text(PRESET.replace("lifetime", "lifetme") % 70)
        refused = self.link("send", self.preset, "--to", "test-game")
        self.assertEqual(refused.code, 1)
        self.assertIn("lifetme", refused.err)
        self.wait_for_height(50)

        unknown = self.link("send", "library:sparks", "--to", "test-game")
        self.assertEqual(unknown.code, 1)
        self.assertIn("has no preset", unknown.err)
        named = self.link("send", "library:sparks", "--to", "test-game", "--name", "fountain")
        self.assertEqual(named.code, 0, named.err)
        wrong = self.link("send", self.preset, "--to", "other-game")
        self.assertEqual(wrong.code, 1)
        self.assertIn("test-game", wrong.err)

    def test_the_editor_shows_its_edits_in_the_game(self):
        self.wait_for_height(1)
        edit_in_editor(self, "test-game", 1, 40)
        self.wait_for_height(40)


# Glowing balls that stay where they are born: on the left, and after the edit on the right.
GLOW = """{"version": 1, "name": "glow", "ground": false, "emitters": [{
  "maxParticles": 300, "layer": "fire", "position": [%g, 1.5, 0], "emission": {"rate": 60}, "lifetime": 3, "speed": 0.2,
  "radius": 0.2, "temperature": 1900, "forces": {"gravity": 0}}]}
"""


class PictureLink(FxTest):
    def setUp(self):
        super().setUp()
        if "FX_LIVE_PICTURE_HOST" not in os.environ and not os.path.exists(PICTURE_HOST):
            self.skipTest("the example with a picture is not built: epoxy and spng are missing")
        runtime = self.folder / "run"
        runtime.mkdir(mode=0o700)
        self.env = dict(os.environ, XDG_RUNTIME_DIR=str(runtime))
        self.preset = self.write("glow.fx.json", GLOW % -2)
        self.picture = self.folder / "game.png"
        self.host = subprocess.Popen([PICTURE_HOST, str(self.preset), str(self.picture), "--link", "picture-game"],
                                     env=self.env, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)

    def tearDown(self):
        if hasattr(self, "host"):
            self.host.kill()
            self.host.communicate()
        super().tearDown()

    def bright(self):
        """Bright pixels of the left and of the right half of the present picture."""
        pixels = Pixels(self.picture)
        half = len(pixels.rows[0]) // 6 * 3
        return [sum(red > 200 for row in pixels.rows for red in row[first:last:3])
                for first, last in ((0, half), (half, 2 * half))]

    def wait_until(self, holds, what):
        end = time.monotonic() + PATIENCE
        while not (self.picture.exists() and holds(*self.bright())):
            self.assertIsNone(self.host.poll(), "the game has ended")
            self.assertLess(time.monotonic(), end, what)
            time.sleep(0.1)

    def shot(self, name):
        if SHOTS:
            os.makedirs(SHOTS, exist_ok=True)
            shutil.copy(self.picture, os.path.join(SHOTS, name))

    def test_the_picture_of_a_game_shows_the_edit_while_it_runs(self):
        self.wait_until(lambda left, right: left > 100 > right, "the game shows the preset on the left")
        self.shot("before.png")
        edit_in_editor(self, "picture-game", 0, 2)
        self.wait_until(lambda left, right: right > 100 > left, "the game shows the edit on the right")
        self.shot("after.png")
        self.assertEqual(self.preset.read_text(), GLOW % -2) # the editor has not saved


if __name__ == "__main__":
    unittest.main()
