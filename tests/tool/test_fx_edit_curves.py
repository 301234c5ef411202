#!/usr/bin/env python3
"""fx edit without a display: keys of several curves that are shown at once."""
import json

from edit_test import SMALL, EditTest, run_tests
from fx_program import fx

CURVES = SMALL.replace('"speed": 0.6,', '''"speed": 0.6,
     "sizeOverLife": {"keys": [[0, 0.5], [0.5, 1], [1, 0.5]]}, "opacityOverLife": {"keys": [[0, 0], [0.5, 1], [1, 0]]},
     "temperatureOverLife": {"keys": [[0, 1.5], [0.25, 1.2], [1, 0.4]]},''')


class Curves(EditTest):
    def run_script(self, script):
        document = self.write("curves.fx.json", CURVES)
        open_curve = "click select/emitters/0\nclick inspector/search\ntype opacity\nclick /emitters/0/opacityOverLife\n"
        events = self.write("events.txt", (open_curve + script).format(folder=self.folder))
        outcome = fx("edit", document, "--headless", "--width", 1200, "--height", 900, "--script", events,
                     "--recovery", self.folder / "recovery")
        if "has no editor" in outcome.err:
            self.skipTest(outcome.err)
        self.assertEqual(outcome.code, 0, outcome.err)
        return outcome

    def keys(self, name):
        emitter = json.loads(self.read(name))["emitters"][0]
        return [emitter[member]["keys"] for member in ("sizeOverLife", "opacityOverLife", "temperatureOverLife")]

    def box(self, places):
        """Events that drag a rectangle over the middle of the canvas."""
        left, top, right, bottom = next(tuple(map(int, line.split()[-4:])) for line in places.splitlines()
                                        if line.startswith("curve/canvas "))
        x = [left + int(share * (right - left)) for share in (0.15, 0.6)]
        return (f"move {x[0]} {top + 3}\npress 0\nmove {(x[0] + x[1]) // 2} {(top + bottom) // 2}\n"
                f"move {x[1]} {bottom - 3}\nrelease 0\n")

    def test_keys_of_several_curves_move_together_as_one_edit_and_hidden_ones_do_not(self):
        show = "click curve/show/sizeOverLife\nclick curve/show/temperatureOverLife\n"
        places = self.run_script(show + "places\n").out
        for name in ("curve/key/1", "curve/key/sizeOverLife/1", "curve/key/temperatureOverLife/1"):
            self.assertIn(f"\n{name} ", places)
        self.run_script(show + self.box(places) + """
drag curve/key/1 40 12
text {folder}/moved.fx.json
key ctrl+z
text {folder}/undone.fx.json
click curve/show/temperatureOverLife
drag curve/key/1 40 12
text {folder}/hidden.fx.json
""")
        before, moved, hidden = (self.keys(name) for name in ("undone.fx.json", "moved.fx.json", "hidden.fx.json"))
        self.assertEqual(self.read("undone.fx.json"), CURVES)
        ways = [after[1][0] - start[1][0] for after, start in zip(moved, before)]
        self.assertGreater(ways[0], 0.03)
        for way in ways:
            self.assertAlmostEqual(way, ways[0], places=4)
        for after, start in zip(moved, before):
            self.assertLess(after[1][1], start[1][1])
            self.assertEqual((after[0], after[2]), (start[0], start[2]))
        self.assertEqual(hidden[:2], moved[:2])
        self.assertEqual(hidden[2], before[2])

    def test_a_way_and_a_factor_are_typed_for_all_selected_keys(self):
        show = "click curve/show/sizeOverLife\n"
        places = self.run_script(show + "places\n").out
        self.run_script(show + self.box(places) + """
click curve/shift
type 0.1
key enter
text {folder}/shifted.fx.json
click curve/scale
type 1/2
key enter
text {folder}/scaled.fx.json
key ctrl+z
key ctrl+z
text {folder}/undone.fx.json
""")
        shifted, scaled = self.keys("shifted.fx.json"), self.keys("scaled.fx.json")
        self.assertEqual([shifted[0][1], shifted[1][1]], [[0.6, 1], [0.6, 1]])
        self.assertEqual([scaled[0][1], scaled[1][1]], [[0.6, 0.5], [0.6, 0.5]])
        self.assertEqual(self.read("undone.fx.json"), CURVES)

    def test_the_delete_key_removes_the_selected_keys_of_the_visible_curves_while_their_panel_has_the_focus(self):
        show = "click curve/show/sizeOverLife\n"
        places = self.run_script(show + "places\n").out
        self.run_script(show + self.box(places) + """
move 5 5
key delete
text {folder}/removed.fx.json
key ctrl+z
text {folder}/undone.fx.json
click select/emitters/0
""" + self.box(places) + """
click select/emitters/0
key delete
text {folder}/elsewhere.fx.json
""")
        self.assertEqual(self.read("elsewhere.fx.json"), CURVES)
        size, opacity, temperature = self.keys("removed.fx.json")
        self.assertEqual((size, opacity, len(temperature)), ([[0, 0.5], [1, 0.5]], [[0, 0], [1, 0]], 3))
        self.assertEqual(self.read("undone.fx.json"), CURVES)


if __name__ == "__main__":
    run_tests()
