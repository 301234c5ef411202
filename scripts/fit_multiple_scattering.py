#!/usr/bin/env python3
"""fit_multiple_scattering.py [--fx FX] [--work FOLDER] [--fit | --check]: the closed form of scattered light against the path tracer.

Clouds of 300 blobs are path traced in the light of the sun alone, and of the sky alone. The same pictures are integrated
along the rays of the eye with the sources of shaders/formulas/multiple_scattering.fx.h, whose text is read here, and exact
optical depths. Prints tables of the deviation of the mean radiance.

--fit    also fits the constants that the text marks `// fitted`, and prints them
--check  a few small pictures; exit code 1 when a mean radiance is off by more than 25 %, or a white medium between a white
         sky and a white ground is not white
--fx     the fx program, build/bin/fx by default
--work   keeps what the path tracer has computed, for the next call
"""
import argparse
import json
import math
import pathlib
import random
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests" / "tool"))
from exr_planes import read_planes  # noqa: E402

FORMULAS = ["henyey_greenstein", "multiple_scattering"]
HEADER = "x[m],y[m],z[m],radius[m],tau_area[m2],albedo,er,eg,eb,g\n"
ILLUMINANCE = 10000.0 # [lx] of the sun; of the sky, its luminance [cd/m2]
EXPOSURE = 14.0       # [EV100]
WHITE = 1.2 * 2.0 ** EXPOSURE # [cd/m2] that a picture shows as 1
DISTANCE, FOV = 6.0, 24.0     # [m], [degree] of the eye; clouds lie within 1 m of the origin
GOAL = 0.25

# Where the eye is. The sun stands at +z, the zenith is +y.
VIEWS = {"sun": {"sun's side": (0, 0, DISTANCE), "side": (DISTANCE, 0, 0), "behind": (0, 0, -DISTANCE)},
         "sky": {"front": (0, 0, DISTANCE), "above": (0, DISTANCE, 0.001), "below": (0, -DISTANCE, 0.001)}}
TOWARDS = {"sun": (0.0, 0.0, 1.0), "sky": (0.0, 1.0, 0.0)}
GRID = [(depth, albedo, g) for depth in (1, 5, 15) for albedo in (0.9, 0.99, 1) for g in (0, 0.7)]
OTHERS = [(1, 0.99, 0.7), (5, 1, 0.4), (5, 0.5, 0), (15, 0.99, 0), (15, 0.5, 0.7), (5, 0.99, 0.85), (40, 1, 0), (40, 1, 0.7)]
FEW = [(5, 0.99, 0), (15, 0.9, 0.4), (20, 0.99, 0.7)]


def blobs_in(seed, radius, axes=(1.0, 1.0, 1.0), count=300):
    """x, y, z, radius of random blobs that fill an ellipsoid with these half axes."""
    draw, blobs = random.Random(seed), []
    while len(blobs) < count:
        place = [draw.uniform(-1, 1) for _ in range(3)]
        if sum(c * c for c in place) <= 1:
            blobs.append(tuple(c * (a - radius) for c, a in zip(place, axes)) + (radius,))
    return blobs


BALL, LUMPY = blobs_in(1, 0.25), blobs_in(5, 0.13)
# light: cloud: (blobs, media, weight in the fit)
CLOUDS = {"sun": {"ball": (BALL, GRID, 1.0), "soft ball": (blobs_in(2, 0.35), OTHERS, 0.5), "lumpy ball": (LUMPY, OTHERS, 0.1),
                  "column": (blobs_in(3, 0.12, (0.4, 1, 0.4)), FEW, 0.03),
                  "disc across": (blobs_in(4, 0.15, (1, 1, 0.4)), FEW, 0.0)},
          "sky": {"ball": (BALL, GRID, 1.0), "lumpy ball": (LUMPY, FEW, 1.0)}}
CHECKED = {"ball": (BALL, [(5, 1, 0), (15, 0.9, 0.7)], 1.0)}


def depth_of(blob, origin, direction, begin, end):
    """Optical depth of a blob of cross section 1, see shaders/formulas/kernel_optical_depth.fx.h."""
    x, y, z = blob[0] - origin[0], blob[1] - origin[1], blob[2] - origin[2]
    middle = x * direction[0] + y * direction[1] + z * direction[2]
    square = blob[3] * blob[3]
    half = square - (x * x + y * y + z * z) + middle * middle
    if half <= 0:
        return 0.0
    half = math.sqrt(half)
    u, v = max(-1.0, (begin - middle) / half), min(1.0, (end - middle) / half)
    if u >= v:
        return 0.0
    bracket = v * (1 - v * v * (2 / 3 - v * v / 5)) - u * (1 - u * u * (2 / 3 - u * u / 5))
    return 105 / (32 * math.pi * square) * (half / blob[3]) ** 5 * bracket


def diameter_of(blobs):
    """Mean optical depth through the middle, over 200 directions, of blobs of cross section 1."""
    total, count = 0.0, 200
    for i in range(count):
        z, turn = 1 - (2 * i + 1) / count, i * math.pi * (3 - math.sqrt(5))
        flat = math.sqrt(1 - z * z)
        direction = (flat * math.cos(turn), flat * math.sin(turn), z)
        total += sum(depth_of(b, (0, 0, 0), direction, -math.inf, math.inf) for b in blobs)
    return total / count


def rays(eye, pixels):
    """Directions through the middles of the pixels, rows from the top, as fx renders them."""
    length = math.hypot(*eye)
    ahead = [-c / length for c in eye]
    right = (-ahead[2], 0.0, ahead[0]) # across the vertical
    scale = math.hypot(*right)
    right = [c / scale for c in right]
    up = (right[1] * ahead[2] - right[2] * ahead[1], right[2] * ahead[0] - right[0] * ahead[2],
          right[0] * ahead[1] - right[1] * ahead[0])
    reach = math.tan(math.radians(FOV / 2))
    for row in range(pixels):
        for column in range(pixels):
            across, above = (2 * (column + 0.5) / pixels - 1) * reach, (1 - 2 * (row + 0.5) / pixels) * reach
            ray = [ahead[i] + across * right[i] + above * up[i] for i in range(3)]
            scale = math.hypot(*ray)
            yield column, tuple(c / scale for c in ray)


def samples_of(blobs, eye, towards, pixels, steps):
    """Points along the rays of a picture: whether in its left half; depth from the eye and of the step; depth towards the
    light and on its whole line; cosine between the light's way and the eye. Depths are those of a cloud of diameter 1."""
    unit, samples = 1 / diameter_of(blobs), []
    for column, ray in rays(eye, pixels):
        middle = -sum(e * r for e, r in zip(eye, ray))
        half = 1.01 ** 2 - sum(e * e for e in eye) + middle * middle
        if half <= 0:
            continue
        half, before = math.sqrt(half), 0.0
        near = [b for b in blobs if depth_of(b, eye, ray, -math.inf, math.inf) > 0]
        for k in range(steps):
            begin = middle - half + 2 * half * k / steps
            depth = unit * sum(depth_of(b, eye, ray, begin, begin + 2 * half / steps) for b in near)
            if depth < 1e-9:
                continue
            point = [eye[i] + (begin + half / steps) * ray[i] for i in range(3)]
            light = unit * sum(depth_of(b, point, towards, 0, math.inf) for b in blobs)
            behind = unit * sum(depth_of(b, point, towards, -math.inf, 0) for b in blobs)
            samples.append((2 * column < pixels, before, depth, light, light + behind,
                            sum(t * r for t, r in zip(towards, ray))))
            before += depth
    return samples


class Formulas:
    """The formula texts as Python; constants that are marked as fitted are `constants`, function.name: value."""

    def __init__(self):
        self.space = {"sqrt": math.sqrt, "exp": math.exp, "abs": abs, "min": min, "max": max,
                      "clamp": lambda x, low, high: min(max(x, low), high)}
        for name in FORMULAS:
            exec(self.python((ROOT / "shaders" / "formulas" / (name + ".fx.h")).read_text()), self.space)

    def python(self, text):
        lines = []
        for name, arguments, body in re.findall(r"FX_FORMULA\((\w+)\)\s*\(([^)]*)\)\s*\{(.*?)\n\}", text, re.S):
            for constant, value in re.findall(r"FX_REAL (\w+) = FX_REAL\(([-.\de]+)\);\s*// fitted", body):
                self.space[f"{name}_{constant}"] = float(value)
                body = re.sub(rf"FX_REAL {constant} = [^;]*;", f"FX_REAL {constant} = {name}_{constant};", body)
            lines.append(f"def {name}({arguments.replace('FX_REAL ', '')}):")
            for statement in re.sub(r"\s+", " ", re.sub(r"//[^\n]*", "", body)).split(";"):
                statement = re.sub(r"FX_REAL\(([-.\de]+)\)", r"\1", statement).replace("FX_REAL ", "").strip()
                lines.append("    " + re.sub(r"= (.+?) \? (.+?) : (.+)$", r"= \2 if \1 else \3", statement))
        return "\n".join(lines)

    def constants(self, function):
        return [name for name in self.space if name.startswith(function + "_")]

    def source(self, light):
        """Source of (albedo, g, cosine, depth towards the light, depth of the line)."""
        if light == "sun":
            return self.space["fxScatteredLight"]
        sky = self.space["fxDiffuseSky"]
        return lambda albedo, g, cosine, depth, line: sky(albedo, g, cosine, depth, line - depth)


class Truth:
    """Pictures of the path tracer, kept in a folder."""

    def __init__(self, fx, folder, pixels, paths):
        self.fx, self.folder, self.pixels, self.paths = fx, pathlib.Path(folder), pixels, paths
        self.path = self.folder / f"truth-{pixels}-{paths}.json"
        self.known = json.loads(self.path.read_text()) if self.path.is_file() else {}

    def means(self, name, blobs, light, eye, case):
        """Mean radiance of the left and the right half of the picture, for a light of 1."""
        key = json.dumps([name, light, eye, case])
        if key not in self.known:
            self.known[key] = self.render(blobs, light, eye, case)
            self.path.write_text(json.dumps(self.known))
        return self.known[key]

    def render(self, blobs, light, eye, case):
        depth, albedo, g = case
        area = depth / diameter_of(blobs)
        cloud, scene, picture = (self.folder / n for n in ("cloud.blobs.csv", "light.scene.json", "picture.exr"))
        cloud.write_text(HEADER + "".join(f"{x:.9g},{y:.9g},{z:.9g},{r:.9g},{area:.9g},{albedo},0,0,0,{g}\n"
                                          for x, y, z, r in blobs))
        sun, sky = (ILLUMINANCE, 0) if light == "sun" else (0, ILLUMINANCE)
        scene.write_text(json.dumps({
            "version": 1, "name": "light", "description": "One light.", "exposureEv100": EXPOSURE, "instances": [],
            "camera": {"position": [0, 0, DISTANCE], "target": [0, 0, 0], "fovYDegrees": FOV},
            "lighting": {"sunDirection": [0, 0, 1], "sunIlluminance": [sun] * 3, "skyLuminance": [sky] * 3,
                         "groundAlbedo": 0},
            "background": {"color": [0, 0, 0], "horizon": [0, 0, 0]}}))
        view = ",".join(map(str, [*eye, 0, 0, 0, FOV]))
        subprocess.run([self.fx, "render", str(cloud), "--renderer", "path", "--lights", str(scene), "--view", view, "--size",
                        f"{self.pixels}x{self.pixels}", "--spp", str(self.paths), "-o", str(picture)],
                       check=True, stdout=subprocess.DEVNULL)
        width, height, planes = read_planes(picture)
        sums = [0.0, 0.0]
        for i, value in enumerate(planes["R"]):
            sums[2 * (i % width) >= width] += value
        return [s * WHITE / ILLUMINANCE * 2 / (width * height) for s in sums]


class Case:
    """One picture: samples, medium, and the truth of its halves."""

    def __init__(self, samples, count, light, case, truth, weight):
        self.samples, self.count, self.light, self.case, self.truth, self.weight = samples, count, light, case, truth, weight

    def model(self, formulas):
        """Mean radiance of the halves."""
        depth, albedo, g = self.case
        source, sums = formulas.source(self.light), [0.0, 0.0]
        for left, before, step, light, line, cosine in self.samples:
            sums[not left] += (math.exp(-depth * before) - math.exp(-depth * (before + step))) * source(
                albedo, g, cosine, depth * light, depth * line)
        return [2 * s / self.count for s in sums]

    def deviations(self, formulas):
        """Of the whole picture, its left and right half, relative to the truth."""
        model, truth = self.model(formulas), self.truth
        return [sum(model) / sum(truth) - 1] + [m / t - 1 for m, t in zip(model, truth)]


def cases_of(light, clouds, truth, pixels, steps):
    """Rows (cloud, medium, pictures from the views)."""
    rows = []
    for name, (blobs, media, weight) in clouds.items():
        samples = [samples_of(blobs, eye, TOWARDS[light], pixels, steps) for eye in VIEWS[light].values()]
        for medium in media:
            rows.append((name, medium, [Case(s, pixels * pixels, light, medium,
                                             truth.means(name, blobs, light, eye, medium), weight)
                                        for s, eye in zip(samples, VIEWS[light].values())]))
    return rows


def residuals(rows, formulas):
    """Their squares are the fourth power of the logarithm of model over truth, so that large deviations count most, and a
    part of its square."""
    out = []
    for _, _, cases in rows:
        for case in cases:
            if case.weight == 0.0:
                continue
            _, left, right = case.deviations(formulas)
            halves = [left, right] if case is cases[1] and case.light == "sun" else [case.deviations(formulas)[0]]
            for deviation in halves:
                r, scale = math.log(1 + deviation), math.sqrt(case.weight)
                out += [scale * 2 * r * abs(r), scale * 0.3 * r]
    return out


def solved(matrix, right):
    """Gaussian elimination with pivots."""
    n = len(right)
    rows = [list(matrix[i]) + [right[i]] for i in range(n)]
    for i in range(n):
        pivot = max(range(i, n), key=lambda k: abs(rows[k][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        for k in range(i + 1, n):
            factor = rows[k][i] / rows[i][i]
            rows[k] = [a - factor * b for a, b in zip(rows[k], rows[i])]
    for i in reversed(range(n)):
        rows[i][n] = (rows[i][n] - sum(rows[i][k] * rows[k][n] for k in range(i + 1, n))) / rows[i][i]
    return [row[n] for row in rows]


def fit(rows, formulas, names, rounds=12):
    """Levenberg and Marquardt's method, with derivatives by differences."""
    space, damping = formulas.space, 1e-2
    at = residuals(rows, formulas)
    for _ in range(rounds):
        values, columns = [space[n] for n in names], []
        for name, value in zip(names, values):
            space[name] = value * 1.001
            columns.append([(b - a) / (0.001 * value) for a, b in zip(at, residuals(rows, formulas))])
            space[name] = value
        normal = [[sum(a * b for a, b in zip(c, d)) for d in columns] for c in columns]
        slope = [-sum(a * b for a, b in zip(c, at)) for c in columns]
        for i in range(len(names)):
            normal[i][i] *= 1 + damping
        for name, value, change in zip(names, values, solved(normal, slope)):
            space[name] = min(max(value + change, 0.7 * value), 1.4 * value)
        then = residuals(rows, formulas)
        better = sum(r * r for r in then) < sum(r * r for r in at)
        print(f"  {math.sqrt(sum(r * r for r in then)):.5f}", " ".join(f"{space[n]:.4f}" for n in names), flush=True)
        if better:
            done = sum(r * r for r in at) - sum(r * r for r in then) < 1e-4 * sum(r * r for r in at)
            at, damping = then, damping / 3
            if done:
                break
        else:
            damping *= 10
            space.update(zip(names, values))


def table(light, rows, formulas):
    """Prints the deviations and returns the largest of each cloud."""
    largest = {}
    heads = list(VIEWS[light])
    more = " side, lit half | side, far half |" if light == "sun" else ""
    print(f"\nLight of the {light}: mean radiance of the path tracer, deviation of the closed form\n")
    print("| cloud | optical diameter | albedo | g | " + " | ".join(heads) + " |" + more)
    print("|---|" + "---|" * (6 + (2 if more else 0)))
    for name, (depth, albedo, g), cases in rows:
        cells = []
        for case in cases:
            deviation = case.deviations(formulas)[0]
            cells.append(f"{sum(case.truth) / 2:.3g} {100 * deviation:+.0f} %")
            largest[name] = max(largest.get(name, 0.0), abs(deviation))
        cells += [f"{100 * d:+.0f} %" for d in cases[1].deviations(formulas)[1:]] if more else []
        print(f"| {name} | {depth} | {albedo} | {g} | " + " | ".join(cells) + " |")
    print("\nlargest: " + ", ".join(f"{name} {100 * d:.0f} %" for name, d in largest.items()), flush=True)
    return largest


def furnace(formulas):
    """A white medium between a white sky and a white ground: largest distance of the source from 1."""
    sky, worst = formulas.space["fxDiffuseSky"], 0.0
    for up in (0, 0.1, 1, 10, 1000):
        for down in (0, 0.3, 3, 300):
            for g in (0, 0.5, 0.9):
                for cosine in (-1, 0, 0.6, 1):
                    both = sky(1, g, cosine, up, down) + sky(1, g, -cosine, down, up)
                    worst = max(worst, abs(both - 1))
    return worst


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--fx", default=str(ROOT / "build" / "bin" / "fx"))
    parser.add_argument("--work")
    mode = parser.add_mutually_exclusive_group()
    mode.add_argument("--fit", action="store_true")
    mode.add_argument("--check", action="store_true")
    options = parser.parse_args(arguments)
    formulas, passed = Formulas(), True
    pixels, paths, grid, steps = (24, 16, 12, 20) if options.check else (48, 64, 16, 24)
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(options.work or temporary)
        folder.mkdir(parents=True, exist_ok=True)
        truth = Truth(options.fx, folder, pixels, paths)
        for light, function in (("sun", "fxMultipleScattering"), ("sky", "fxDiffuseSky")):
            rows = cases_of(light, CHECKED if options.check else CLOUDS[light], truth, grid, steps)
            if options.fit:
                names = formulas.constants(function)
                print(f"fit of {function}: residual, " + ", ".join(n.split("_")[1] for n in names))
                fit(rows, formulas, names)
            passed = table(light, rows, formulas)["ball"] <= GOAL and passed
    white = furnace(formulas)
    print(f"white medium, sky and ground: 1 within {white:.1g}")
    return 0 if passed and white < 1e-12 else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
