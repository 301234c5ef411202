#!/usr/bin/env python3
"""fx edit without a display: events of mouse and keyboard edit the file that they should."""
import json
import re

from edit_test import SCRIPT, SMALL, EditTest, run_tests
from fx_program import LIBRARY, fx


class Members(EditTest):
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

    def test_the_picture_follows_the_camera_and_the_time_of_the_preview(self):
        outcome = self.small("""
places
click select
shot {folder}/before.png
open /preview/camera/position/2
click /preview/camera/position/2
type 12
key enter
shot {folder}/far.png
key ctrl+z
shot {folder}/back.png
open /preview/time
click /preview/time
type 0
key enter
shot {folder}/start.png
""")
        before, far, back, start = (self.view(f"{name}.png", outcome.out) for name in ("before", "far", "back", "start"))
        self.assertNotEqual(far, before)
        self.assertEqual(back, before)
        self.assertNotEqual(start, before)

    def test_a_view_becomes_the_camera_of_the_preview_and_back(self):
        outcome = self.small("""
places
click select
shot {folder}/before.png
drag viewport 60 0
shot {folder}/turned.png
click camera
click camera/look
shot {folder}/back.png
drag viewport 60 0
click camera
click camera/take
text {folder}/taken.fx.json
shot {folder}/taken.png
key ctrl+z
text {folder}/undone.fx.json
""")
        before, turned, back, taken = (self.view(f"{name}.png", outcome.out)
                                       for name in ("before", "turned", "back", "taken"))
        self.assertNotEqual(turned, before)
        self.assertEqual(back.rows[30:], before.rows[30:])
        self.assertNotEqual(taken, before)
        camera = json.loads(self.read("taken.fx.json"))["preview"]["camera"]
        self.assertGreater(abs(camera["position"][0]), 0.5)
        self.assertEqual(camera["target"], [0, 1, 0])
        self.assertEqual(self.read("undone.fx.json"), SMALL)

    def test_one_number_of_the_sun_keeps_the_rest_of_the_light(self):
        self.small("""
click select
open /preview/lighting/sunIlluminance/0
click /preview/lighting/sunIlluminance/0
type 20000
key enter
text {folder}/edited.fx.json
key ctrl+z
text {folder}/undone.fx.json
""")
        lighting = json.loads(self.read("edited.fx.json"))["preview"]["lighting"]
        self.assertEqual(lighting, {"sunDirection": [0.55, 0.5, 0.45], "sunIlluminance": [20000, 34500, 27000],
                                    "skyLuminance": [2500, 3150, 4200]})
        self.assertEqual(self.read("undone.fx.json"), SMALL)

    def test_open_opens_what_is_closed_and_leaves_what_is_open(self):
        trail = "/emitters/0/trail"
        outcome = self.small(f"open {trail}\nopen {trail}\nopen /emitters/0/forces\nclick {trail}/lifetime\nplaces\n")
        self.assertRegex(outcome.out, r"(?m)^/emitters/0/trail/lifetime ")

    def test_a_widget_in_a_closed_header_is_named_with_the_header(self):
        _, outcome = self.edit("click select/emitters/0\nclick /emitters/0/trail/lifetime\n")
        if "has no editor" in outcome.err:
            self.skipTest(outcome.err)
        self.assertEqual(outcome.code, 1)
        self.assertIn("it may lie in the closed header /emitters/0/trail: open /emitters/0/trail", outcome.err)
        _, outcome = self.edit("click select/emitters/0\nclick /emitters/1/radius/0\n")
        self.assertIn("it may belong to /emitters/1: click select/emitters/1", outcome.err)

    def test_a_script_that_fails_leaves_its_edits_for_the_next_start(self):
        preset, outcome = self.edit("click /emitters/0/maxParticles\ntype 200\nkey enter\nclick nothing\n")
        if "has no editor" in outcome.err:
            self.skipTest(outcome.err)
        self.assertEqual(outcome.code, 1)
        kept = re.search(r"are kept in (\S+); fx edit with", outcome.err)
        self.assertTrue(kept, outcome.err)
        self.assertIn("recovery", kept[1])
        self.write("recover.txt", f"frames 1\nclick recover\ntext {self.folder}/recovered.fx.json\n")
        again = fx("edit", preset, "--headless", "--width", 960, "--height", 640, "--script",
                   self.folder / "recover.txt", "--recovery", self.folder / "recovery")
        self.assertEqual(again.code, 0, again.err)
        self.assertEqual(json.loads(self.read("recovered.fx.json"))["emitters"][0]["maxParticles"], 200)

    def test_the_parts_of_a_color_have_names(self):
        self.small("""
click select/emitters/0
open /emitters/0/emissionOverLife
click /emitters/0/emissionOverLife
at curve/canvas 0.025 0.88
click curve/color/0
type 5
key enter
click curve/color/2
type 7
key enter
text {folder}/parts.fx.json
click curve/color/all
type 3
key enter
text {folder}/all.fx.json
""")
        first = [json.loads(self.read(name))["emitters"][0]["emissionOverLife"] for name in ("parts.fx.json", "all.fx.json")]
        colors = [value["keys"][0][1] if isinstance(value, dict) else value for value in first]
        self.assertEqual(colors[0][::2], [5, 7])
        self.assertEqual(colors[1], [3, 3, 3])

    def test_what_is_added_is_valid_from_the_start(self):
        self.small("""
click select/emitters/0
open add/emitters/0/events
click add/emitters/0/events
click select
open add/preview/instance/keys
click add/preview/instance/keys
click add/preview/instance/keys
open add/preview/instance/triggers
click add/preview/instance/triggers
text {folder}/added.fx.json
""")
        outcome = fx("validate", self.folder / "added.fx.json")
        self.assertEqual(outcome.code, 0, outcome.out + outcome.err)
        preset = json.loads(self.read("added.fx.json"))
        self.assertEqual(len(preset["emitters"][0]["events"]), 1)
        keys = preset["preview"]["instance"]["keys"]
        self.assertEqual([(key["time"], key["position"]) for key in keys], [(0, [0, 0, 0]), (1, [0, 0, 0])])

    def test_the_search_finds_titles_and_names_in_the_file(self):
        for words in ("detailAmount", "Detail"):
            places = self.small(f"click select/emitters/0\nclick inspector/search\ntype {words}\nplaces\n").out
            self.assertRegex(places, r"(?m)^/emitters/0/detailAmount ")
            self.assertNotRegex(places, r"(?m)^/emitters/0/radius/0 ")

    def test_an_emitter_to_begin_with_is_added_with_a_name_of_its_own(self):
        self.small(2 * "click outliner/add\nclick add/starter/flame\n" + "text {folder}/added.fx.json\n")
        emitters = json.loads(self.read("added.fx.json"))["emitters"]
        self.assertEqual([emitter["name"] for emitter in emitters], ["balls", "flame", "flame 2"])

    def test_an_unknown_widget_is_named_with_its_line(self):
        _, outcome = self.edit("frames 1\nclick nothing\n")
        if "has no editor" in outcome.err:
            self.skipTest(outcome.err)
        self.assertEqual(outcome.code, 1)
        self.assertIn("events.txt:2: no widget has the name", outcome.err)


if __name__ == "__main__":
    run_tests()
