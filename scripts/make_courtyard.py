#!/usr/bin/env python3
"""make_courtyard.py FOLDER: writes FOLDER/courtyard.obj and courtyard.mtl, the stage of the courtyard scene.

A paved square of 24 x 24 m [m, +Y up] around the origin, walls with arched openings on three sides, six octagonal
pillars around the center, crates and steps. The side towards +Z is open: there the camera stands. Plain geometry with
one normal per face and one diffuse color (linear Rec. 709) per material; the same bytes on every machine.
"""
import math
import pathlib
import sys

from made_files import Polygons, noise, write_text

HALF = 12.0  # [m] half the side of the square
WALL_HEIGHT = 5.0  # [m]
WALL_THICKNESS = 0.7  # [m]


class Mesh(Polygons):
    def octagon_ring(self, material, center, profile):
        """Turns `profile`, a list of (radius, height) from bottom to top, around a vertical axis; caps the top."""
        x, z = center

        def corner(radius, height, k):
            angle = math.pi / 8 + k * math.pi / 4
            return (x + radius * math.cos(angle), height, z - radius * math.sin(angle))

        for (r0, y0), (r1, y1) in zip(profile, profile[1:]):
            for k in range(8):
                self.polygon(material, [corner(r0, y0, k), corner(r0, y0, k + 1), corner(r1, y1, k + 1),
                                        corner(r1, y1, k)])
        self.polygon(material, [corner(*profile[-1], k) for k in range(8)])

    def triangles(self):
        return sum(len(points) - 2 for faces in self.faces.values() for points in faces)


def normal_of(points):
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = points[0], points[1], points[2]
    ux, uy, uz, vx, vy, vz = bx - ax, by - ay, bz - az, cx - ax, cy - ay, cz - az
    n = (uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx)
    length = math.sqrt(sum(c * c for c in n))
    return tuple(c / length for c in n)


def shades(name, color, spread, count):
    """`count` materials around `color`, differing in brightness by up to `spread` and a little in hue."""
    result = {}
    for k in range(count):
        gain = 1.0 + spread * (2.0 * (k + 0.5) / count - 1.0)
        tint = 0.04 * (noise(k, len(name)) - 0.5)
        result[f"{name}_{k}"] = (color[0] * gain * (1 + tint), color[1] * gain, color[2] * gain * (1 - tint))
    return result


MATERIALS = {
    "joint": (0.09, 0.08, 0.07),
    "earth": (0.16, 0.13, 0.10),
    "trim": (0.46, 0.42, 0.36),
    "pillar": (0.50, 0.47, 0.42),
    "step": (0.38, 0.36, 0.33),
    "iron": (0.05, 0.05, 0.05),
    **shades("paving", (0.28, 0.26, 0.235), 0.22, 6),
    **shades("stone", (0.40, 0.33, 0.255), 0.16, 5),
    **shades("plank", (0.30, 0.185, 0.09), 0.25, 4),
}


def pick(name, count, *key):
    return f"{name}_{int(noise(*key) * count)}"


def add_ground(mesh):
    mesh.polygon("earth", [(-60, -0.06, 60), (60, -0.06, 60), (60, -0.06, -60), (-60, -0.06, -60)])
    mesh.polygon("joint", [(-HALF, -0.025, HALF + 8), (HALF, -0.025, HALF + 8), (HALF, -0.025, -HALF),
                           (-HALF, -0.025, -HALF)])
    joint = 0.02
    for i in range(-12, 12):
        for j in range(-12, 20):
            shift = 0.5 if j % 2 else 0.0
            x0 = max(-HALF, i + shift) + joint
            x1 = min(HALF, i + 1 + shift) - joint
            z0, z1 = j + joint, j + 1 - joint
            mesh.polygon(pick("paving", 6, i, j, 1), [(x0, 0, z1), (x1, 0, z1), (x1, 0, z0), (x0, 0, z0)])
        if i == -12:
            for j in range(-11, 20, 2): # half tiles where a shifted row begins
                mesh.polygon(pick("paving", 6, i, j, 2), [(-HALF + joint, 0, j + 1 - joint), (-11.5 - joint, 0, j + 1 - joint),
                                                          (-11.5 - joint, 0, j + joint), (-HALF + joint, 0, j + joint)])


def add_pier(mesh, place, x0, x1, top, seed):
    """Courses of stone, every second one set back a little."""
    courses = max(1, round(top / 0.6))
    for k in range(courses):
        inset = 0.02 if k % 2 else 0.0
        y0, y1 = top * k / courses, top * (k + 1) / courses
        mesh.box(pick("stone", 5, seed, k), (x0, y0, -WALL_THICKNESS / 2 + inset),
                 (x1, y1, WALL_THICKNESS / 2 - inset), place)


def add_arch(mesh, place, x0, x1, spring, seed):
    """The wall above an opening: a half circle from x0 to x1 that begins at height `spring`."""
    middle, radius, steps = (x0 + x1) / 2, (x1 - x0) / 2, 10
    half = WALL_THICKNESS / 2 - 0.02 # flush with the set-back courses of the piers, so that no gap shows
    curve = [(middle - radius * math.cos(math.pi * k / steps), spring + radius * math.sin(math.pi * k / steps))
             for k in range(steps + 1)]
    for k, ((ax, ay), (bx, by)) in enumerate(zip(curve, curve[1:])):
        stone = pick("stone", 5, seed, k, 7)
        faces = [
            [(ax, ay, half), (bx, by, half), (bx, WALL_HEIGHT, half), (ax, WALL_HEIGHT, half)],
            [(bx, by, -half), (ax, ay, -half), (ax, WALL_HEIGHT, -half), (bx, WALL_HEIGHT, -half)],
            [(ax, ay, -half), (bx, by, -half), (bx, by, half), (ax, ay, half)],
        ]
        for face in faces:
            mesh.polygon(stone, [place(p) for p in face])


def add_wall(mesh, place, openings, seed):
    """A wall along local x from -12 to 12 m; `openings` are (center, width, spring height)."""
    edges = [-HALF]
    for center, width, spring in openings:
        x0, x1 = center - width / 2, center + width / 2
        add_arch(mesh, place, x0, x1, spring, seed + int(center * 10))
        edges += [x0, x1]
    edges.append(HALF)
    for k in range(0, len(edges), 2):
        add_pier(mesh, place, edges[k], edges[k + 1], WALL_HEIGHT, seed + k)
    overhang = WALL_THICKNESS / 2 + 0.12
    mesh.box("trim", (-HALF - 0.12, WALL_HEIGHT, -overhang), (HALF + 0.12, WALL_HEIGHT + 0.22, overhang), place,
             bottom=True)


def turned(x, z, degrees, y=0.0):
    """Placement: turn about +Y by `degrees`, then move."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return lambda p: (x + c * p[0] + s * p[2], y + p[1], z - s * p[0] + c * p[2])


def add_pillar(mesh, x, z):
    mesh.box("trim", (x - 0.62, 0, z - 0.62), (x + 0.62, 0.22, z + 0.62))
    mesh.octagon_ring("pillar", (x, z), [(0.56, 0.22), (0.56, 0.38), (0.44, 0.50), (0.40, 0.52), (0.36, 3.10),
                                         (0.40, 3.14), (0.40, 3.22), (0.56, 3.46), (0.56, 3.54)])
    mesh.box("trim", (x - 0.62, 3.54, z - 0.62), (x + 0.62, 3.78, z + 0.62), bottom=True)


def add_crate(mesh, x, y, z, size, degrees, seed):
    """A box of planks with boards along its edges."""
    place = turned(x, z, degrees, y)
    half, board, lip = size / 2, size * 0.11, size * 0.03
    planks = 4
    for k in range(planks):
        a, b = -half + lip + (size - 2 * lip) * k / planks, -half + lip + (size - 2 * lip) * (k + 1) / planks
        mesh.box(pick("plank", 4, seed, k), (a, lip, -half + lip), (b, size - lip, half - lip), place)
    edge = pick("plank", 4, seed, 99)
    for sx in (-half, half - board):
        for sz in (-half, half - board):
            mesh.box(edge, (sx, 0, sz), (sx + board, size, sz + board), place)
    for y0 in (0, size - board):
        for s in (-half, half - board):
            mesh.box(edge, (-half + board, y0, s), (half - board, y0 + board, s + board), place, bottom=y0 > 0)
            mesh.box(edge, (s, y0, -half + board), (s + board, y0 + board, half - board), place, bottom=y0 > 0)


def add_steps(mesh):
    for k in range(4):
        depth = 0.45 * (4 - k)
        mesh.box("step", (-2.2, 0.17 * k, -HALF + WALL_THICKNESS / 2), (2.2, 0.17 * (k + 1), -HALF + 0.35 + depth))


def courtyard():
    mesh = Mesh()
    add_ground(mesh)
    add_wall(mesh, turned(0, -HALF, 0), [(-7, 2.6, 2.0), (0, 3.2, 2.4), (7, 2.6, 2.0)], 100)
    add_wall(mesh, turned(-HALF, 0, 90), [(-6.5, 2.4, 1.9), (0, 2.4, 1.9), (6.5, 2.4, 1.9)], 200)
    add_wall(mesh, turned(HALF, 0, -90), [(-6.5, 2.4, 1.9), (0, 2.4, 1.9), (6.5, 2.4, 1.9)], 300)
    for x in (-3.6, 3.6):
        for z in (-7.0, -2.6, 2.6):
            add_pillar(mesh, x, z)
    mesh.box("trim", (-4.3, 3.78, -7.35), (4.3, 4.15, -6.65), bottom=True) # beam over the far pair
    for x, y, z, size, degrees in [(-6.6, 0, 1.2, 1.0, 12), (-7.8, 0, 0.7, 1.0, -6), (-7.1, 1.0, 0.9, 0.9, 28),
                                   (6.3, 0, -1.0, 1.1, -20), (7.4, 0, 0.4, 0.8, 35), (5.6, 0, 3.8, 0.7, 8)]:
        add_crate(mesh, x, y, z, size, degrees, int(abs(x * 100) + y * 10))
    add_steps(mesh)
    return mesh


def write_mesh(mesh, folder):
    number = "{:.5g}".format
    points, normals, body = {}, {}, []
    for material in sorted(mesh.faces):
        body.append(f"usemtl {material}")
        for face in mesh.faces[material]:
            normal = " ".join(number(c + 0.0) for c in normal_of(face))
            n = normals.setdefault(normal, len(normals) + 1)
            corners = [points.setdefault(" ".join(number(c + 0.0) for c in p), len(points) + 1) for p in face]
            body.append("f " + " ".join(f"{v}//{n}" for v in corners))
    head = ["# Generated by scripts/make_courtyard.py; metres, +Y up", "mtllib courtyard.mtl"]
    lines = head + [f"v {p}" for p in points] + [f"vn {n}" for n in normals] + body
    write_text(folder / "courtyard.obj", "\n".join(lines) + "\n")
    kd = [f"newmtl {name}\nKd {c[0]:.4f} {c[1]:.4f} {c[2]:.4f}" for name, c in sorted(MATERIALS.items())]
    write_text(folder / "courtyard.mtl", "# Generated by scripts/make_courtyard.py; linear Rec. 709\n" + "\n".join(kd) + "\n")


def main():
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    mesh = courtyard()
    write_mesh(mesh, folder)
    print(f"{folder}/courtyard.obj: {mesh.triangles()} triangles")
    return 0


if __name__ == "__main__":
    sys.exit(main())
