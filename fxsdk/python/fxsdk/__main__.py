"""python3 -m fxsdk [PRESET] [--time S] [--size WxH] [-o FILE]: draws an effect into a PNG file, and says how that is written in Python."""
import argparse
import sys

import fxsdk


def size_of(text):
    width, _, height = text.partition("x")
    return int(width), int(height)


def main():
    parser = argparse.ArgumentParser(prog="python3 -m fxsdk", description="Draws an effect into a PNG file.")
    parser.add_argument("preset", nargs="?", default="explosion", help="of the library, or a *.fx.json file (default: %(default)s)")
    parser.add_argument("--time", type=float, help="[s] of the effect (default: that of its preview)")
    parser.add_argument("--size", type=size_of, default=(640, 360), help="[pixel] such as 640x360, the default")
    parser.add_argument("-o", "--output", default="effect.png", help="file (default: %(default)s)")
    options = parser.parse_args()
    try:
        fxsdk.write_png(options.output, fxsdk.render(options.preset, time=options.time, size=options.size))
    except (fxsdk.Error, OSError, RuntimeError) as error:
        sys.exit(f"python3 -m fxsdk: {error}")
    print(f"""{options.output} was drawn by
    import fxsdk
    pixels = fxsdk.render({options.preset!r}{"" if options.time is None else f", time={options.time}"}, size={options.size})
    fxsdk.write_png({options.output!r}, pixels)""")


if __name__ == "__main__":
    main()
