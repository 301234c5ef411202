#!/usr/bin/env python3
"""Writes the mesh of the library preset "debris": a broken piece of masonry, an uneven icosahedron.

The farthest vertex is at distance 1, so that a particle's radius is that of the ball around its piece.
Usage: scripts/make_debris_chunk.py > fxsdk/presets/library/debris-chunk.obj
"""
import math

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


def main():
    vertices = []
    for i, corner in enumerate(icosahedron()):
        uneven = 0.7 + 0.3 * ((i * 7 + 3) % 12) / 11  # each vertex at a distance of its own
        vertices.append([c * s * uneven for c, s in zip(corner, STRETCH)])
    farthest = max(math.sqrt(sum(c * c for c in v)) for v in vertices)
    print("# made by scripts/make_debris_chunk.py")
    for v in vertices:
        print("v " + " ".join(f"{c / farthest:.5f}" for c in v))
    for face in FACES:
        print("f " + " ".join(str(i + 1) for i in face))


if __name__ == "__main__":
    main()
