#!/usr/bin/env python3
"""make_preview_stages.py FOLDER: writes to FOLDER what stands around the library's presets in their previews.

stage-falls.obj  a cliff with a notch for a waterfall of 8 m, boulders and a pool
stage-range.obj  a barrel along +X that ends in the origin, 1.5 m above a floor
stage-slope.obj  a snowy mountain side that falls towards +Z
stage-yard.obj   a paved yard with a wall, a bench and crates
stage-courtyard.obj, stage-wall.obj, stage-corridor.obj, stage-water.obj, stage-studio-gray.obj
                 the stages of fx render --stage and of the editor (fxsdk/scene_file/stages.h)
props-*.obj      what stands on a stage: the logs of a fire, a burner, a grinder, a rifle, trees
stage.mtl        their colors, linear Rec. 709

Metres, +Y up, the same bytes on every machine. The build runs it; nothing but Python's own library is needed.
"""
import math
import pathlib
import sys

import preview_props
import stage_rooms
from made_files import Polygons, noise, write_text

COLORS = {
    "gray": (0.18, 0.18, 0.18), "plaster": (0.42, 0.38, 0.31), "dado": (0.13, 0.18, 0.17), "tile_0": (0.17, 0.16, 0.15),
    "tile_1": (0.11, 0.105, 0.10), "brick_0": (0.24, 0.10, 0.065), "brick_1": (0.19, 0.08, 0.055),
    "brick_2": (0.28, 0.14, 0.09), "mortar": (0.22, 0.20, 0.18), "shade": (0.015, 0.016, 0.018), "water": (0.012, 0.032, 0.036),
    "rock_dark": (0.045, 0.045, 0.045), "rock": (0.11, 0.10, 0.09), "rock_light": (0.17, 0.155, 0.13),
    "moss": (0.07, 0.10, 0.035), "pool": (0.02, 0.035, 0.04), "steel": (0.035, 0.035, 0.04),
    "floor": (0.10, 0.095, 0.09), "slab_0": (0.15, 0.145, 0.135), "slab_1": (0.12, 0.115, 0.11),
    "slab_2": (0.18, 0.17, 0.155), "wall_0": (0.24, 0.19, 0.15), "wall_1": (0.20, 0.155, 0.12),
    "wood": (0.16, 0.10, 0.05), "ash": (0.16, 0.155, 0.15), "bark": (0.10, 0.068, 0.042), "bottle": (0.30, 0.035, 0.025),
    "char": (0.022, 0.02, 0.019), "crag": (0.13, 0.125, 0.12), "gun": (0.03, 0.03, 0.033), "gun_round": (0.04, 0.04, 0.043),
    "needles": (0.028, 0.05, 0.024), "sack": (0.22, 0.18, 0.11), "scree": (0.40, 0.40, 0.41),
    "snow": (0.84, 0.86, 0.89), "stone": (0.17, 0.16, 0.15),
    "trunk": (0.08, 0.055, 0.04), "wood_end": (0.30, 0.21, 0.12),
}  # fmt: skip


class Mesh(Polygons):
    def tube(self, material, x0, x1, y, radius, sides=12):
        """Along +X, with an end at x1."""
        def rim(x, k, r=radius):
            angle = 2 * math.pi * k / sides
            return (x, y + r * math.cos(angle), r * math.sin(angle))

        for k in range(sides):
            self.polygon(material, [rim(x0, k), rim(x1, k), rim(x1, k + 1), rim(x0, k + 1)])
        self.polygon(material, [rim(x1, k) for k in range(sides)])
        self.polygon(material, [rim(x0, k) for k in reversed(range(sides))])

    def boulder(self, x, z, radius, seed):
        """An uneven ball that stands halfway in the ground."""
        rows, columns = 4, 7

        def corner(row, column):
            up, around = 0.5 * math.pi * row / rows, 2 * math.pi * (column % columns) / columns
            r = radius * (0.75 + 0.5 * noise(row, column % columns if row < rows else 0, seed))
            return (x + r * math.cos(up) * math.cos(around), 0.75 * r * math.sin(up) - 0.15 * radius,
                    z - r * math.cos(up) * math.sin(around))

        for row in range(rows):
            for column in range(columns):
                points = [corner(row, column), corner(row, column + 1), corner(row + 1, column + 1),
                          corner(row + 1, column)]
                kind = "moss" if row == rows - 1 and noise(column, seed) < 0.5 else "rock_dark"
                self.polygon(kind, points[:3])
                if row + 1 < rows:
                    self.polygon(kind, [points[0], points[2], points[3]])


COLUMNS, ROWS = 34, 18


def cliff_point(i, j):
    """Node of the cliff's face: columns from left to right, rows upwards; the last row is its edge."""
    x = -13 + 26 * (i + 0.4 * (noise(i, j, 1) - 0.5)) / COLUMNS
    notch = math.exp(-((x / 3.1) ** 6))
    top = 10.6 + 1.6 * (noise(i // 2, 2) - 0.3) + 0.4 * noise(i, 3) - notch * 2.7
    if notch > 0.5:
        top = 7.86 + 0.12 * noise(i, 4)
    y = top * (j + (0.5 * (noise(i, j, 5) - 0.5) if 0 < j < ROWS else 0)) / ROWS
    ledge = 0.7 * noise(j // 2, i // 3, 6) + 0.5 * noise(i, j, 7)
    z = -1.5 + 0.5 * ledge - 0.10 * y * (1 - notch) + 1.1 * (1 - notch) * (1 - y / 14) + 0.5 * notch * (j / ROWS) ** 2
    return (x, y, z)


def falls():
    mesh = Mesh()
    nodes = [[cliff_point(i, j) for i in range(COLUMNS + 1)] for j in range(ROWS + 1)]
    for j in range(ROWS):
        for i in range(COLUMNS):
            a, b, c, d = nodes[j][i], nodes[j][i + 1], nodes[j + 1][i + 1], nodes[j + 1][i]
            wet = abs(a[0]) < 3.6 + noise(i, j, 8)
            bed = noise(j // 2, 9) + 0.5 * noise(i // 4, j // 2, 10)  # beds of rock differ in color
            dry = "rock_light" if bed < 0.5 else "rock"
            mossy = noise(i // 2, j, 11) < 0.5 * (j / ROWS) ** 2 and not wet
            for face in ([a, b, c], [a, c, d]):
                mesh.polygon("moss" if mossy else "rock_dark" if wet else dry, face)
    for i in range(COLUMNS):
        a, b = nodes[ROWS][i], nodes[ROWS][i + 1]
        kind = "pool" if abs(a[0]) < 2.6 else "moss"
        mesh.polygon(kind, [a, b, (b[0], b[1] + 0.3, b[2] - 9), (a[0], a[1] + 0.3, a[2] - 9)])
    mesh.polygon("pool", [(-40, 0, 40), (40, 0, 40), (40, 0, -3), (-40, 0, -3)])
    for k in range(15):
        side = -1 if k % 2 else 1
        mesh.boulder(side * (2.9 + 6 * noise(k, 20) ** 1.3), 0.2 + 3.2 * noise(k, 21), 0.35 + 0.75 * noise(k, 22), k)
    return mesh


def shooting_range():
    mesh = Mesh()
    mesh.polygon("floor", [(-900, 0, 900), (900, 0, 900), (900, 0, -900), (-900, 0, -900)])
    mesh.tube("steel", -0.42, -0.06, 1.5, 0.009)
    mesh.tube("steel", -0.075, 0.0, 1.5, 0.0125)
    mesh.tube("steel", -0.30, -0.27, 1.5, 0.013)
    mesh.box("steel", (-0.29, 1.505, -0.003), (-0.275, 1.54, 0.003))
    mesh.box("steel", (-0.9, 1.445, -0.024), (-0.40, 1.525, 0.024))
    mesh.box("wood", (-0.62, 1.44, -0.021), (-0.24, 1.485, 0.021))
    return mesh


def yard():
    mesh = Mesh()
    mesh.polygon("floor", [(-60, -0.04, 60), (60, -0.04, 60), (60, -0.04, -60), (-60, -0.04, -60)])
    for i in range(-8, 8):
        for z in range(-6, 12):
            x = 1.5 * i + (0.75 if z % 2 else 0)
            mesh.polygon(f"slab_{int(3 * noise(i, z, 30))}", [(x + 0.015, 0, z + 0.985), (x + 1.485, 0, z + 0.985),
                                                              (x + 1.485, 0, z + 0.015), (x + 0.015, 0, z + 0.015)])
    for course in range(6):
        for i in range(-6, 6):
            x, y = 2 * i + (0.5 if course % 2 else -0.5), 0.53 * course
            mesh.box(f"wall_{int(2 * noise(i, course, 32))}", (x, y, -6.4), (x + 1.97, y + 0.51, -6 - 0.03 * noise(i, course, 31)))
    mesh.box("wall_1", (-12.4, 0, -6.35), (11.4, 3.15, -6.06))
    mesh.box("slab_2", (-12.7, 3.2, -6.5), (12.7, 3.36, -5.88))
    for x, z, size in ((-2.6, -3.4, 0.9), (-3.7, -3.1, 0.8), (-3.1, -2.2, 0.6), (3.4, -2.6, 0.8)):
        mesh.box("wood", (x, 0, z), (x + size, size, z + size))
    mesh.box("wood", (1.0, 0.40, -4.4), (3.0, 0.47, -3.9))
    for x in (1.15, 2.7):
        mesh.box("slab_0", (x, 0, -4.35), (x + 0.15, 0.40, -3.95))
    return mesh


def round_normals(mesh):
    """Normals of the round materials, by vertex, weighted by the areas of faces."""
    sums = {}
    for material in preview_props.ROUND & mesh.faces.keys():
        for face in mesh.faces[material]:
            area = [0.0, 0.0, 0.0]
            for a, b in zip(face[1:], face[2:]):
                part = preview_props.cross([q - p for p, q in zip(face[0], a)], [q - p for p, q in zip(face[0], b)])
                area = [s + p for s, p in zip(area, part)]
            for point in face:
                sums[name(point)] = [s + p for s, p in zip(sums.get(name(point), (0.0, 0.0, 0.0)), area)]
    return {point: preview_props.unit(normal) for point, normal in sums.items() if any(normal)}


def name(point):
    return " ".join(f"{c + 0.0:.4g}" for c in point)


def obj(mesh):
    normals = round_normals(mesh)
    points, directions, body = {}, {}, []
    for material in sorted(mesh.faces):
        body.append(f"usemtl {material}")
        for face in mesh.faces[material]:
            words = []
            for point in face:
                word = str(points.setdefault(name(point), len(points) + 1))
                if material in preview_props.ROUND and name(point) in normals:
                    direction = " ".join(f"{c + 0.0:.2f}" for c in normals[name(point)])
                    word += f"//{directions.setdefault(direction, len(directions) + 1)}"
                words.append(word)
            body.append("f " + " ".join(words))
    head = ["# Made by scripts/make_preview_stages.py", "mtllib stage.mtl"]
    return "\n".join([*head, *(f"v {p}" for p in points), *(f"vn {d}" for d in directions), *body]) + "\n"


def main():
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    stages = (("falls", falls()), ("range", shooting_range()), ("slope", preview_props.slope()), ("yard", yard()))
    for stage, mesh in stages:
        write_text(folder / f"stage-{stage}.obj", obj(mesh))
    for stage, mesh in stage_rooms.rooms(Mesh).items():
        write_text(folder / f"stage-{stage}.obj", obj(mesh))
    for props in ("burner", "camp", "grinder", "rifle", "trees"):
        write_text(folder / f"props-{props}.obj", obj(getattr(preview_props, props)()))
    kd = [f"newmtl {color}\nKd {r:.4f} {g:.4f} {b:.4f}" + ("\nillum 7" if color == "water" else "")
          for color, (r, g, b) in sorted(COLORS.items())]  # 7: it reflects by Fresnel's equations
    write_text(folder / "stage.mtl", "\n".join(kd) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
