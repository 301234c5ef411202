#!/usr/bin/env python3
"""scripts/make_courtyard.py: the mesh is complete, faces outward, stays in its limits and is the same at every run."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "make_courtyard.py"


def make(folder):
    subprocess.run([sys.executable, SCRIPT, folder], check=True, capture_output=True)
    return (folder / "courtyard.obj").read_text(), (folder / "courtyard.mtl").read_text()


class Courtyard(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.obj, cls.mtl = make(pathlib.Path(cls.folder.name))
        rows = [line.split() for line in cls.obj.split("\n") if line]
        cls.points = [tuple(map(float, row[1:])) for row in rows if row[0] == "v"]
        cls.normals = [tuple(map(float, row[1:])) for row in rows if row[0] == "vn"]
        cls.faces = [[tuple(int(i) for i in corner.split("//")) for corner in row[1:]] for row in rows if row[0] == "f"]
        cls.used = {row[1] for row in rows if row[0] == "usemtl"}

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_it_has_a_few_thousand_triangles(self):
        triangles = sum(len(face) - 2 for face in self.faces)
        self.assertGreater(triangles, 1000)
        self.assertLess(triangles, 8000)

    def test_every_material_is_defined_and_reflects_less_than_it_receives(self):
        defined = {}
        name = None
        for row in (line.split() for line in self.mtl.split("\n")):
            if row[:1] == ["newmtl"]:
                name = row[1]
            elif row[:1] == ["Kd"]:
                defined[name] = [float(v) for v in row[1:]]
        self.assertLessEqual(self.used, set(defined))
        self.assertTrue(all(0 < v < 0.9 for color in defined.values() for v in color))

    def test_every_face_turns_counter_clockwise_about_its_normal(self):
        for face in self.faces:
            a, b, c = (self.points[corner[0] - 1] for corner in face[:3])
            n = self.normals[face[0][1] - 1]
            u, v = [b[k] - a[k] for k in range(3)], [c[k] - a[k] for k in range(3)]
            cross = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
            self.assertGreater(sum(x * y for x, y in zip(cross, n)), 0)

    def test_the_ground_is_at_zero_and_looks_up(self):
        flat = [face for face in self.faces if all(self.points[v - 1][1] == 0 for v, _ in face)]
        self.assertGreater(len(flat), 24 * 24)
        self.assertTrue(all(self.normals[n - 1] == (0, 1, 0) for face in flat for _, n in face))

    def test_the_middle_is_free_for_an_effect(self):
        raised = [p for p in self.points if p[1] > 0.01]
        self.assertTrue(all(p[0] ** 2 + p[2] ** 2 > 3.0**2 for p in raised))

    def test_walls_face_the_court_and_the_outside(self):
        inner = [n for face in self.faces for v, n in face[:1]
                 if abs(self.points[v - 1][2] + 11.65) < 0.03 and self.points[v - 1][1] > 3]
        self.assertTrue(any(self.normals[n - 1][2] == 1 for n in inner))

    def test_a_second_run_gives_the_same_bytes(self):
        with tempfile.TemporaryDirectory() as other:
            self.assertEqual(make(pathlib.Path(other)), (self.obj, self.mtl))


if __name__ == "__main__":
    unittest.main()
