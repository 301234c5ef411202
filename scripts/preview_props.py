"""What stands beside effects in the previews of the library's presets: meshes for make_preview_stages.py."""
import math

from made_files import Polygons, noise

# Normals of these materials are averaged where faces meet, so that their surfaces look round.
ROUND = {"ash", "bark", "bottle", "char", "crag", "gun_round", "scree", "snow", "stone"}


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def between(a, b, t):
    return tuple(x + (y - x) * t for x, y in zip(a, b))


def unit(v):
    length = math.sqrt(sum(c * c for c in v))
    return tuple(c / length for c in v)


class Props(Polygons):
    def rod(self, material, a, b, radii, sides=10, end=None, rough=0.0, seed=0):
        """A rod from a to b, of a radius at each of its equally spaced rings, with flat ends of the material `end`."""
        axis = unit([y - x for x, y in zip(a, b)])
        u = unit(cross(axis, (0, 0, 1) if abs(axis[2]) < 0.9 else (1, 0, 0)))
        v = cross(axis, u)

        def rim(ring):
            center, points = between(a, b, ring / (len(radii) - 1)), []
            for k in range(sides):
                turn = 2 * math.pi * k / sides
                r = radii[ring] * (1 + rough * (noise(ring, k, seed) - 0.5))
                points.append(tuple(c + r * (math.cos(turn) * p + math.sin(turn) * q) for c, p, q in zip(center, u, v)))
            return points

        rims = [rim(ring) for ring in range(len(radii))]
        for low, high in zip(rims, rims[1:]):
            for k in range(sides):
                n = (k + 1) % sides
                self.polygon(material, [low[k], low[n], high[n], high[k]])
        if end:
            self.polygon(end, rims[-1])
            self.polygon(end, rims[0][::-1])

    def ring(self, material, center, radius, tube, sides=24, around=6):
        """A level ring."""
        def point(i, k):
            a, b = 2 * math.pi * i / sides, 2 * math.pi * k / around
            r = radius + tube * math.cos(b)
            return (center[0] + r * math.cos(a), center[1] + tube * math.sin(b), center[2] - r * math.sin(a))

        for i in range(sides):
            for k in range(around):
                self.polygon(material, [point(i, k), point(i + 1, k), point(i + 1, k + 1), point(i, k + 1)])

    def stone(self, material, x, z, radius, seed, flatness=0.7):
        """An uneven ball that stands halfway in the ground."""
        rows, columns = 5, 10

        def corner(row, column):
            up, around = 0.5 * math.pi * row / rows, 2 * math.pi * (column % columns) / columns
            r = radius * (0.8 + 0.4 * noise(row // 2, (column % columns) // 2 if row < rows else 0, seed))
            return (x + r * math.cos(up) * math.cos(around), flatness * r * math.sin(up) - 0.1 * radius,
                    z - r * math.cos(up) * math.sin(around))

        for row in range(rows):
            for column in range(columns):
                low, high = corner(row, column), corner(row + 1, column)
                low2, high2 = corner(row, column + 1), corner(row + 1, column + 1)
                self.polygon(material, [low, low2, high2, high] if row + 1 < rows else [low, low2, high])

    def conifer(self, x, z, height, seed, floor=0.0, layers=6, sides=9):
        """A trunk and skirts of branches with uneven rims."""
        trunk = 0.016 * height
        self.rod("trunk", (x, floor - 0.3, z), (x, floor + 0.5 * height, z), [trunk, 0.5 * trunk], 5)
        for layer in range(layers):
            t = layer / layers
            low, high = floor + height * (0.1 + 0.88 * t), floor + height * (0.1 + 0.88 * min(1.0, t + 1.9 / layers))
            reach = height * 0.2 * (1.03 - t) ** 0.8
            shift = 0.05 * reach * noise(layer, seed, 50)
            rim = []
            for k in range(2 * sides):
                turn = math.pi * (k + noise(layer, seed)) / sides
                r = reach * ((0.82 if k % 2 else 1.0) + 0.24 * (noise(layer, k, seed) - 0.5))
                drop = (0.0 if k % 2 else 0.05 * height) * (0.5 + noise(k, layer, seed, 51))
                rim.append((x + shift + r * math.cos(turn), low - drop, z - r * math.sin(turn)))
            for k in range(2 * sides):
                self.polygon("needles", [rim[k], rim[(k + 1) % (2 * sides)], (x, high, z)])


def camp():
    """Crossed logs, half burned, in a ring of stones, and a trunk to sit on."""
    props = Props()
    sides = 18
    rim = [(0.44 * math.cos(2 * math.pi * k / sides), -0.01, -0.44 * math.sin(2 * math.pi * k / sides)) for k in range(sides)]
    inner = [(0.5 * x, 0.035 + 0.03 * noise(k, 70), 0.5 * z) for k, (x, _, z) in enumerate(rim)]
    for k in range(sides):
        n = (k + 1) % sides
        props.polygon("ash", [rim[k], rim[n], inner[n], inner[k]])
        props.polygon("char", [inner[k], inner[n], (0, 0.06, 0)])
    for k in range(12):
        turn = 2 * math.pi * (k + 0.4 * noise(k, 71)) / 12
        props.stone("stone", 0.54 * math.cos(turn), -0.54 * math.sin(turn), 0.10 + 0.05 * noise(k, 72), k)
    logs = [  # (turn [degree], radius at the foot, height and reach of the tip)
        (20, 0.43, 0.40, 0.10), (75, 0.40, 0.36, 0.12), (140, 0.44, 0.44, 0.09), (200, 0.42, 0.34, 0.13),
        (255, 0.40, 0.42, 0.08), (318, 0.45, 0.38, 0.11),
    ]  # fmt: skip
    for k, (degrees, foot, height, tip) in enumerate(logs):
        c, s = math.cos(math.radians(degrees)), -math.sin(math.radians(degrees))
        low, high, r = (foot * c, 0.03, foot * s), (-tip * c, height, -tip * s), 0.036 + 0.014 * noise(k, 73)
        burned = between(low, high, 0.33)
        props.rod("bark", low, burned, [r, r, 1.05 * r], 12, None, 0.18, 80 + k)
        props.rod("char", burned, high, [1.02 * r, 0.95 * r, 0.85 * r, 0.6 * r], 12, "char", 0.3, 90 + k)
        props.rod("wood_end", between(low, high, -0.004), low, [0.98 * r, r], 12, "wood_end")
    for k, (x, z, turn) in enumerate(((0.02, 0.16, 8), (-0.05, -0.15, -14))):
        c, s = 0.34 * math.cos(math.radians(turn)), 0.34 * math.sin(math.radians(turn))
        props.rod("char", (x - c, 0.075, z - s), (x + c, 0.07, z + s), [0.042, 0.05, 0.048, 0.04], 12, "char", 0.25, 100 + k)
    props.rod("bark", (1.05, 0.15, -1.5), (2.55, 0.16, -0.75), [0.17, 0.175, 0.165, 0.17], 16, "wood_end", 0.08, 110)
    for k in range(5):  # firewood
        x, y = 1.75 + 0.13 * (k % 3) + 0.06 * (k // 3), 0.06 + 0.1 * (k // 3)
        front = 0.35 + 0.04 * noise(k, 74)
        props.rod("bark", (x, y, front), (x + 0.02, y, 0.82), [0.062, 0.06, 0.06], 10, "wood_end", 0.15, 120 + k)
    return props


def burner():
    """A ring burner on three feet above a plate, its hose and its bottle of gas."""
    props = Props()
    for radius in (0.25, 0.13):
        props.ring("gun_round", (0, 0.05, 0), radius, 0.018)
    props.rod("gun_round", (-0.25, 0.05, 0), (0.25, 0.05, 0), [0.014, 0.014], 8)
    for k in range(3):
        c, s = math.cos(2.1 * k + 0.5), -math.sin(2.1 * k + 0.5)
        props.rod("gun_round", (0.25 * c, 0.05, 0.25 * s), (0.36 * c, -0.01, 0.36 * s), [0.012, 0.012], 8, "steel")
    props.rod("slab_2", (0, -0.03, 0), (0, 0.012, 0), [0.62, 0.62], 32, "slab_1")
    hose = [(0.25, 0.05, 0), (0.5, 0.03, -0.02), (0.8, 0.012, -0.16), (1.1, 0.012, -0.42), (1.2, 0.3, -0.66), (1.16, 0.62, -0.72)]
    for a, b in zip(hose, hose[1:]):
        props.rod("char", a, b, [0.012, 0.012], 8)
    x, z = 1.15, -0.75
    props.rod("bottle", (x, 0, z), (x, 0.56, z), [0.13, 0.145, 0.15, 0.15, 0.15, 0.15, 0.142, 0.1, 0.03], 20)
    props.rod("gun_round", (x, 0.54, z), (x, 0.64, z), [0.02, 0.02], 8, "steel")
    props.ring("bottle", (x, 0.63, z), 0.085, 0.009, 20, 6)
    for k in range(3):
        c, s = 0.085 * math.cos(2.1 * k), -0.085 * math.sin(2.1 * k)
        props.rod("bottle", (x + c, 0.5, z + s), (x + c, 0.63, z + s), [0.008, 0.008], 6)
    return props


def grinder():
    """A pipe on two trestles that an angle grinder cuts at the origin, 0.9 m above the ground."""
    props = Props()
    props.rod("gun_round", (-0.012, 0.872, -1.1), (-0.012, 0.872, 1.1), [0.028, 0.028], 16, "char")
    for z in (-0.75, 0.75):
        for dx in (-0.28, 0.28):
            for dz in (-0.12, 0.12):
                props.rod("wood_end", (dx, -0.01, z + dz), (0.12 * dx, 0.82, z + 0.2 * dz), [0.025, 0.022], 6)
        props.box("wood", (-0.1, 0.78, z - 0.04), (0.1, 0.844, z + 0.04), bottom=True)
    # Disc, its guard, gear head, body and handle of the grinder.
    props.rod("stone", (-0.035, 0.945, -0.003), (-0.035, 0.945, 0.003), [0.062, 0.062], 28, "stone")
    props.rod("gun_round", (-0.035, 0.945, 0.003), (-0.035, 0.945, 0.045), [0.034, 0.03], 14, "steel")
    for k in range(8):
        a, b = (math.radians(60 + 22 * (k + i)) for i in (0, 1))
        p, q = ((-0.035 + 0.07 * math.cos(t), 0.945 + 0.07 * math.sin(t)) for t in (a, b))
        props.polygon("steel", [(*q, -0.02), (*p, -0.02), (*p, 0.02), (*q, 0.02)])
        props.polygon("steel", [(*p, -0.02), (*q, -0.02), (*q, 0.02), (*p, 0.02)])
    props.rod("bottle", (-0.05, 0.955, 0.035), (-0.30, 1.05, 0.05), [0.032, 0.034, 0.03, 0.026], 14, "char")
    props.rod("char", (-0.30, 1.05, 0.05), (-0.36, 1.07, 0.055), [0.03, 0.028], 14, "char")
    props.rod("char", (-0.04, 0.955, 0.05), (-0.02, 1.0, 0.17), [0.016, 0.017, 0.014], 10, "char")
    return props


def rifle():
    """A rifle along +X whose muzzle is the origin, on sandbags on a bench whose feet are 1.1 m below."""
    props = Props()
    props.rod("gun_round", (-0.48, 0, 0), (-0.075, 0, 0), [0.013, 0.011, 0.0095, 0.0095], 16)
    props.rod("gun_round", (-0.078, 0, 0), (0, 0, 0), [0.0125, 0.014, 0.014, 0.0135], 16, "char")
    for x in (-0.055, -0.035, -0.015):  # ports of the muzzle brake
        for z in (-0.0141, 0.0141):
            port = [(x, -0.004, z), (x + 0.011, -0.004, z), (x + 0.011, 0.005, z), (x, 0.005, z)]
            props.polygon("char", port if z > 0 else port[::-1])
    props.box("gun", (-0.262, -0.002, -0.004), (-0.245, 0.045, 0.004), bottom=True)
    props.box("gun", (-0.272, -0.016, -0.014), (-0.235, 0.012, 0.014), bottom=True)
    props.rod("gun_round", (-0.50, 0.024, 0), (-0.25, 0.024, 0), [0.009, 0.009], 12)
    props.rod("wood", (-0.52, -0.004, 0), (-0.29, -0.004, 0), [0.029, 0.031, 0.029, 0.024], 14, "wood")
    props.box("gun", (-0.76, -0.035, -0.018), (-0.50, 0.038, 0.018), bottom=True)
    props.rod("gun_round", (-0.72, 0.072, 0), (-0.5, 0.072, 0), [0.019, 0.016, 0.016, 0.02], 14, "char")
    for x in (-0.68, -0.55):
        props.box("gun", (x, 0.03, -0.008), (x + 0.02, 0.07, 0.008))
    for k in range(4):  # the curved magazine
        x, y, d = -0.60 + 0.012 * k * k / 3, -0.035 - 0.042 * k, 0.006 * k
        props.box("gun", (x, y - 0.044, -0.012), (x + 0.062 + d, y, 0.012), bottom=True)
    props.rod("wood", (-0.70, -0.03, 0), (-0.755, -0.13, 0), [0.02, 0.019, 0.021], 12, "wood")
    props.rod("wood", (-0.75, -0.005, 0), (-1.03, -0.045, 0), [0.022, 0.03, 0.042, 0.05], 14, "wood")
    sacks = ((-0.39, -0.10, 0, 0.062), (-0.40, -0.175, 0.07, 0.06), (-0.38, -0.175, -0.08, 0.06), (-0.98, -0.13, 0, 0.055),
             (-0.97, -0.185, 0.06, 0.05))
    for k, (x, y, z, r) in enumerate(sacks):
        radii = [share * r for share in (0.5, 0.95, 1, 1.02, 0.95, 0.5)]
        props.rod("sack", (x, y, z - 0.13), (x, y, z + 0.13), radii, 12, "sack", 0.1, 130 + k)
    props.box("wood_end", (-1.25, -0.285, -0.42), (-0.18, -0.245, 0.42), bottom=True)
    for x in (-1.15, -0.28):
        for z in (-0.36, 0.36):
            props.box("wood", (x - 0.035, -1.12, z - 0.035), (x + 0.035, -0.285, z + 0.035))
    return props


def trees():
    """Conifers and a fence on level ground, for a bank of fog."""
    props = Props()
    count = 0
    for k in range(400):
        x, z = -75 + 150 * noise(k, 140), -62 + 84 * noise(k, 141)
        wood = noise(int(math.floor(x / 22)), int(math.floor(z / 18)), 142)
        if count < 34 and wood > 0.55 and not (abs(x + 3) < 9 and z > -30):
            props.conifer(x, z, 7 + 9 * noise(k, 143), k, 0.0, 5, 5)
            count += 1
    for k in range(15):
        x, z = -34 + 4.2 * k, 34 - 1.1 * k
        props.rod("bark", (x, -0.2, z), (x + 0.05 * noise(k, 144), 1.25, z), [0.07, 0.06], 7, "wood_end", 0.1, k)
        if k < 14:
            for y in (0.55, 1.05):
                props.rod("bark", (x, y, z), (x + 4.2, y + 0.1 * (noise(k, y > 1, 145) - 0.5), z - 1.1), [0.035, 0.035], 6)
    return props


SLOPE = math.tan(math.radians(24))  # of the way of the avalanche
FOOT = 62.0  # [m] where the slope ends, along +z


def slope_height(x, z):
    """[m] A mountain side that falls towards +z, with a gully along z in its middle."""
    def smooth_noise(u, v, seed):
        i, j = math.floor(u), math.floor(v)
        a, b = (t * t * (3 - 2 * t) for t in (u - i, v - j))
        low = noise(i, j, seed) * (1 - a) + noise(i + 1, j, seed) * a
        high = noise(i, j + 1, seed) * (1 - a) + noise(i + 1, j + 1, seed) * a
        return low * (1 - b) + high * b

    up = FOOT - z
    y = SLOPE * (up if up > 60 else 12 * math.log1p(math.exp(up / 12)))
    side = min(max((abs(x) - 34) / 60, 0.0), 1.0)
    side = side * side * (3 - 2 * side) * min(max((up + 10) / 60, 0.0), 1.0)
    y += side * (8 + 26 * smooth_noise(x / 46, z / 60, 150) + 7 * smooth_noise(x / 14, z / 18, 151))
    top = max(0.0, up - 190)
    y += top * (0.15 + 0.75 * smooth_noise(x / 55 + 3, z / 90, 152) + 0.25 * smooth_noise(x / 21, z / 33, 153))
    rough = 0.25 + side + min(top / 60, 1.0)
    return y + rough * (2.2 * smooth_noise(x / 9, z / 11, 154) - 1.1)


def slope():
    """A snowy mountain side, rocks and conifers."""
    props = Props()
    columns, rows = 40, 42
    xs = [math.copysign(abs(t) ** 1.5 * 300, t) for t in (2 * i / columns - 1 for i in range(columns + 1))]
    zs = [130 - 470 * (j / rows) ** 1.25 for j in range(rows + 1)]
    nodes = [[(x, slope_height(x, z), z) for x in xs] for z in zs]
    for j in range(rows):
        for i in range(columns):
            a, b, c, d = nodes[j][i], nodes[j][i + 1], nodes[j + 1][i + 1], nodes[j + 1][i]
            n = unit(cross([q - p for p, q in zip(a, c)], [q - p for p, q in zip(b, d)]))
            level = n[1] + 0.1 * (noise(i // 2, j // 2, 160) - 0.5)
            kind = "snow" if level > 0.68 or a[1] < 20 else "scree" if level > 0.58 else "crag"
            props.polygon(kind, [a, b, c, d])
    for k in range(30):
        side = -1 if k % 2 else 1
        x, z = side * (40 + 80 * noise(k, 161)), 95 - 150 * noise(k, 162)
        props.conifer(x, z, 8 + 9 * noise(k, 163), 200 + k, slope_height(x, z), 5, 5)
    for k in range(9):
        x, z = -30 + 60 * noise(k, 164), 66 + 34 * noise(k, 165)
        props.stone("crag", x, z, 0.4 + 0.9 * noise(k, 166), 300 + k)
    return props
