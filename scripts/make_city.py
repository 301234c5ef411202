#!/usr/bin/env python3
"""scripts/make_city.py OUT.scene.json [--instances N]: a city of effects around a camera that turns.

Twelve presets, written beside the scene as city-00.fx.json ..., are placed on a grid; from its center the camera turns once in 12
seconds. For trying out what is simulated: fx explain OUT.scene.json --time 1; fx render OUT.scene.json -o city.png --stats s.json.
"""
import argparse
import json
import math
import pathlib

PRESETS = 12
SPACING = 25.0  # meters between neighbors
EMPTY = 30.0  # meters about the camera


def preset(index):
    """A fountain; those that differ in number differ in what costs time."""
    curl = 0 if index % 3 else 1
    return {
        "version": 1,
        "name": f"city {index}",
        "ground": False,
        "bound": 6,
        "offscreen": "replay",
        "emitters": [{
            "maxParticles": 64 + 16 * index, "shape": "sphere", "size": 0.5, "emission": {"rate": 20 + 5 * index},
            "lifetime": 1 + 0.1 * index, "speed": 1, "radius": 0.2, "albedoOverLife": [0.5, 0.5, 0.5],
            "forces": {"drag": 0.5, "gravity": 0.1, "curlStrength": curl}}],
    }


def places(count):
    side = math.ceil(math.sqrt(count)) + 4
    found = []
    for row in range(side):
        for column in range(side):
            x = SPACING * (column - side // 2) + 3 * (row % 5)
            z = SPACING * (row - side // 2) + 3 * (column % 7)
            if max(abs(x), abs(z)) > EMPTY and len(found) < count:
                found.append([x, 0, z])
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--instances", type=int, default=10000)
    options = parser.parse_args()
    for index in range(PRESETS):
        (options.out.parent / f"city-{index:02}.fx.json").write_text(json.dumps(preset(index), indent=1) + "\n")
    keys = [{"time": k, "position": [0, 2, 0], "target": [100 * math.sin(k * math.tau / 12), 2, -100 * math.cos(k * math.tau / 12)]}
            for k in range(13)]
    scene = {
        "version": 1,
        "name": "city",
        "camera": {"fovYDegrees": 40, "keys": keys},
        "instances": [{"preset": f"city-{i % PRESETS:02}.fx.json", "position": place, "seed": i}
                      for i, place in enumerate(places(options.instances))],
    }
    options.out.write_text(json.dumps(scene) + "\n")
    print(f"{options.out}: {len(scene['instances'])} instances of {PRESETS} presets")


if __name__ == "__main__":
    main()
