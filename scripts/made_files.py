"""What the scripts that make meshes and textures share: polygons by material, repeatable noise, files."""


def noise(*key):
    """A number in [0, 1) that depends on nothing but the integers `key` (splitmix64 steps)."""
    state = 0x9E3779B97F4A7C15
    for value in key:
        state = (state ^ (value & 0xFFFFFFFFFFFFFFFF)) * 0xBF58476D1CE4E5B9 & 0xFFFFFFFFFFFFFFFF
        state = (state ^ (state >> 27)) * 0x94D049BB133111EB & 0xFFFFFFFFFFFFFFFF
        state ^= state >> 31
    return state / 2.0**64


class Polygons:
    """Polygons, counter-clockwise seen from outside, grouped by material."""

    def __init__(self):
        self.faces = {}

    def polygon(self, material, points):
        self.faces.setdefault(material, []).append(points)

    def box(self, material, low, high, place=lambda p: p, bottom=False):
        """An axis-aligned box moved by `place`; its bottom is left out unless asked for."""
        (x0, y0, z0), (x1, y1, z1) = low, high
        sides = [
            [(x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1)],
            [(x1, y0, z0), (x0, y0, z0), (x0, y1, z0), (x1, y1, z0)],
            [(x1, y0, z1), (x1, y0, z0), (x1, y1, z0), (x1, y1, z1)],
            [(x0, y0, z0), (x0, y0, z1), (x0, y1, z1), (x0, y1, z0)],
            [(x0, y1, z1), (x1, y1, z1), (x1, y1, z0), (x0, y1, z0)],
        ]
        if bottom:
            sides.append([(x0, y0, z0), (x1, y0, z0), (x1, y0, z1), (x0, y0, z1)])
        for side in sides:
            self.polygon(material, [place(p) for p in side])


def write_bytes(path, data):
    """Replaces the file only when it differs, so that builds see no change where there is none."""
    if path.exists() and path.read_bytes() == data:
        return
    temporary = path.with_name(path.name + ".tmp")
    temporary.write_bytes(data)
    temporary.replace(path)


def write_text(path, text):
    write_bytes(path, text.encode())
