"""A test of fx edit without a display."""
import re
import shutil
import sys
import unittest

from fx_program import LIBRARY, FxTest, fx
from png_pixels import Pixels

SCRIPT = """
click /emitters/0/maxParticles
type 2*100
key enter
click solo/emitters/1
text {folder}/edited.fx.json
key ctrl+z
text {folder}/undone.fx.json
key ctrl+y
click save
"""


# A preset whose picture is soon drawn, also by the reference renderer.
SMALL = """{"version": 1,
  "emitters": [
    {"name": "balls", "maxParticles": 40, "emission": {"rate": 20, "bursts": [{"time": 0.5, "count": 4}]}, "lifetime": 2,
     "shape": "sphere", "position": [0, 1, 0], "size": 0.4, "radius": 0.25, "speed": 0.6, "opticalDepth": 3,
     "forces": {"gravity": 0, "vortices": [{"radius": 1, "speed": 1}]}}
  ],
  "preview": {"camera": {"position": [0, 1, 6], "target": [0, 1, 0]}}
}
"""


def run_tests():
    """unittest.main(); the exit code is 77 if each test was skipped, which CTest reports."""
    result = unittest.main(exit=False).result
    if result.wasSuccessful() and 0 < result.testsRun == len(result.skipped):
        sys.exit(77)
    sys.exit(not result.wasSuccessful())


class EditTest(FxTest):
    def small(self, script, *options):
        """Runs a script on the small preset; returns the outcome."""
        preset = self.write("small.fx.json", SMALL)
        events = self.write("events.txt", script.format(folder=self.folder))
        outcome = fx("edit", preset, "--headless", "--width", 960, "--height", 640, "--script", events,
                     "--recovery", self.folder / "recovery", *options)
        if "has no editor" in outcome.err:
            self.skipTest(outcome.err)
        self.assertEqual(outcome.code, 0, outcome.err)
        return outcome

    def read(self, name):
        return (self.folder / name).read_text()

    def view(self, name, places, share=(0.0, 1.0)):
        """The picture of a screenshot, without the lines of text at its top."""
        left, top, right, bottom = map(int, re.search(r"^viewport (.*)$", places, re.M)[1].split())
        width = right - left
        return Pixels(self.folder / name, (left + int(share[0] * width), top + 90, left + int(share[1] * width), bottom))

    def edit(self, script):
        preset = self.folder / "campfire.fx.json"
        shutil.copy(LIBRARY / "campfire.fx.json", preset)
        events = self.write("events.txt", script.format(folder=self.folder))
        return preset, fx("edit", preset, "--headless", "--width", 960, "--height", 640, "--script", events,
                          "--recovery", self.folder / "recovery")
