"""Stages that any effect can be shown on: a courtyard, a wall, a corridor, water, a gray studio. Metres, +Y up; effects
stand in the origin, on y = 0, and are looked at from +Z."""
import math

from made_files import noise


def paving(mesh, x0, x1, z0, z1, size, kinds, seed, gap=0.012):
    """Slabs in rows that are shifted by half a slab, on a bed 3 cm below."""
    mesh.polygon("mortar", [(x0, -0.03, z1), (x1, -0.03, z1), (x1, -0.03, z0), (x0, -0.03, z0)])
    rows = round((z1 - z0) / size)
    for row in range(rows):
        z = z0 + row * size
        x, column = x0 - (0.5 * size if row % 2 else 0), 0
        while x < x1 - 0.01:
            low, high = max(x, x0), min(x + size, x1)
            kind = kinds[int(len(kinds) * noise(column, row, seed))]
            mesh.polygon(kind, [(low + gap, 0, z + size - gap), (high - gap, 0, z + size - gap), (high - gap, 0, z + gap),
                                (low + gap, 0, z + gap)])
            x, column = x + size, column + 1


def masonry(mesh, place, length, y0, y1, block, kinds, seed, holes=(), gap=0.008):
    """Blocks of a wall in its own coordinates: x along it, y upwards, z towards who sees it. `holes` stay open."""
    wide, tall = block
    rows = round((y1 - y0) / tall)
    for row in range(rows):
        y = y0 + row * tall
        x, column = -(0.5 * wide if row % 2 else 0), 0
        while x < length - 0.01:
            pieces = [(max(x, 0.0), min(x + wide, length))]
            for h0, h1, bottom, top in holes:
                if y + tall > bottom + 0.01 and y < top - 0.01:
                    pieces = [(a, b) for p, q in pieces for a, b in ((p, min(q, h0)), (max(p, h1), q)) if b - a > 0.01]
            kind = kinds[int(len(kinds) * noise(column, row, seed))]
            out = 0.02 * noise(row, column, seed + 1)
            for a, b in pieces:
                mesh.box(kind, (a + gap, y + gap, -0.3), (b - gap, y + tall - gap, out), place, bottom=True)
            x, column = x + wide, column + 1


def backing(mesh, place, length, y0, y1, holes, deep=-0.025):
    """Mortar behind the blocks, with the same holes."""
    edges = sorted({0.0, length, *(x for h in holes for x in h[:2])})
    for a, b in zip(edges, edges[1:]):
        open_at = [h for h in holes if h[0] <= a + 1e-6 and h[1] >= b - 1e-6]
        spans = [(y0, open_at[0][2]), (open_at[0][3], y1)] if open_at else [(y0, y1)]
        for low, high in spans:
            if high - low > 0.01:
                mesh.box("mortar", (a, low, -0.28), (b, high, deep), place, bottom=True)


def turned(x0, z0, direction):
    """Places a wall that begins at (x0, z0) and runs along +x seen from +z (0), from -x (1) or from +x (2)."""
    return {
        0: lambda p: (x0 + p[0], p[1], z0 + p[2]),
        1: lambda p: (x0 - p[2], p[1], z0 + p[0]),  # seen from -x
        2: lambda p: (x0 + p[2], p[1], z0 - p[0]),  # seen from +x
    }[direction]


def wall_with(mesh, place, length, height, kinds, seed, holes, block=(0.62, 0.31)):
    masonry(mesh, place, length, 0.0, height, block, kinds, seed, holes)
    backing(mesh, place, length, 0.0, height, holes)
    mesh.box("slab_2", (-0.06, height, -0.4), (length + 0.06, height + 0.14, 0.1), place, bottom=True)
    for left, right, bottom, top in holes:
        mesh.box("slab_2", (left - 0.15, top, -0.25), (right + 0.15, top + 0.22, 0.05), place, bottom=True)
        if bottom > 0.1:
            mesh.box("slab_2", (left - 0.1, bottom - 0.1, -0.25), (right + 0.1, bottom, 0.09), place, bottom=True)
        mesh.box("shade", (left, bottom, -0.34), (right, top, -0.24), place, bottom=True)
        if bottom > 0.1:
            middle = 0.5 * (left + right)
            mesh.box("wood", (middle - 0.03, bottom, -0.24), (middle + 0.03, top, -0.18), place)
            mesh.box("wood", (left, 0.5 * (bottom + top) - 0.03, -0.24), (right, 0.5 * (bottom + top) + 0.03, -0.18), place)
        else:
            for k in range(5):
                a = left + (right - left) * k / 5
                mesh.box("wood", (a + 0.01, bottom, -0.24), (a + (right - left) / 5 - 0.01, top, -0.17), place)


def courtyard(mesh):
    mesh.polygon("floor", [(-60, -0.06, 60), (60, -0.06, 60), (60, -0.06, -60), (-60, -0.06, -60)])
    paving(mesh, -9, 9, -7, 9, 1.0, ("slab_0", "slab_1", "slab_2"), 50)
    stone = ("wall_0", "wall_1", "wall_0", "slab_2")
    windows = [(x, x + 1.1, 1.55, 3.1) for x in (2.0, 5.0, 11.9, 14.9)]
    wall_with(mesh, turned(-9, -7, 0), 18.0, 4.65, stone, 51, [*windows, (8.3, 9.8, 0.0, 2.48)])
    wall_with(mesh, turned(9, -7, 1), 13.0, 3.72, stone, 53, [(4.0, 5.1, 1.24, 2.79), (8.0, 9.1, 1.24, 2.79)])
    wall_with(mesh, turned(-9, 6, 2), 13.0, 3.72, stone, 55, [(5.0, 6.5, 0.0, 2.48)])
    for x in (-9.1, 8.5):
        mesh.box("slab_2", (x, 0, 5.7), (x + 0.7, 4.3, 6.4))
        mesh.box("slab_1", (x - 0.1, 4.3, 5.6), (x + 0.8, 4.45, 6.5))
    for x, z, size in ((-7.6, -5.6, 0.95), (-6.5, -5.9, 0.8), (-7.2, -4.4, 0.6), (6.9, -5.6, 0.9)):
        mesh.box("wood", (x, 0, z), (x + size, size, z + size))
        for y in (0.0, size - 0.1):
            mesh.box("wood_end", (x - 0.02, y, z - 0.02), (x + size + 0.02, y + 0.1, z + size + 0.02))


def wall(mesh):
    mesh.polygon("slab_1", [(-60, -0.02, 60), (60, -0.02, 60), (60, -0.02, -60), (-60, -0.02, -60)])
    paving(mesh, -6, 6, -2.6, 6.4, 0.6, ("tile_0", "slab_1", "tile_0"), 60)
    bricks = ("brick_0", "brick_1", "brick_0", "brick_2")
    place = turned(-5.0, -2.6, 0)
    masonry(mesh, place, 10.0, 0.0, 4.0, (0.4, 0.2), bricks, 61, gap=0.009)
    backing(mesh, place, 10.0, 0.0, 4.0, [], deep=-0.012)
    mesh.box("slab_2", (-5.1, 4.0, -2.98), (5.1, 4.12, -2.5))


def corridor(mesh):
    """4 m wide, 3 m high, 26 m long; sun comes in by the windows of its right side."""
    paving(mesh, -2, 2, -16, 10, 0.5, ("tile_0", "tile_1", "tile_0"), 70, gap=0.006)
    end = [(-2, 0, -16), (2, 0, -16), (2, 3, -16), (-2, 3, -16)]
    mesh.polygon("plaster", end)
    mesh.box("wood", (-0.55, 0, -16), (0.55, 2.2, -15.94))
    mesh.box("plaster", (-2.5, 3.0, -16.3), (2.5, 3.2, 10), bottom=True)
    for z in range(-14, 10, 4):  # beams
        mesh.box("wall_1", (-2, 2.78, z - 0.12), (2, 3.0, z + 0.12), bottom=True)
    mesh.box("dado", (-2.3, 0, -16), (-1.98, 1.05, 10))
    mesh.box("plaster", (-2.3, 1.05, -16), (-2, 3, 10))
    mesh.box("wood", (-2.3, 1.05, -16), (-1.95, 1.12, 10))
    piers = [-16.0, *(float(z) for z in range(-13, 8, 4)), 10.0]
    mesh.box("dado", (1.98, 0, -16), (2.3, 0.95, 10))
    mesh.box("wood", (1.93, 0.95, -16), (2.32, 1.0, 10))
    mesh.box("plaster", (2, 2.45, -16), (2.3, 3, 10), bottom=True)
    for a, b in zip(piers, piers[1:]):
        low = a + (1.0 if a > -16 else 0)
        mesh.box("plaster", (2, 1.0, low), (2.3, 2.45, min(low + 1.6, b)))
    mesh.polygon("floor", [(2.3, -0.1, 14), (16, -0.1, 14), (16, -0.1, -20), (2.3, -0.1, -20)])


def water(mesh):
    """A round quay, 8 m in radius, half a metre above a lake."""
    side = 2400
    mesh.polygon("water", [(-side, -0.5, side), (side, -0.5, side), (side, -0.5, -side), (-side, -0.5, -side)])
    sides = 40

    def rim(radius, k, y):
        angle = 2 * math.pi * k / sides
        return (radius * math.cos(angle), y, -radius * math.sin(angle))

    rings = [0.0, 1.2, 2.4, 3.6, 4.8, 6.0, 7.2, 8.0]
    for ring, (inner, outer) in enumerate(zip(rings, rings[1:])):
        step = 4 if ring < 2 else 2 if ring < 4 else 1
        for k in range(0, sides, step):
            kind = "slab_2" if ring == 6 else ("slab_0", "slab_1")[int(2 * noise(ring, k, 80))]
            a, b = k + 0.02 * step, k + step - 0.02 * step
            arc = [a + (b - a) * i / step for i in range(step + 1)]
            outside = [rim(outer - 0.012, t, 0) for t in arc]
            inside = [rim(inner + 0.012, t, 0) for t in reversed(arc)] if inner > 0 else [(0, 0, 0)]
            mesh.polygon(kind, outside + inside)
    for k in range(sides):
        mesh.polygon("mortar", [rim(7.98, k, -0.03), rim(7.98, k + 1, -0.03), (0, -0.03, 0)])
        kind = ("rock", "rock_light")[int(2 * noise(k // 2, 81))]
        mesh.polygon(kind, [rim(8, k, -0.8), rim(8, k + 1, -0.8), rim(8, k + 1, 0), rim(8, k, 0)])
    for k in range(38):
        angle, r = 2 * math.pi * (k + 0.6 * noise(k, 82)) / 38, 8.25 + 0.6 * noise(k, 83)
        mesh.boulder(r * math.cos(angle), r * math.sin(angle), 0.3 + 0.3 * noise(k, 84), 90 + k)


def studio_gray(mesh):
    """A level disk of 40 m; the background continues it in the color that it has under the stage's light."""
    corners = [(40 * math.cos(2 * math.pi * k / 64), 0, -40 * math.sin(2 * math.pi * k / 64)) for k in range(64)]
    mesh.polygon("gray", corners)


def rooms(make):
    """Meshes by the name of their stage. @param make: creates an empty mesh"""
    meshes = {}
    for name, build in (("courtyard", courtyard), ("wall", wall), ("corridor", corridor), ("water", water),
                        ("studio-gray", studio_gray)):
        meshes[name] = make()
        build(meshes[name])
    return meshes
