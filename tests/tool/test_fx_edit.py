#!/usr/bin/env python3
"""fx edit without a display: the picture, what is shown in it, and what is written of it.

FX_EDIT_EDITS: edits of the test of many edits in a row (default 60)."""
import json
import os
import re

from edit_test import SMALL, EditTest, run_tests
from fx_program import fx
from png_pixels import Pixels

EDITS = int(os.environ.get("FX_EDIT_EDITS", "60"))


class Picture(EditTest):
    def test_a_stage_changes_the_picture_and_the_file_only_when_it_is_kept(self):
        outcome = self.small("""
places
shot {folder}/document.png
click stage
click stage/night
key escape
shot {folder}/night.png
text {folder}/chosen.fx.json
click stage
click stage/reset
click stage/figure
key escape
shot {folder}/figure.png
click stage
click stage/studio-gray
click stage/sun/elevation
type 20
key enter
click stage/keep
key escape
text {folder}/kept.fx.json
key ctrl+z
text {folder}/undone.fx.json
""")
        names = ("document.png", "night.png", "figure.png")
        document, night, figure = (self.view(name, outcome.out) for name in names)
        self.assertLess(night.mean(), 0.5 * document.mean())
        self.assertNotEqual(figure, document)
        self.assertEqual(self.read("chosen.fx.json"), SMALL)
        self.assertEqual(self.read("undone.fx.json"), SMALL)
        preview = json.loads(self.read("kept.fx.json"))["preview"]
        self.assertEqual(preview["mesh"], {"file": "library:stage-studio-gray.obj"})
        self.assertAlmostEqual(preview["lighting"]["sunDirection"][1], 0.34202, places=5)
        self.assertIn("figure", preview)

    def test_sun_and_sky_are_dragged_in_the_picture_and_kept_as_one_edit(self):
        outcome = self.small("""
places
shot {folder}/document.png
drag handle/sky 0 -30
shot {folder}/brighter.png
text {folder}/view.fx.json
drag handle/sunlight 0 60
shot {folder}/darker.png
drag handle/sun 12 6
click handle/sky
click sky/0
type 500000
key enter
shot {folder}/red.png
click sky/keep
text {folder}/kept.fx.json
key escape
key ctrl+z
text {folder}/undone.fx.json
""")
        document, brighter, darker, red = (self.view(f"{name}.png", outcome.out, (0.0, 0.3))
                                           for name in ("document", "brighter", "darker", "red"))
        self.assertGreater(brighter.mean(), document.mean())
        self.assertLess(darker.mean(), brighter.mean())
        self.assertNotEqual(red, darker)
        self.assertEqual(self.read("view.fx.json"), SMALL)
        self.assertEqual(self.read("undone.fx.json"), SMALL)
        preview = json.loads(self.read("kept.fx.json"))["preview"]
        red, green, blue = preview["lighting"]["skyLuminance"]
        self.assertEqual(red, 500000)
        self.assertGreater(green, 1000)
        self.assertIn("sunDirection", preview["lighting"])
        self.assertGreater(preview["background"]["color"][0], preview["background"]["color"][2])

    def test_an_own_mesh_stands_in_the_picture(self):
        self.write("own.obj", "v -9 -1 -3\nv 9 -1 -3\nv 9 9 -3\nv -9 9 -3\nf 1 2 3 4\n")
        outcome = self.small("""
places
shot {folder}/document.png
click stage
click stage/mesh
type own.obj
key enter
key escape
shot {folder}/own.png
""")
        self.assertNotEqual(self.view("document.png", outcome.out), self.view("own.png", outcome.out))

    def test_a_dragged_handle_is_one_edit_that_equals_the_typed_one(self):
        self.small("""
click select/emitters/0
drag handle/emitters/0/position 60 -25
text {folder}/dragged.fx.json
key ctrl+z
text {folder}/undone.fx.json
drag handle/emitters/0/size 30 0
drag handle/emitters/0/forces/vortices/0/radius 40 0
text {folder}/sizes.fx.json
""")
        self.assertEqual(self.read("undone.fx.json"), SMALL)
        emitter = json.loads(self.read("dragged.fx.json"))["emitters"][0]
        x, y, z = emitter["position"]
        self.assertGreater(x, 0.3)
        self.assertGreater(y, 1.1)
        self.assertAlmostEqual(z, 0.0)
        self.small(f"""
click select/emitters/0
click /emitters/0/position/0
type {x}
key enter
click /emitters/0/position/1
type {y}
key enter
text {{folder}}/typed.fx.json
""")
        self.assertEqual(json.loads(self.read("typed.fx.json")), json.loads(self.read("dragged.fx.json")))
        sizes = json.loads(self.read("sizes.fx.json"))["emitters"][0]
        self.assertGreater(sizes["size"], 0.5)
        self.assertGreater(sizes["forces"]["vortices"][0]["radius"], 1.1)

    def test_a_click_on_a_handle_edits_nothing(self):
        self.small("""
click select/emitters/0
click handle/emitters/0/position
click mark/emitters/0/emission/bursts/0/time
text {folder}/clicked.fx.json
""")
        self.assertEqual(self.read("clicked.fx.json"), SMALL)

    def test_a_burst_is_dragged_along_the_timeline_as_one_edit(self):
        self.small("""
drag mark/emitters/0/emission/bursts/0/time 80 0
text {folder}/dragged.fx.json
key ctrl+z
text {folder}/undone.fx.json
""")
        burst = json.loads(self.read("dragged.fx.json"))["emitters"][0]["emission"]["bursts"][0]
        self.assertGreater(burst["time"], 0.8)
        self.assertEqual(round(100 * burst["time"], 6), round(100 * burst["time"]))
        self.assertEqual(self.read("undone.fx.json"), SMALL)

    def test_each_overlay_is_drawn_and_taken_away(self):
        names = ("bounds", "velocities", "overdraw", "slice", "slices", "shapes")
        script = "time 1\nclick select/emitters/0\nplaces\nshot {folder}/plain.png\n"
        for name in names:
            toggle = f"click overlays\nclick overlay/{name}\nkey escape\n"
            script += f"{toggle}shot {{folder}}/{name}.png\n{toggle}"
        outcome = self.small(script + "shot {folder}/again.png\n")
        plain = self.view("plain.png", outcome.out)
        for name in names:
            self.assertNotEqual(self.view(f"{name}.png", outcome.out), plain, name)
        self.assertEqual(self.view("again.png", outcome.out), plain)

    def test_before_and_now_are_on_both_sides_of_the_line(self):
        outcome = self.small("""
time 1
click overlays
click overlay/shapes
key escape
click select/emitters/0
places
shot {folder}/before.png
click /emitters/0/radius/0
type 0.6
key enter
shot {folder}/now.png
click compare
shot {folder}/both.png
drag handle/split 100 0
shot {folder}/moved.png
""")
        shares = {"left": (0.0, 0.45), "right": (0.55, 1.0), "next": (0.53, 0.56)}
        view = {(name, side): self.view(name + ".png", outcome.out, shares[side])
                for name in ("before", "now", "both", "moved") for side in shares}
        self.assertNotEqual(view["before", "next"], view["now", "next"])
        self.assertEqual(view["both", "left"].rows[:130], view["before", "left"].rows[:130])
        self.assertEqual(view["both", "right"].rows[:130], view["now", "right"].rows[:130])
        self.assertEqual(view["moved", "next"].rows[:130], view["before", "next"].rows[:130])

    def test_the_error_against_the_reference_is_stated_and_shown(self):
        outcome = self.small("""
time 1
places
shot {folder}/plain.png
click error
compared
shot {folder}/error.png
click error/shown
shot {folder}/hidden.png
""")
        found = re.search(r"error of 1.00 s, 160x\d+: mean ([\d.]+), p99 ([\d.]+), largest ([\d.]+) of white", outcome.out)
        self.assertTrue(found, outcome.out)
        mean, p99, largest = map(float, found.groups())
        self.assertTrue(0.0 < mean <= p99 <= largest <= 1.0, outcome.out)
        self.assertLess(mean, 0.05)
        plain = self.view("plain.png", outcome.out)
        self.assertNotEqual(self.view("error.png", outcome.out), plain)
        self.assertEqual(self.view("hidden.png", outcome.out).rows[30:], plain.rows[30:])

    def test_the_error_of_a_playing_effect_is_that_of_the_moment_of_the_click(self):
        stated = r"error of ([\d.]+) s, .*"
        playing = re.search(stated, self.small("time 0.5\nkey space\nframes 20\nclick error\ncompared\n").out)
        self.assertGreater(float(playing[1]), 0.8)
        still = re.search(stated, self.small(f"time {playing[1]}\nclick error\ncompared\n").out)
        self.assertEqual(playing[0], still[0])
        self.assertNotIn("before", still[0])

    def test_an_error_does_not_hide_later_edits(self):
        edit = "click /emitters/0/radius/0\ntype 0.6\nkey enter\n"
        outcome = self.small("time 1\nplaces\nclick select/emitters/0\nclick error\ncompared\n"
                             f"{edit}compared\nshot {{folder}}/after.png\nclick error/shown\nshot {{folder}}/error.png\n")
        self.assertRegex(outcome.out, "(?m)^error of 1.00 s.*, before the last change of the picture$")
        self.small(f"time 1\nclick select/emitters/0\n{edit}shot {{folder}}/plain.png\n")
        after, error, plain = (self.view(f"{name}.png", outcome.out) for name in ("after", "error", "plain"))
        self.assertEqual(after.rows[30:], plain.rows[30:])
        self.assertNotEqual(error.rows[30:], plain.rows[30:])

    def test_a_size_of_zero_is_dragged_beside_the_position(self):
        preset = self.write("zero.fx.json", SMALL.replace('"size": 0.4', '"size": 0'))
        events = self.write("events.txt", f"click select/emitters/0\ndrag handle/emitters/0/size 40 0\n"
                                          f"text {self.folder}/dragged.fx.json\n")
        outcome = fx("edit", preset, "--headless", "--width", 960, "--height", 640, "--script", events,
                     "--recovery", self.folder / "recovery")
        if "has no editor" in outcome.err:
            self.skipTest(outcome.err)
        self.assertEqual(outcome.code, 0, outcome.err)
        emitter = json.loads(self.read("dragged.fx.json"))["emitters"][0]
        self.assertGreater(emitter["size"], 0.1)
        self.assertEqual(emitter["position"], [0, 1, 0])

    def test_a_comparison_with_the_reference_can_be_cancelled(self):
        outcome = self.small("time 1\nclick error\nclick error/cancel\ncompared\n")
        self.assertIn("cancelled", outcome.out)

    def test_the_budget_is_measured_and_shown(self):
        outcome = self.small("""
time 1
click tab/Budget
click budget/measure
measured
places
shot {folder}/budget.png
click /emitters/0/maxParticles
type 30
key enter
measured
""")
        for quality in ("low", "medium", "high"):
            found = re.search(rf"^quality {quality}: (\d+) particles, simulation (\S+), lights (\S+), stage (\S+), "
                              r"effects (\S+) ms$", outcome.out, re.M)
            self.assertTrue(found, outcome.out)
            self.assertGreater(int(found[1]), 10)
            self.assertTrue(all(float(time) > 0 for time in found.groups()[1:]), outcome.out)
        stages = r"simulation (\S+), lights (\S+), effects (\S+), noise (\S+) ms$"
        element = re.search(r"(?m)^/emitters/0: \d+ particles, " + stages, outcome.out)
        technique = re.search(r"(?m)^technique /emitters: " + stages, outcome.out)
        self.assertTrue(element and technique, outcome.out)
        for found in (element, technique):
            self.assertGreater(sum(map(float, found.groups()[:3])), 0, outcome.out)
            self.assertGreater(float(found[4]), 0, outcome.out)
        for place in ("technique/emitters", "budget/technique", "budget/element"):
            self.assertIn(f"\n{place} ", outcome.out)
        moments = [int(count) for count in re.findall(r"^at \S+ s: (\d+) particles", outcome.out, re.M)][:24]
        self.assertEqual((moments[0], len(moments)), (0, 24))
        self.assertGreater(max(moments), 35)
        self.assertIn("before the last change", outcome.out)
        self.assertIn("budget/high ", outcome.out)

    def test_the_button_writes_pictures_sequences_and_turntables(self):
        render = """
click render
click render/kind/{0}
click render/file
key ctrl+a
type {{folder}}/{1}
click render/width
type 96
key enter
click render/height
type 64
key enter
"""
        self.small("time 1\n" + render.format("picture", "still.png") + "click render/start\nrendered\n" +
                   render.format("turntable", "turn.%02d.png") +
                   "click render/turns\ntype 4\nkey enter\nclick render/start\nrendered\n" +
                   "click timeline/end\ntype 0.2\nkey enter\n" +
                   render.format("sequence", "frames.%02d.png") + "click render/start\nrendered\n")
        names = self.names()
        self.assertEqual([n for n in names if n.startswith("turn")], [f"turn.0{i}.png" for i in range(4)])
        self.assertEqual([n for n in names if n.startswith("frames")], [f"frames.0{i}.png" for i in range(7)])
        still, first, second = (Pixels(self.folder / n) for n in ("still.png", "turn.00.png", "turn.01.png"))
        self.assertEqual((len(still.rows), len(still.rows[0])), (64, 3 * 96))
        self.assertEqual(still, first)
        self.assertNotEqual(first, second)

    def test_many_edits_compile_nothing_and_leave_no_memory(self):
        outcome = self.small("time 1\n", "--measure", EDITS)
        found = re.search(r"^(\d+) edits of \S+: median (\S+) ms, p95 (\S+) ms .*; at most (\d+) frames; (\d+) late compiles; "
                          r"memory grew by (-?\S+) MiB$", outcome.out, re.M)
        self.assertTrue(found, outcome.out)
        self.assertEqual((int(found[1]), int(found[5])), (EDITS, 0))
        self.assertLessEqual(int(found[4]), 2)
        # The undo history keeps some hundred bytes of each edit; a preset that stayed would hold far more.
        self.assertLess(float(found[6]), 6 + 0.004 * EDITS)

    def test_an_effect_moves_along_a_circle_in_the_picture_alone(self):
        outcome = self.small("""
click overlays
click overlay/shapes
key escape
time 1
places
shot {folder}/still.png
click motion
click motion/circle
click motion/radius
type 1.5
key enter
key escape
shot {folder}/circle.png
click motion
click motion/still
key escape
shot {folder}/again.png
text {folder}/moved.fx.json
""")
        still, circle, again = (self.view(f"{name}.png", outcome.out) for name in ("still", "circle", "again"))
        self.assertNotEqual(still, circle)
        self.assertEqual(still, again)
        self.assertEqual(self.read("moved.fx.json"), SMALL)

    def test_a_file_that_does_not_fit_is_refused_with_the_remedy(self):
        outcome = self.small("""
click render
click render/kind/sequence
click render/file
key ctrl+a
type one.png
click render/start
rendered
""")
        self.assertIn("several frames are NAME.%04d.png or NAME.mp4", outcome.out)


if __name__ == "__main__":
    run_tests()
