#!/usr/bin/env python3
"""host_table.py [--programs FOLDER] [--size WxH] [--frames N] [-o FOLDER] [HOST...]: the table of docs/howto/example-hosts.md.

Runs the example hosts without a window, each for N frames (default 95, in the middle of an explosion), and prints what they
measure of themselves as a table, with the machine. Pictures go to FOLDER, if it is given. Hosts that are not built are left
out, and so is `ogre` without xvfb-run and without a display; the error stream says so. Exit code 1 if a host fails, if its
picture is wrong, or if it finds pixels or GL states changed.
"""
import argparse
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
HOSTS = ("glfw_c", "sdl2", "ogre", "deferred", "ldr")
# Root mean square difference from the media over 32-bit floats with one sample. Depth of one of several samples is that of
# another surface at edges.
LARGEST_MEDIA_ERROR = {1: 0.002, 4: 0.03}
LARGEST_DISPLAY_ERROR = 1.0  # mean over the covered pixels [steps of 8 bits]; formats round to half a step


def command_of(program):
    """The words that run a host, or None and why it cannot run."""
    if not program.is_file():
        return None, "is not built"
    if program.name != "host_ogre":
        return [program], ""
    if shutil.which("xvfb-run"):
        return ["xvfb-run", "-a", program], ""
    return ([program], "") if os.environ.get("DISPLAY") else (None, "needs xvfb-run (Debian: xvfb, xauth) or a display")


def run(program, picture, size, frames, *options):
    """@return what the host prints, as a dict; throws CalledProcessError when it fails"""
    command, _ = command_of(program)
    done = subprocess.run([*command, "--headless", picture, "--frames", str(frames), "--size", size, *options],
                          capture_output=True, text=True)
    if done.returncode != 0:
        raise subprocess.CalledProcessError(done.returncode, command, done.stdout, done.stderr)
    return json.loads(done.stdout)


def is_right(row):
    """Whether effects have the right place, depth and light in the target of the host."""
    return (0 < row["pixels_visible"] == row["pixels_visible_changed"] and not row["later_frame_changed"] and
            row["media_error"] <= LARGEST_MEDIA_ERROR[row["samples"]] and row["display_error"] <= LARGEST_DISPLAY_ERROR)


def line_of(row):
    verdict = "right" if is_right(row) else "wrong"
    return (f"| `{row['host']}` | {row['target_format']} | {row['depth']} | {row['samples']} | {verdict} "
            f"| {row['pixels_outside_changed']} | {row['gl_state_differences']} of {row['gl_state_values']} | {row['gl_calls']} "
            f"| {row['state_calls']} | {row['state_cost_ratio']:.2f} |")


def machine(row):
    model = [line.split(":")[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")][:1]
    return f"{(model or ['unknown processor'])[0]}, {os.cpu_count()} processors, {row['renderer']}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--programs", type=pathlib.Path, default=ROOT / "build/bin", help="folder of the programs host_...")
    parser.add_argument("--size", default="480x270")
    parser.add_argument("--frames", type=int, default=95)
    parser.add_argument("-o", "--output", type=pathlib.Path, help="folder for pictures")
    parser.add_argument("host", nargs="*", help="of " + ", ".join(HOSTS))
    arguments = parser.parse_args()
    for host in arguments.host:
        if host not in HOSTS:
            parser.error(f"there is no host {host}; hosts are {', '.join(HOSTS)}")
    rows, is_wrong = [], False
    with tempfile.TemporaryDirectory() as temporary:
        folder = arguments.output or pathlib.Path(temporary)
        folder.mkdir(parents=True, exist_ok=True)
        for host in arguments.host or HOSTS:
            program = arguments.programs / f"host_{host}"
            command, reason = command_of(program)
            if not command:
                print(f"host_table.py: {host} is left out: it {reason}", file=sys.stderr)
                continue
            try:
                rows.append(run(program, folder / f"{host}.png", arguments.size, arguments.frames))
            except subprocess.CalledProcessError as error:
                print(f"host_table.py: {host} ended with {error.returncode}: {error.stderr}", file=sys.stderr)
                is_wrong = True
    print("| host | target | depth | samples | picture | outside | GL states | GL calls | of these for states | time |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    for row in rows:
        print(line_of(row))
        is_wrong = is_wrong or not is_right(row) or row["pixels_outside_changed"] != 0 or row["gl_state_differences"] != 0
    if rows:
        print(f"\n{arguments.size} pixels, frame {arguments.frames}. {machine(rows[0])}.")
    return 1 if is_wrong or not rows else 0


if __name__ == "__main__":
    sys.exit(main())
