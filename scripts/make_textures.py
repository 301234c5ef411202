#!/usr/bin/env python3
"""make_textures.py FOLDER: writes the images of the library's presets to FOLDER, the same bytes on every machine.

spark.png         64 x 64    a glowing point with a soft halo
flash.png         128 x 128  a muzzle flash from the front: an uneven star around a white core
tongue.png        64 x 128   a muzzle flash from the side: a tongue whose tip is the upper end
flakes.png        192 x 128  3 x 2 snowflakes: stars, a plate, clumps
ring.png          64 x 64    the ring that a drop throws up
scorch.png        128 x 128  what a fireball leaves on the ground: soot in the middle, streaks of it outwards
streak.png        64 x 16    across a streak of light: a hot core and a halo
water.png         64 x 128   strands of falling water, the upper end falls first
smoke.png         512 x 512  8 x 8 frames of a puff that turns, grows and thins out
smoke-motion.png  256 x 256  where each texel of smoke.png goes until the next frame

Color is sRGB, opacity is linear. The build runs it; nothing but Python's own library is needed.
"""
import math
import pathlib
import struct
import sys
import zlib

from made_files import noise, write_bytes

TAU = 2 * math.pi


class Lattice:
    """Smooth periodic noise in [0, 1): random values on `columns` x `rows` nodes over the unit square."""

    def __init__(self, columns, rows, seed):
        self.columns, self.rows = columns, rows
        self.values = [[noise(i, j, seed) for i in range(columns)] for j in range(rows)]

    def at(self, u, v):
        x, y = u * self.columns, v * self.rows
        i, j = math.floor(x), math.floor(y)
        fx, fy = x - i, y - j
        fx, fy = fx * fx * (3 - 2 * fx), fy * fy * (3 - 2 * fy)
        low, high = self.values[j % self.rows], self.values[(j + 1) % self.rows]
        i0, i1 = i % self.columns, (i + 1) % self.columns
        return (low[i0] * (1 - fx) + low[i1] * fx) * (1 - fy) + (high[i0] * (1 - fx) + high[i1] * fx) * fy


class Octaves:
    """Sum of lattices, each next one twice as fine and half as strong; around 0.5."""

    def __init__(self, columns, rows, count, seed):
        self.parts = [(0.5**k, Lattice(columns << k, rows << k, seed + k)) for k in range(count)]
        self.norm = 1 / sum(weight for weight, _ in self.parts)

    def at(self, u, v):
        return self.norm * sum(weight * lattice.at(u, v) for weight, lattice in self.parts)


def clamp(value, low=0.0, high=1.0):
    return min(max(value, low), high)


def smooth(edge0, edge1, value):
    t = clamp((value - edge0) / (edge1 - edge0))
    return t * t * (3 - 2 * t)


def to_srgb(linear):
    return 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055


def color_byte(linear):
    return round(255 * to_srgb(clamp(linear)))


def alpha_byte(alpha):
    return round(255 * clamp(alpha))


def picture(width, height, texel):
    """RGBA rows of `texel(u, v)`: (linear color, opacity); u to the right, v upwards, both in (0, 1)."""
    rows = []
    for y in range(height):
        row = bytearray()
        for x in range(width):
            color, alpha = texel((x + 0.5) / width, 1 - (y + 0.5) / height)
            row += bytes([*(color_byte(c) for c in color), alpha_byte(alpha)])
        rows.append(bytes(row))
    return rows


def filtered(row, above):
    """The row as its difference from the one above, which smooth images pack best with."""
    return b"\x02" + bytes((a - b) & 255 for a, b in zip(row, above))


def png(rows):
    """An RGBA image of 8 bits."""
    width, height = len(rows[0]) // 4, len(rows)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    above = bytes(len(rows[0]))
    packed = bytearray()
    for row in rows:
        packed += filtered(row, above)
        above = row
    head = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(bytes(packed), 9))
            + chunk(b"IEND", b""))


WHITE = (1.0, 1.0, 1.0)


def spark(u, v):
    r = math.hypot(2 * u - 1, 2 * v - 1)
    light = math.exp(-60 * r * r) + 0.3 * math.exp(-9 * r * r) + 0.06 * math.exp(-3 * r)
    return WHITE, light * smooth(1.0, 0.75, r)


class Flash:
    """Petals of uneven length around a white core."""

    PETALS = 6

    def __init__(self):
        self.grain = Octaves(5, 5, 4, 20)
        self.petals = []
        for k in range(self.PETALS):
            angle = TAU * (k + 0.55 * (noise(k, 21) - 0.5)) / self.PETALS
            self.petals.append((angle, 0.5 + 0.45 * noise(k, 22), 0.2 + 0.16 * noise(k, 23)))

    def __call__(self, u, v):
        x, y = 2 * u - 1, 2 * v - 1
        r, angle = math.hypot(x, y), math.atan2(y, x)
        light = math.exp(-26 * r * r)
        ragged = 0.55 + 0.9 * self.grain.at(u, v)
        for direction, length, width in self.petals:
            away = abs((angle - direction + math.pi) % TAU - math.pi)
            along = r / (length * ragged)
            shape = math.exp(-((away / (width * (1.1 - 0.6 * along))) ** 2)) if along < 1 else 0
            light += 0.75 * shape * max(1 - along, 0.0) ** 0.8 * smooth(0.0, 0.12, r)
        light = (light + 0.1 * math.exp(-5 * r * r)) * smooth(1.0, 0.85, r)
        heat = clamp(1.2 * light)
        return (1.0, 0.30 + 0.65 * heat, 0.06 + 0.7 * heat * heat), light


class Tongue:
    """Narrow where it leaves the muzzle, widest at a third, ragged towards the tip."""

    def __init__(self):
        self.grain = Octaves(4, 5, 4, 30)

    def __call__(self, u, v):
        bend = 0.10 * (self.grain.at(0.3, 0.6 * v) - 0.5) * v
        width = 0.10 + 0.62 * math.sin(math.pi * min(v * 0.75 + 0.05, 1)) ** 1.3 * (1 - v) ** 0.45
        across = abs(2 * (u + bend) - 1) / max(width, 1e-3)
        torn = self.grain.at(u, 0.7 * v) - 0.5
        edge = across + (0.4 + 1.6 * v) * torn * 1.2
        light = smooth(1.0, 0.1, edge) * smooth(0.0, 0.06, v) * smooth(1.0, 0.6, v + 0.5 * torn)
        light += 0.7 * math.exp(-14 * across * across) * smooth(0.75, 0.0, v) * smooth(0.0, 0.05, v)
        light *= smooth(1.0, 0.8, abs(2 * u - 1))
        heat = clamp(light * (1.15 - 0.75 * v))
        return (1.0, 0.26 + 0.62 * heat, 0.05 + 0.6 * heat * heat), light


def segment_distance(px, py, ax, ay, bx, by):
    dx, dy = bx - ax, by - ay
    t = clamp(((px - ax) * dx + (py - ay) * dy) / (dx * dx + dy * dy))
    return math.hypot(px - ax - t * dx, py - ay - t * dy)


def star_flake(x, y, branches, spread, plate):
    """Distance-like profile of a six-armed crystal; the arms' twins are folded onto one half."""
    angle = (math.atan2(y, x) + math.pi / 6) % (math.pi / 3) - math.pi / 6
    r = math.hypot(x, y)
    px, py = r * math.cos(angle), abs(r * math.sin(angle))
    d = segment_distance(px, py, 0, 0, 0.9, 0) - 0.035
    for place, length in branches:
        c, s = math.cos(spread), math.sin(spread)
        d = min(d, segment_distance(px, py, place, 0, place + length * c, length * s) - 0.028)
    return min(d, px - plate)


FLAKES = [
    lambda x, y: star_flake(x, y, [(0.35, 0.3), (0.6, 0.24)], math.pi / 3, 0.16),
    lambda x, y: star_flake(x, y, [(0.25, 0.22), (0.45, 0.36), (0.68, 0.18)], math.pi / 3, 0.1),
    lambda x, y: star_flake(x, y, [(0.62, 0.22)], math.pi / 4, 0.42),
]


class Flakes:
    """Three crystals below, three clumps of crystals above."""

    def __init__(self):
        self.grain = Octaves(4, 4, 3, 40)

    def clump(self, x, y, index):
        alpha = 0.0
        for k in range(7):
            angle, far = TAU * noise(k, index, 41), 0.5 * math.sqrt(noise(k, index, 42))
            size = 0.3 + 0.25 * noise(k, index, 43)
            turn = TAU * noise(k, index, 44)
            dx, dy = (x - far * math.cos(angle)) / size, (y - far * math.sin(angle)) / size
            c, s = math.cos(turn), math.sin(turn)
            alpha += 0.55 * math.exp(-3.5 * (dx * dx + dy * dy))
            alpha += 0.5 * smooth(0.08, 0.0, FLAKES[k % 3](c * dx + s * dy, c * dy - s * dx)) * (dx * dx + dy * dy < 1)
        return alpha * (0.5 + self.grain.at(0.25 * x + 0.3 * index, 0.25 * y))

    def __call__(self, u, v):
        column, row = min(int(u * 3), 2), min(int(v * 2), 1)
        x, y = 2 * (u * 3 - column) - 1, 2 * (v * 2 - row) - 1
        r = math.hypot(x, y)
        rim = smooth(1.0, 0.85, r)
        if row == 1:
            return WHITE, min(self.clump(1.1 * x, 1.1 * y, column), 1.0) * rim
        d = FLAKES[column](x / 0.95, y / 0.95)
        return WHITE, (0.9 * smooth(0.035, -0.01, d) + 0.3 * math.exp(-3 * r * r)) * rim


def ring(u, v):
    x, y = 2 * u - 1, 2 * v - 1
    r, angle = math.hypot(x, y), math.atan2(y, x)
    crest = math.exp(-(((r - 0.78) / 0.085) ** 2)) + 0.35 * math.exp(-(((r - 0.48) / 0.09) ** 2))
    uneven = 0.8 + 0.2 * math.sin(3 * angle + 1) * math.sin(5 * angle)
    return WHITE, crest * uneven * smooth(1.0, 0.92, r)


class Scorch:
    """Soot: whole in the middle, patchy around it, in streaks that run outwards at the rim."""

    def __init__(self):
        self.patches = Octaves(5, 5, 4, 80)
        self.streaks = Octaves(22, 2, 3, 85)

    def __call__(self, u, v):
        x, y = 2 * u - 1, 2 * v - 1
        r, turn = math.hypot(x, y), math.atan2(y, x) / TAU
        patch = self.patches.at(u, v) - 0.5
        streak = self.streaks.at(turn % 1, 0.4 * r) - 0.5
        soot = smooth(1.05, 0.5, r + 0.6 * patch + 0.7 * streak * smooth(0.4, 0.9, r))
        dark = smooth(0.2, 0.9, soot + 0.6 * patch)
        color = tuple(0.11 + (0.022 - 0.11) * dark for _ in range(3))
        return (color[0], 0.9 * color[1], 0.78 * color[2]), 0.92 * soot * smooth(1.0, 0.88, r)


def streak(u, v):
    away = abs(2 * u - 1)
    core = math.exp(-((away / 0.16) ** 2))
    light = core + 0.22 * math.exp(-((away / 0.42) ** 2))
    heat = smooth(0.15, 1.0, core)
    return (1.0, 0.55 + 0.45 * heat, 0.4 + 0.6 * heat), light * smooth(1.0, 0.8, away)


class Water:
    """Fibers along the fall that part and join, denser in the middle, torn at the upper end, which falls first."""

    def __init__(self):
        self.fiber = [Octaves(9, 2, 3, 50), Octaves(14, 3, 2, 54)]
        self.gap = Octaves(3, 4, 3, 58)

    def __call__(self, u, v):
        sway = 0.05 * math.sin(TAU * (0.7 * v + 0.2))
        fiber = self.fiber[0].at(u + sway, 0.5 * v) * 0.6 + self.fiber[1].at(u - sway, v) * 0.5
        body = math.exp(-4.5 * (2 * u - 1) ** 2) * smooth(1.0, 0.75, abs(2 * u - 1))
        ends = smooth(0.0, 0.35, v) * smooth(1.0, 0.7, v + 0.25 * (fiber - 0.5))
        torn = smooth(0.25, 0.6, self.gap.at(u, v) + 0.25 * body)
        bright = 0.55 + 0.45 * smooth(0.4, 0.75, fiber)
        return (bright, bright, bright), 1.25 * body * ends * torn * smooth(0.28, 0.72, fiber)


class Smoke:
    """A puff carried by a steady swirling flow: frame n is the first one, looked up where the flow came from, and
    worn away where it is thin."""

    SIDE, TILES, LIFE = 64, 8, 64
    STEP = 0.007  # way between two frames at a speed of 1, in frames' widths

    def __init__(self):
        self.density = Octaves(4, 4, 5, 60)
        self.stream = Octaves(3, 3, 3, 70)
        n = self.SIDE
        centers = [(i + 0.5) / n for i in range(n)]
        self.flow = [[self.velocity(x, y) for x in centers] for y in centers]
        self.frames = self.make_frames()

    def velocity(self, x, y):
        """Noise without divergence, as the slope of a stream function, and an outward push that grows the puff."""
        h = 1 / 128
        vx = (self.stream.at(x, y + h) - self.stream.at(x, y - h)) / (2 * h) * 0.16
        vy = (self.stream.at(x - h, y) - self.stream.at(x + h, y)) / (2 * h) * 0.16
        rim = smooth(0.5, 0.36, math.hypot(x - 0.5, y - 0.5))
        return (vx + 0.5 * (x - 0.5)) * rim, (vy + 0.5 * (y - 0.5)) * rim

    def first(self, x, y):
        """The puff before it moves."""
        r = math.hypot(x - 0.5, y - 0.5) / 0.34
        return clamp(1.15 - r + 1.9 * (self.density.at(x, y) - 0.5)) if r < 1.6 else 0.0

    def make_frames(self):
        n = self.SIDE
        table = [[self.first((i + 0.5) / n, (j + 0.5) / n) for i in range(n)] for j in range(n)]
        came = [[((i + 0.5) / n, (j + 0.5) / n) for i in range(n)] for j in range(n)]
        frames = []
        for _ in range(self.LIFE):
            frames.append([[sample(table, x, y) for x, y in row] for row in came])
            came = [[sample_pair(came, (i + 0.5) / n - self.STEP * vx, (j + 0.5) / n - self.STEP * vy)
                     for i, (vx, vy) in enumerate(row)] for j, row in enumerate(self.flow)]
        return frames

    def alpha(self, frame, i, j):
        n = self.SIDE
        r = math.hypot((i + 0.5) / n - 0.5, (j + 0.5) / n - 0.5)
        worn = 0.35 * frame / self.LIFE
        thick = self.frames[frame][j][i]
        return 0.9 * smooth(worn, worn + 0.75, thick) * smooth(0.5, 0.36, r)

    def rows(self):
        n, result = self.SIDE, []
        for y in range(n * self.TILES):
            row = bytearray()
            for x in range(n * self.TILES):
                frame = y // n * self.TILES + x // n
                row += bytes([255, 255, 255, alpha_byte(self.alpha(frame, x % n, y % n)) & 0xFC])
            result.append(bytes(row))
        return result

    def motion_rows(self):
        """Half as fine; red to the right, green downwards as rows of the image go; 127 steps are MOTION frames' widths."""
        n, half, result = self.SIDE, self.SIDE // 2, []
        for y in range(half * self.TILES):
            row = bytearray()
            for x in range(half * self.TILES):
                vx, vy = self.flow[y % half * 2][x % half * 2]
                row += bytes([*(round(clamp(128 + 127 * c * self.STEP / MOTION, 1, 255)) for c in (vx, vy)), 0, 255])
            result.append(bytes(row))
        return result


MOTION = 0.005  # the presets' "motionScale"


def corners(x, y, n):
    """The four texels around a place of the unit square, held at the rim, and the shares of the far ones."""
    x, y = clamp(x * n - 0.5, 0, n - 1), clamp(y * n - 0.5, 0, n - 1)
    i, j = min(int(x), n - 2), min(int(y), n - 2)
    return i, j, x - i, y - j


def sample(table, x, y):
    i, j, fx, fy = corners(x, y, len(table))
    low, high = table[j], table[j + 1]
    return (low[i] * (1 - fx) + low[i + 1] * fx) * (1 - fy) + (high[i] * (1 - fx) + high[i + 1] * fx) * fy


def sample_pair(table, x, y):
    i, j, fx, fy = corners(x, y, len(table))
    a, b, c, d = (1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy
    low, high = table[j], table[j + 1]
    return tuple(low[i][k] * a + low[i + 1][k] * b + high[i][k] * c + high[i + 1][k] * d for k in (0, 1))


def main():
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    folder = pathlib.Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    smoke = Smoke()
    images = {
        "spark.png": picture(64, 64, spark),
        "flash.png": picture(128, 128, Flash()),
        "tongue.png": picture(64, 128, Tongue()),
        "flakes.png": picture(192, 128, Flakes()),
        "ring.png": picture(64, 64, ring),
        "scorch.png": picture(128, 128, Scorch()),
        "streak.png": picture(64, 16, streak),
        "water.png": picture(64, 128, Water()),
        "smoke.png": smoke.rows(),
        "smoke-motion.png": smoke.motion_rows(),
    }
    for name, rows in images.items():
        write_bytes(folder / name, png(rows))
    return 0


if __name__ == "__main__":
    sys.exit(main())
