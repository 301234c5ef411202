#!/usr/bin/env python3
"""fx edit in a window under Xvfb, with real events of mouse and keyboard by xdotool: the file after each step.

The lists of scripts/dependencies leave xdotool out: both tests take 70 to 200 s, for which the suite has no room. So scripts/test and CI
skip them, and CTest says "Skipped" (exit code 77). Where xdotool is installed they run: python3 tests/tool/test_fx_edit_window.py

FXSDK_LONG_TESTS=1: a session is done twice, with equal files. FX_EDIT_STEPS: edits that are undone (default 50).
FX_EDIT_SHOTS: a folder for screenshots, by ImageMagick."""
import json
import os
import re
import shutil
import subprocess
import time
import unittest

from edit_test import run_tests
from fx_program import FX, LONG, PATIENCE, FxTest, fx

STEPS = int(os.environ.get("FX_EDIT_STEPS", "50"))
SHOTS = os.environ.get("FX_EDIT_SHOTS")
SIZE = ("--width", 960, "--height", 640, "--scale", 1)
LEAST = 0.12 # [s] in which an editor on an idle machine draws several frames
PAUSE = 1.5  # [s] in which it draws a frame on a machine that is busy

# A picture that is soon drawn.
PRESET = """{"version": 1,
  "emitters": [
    {"name": "balls", "maxParticles": 40, "emission": {"rate": 20}, "lifetime": 2, "position": [0, 1, 0],
     "radius": 0.25, "speed": 0.6, "opticalDepth": 3, "opacityOverLife": {"keys": [[0, 0], [0.5, 1], [1, 0]]}, "forces": {"gravity": 0}},
    {"name": "more", "maxParticles": 40, "emission": {"rate": 10}, "lifetime": 1, "position": [1, 1, 0], "radius": 0.1,
     "speed": 0.6, "opticalDepth": 1, "forces": {"gravity": 0}}
  ],
  "preview": {"camera": {"position": [0, 1, 6], "target": [0, 1, 0]}}
}
"""
# The same with more emitters, so that one can go down four times.
MANY = json.dumps({**json.loads(PRESET), "emitters": json.loads(PRESET)["emitters"] + [
    {**json.loads(PRESET)["emitters"][1], "name": f"more {i}", "position": [i, 2, 0]} for i in range(3)]})


class Display:
    """An X server without a screen."""

    def __init__(self):
        read, write = os.pipe()
        self.server = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x800x24", "-nolisten", "tcp"],
                                       pass_fds=[write], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as answer:
            self.name = ":" + answer.readline().strip()

    def close(self):
        self.server.terminate()
        self.server.wait()


class Window:
    """fx edit with a document, as someone sees it who has a mouse and a keyboard."""

    def __init__(self, display, document, recovery, places):
        self.env = dict(os.environ, DISPLAY=display.name)
        self.places = places
        self.process = subprocess.Popen([FX, "edit", document, *map(str, SIZE), "--recovery", recovery], env=self.env,
                                        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.pace = LEAST # [s] in which the editor draws a frame, after what the last answers have taken
        end = time.monotonic() + PATIENCE
        while not (found := self.xdotool("search", "--name", " - fx edit$", check=False).split()):
            if self.process.poll() is not None or time.monotonic() > end:
                said = self.end()
                if "GLFW was missing" in said or "without a display" in said:
                    raise unittest.SkipTest("fx edit opens no window here: " + said)
                raise AssertionError("fx edit opens no window: " + said)
            time.sleep(0.1)
        self.window = found[0]
        self.xdotool("windowfocus", self.window)
        self.rest(3)

    def xdotool(self, *words, check=True):
        return subprocess.run(["xdotool", *map(str, words)], env=self.env, check=check, stdout=subprocess.PIPE,
                              stderr=subprocess.DEVNULL, text=True).stdout

    def title(self):
        return self.xdotool("getwindowname", self.window).strip()

    def edits(self):
        found = re.search(r", (\d+) edits?", self.title())
        return int(found[1]) if found else 0

    def wait(self, what, holds):
        start = time.monotonic()
        end = start + PATIENCE
        while not holds():
            if time.monotonic() > end or self.process.poll() is not None:
                raise AssertionError(f"{what}: the title is \"{self.title()}\"")
            time.sleep(0.02)
        self.pace = max(LEAST, min(2 * (time.monotonic() - start), 3), 0.7 * self.pace)

    def rest(self, frames=1):
        """Until the editor has seen the last event; events of one frame would be one for it."""
        time.sleep(frames * self.pace)

    def wait_for_edits(self, wanted):
        self.wait(f"{wanted} edits are wanted", lambda: self.edits() == wanted)

    def middle(self, name):
        left, top, right, bottom = self.places[name]
        return (left + right) // 2, (top + bottom) // 2

    def press(self, name):
        self.xdotool("mousemove", "--window", self.window, *self.middle(name))
        self.rest()
        self.xdotool("mousedown", 1)

    def click(self, name, edits=None):
        """Clicks; with `edits` until so many are done."""
        self.press(name)
        self.rest()
        self.xdotool("mouseup", 1)
        self.wait_for_edits(edits) if edits is not None else self.rest(3)

    def drag(self, name, x, y):
        """Drags with pauses at both ends: the way counts from the frame that sees the button until the one that sees it no
        more."""
        self.press(name)
        time.sleep(max(PAUSE, 3 * self.pace))
        for _ in range(4):
            self.xdotool("mousemove_relative", "--", x // 4, y // 4)
            self.rest()
        time.sleep(max(PAUSE, 3 * self.pace))
        self.xdotool("mouseup", 1)
        self.rest(3)

    def type(self, text):
        self.xdotool("type", "--delay", 100, text)
        self.rest(3)
        self.key("Return")

    def key(self, name, holds=None):
        """Holds a key until `holds` is true, so that some frame sees it. On a busy machine an editor may take a release
        and the next press for one; the key is then pressed again."""
        *held, last = name.split("+")
        for key in held:
            self.xdotool("keydown", key)
        end = time.monotonic() + PATIENCE
        while True:
            self.xdotool("keydown", last)
            again = time.monotonic() + 8
            while holds and not holds() and time.monotonic() < again:
                time.sleep(0.02)
            time.sleep(self.pace if holds else max(PAUSE, 3 * self.pace))
            self.xdotool("keyup", last)
            self.rest()
            if not holds or holds():
                break
            if time.monotonic() > end:
                raise AssertionError(f"{name} has no effect: the title is \"{self.title()}\"")
        for key in held:
            self.xdotool("keyup", key)
        self.rest()

    def save(self):
        self.key("ctrl+s", lambda: "not saved" not in self.title())

    def shot(self, name):
        if SHOTS and shutil.which("import"):
            os.makedirs(SHOTS, exist_ok=True)
            subprocess.run(["import", "-window", "root", os.path.join(SHOTS, name + ".png")], env=self.env, check=True)

    def end(self):
        """Ends the editor as a crash does. @return what it said"""
        self.process.kill()
        return self.process.communicate()[0]


class EditWindow(FxTest):
    def setUp(self):
        super().setUp()
        for program in ("Xvfb", "xdotool"):
            if not shutil.which(program):
                self.skipTest(f"{program} is missing (Debian: xvfb, xdotool)")
        self.display = Display()

    def tearDown(self):
        if hasattr(self, "display"):
            self.display.close()
        super().tearDown()

    def places(self, document, script, *options):
        """Where the same events bring the widgets; found without a window."""
        events = self.write("places.txt", script + "places\n")
        outcome = fx("edit", document, "--headless", *SIZE, "--script", events, *options)
        if "has no editor" in outcome.err:
            self.skipTest(outcome.err)
        self.assertEqual(outcome.code, 0, outcome.err)
        found = re.findall(r"^(.*) (-?\d+) (-?\d+) (-?\d+) (-?\d+)$", outcome.out, re.M)
        return {name: tuple(map(int, numbers)) for name, *numbers in found}

    def session(self, name):
        """One session. @return the file after each step"""
        folder = self.folder / name
        folder.mkdir()
        document, recovery = folder / "balls.fx.json", folder / "recovery"
        document.write_text(PRESET)
        files = {}
        spare = ("--recovery", folder / "spare")
        curve = "click select/emitters/0\nclick inspector/search\ntype opacity\nclick /emitters/0/opacityOverLife\n"
        places = self.places(document, "click select/emitters/0\n", *spare)
        places.update({k: v for k, v in self.places(document, curve, *spare).items() if k not in places or "opacity" in k})
        window = Window(self.display, document, recovery, places)
        try:
            window.shot(f"{name}-1-open")
            # A key of a curve.
            window.click("select/emitters/0")
            window.click("inspector/search")
            window.type("opacity")
            window.click("/emitters/0/opacityOverLife")
            window.drag("curve/key/1", 60, 16)
            window.wait_for_edits(1)
            window.shot(f"{name}-2-curve")
            window.save()
            files["curve"] = document.read_text()
            # A number, which the search brings into sight.
            window.click("inspector/search")
            window.key("ctrl+a")
            window.type("capacity")
            window.places.update(self.places(document, "click inspector/search\ntype capacity\n", *spare))
            window.click("/emitters/0/maxParticles")
            window.type("2*30")
            window.wait_for_edits(2)
            window.save()
            files["number"] = document.read_text()
            window.shot(f"{name}-3-number")
            # Solo and scrub change the picture, not the file.
            window.click("solo/emitters/1")
            window.drag("timeline/bar", 120, 0)
            window.shot(f"{name}-4-solo-and-scrub")
            self.assertEqual(window.edits(), 2)
            self.assertEqual(document.read_text(), files["number"])
            # Edits in a row, and all of them back.
            for i in range(STEPS):
                window.click("outliner/down" if i % 2 == 0 else "outliner/up", edits=3 + i)
            while (done := window.edits()) > 2:
                window.key("ctrl+z", lambda: window.edits() < done)
            window.save() if "not saved" in window.title() else None
            files["undone"] = document.read_text()
            # An edit that a crash interrupts.
            window.click("outliner/duplicate", edits=3)
            window.wait("a recovery file", lambda: any(recovery.rglob("*")) and time.sleep(1.5) is None)
        finally:
            window.end()
        files["killed"] = document.read_text()
        copy = folder / "copy"
        shutil.copytree(recovery, copy)
        window = Window(self.display, document, recovery, self.places(document, "", "--recovery", copy))
        try:
            window.shot(f"{name}-5-after-the-crash")
            window.click("recover", edits=1)
            window.shot(f"{name}-6-recovered")
            window.save()
        finally:
            window.end()
        files["recovered"] = document.read_text()
        return files

    def test_keys_and_clicks_faster_than_frames_are_all_seen(self):
        document, recovery = self.folder / "balls.fx.json", self.folder / "recovery"
        document.write_text(MANY)
        places = self.places(document, "click select/emitters/0\n", "--recovery", self.folder / "spare")
        window = Window(self.display, document, recovery, places)
        try:
            window.click("select/emitters/0")
            window.xdotool("mousemove", "--window", window.window, *window.middle("outliner/down"))
            window.rest(3)
            # Each click takes the element one place down.
            window.xdotool("click", "--repeat", 4, "--delay", 0, 1)
            window.wait_for_edits(4)
            # Presses that are closer than some milliseconds are one for GLFW. The edits that are left differ if one is lost.
            window.xdotool("key", "--delay", 12, "ctrl+z", "ctrl+z", "ctrl+y", "ctrl+z", "ctrl+z")
            window.wait_for_edits(1)
            window.xdotool("key", "--delay", 12, "ctrl+y", "ctrl+y")
            window.wait_for_edits(3)
            window.save()
        finally:
            window.end()
        names = [emitter["name"] for emitter in json.loads(document.read_text())["emitters"]]
        self.assertEqual(names, ["more", "more 0", "more 1", "balls", "more 2"])

    def test_a_session_of_mouse_and_keyboard_gives_the_wanted_files(self):
        files = self.session("first")
        parsed = {step: json.loads(text)["emitters"] for step, text in files.items()}
        before = json.loads(PRESET)["emitters"]
        time_of_key, value = parsed["curve"][0]["opacityOverLife"]["keys"][1]
        self.assertGreater(time_of_key, 0.55)
        self.assertLess(value, 0.95)
        self.assertEqual(parsed["curve"][0]["maxParticles"], before[0]["maxParticles"])
        self.assertEqual(parsed["number"][0]["maxParticles"], 60)
        self.assertEqual(parsed["number"][1], before[1])
        self.assertEqual(files["undone"], files["number"])
        self.assertEqual(files["killed"], files["number"])
        self.assertEqual([e["name"] for e in parsed["recovered"]], ["balls", "balls 2", "more"])
        self.assertEqual(parsed["recovered"][0], parsed["number"][0])
        if LONG:
            self.assertEqual(self.session("second"), files)


if __name__ == "__main__":
    run_tests()
