#!/usr/bin/env python3
"""Writes a mesh of the library preset "debris": a broken piece of masonry, an uneven icosahedron or a broken box.

The farthest vertex is at distance 1, so that a particle's radius is that of the ball around its piece.
Usage: scripts/make_debris_chunk.py [chunk|slab|brick|shard] > fxsdk/presets/library/debris-chunk.obj
"""
import math
import sys

GOLDEN = (1 + math.sqrt(5)) / 2
STRETCH = (1.0, 0.62, 0.8)  # a chip is flatter than it is wide
FACES = [
    (0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2),
    (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5),
    (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1),
]  # fmt: skip


def icosahedron():
    g = GOLDEN
    return [
        (-1, g, 0), (1, g, 0), (-1, -g, 0), (1, -g, 0), (0, -1, g), (0, 1, g),
        (0, -1, -g), (0, 1, -g), (g, 0, -1), (g, 0, 1), (-g, 0, -1), (-g, 0, 1),
    ]  # fmt: skip


# Boxes of which planes have broken off corners and edges: half extents, then cuts as (normal, distance).
BROKEN = {
    "slab": ((1.0, 0.22, 0.75), [((0.7, 0.15, 0.7), 0.75), ((-0.8, 0.3, 0.5), 0.8), ((0.5, -0.4, -0.75), 0.9),
                                 ((-0.6, 0.6, -0.5), 0.75)]),
    "brick": ((1.0, 0.42, 0.52), [((0.95, 0.25, 0.2), 0.72), ((0.6, -0.6, 0.55), 0.8), ((-0.5, 0.75, 0.45), 0.85)]),
    "shard": ((1.0, 0.3, 0.36), [((0.75, 0.6, 0.1), 0.55), ((0.6, -0.3, 0.75), 0.5), ((0.55, -0.7, -0.5), 0.5),
                                 ((-0.7, 0.6, -0.4), 0.62), ((-0.6, -0.2, 0.8), 0.62)]),
}


def cut(faces, normal, distance):
    """The convex body of `faces` (lists of points, counter-clockwise from outside) behind a plane."""
    def height(p):
        return sum(a * b for a, b in zip(p, normal)) - distance

    kept, rim = [], []
    for face in faces:
        points = []
        for p, q in zip(face, face[1:] + face[:1]):
            hp, hq = height(p), height(q)
            if hp <= 0:
                points.append(p)
            if (hp < 0 < hq) or (hq < 0 < hp):
                t = hp / (hp - hq)
                crossing = tuple(round(a + t * (b - a), 9) for a, b in zip(p, q))
                points.append(crossing)
                rim.append(crossing)
        if len(points) > 2:
            kept.append(points)
    rim = sorted(set(rim))
    if len(rim) > 2:
        length = math.sqrt(sum(c * c for c in normal))
        n = [c / length for c in normal]
        center = [sum(c) / len(rim) for c in zip(*rim)]
        u = [a - b for a, b in zip(rim[0], center)]
        v = [n[1] * u[2] - n[2] * u[1], n[2] * u[0] - n[0] * u[2], n[0] * u[1] - n[1] * u[0]]

        def around(p):
            d = [a - b for a, b in zip(p, center)]
            return math.atan2(sum(a * b for a, b in zip(d, v)), sum(a * b for a, b in zip(d, u)))

        kept.append(sorted(rim, key=around))
    return kept


def broken_box(half, cuts):
    x, y, z = half
    faces = [
        [(-x, -y, z), (x, -y, z), (x, y, z), (-x, y, z)], [(x, -y, -z), (-x, -y, -z), (-x, y, -z), (x, y, -z)],
        [(x, -y, z), (x, -y, -z), (x, y, -z), (x, y, z)], [(-x, -y, -z), (-x, -y, z), (-x, y, z), (-x, y, -z)],
        [(-x, y, z), (x, y, z), (x, y, -z), (-x, y, -z)], [(-x, -y, -z), (x, -y, -z), (x, -y, z), (-x, -y, z)],
    ]  # fmt: skip
    for normal, distance in cuts:
        faces = cut(faces, normal, distance)
    places = {}
    indices = [[places.setdefault(p, len(places)) for p in face] for face in faces]
    return list(places), indices


def chunk():
    vertices = []
    for i, corner in enumerate(icosahedron()):
        uneven = 0.7 + 0.3 * ((i * 7 + 3) % 12) / 11  # each vertex at a distance of its own
        vertices.append([c * s * uneven for c, s in zip(corner, STRETCH)])
    return vertices, FACES


def main():
    name = sys.argv[1] if len(sys.argv) > 1 else "chunk"
    if name != "chunk" and name not in BROKEN:
        print(__doc__, file=sys.stderr)
        return 2
    vertices, faces = chunk() if name == "chunk" else broken_box(*BROKEN[name])
    farthest = max(math.sqrt(sum(c * c for c in v)) for v in vertices)
    print("# made by scripts/make_debris_chunk.py")
    for v in vertices:
        print("v " + " ".join(f"{c / farthest:.5f}" for c in v))
    for face in faces:
        print("f " + " ".join(str(i + 1) for i in face))
    return 0


if __name__ == "__main__":
    sys.exit(main())
