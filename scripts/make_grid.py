#!/usr/bin/env python3
"""Writes sample grids for presets, one of each kind (docs/howto/grids.md).

Usage: scripts/make_grid.py swirl|cloud|hills OUT.fxgrid
swirl: 3 channels, air [m/s] that turns around the y axis and rises; for "vectorFields".
cloud: 1 channel, a density that falls off from the middle; for the shape "volume".
hills: 1 channel, 1 node along y, heights [m]; for collisions of the shape "heights".
"""
import math
import struct
import sys


def swirl(x, y, z):
    radius = math.hypot(x, z)
    turn = 3 / (1 + radius * radius)
    return turn * z, 0.5, -turn * x


def cloud(x, y, z):
    return (max(0.0, 1 - x * x - y * y - z * z),)


def hills(x, y, z):
    return (0.4 * math.sin(1.5 * x) * math.cos(1.1 * z) + 0.4,)


# function, nodes, first node [m], last node [m]
GRIDS = {
    "swirl": (swirl, (16, 8, 16), (-2, 0, -2), (2, 4, 2)),
    "cloud": (cloud, (16, 16, 16), (-1, -1, -1), (1, 1, 1)),
    "hills": (hills, (32, 1, 32), (-4, 0, -4), (4, 0, 4)),
}


def bytes_of(function, nodes, low, high):
    cell = [(b - a) / (n - 1) if n > 1 else 1 for a, b, n in zip(low, high, nodes)]
    first = function(*low)
    header = "fxgrid 1\nnodes {} {} {}\nchannels {}\n".format(*nodes, len(first))
    header += "low {:g} {:g} {:g}\n".format(*low) + "cell {:.7g} {:.7g} {:.7g}\ndata\n".format(*cell)
    data = [header.encode()]
    for k in range(nodes[2]):
        for j in range(nodes[1]):
            for i in range(nodes[0]):
                place = [a + n * c for a, n, c in zip(low, (i, j, k), cell)]
                data.append(struct.pack(f"<{len(first)}f", *function(*place)))
    return b"".join(data)


def main(arguments):
    if len(arguments) != 2 or arguments[0] not in GRIDS:
        print(__doc__, file=sys.stderr)
        return 2
    with open(arguments[1], "wb") as file:
        file.write(bytes_of(*GRIDS[arguments[0]]))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
