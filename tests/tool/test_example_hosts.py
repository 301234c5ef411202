#!/usr/bin/env python3
"""The example hosts: effects are seen in each, and neither its picture nor its GL state changes elsewhere.

HOSTS names the folder of the programs, HOSTS_BUILT those that this build has, with blanks between.
"""
import ctypes
import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

from png_pixels import Pixels

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAMS = pathlib.Path(os.environ.get("HOSTS", ROOT / "build/bin"))
BUILT = os.environ.get("HOSTS_BUILT", "deferred ldr").split()
WIDTH, HEIGHT, FRAMES = 160, 90, 80
FIRE = (46, 44, 60, 62)       # left, top, right, bottom of the campfire
EXPLOSION = (80, 10, 125, 50)
SKY = (2, 2, 40, 20)          # without effects
# States that the cache of host_sdl2 sets again when it needs them.
CACHED = re.compile(r"GL_CURRENT_PROGRAM|GL_VERTEX_ARRAY_BINDING|GL_DRAW_FRAMEBUFFER_BINDING|GL_DEPTH_(TEST|WRITEMASK|FUNC)|GL_CULL_FACE"
                    r"|GL_BLEND\[\d+\]|GL_TEXTURE_BINDING_2D\[[0-3]\]|GL_VIEWPORT\[0\]\.\d")

spec = importlib.util.spec_from_file_location("host_table", ROOT / "scripts/host_table.py")
host_table = importlib.util.module_from_spec(spec)
spec.loader.exec_module(host_table)


def brightest(picture, rectangle):
    """The pixel with the most red."""
    rows = Pixels(picture, rectangle).rows
    return max((tuple(row[i:i + 3]) for row in rows for i in range(0, len(row), 3)), key=sum)


def mean_difference(first, second):
    """Of two pictures, in steps of 8 bits."""
    pairs = [(a, b) for x, y in zip(Pixels(first).rows, Pixels(second).rows) for a, b in zip(x, y)]
    return sum(abs(a - b) for a, b in pairs) / len(pairs)


class ClientMessage(ctypes.Structure):
    """XClientMessageEvent, as large as any XEvent."""
    _fields_ = [("type", ctypes.c_int), ("serial", ctypes.c_ulong), ("send_event", ctypes.c_int), ("display", ctypes.c_void_p),
                ("window", ctypes.c_ulong), ("message_type", ctypes.c_ulong), ("format", ctypes.c_int), ("data", ctypes.c_long * 5),
                ("rest", ctypes.c_long * 24)]


def run_until_closed(command):
    """Runs a program, and asks its window to close as a window manager does. @return its exit code"""
    x, pointer = ctypes.CDLL("libX11.so.6"), ctypes.c_void_p
    x.XOpenDisplay.restype = pointer
    x.XDefaultRootWindow.restype = x.XInternAtom.restype = ctypes.c_ulong
    display = pointer(x.XOpenDisplay(None))
    ignore = ctypes.CFUNCTYPE(ctypes.c_int, pointer, pointer)(lambda *_: 0)
    x.XSetErrorHandler(ignore)  # a window may be gone when its message is sent
    protocols, deletion = (x.XInternAtom(display, name, 0) for name in (b"WM_PROTOCOLS", b"WM_DELETE_WINDOW"))
    x.XSync(display, 0)  # OGRE knows only atoms that exist before it starts
    program = subprocess.Popen(command)
    unused, children, count = ctypes.c_ulong(), ctypes.POINTER(ctypes.c_ulong)(), ctypes.c_uint()
    end = time.monotonic() + 60
    while program.poll() is None and time.monotonic() < end:
        time.sleep(0.5)
        x.XQueryTree(display, ctypes.c_ulong(x.XDefaultRootWindow(display)), ctypes.byref(unused), ctypes.byref(unused),
                     ctypes.byref(children), ctypes.byref(count))
        for window in children[:count.value]:
            message = ClientMessage(type=33, window=window, message_type=protocols, format=32, data=(deletion,))
            x.XSendEvent(display, ctypes.c_ulong(window), 0, ctypes.c_long(0), ctypes.byref(message))
        x.XSync(display, 0)
    if program.poll() is None:
        program.kill()
    return program.wait()


class ExampleHosts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.rows = {}

    def row_of(self, host):
        """What a host prints; each runs once. Skips the test when it cannot run."""
        command, reason = host_table.command_of(PROGRAMS / f"host_{host}")
        if host not in BUILT or not command:
            self.skipTest(f"{host} {reason or 'is not built: its library is missing'}")
        if host not in self.rows:
            picture = self.folder / f"{host}.png"
            self.rows[host] = host_table.run(PROGRAMS / f"host_{host}", picture, f"{WIDTH}x{HEIGHT}", FRAMES)
        return self.rows[host]

    def check(self, host):
        row = self.row_of(host)
        self.assertEqual(row["host"], host)
        self.assertGreater(row["pixels_covered"], 1000)
        self.assertGreater(row["pixels_visible"], 200)
        self.assertEqual(row["pixels_visible_changed"], row["pixels_visible"])
        self.assertEqual(row["pixels_outside_changed"], 0)
        self.assertFalse(row["later_frame_changed"])
        self.assertLessEqual(row["media_error"], host_table.LARGEST_MEDIA_ERROR[row["samples"]])
        self.assertLessEqual(row["display_error"], host_table.LARGEST_DISPLAY_ERROR)
        self.assertGreaterEqual(row["gl_state_values"], 90)
        self.assertEqual(row["gl_state_differences"], 0)
        self.assertGreater(row["gl_calls"], row["state_calls"])
        self.assertGreater(row["state_calls"], row["state_queries"])
        self.assertGreater(row["state_queries"], 0)
        self.assertTrue(host_table.is_right(row))
        for place in (FIRE, EXPLOSION):
            red, green, blue = brightest(self.folder / f"{host}.png", place)
            self.assertGreater(red, 200, (host, place))
            self.assertGreater(red, blue + 20, (host, place))
        self.assertLess(max(brightest(self.folder / f"{host}.png", SKY)), 120)

    def test_glfw_in_c(self):
        self.check("glfw_c")

    def test_sdl2(self):
        self.check("sdl2")

    def test_ogre(self):
        self.check("ogre")

    def test_deferred(self):
        self.check("deferred")

    def test_ldr(self):
        self.check("ldr")

    def test_all_hosts_show_the_same_picture(self):
        self.row_of("ldr")
        for host in host_table.HOSTS:
            with self.subTest(host):
                self.row_of(host)
                self.assertLess(mean_difference(self.folder / "ldr.png", self.folder / f"{host}.png"), 1.0)

    def test_a_host_that_restores_its_state_draws_the_same_picture(self):
        self.row_of("sdl2")
        own = self.folder / "own.png"
        row = host_table.run(PROGRAMS / "host_sdl2", own, f"{WIDTH}x{HEIGHT}", FRAMES, "--host-restores")
        self.assertEqual(Pixels(own), Pixels(self.folder / "sdl2.png"))
        self.assertGreater(row["gl_state_differences"], 0)  # so the comparison of states can see one
        self.assertFalse(row["later_frame_changed"])
        self.assertLess(row["gl_calls"], self.rows["sdl2"]["gl_calls"])

    def test_a_host_that_restores_its_state_leaves_only_what_its_cache_sets(self):
        self.row_of("sdl2")
        done = subprocess.run([PROGRAMS / "host_sdl2", "--headless", self.folder / "restored.png", "--frames", "40", "--size", "64x36",
                               "--host-restores"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        names = re.findall(r"^GL state (\S+): ", done.stderr, re.MULTILINE)
        self.assertIn("GL_CURRENT_PROGRAM", names)
        self.assertEqual([name for name in names if not CACHED.fullmatch(name)], [])

    def test_windows_show_as_many_frames_as_they_are_told_to(self):
        if not shutil.which("xvfb-run"):
            self.skipTest("xvfb-run is missing (Debian: xvfb, xauth)")
        for host in BUILT:
            with self.subTest(host):
                done = subprocess.run(["xvfb-run", "-a", PROGRAMS / f"host_{host}", "--frames", "3", "--size", "64x36"],
                                      capture_output=True, text=True)
                if "built without GLFW" in done.stderr:
                    self.skipTest(done.stderr.strip())
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual(done.stdout, "")  # nothing is measured

    def test_windows_can_be_closed(self):
        if not shutil.which("xvfb-run"):
            self.skipTest("xvfb-run is missing (Debian: xvfb, xauth)")
        for host in BUILT:
            with self.subTest(host):
                done = subprocess.run(["xvfb-run", "-a", sys.executable, __file__, "--close", PROGRAMS / f"host_{host}", "--size", "32x18"],
                                      capture_output=True, text=True)
                if "built without GLFW" in done.stderr:
                    self.skipTest(done.stderr.strip())
                self.assertEqual(done.returncode, 0, done.stderr)

    def test_the_page_has_the_table_and_its_commands_work(self):
        page = (ROOT / "docs/howto/example-hosts.md").read_text()
        for host in host_table.HOSTS:
            with self.subTest(host):
                row = self.row_of(host)
                states = f"0 of {row['gl_state_values']}"
                self.assertIn(f"| `{host}` | {row['target_format']} | {row['depth']} | {row['samples']} | right | 0 | {states} |", page)
        (self.folder / "build").mkdir()
        (self.folder / "build/bin").symlink_to(PROGRAMS.resolve())
        (self.folder / "scripts").symlink_to(ROOT / "scripts")
        commands = re.findall(r"^```sh\n(.*?)^```", page, re.MULTILINE | re.DOTALL)
        self.assertEqual(len(commands), 2)
        for command in commands:
            done = subprocess.run(["bash", "-c", command], cwd=self.folder, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("ldr", done.stdout)

    def test_arguments_and_files_that_are_wrong_are_refused(self):
        for arguments in (["--frames", "0"], ["--size", "8x8"], ["--size", "64x64x"], ["--headless"], ["--nothing"]):
            done = subprocess.run([PROGRAMS / "host_ldr", *arguments], capture_output=True, text=True)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertIn("usage: ", done.stderr)
        done = subprocess.run([PROGRAMS / "host_ldr", "--headless", "/nowhere/a.png", "--frames", "1", "--size", "32x32"],
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertIn("cannot write /nowhere/a.png", done.stderr)
        done = subprocess.run([ROOT / "scripts/host_table.py", "--programs", "/nowhere"], capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertIn("ldr is left out: it is not built", done.stderr)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--close"]:
        sys.exit(run_until_closed(sys.argv[2:]))
    unittest.main()
