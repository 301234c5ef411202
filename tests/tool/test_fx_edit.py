#!/usr/bin/env python3
"""fx edit without a display: events of mouse and keyboard edit the file that they should."""
import json
import shutil
import unittest

from fx_program import LIBRARY, FxTest, fx

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


class Edit(FxTest):
    def edit(self, script):
        preset = self.folder / "campfire.fx.json"
        shutil.copy(LIBRARY / "campfire.fx.json", preset)
        events = self.write("events.txt", script.format(folder=self.folder))
        return preset, fx("edit", preset, "--headless", "--width", 960, "--height", 640, "--script", events,
                          "--recovery", self.folder / "recovery")

    def test_a_typed_number_is_undone_redone_and_saved(self):
        preset, outcome = self.edit(SCRIPT)
        if "has no editor" in outcome.err:
            self.skipTest(outcome.err)
        self.assertEqual(outcome.code, 0, outcome.err)
        before = (LIBRARY / "campfire.fx.json").read_text()
        self.assertEqual((self.folder / "undone.fx.json").read_text(), before)
        self.assertEqual((self.folder / "edited.fx.json").read_text(), preset.read_text())
        self.assertEqual(json.loads(preset.read_text())["emitters"][0]["maxParticles"], 200)
        changed = [a for a, b in zip(before.splitlines(), preset.read_text().splitlines()) if a != b]
        self.assertEqual(changed, [f'      "maxParticles": {json.loads(before)["emitters"][0]["maxParticles"]},'])

    def test_an_unknown_widget_is_named_with_its_line(self):
        _, outcome = self.edit("frames 1\nclick nothing\n")
        if "has no editor" in outcome.err:
            self.skipTest(outcome.err)
        self.assertEqual(outcome.code, 1)
        self.assertIn("events.txt:2: no widget has the name", outcome.err)


if __name__ == "__main__":
    unittest.main()
