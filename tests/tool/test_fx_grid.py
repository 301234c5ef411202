#!/usr/bin/env python3
"""fx grid and docs/howto/grids.md: what they write is what presets read."""
import array
import re
import subprocess
import sys
import unittest

from fx_program import ROOT, FxTest, fx

PAGE = ROOT / "docs/howto/grids.md"


class Grid(FxTest):
    def preset(self, members):
        return self.write("grid.fx.json", '{"version":1,"emitters":[{"emission":{"rate":1},' + members + "}]}")

    def assert_valid(self, members):
        outcome = fx("validate", self.preset(members))
        self.assertEqual((outcome.code, "warning" in outcome.out), (0, False), outcome.out + outcome.err)

    def test_the_snippet_of_the_page_writes_a_vector_field(self):
        snippet = re.search(r"^```python\n(.*?)^```$", PAGE.read_text(), re.S | re.M).group(1)
        self.assertLessEqual(len([line for line in snippet.splitlines() if line]), 12)
        subprocess.run([sys.executable, "-c", snippet], cwd=self.folder, check=True)
        self.assert_valid('"forces":{"drag":1,"vectorFields":[{"file":"swirl.fxgrid"}]}')

    def test_the_script_writes_one_of_each_kind(self):
        for name, members in (("swirl", '"forces":{"drag":1,"vectorFields":[{"file":"swirl.fxgrid"}]}'),
                              ("cloud", '"shape":"volume","file":"cloud.fxgrid"'),
                              ("hills", '"collisions":[{"shape":"heights","file":"hills.fxgrid"}]')):
            subprocess.run([sys.executable, ROOT / "scripts/make_grid.py", name, self.folder / f"{name}.fxgrid"], check=True)
            self.assert_valid(members)

    def test_lines_in_any_order_and_raw_numbers_give_the_same_grid(self):
        nodes, low, cell = (3, 2, 4), (-1.0, 0.5, 2.0), (0.5, 1.0, 0.25)
        places = [(i, j, k) for k in range(nodes[2]) for j in range(nodes[1]) for i in range(nodes[0])]
        values = [float(100 * k + 10 * j + i) for i, j, k in places]
        lines = [",".join(str(a + n * c) for a, n, c in zip(low, place, cell)) + f",{value}"
                 for place, value in zip(places, values)]
        text = self.write("points.csv", "x,y,z,density\n# of a test\n" + "\n".join(reversed(lines)) + "\n")
        raw = self.write("numbers.raw", array.array("f", values).tobytes())
        self.assertEqual(fx("grid", text, "-o", self.folder / "a.fxgrid").code, 0)
        outcome = fx("grid", raw, "-o", self.folder / "b.fxgrid", "--nodes", *nodes, "--low", *low, "--cell", *cell)
        self.assertEqual(outcome.code, 0, outcome.err)
        written = (self.folder / "a.fxgrid").read_bytes()
        self.assertEqual(written, (self.folder / "b.fxgrid").read_bytes())
        header, data = written.split(b"data\n", 1)
        self.assertIn(b"nodes 3 2 4\nchannels 1\nlow -1 0.5 2\ncell 0.5 1 0.25\n", header)
        self.assertEqual(list(array.array("f", data)), values)
        self.assert_valid('"shape":"volume","file":"a.fxgrid"')

    def test_vectors_have_three_channels(self):
        text = self.write("air.csv", "".join(f"{x} {y} {z} {y} 0 1\n" for x in (0, 1) for y in (0, 1) for z in (0, 1)))
        self.assertEqual(fx("grid", text, "-o", self.folder / "air.fxgrid").code, 0)
        self.assert_valid('"forces":{"drag":1,"vectorFields":[{"file":"air.fxgrid"}]}')

    def test_what_is_no_grid_is_refused_with_its_place(self):
        for text, message in (("0,0,0,1\n0,0,1\n", "line 2: expected"), ("0 0 0 1\n0 0 0 2\n", "found 2 places"),
                              ("", "no line with numbers"), ("0 0 0 1\n1 0 0 1\n2.5 0 0 1\n", "line 2: the place lies"),
                              ("0 0 0 1\n1 0 0 1 2 3\n", "line 2: found 3 channels"), ("0 0 0 nan\n1 0 0 1\n", "line 1: expected")):
            outcome = fx("grid", self.write("bad.csv", text), "-o", self.folder / "bad.fxgrid")
            self.assertEqual(outcome.code, 1, text)
            self.assertIn(message, outcome.err, text)
        raw = self.write("short.raw", b"1234")
        self.assertEqual(fx("grid", raw, "-o", self.folder / "bad.fxgrid", "--nodes", 2, 2, 2).code, 1)
        self.assertEqual(fx("grid", raw, "-o", self.folder / "bad.txt").code, 2)
        self.assertFalse((self.folder / "bad.fxgrid").exists())


if __name__ == "__main__":
    unittest.main()
