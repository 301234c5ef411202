#!/usr/bin/env python3
"""fx edit without a display: triggers and camera keys on the timeline, motions of the effect, and keys that are struck fast."""
import json

from edit_test import SMALL, EditTest, run_tests
from fx_program import fx

LISTENING = SMALL.replace('"emitters": [', '''"emitters": [
    {"name": "hits", "maxParticles": 200, "emission": {"rate": 0}, "lifetime": 3, "radius": 0.3, "speed": 0, "opticalDepth": 6,
     "shape": "sphere", "size": 1, "forces": {"gravity": 0}},
    {"name": "listener", "maxParticles": 1, "emission": {"rate": 0}, "lifetime": 1, "position": [0, 1, 0],
     "events": [{"on": "host", "name": "hit", "emit": "hits", "count": 100}, {"on": "host", "name": "miss", "emit": "hits"}]},''')
SCENE = """{
  "version": 1,
  "camera": {
    "position": [0, 1, 6], "target": [0, 1, 0],
    "keys": [
      {"time": 1, "position": [0, 1, 6], "target": [0, 1, 0]},
      {"time": 3, "position": [6, 3, 1], "target": [0, 1, 0]}
    ]
  },
  "lighting": {"sunIlluminance": 17500, "skyLuminance": 900},
  "instances": [{"preset": "library:campfire", "position": [0, 0, 0]}]
}
"""


class Timeline(EditTest):
    def run_script(self, name, text, script):
        self.write("small.fx.json", SMALL)
        document = self.write(name, text)
        events = self.write("events.txt", script.format(folder=self.folder))
        outcome = fx("edit", document, "--headless", "--width", 960, "--height", 640, "--script", events,
                     "--recovery", self.folder / "recovery")
        if "has no editor" in outcome.err:
            self.skipTest(outcome.err)
        self.assertEqual(outcome.code, 0, outcome.err)
        return outcome

    def triggers(self, name):
        return json.loads(self.read(name))["preview"]["instance"].get("triggers")

    def test_a_trigger_is_added_dragged_and_removed_with_one_undo_each(self):
        outcome = self.run_script("listening.fx.json", LISTENING, """
time 1.5
places
shot {folder}/before.png
time 1
click timeline/trigger
click timeline/trigger/hit
text {folder}/added.fx.json
time 1.5
shot {folder}/after.png
drag mark/preview/instance/triggers/0/time 60 0
text {folder}/dragged.fx.json
rightclick mark/preview/instance/triggers/0/time
text {folder}/removed.fx.json
key ctrl+z
text {folder}/again.fx.json
key ctrl+z
key ctrl+z
text {folder}/undone.fx.json
""")
        self.assertEqual(self.triggers("added.fx.json"), [{"time": 1, "name": "hit"}])
        self.assertNotEqual(self.view("after.png", outcome.out), self.view("before.png", outcome.out))
        moved = self.triggers("dragged.fx.json")[0]["time"]
        self.assertGreater(moved, 1.3)
        self.assertEqual(round(100 * moved, 6), round(100 * moved))
        self.assertIsNone(self.triggers("removed.fx.json"))
        self.assertEqual(self.read("again.fx.json"), self.read("dragged.fx.json"))
        self.assertEqual(self.read("undone.fx.json"), LISTENING)

    def test_a_trigger_needs_someone_who_listens(self):
        self.run_script("deaf.fx.json", SMALL, "click timeline/trigger\ntext {folder}/same.fx.json\n")
        self.assertEqual(self.read("same.fx.json"), SMALL)

    def test_keys_of_the_camera_are_added_from_the_view_moved_removed_and_saved(self):
        self.run_script("moving.scene.json", SCENE, """
text {folder}/opened.scene.json
time 2
drag viewport 60 20
click timeline/camera key
text {folder}/added.scene.json
drag mark/camera/keys/1/time 10 0
text {folder}/dragged.scene.json
rightclick mark/camera/keys/1/time
text {folder}/removed.scene.json
key ctrl+z
click save
key ctrl+z
key ctrl+z
text {folder}/undone.scene.json
""")
        self.assertEqual(self.read("opened.scene.json"), SCENE)
        before = json.loads(SCENE)
        added = json.loads(self.read("added.scene.json"))
        self.assertEqual([key["time"] for key in added["camera"]["keys"]], [1, 2, 3])
        key = added["camera"]["keys"].pop(1)
        self.assertEqual(added, before)
        self.assertNotEqual(key["position"], [0, 1, 6])
        self.assertAlmostEqual(sum((a - b) ** 2 for a, b in zip(key["position"], key["target"])), 36, places=1)
        moved = json.loads(self.read("dragged.scene.json"))["camera"]["keys"][1]
        self.assertGreater(moved["time"], 2)
        self.assertEqual(moved["position"], key["position"])
        self.assertEqual(self.read("removed.scene.json"), SCENE)
        self.assertEqual(self.read("moving.scene.json"), self.read("dragged.scene.json"))
        self.assertEqual(self.read("undone.scene.json"), SCENE)

    def test_the_view_follows_the_keys_of_the_camera_until_it_is_moved(self):
        outcome = self.run_script("moving.scene.json", SCENE, """
click overlays
click overlay/shapes
key escape
time 1
places
click timeline/follow
frames 2
shot {folder}/first.png
time 3
shot {folder}/last.png
time 1
shot {folder}/again.png
time 3
drag viewport 1 0
time 1
shot {folder}/free.png
text {folder}/same.scene.json
""")
        first, last, again, free = (self.view(f"{name}.png", outcome.out) for name in ("first", "last", "again", "free"))
        self.assertNotEqual(first, last)
        self.assertEqual(first, again)
        self.assertNotEqual(free, first)
        self.assertEqual(self.read("same.scene.json"), SCENE)

    def test_each_motion_shows_another_picture_and_the_document_is_the_same(self):
        text = SMALL.replace('"preview": {', '''"preview": {"instance": {"keys": [
    {"time": 0, "position": [0, 0, 0]}, {"time": 2, "position": [1.5, 0, 0]}]}, "time": 1.2, ''')
        script = "click overlays\nclick overlay/shapes\nkey escape\ntime 0.6\nplaces\n"
        kinds = ("document", "still", "circle", "throw", "document")
        for i, kind in enumerate(kinds):
            script += f"click motion\nclick motion/{kind}\nkey escape\nframes 2\nshot {{folder}}/{i}.png\n"
        outcome = self.run_script("moving.fx.json", text, script + "text {folder}/same.fx.json\n")
        views = [self.view(f"{i}.png", outcome.out) for i in range(len(kinds))]
        for i in range(4):
            for j in range(i):
                self.assertNotEqual(views[i], views[j], (kinds[i], kinds[j]))
        self.assertEqual(views[4], views[0])
        self.assertEqual(self.read("same.fx.json"), text)

    def test_keys_that_are_struck_within_one_frame_are_all_seen(self):
        burst = "mark/emitters/0/emission/bursts/0/time"
        self.run_script("small.fx.json", SMALL, f"""
drag {burst} 20 0
drag {burst} 20 0
drag {burst} 20 0
text {{folder}}/three.fx.json
strike ctrl+z ctrl+z ctrl+z
text {{folder}}/undone.fx.json
strike ctrl+y ctrl+y
strike ctrl+y
text {{folder}}/redone.fx.json
strike ctrl+z ctrl+s
""")
        self.assertEqual(self.read("undone.fx.json"), SMALL)
        self.assertEqual(self.read("redone.fx.json"), self.read("three.fx.json"))
        saved = json.loads(self.read("small.fx.json"))["emitters"][0]["emission"]["bursts"][0]["time"]
        self.assertLess(saved, json.loads(self.read("three.fx.json"))["emitters"][0]["emission"]["bursts"][0]["time"])
        self.assertGreater(saved, 0.5)


if __name__ == "__main__":
    run_tests()
