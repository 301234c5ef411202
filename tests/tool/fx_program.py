"""Runs the fx program for the tests beside this file, under limits of memory and processor time."""
import os
import pathlib
import resource
import signal
import subprocess
import tempfile
import time
import unittest

FX = os.environ.get("FX_PROGRAM", "build/bin/fx")
ROOT = pathlib.Path(__file__).resolve().parents[2]
LIBRARY = ROOT / "fxsdk/presets/library"
LONG = os.environ.get("FXSDK_LONG_TESTS") == "1" # whether tests that have a longer form take it
PATIENCE = 250 # [s] until a program that was told to end counts as hanging; no result depends on it


class Outcome:
    def __init__(self, code, out, err, peak):
        self.code, self.out, self.err, self.peak = code, out, err, peak # peak resident memory [byte]


def fx(*arguments, cpu_seconds=None, stdout=None, env=None, cwd=None):
    """Runs fx to its end. Beyond `cpu_seconds` of processor time the system kills it, which is a negative code."""

    def limit():
        if cpu_seconds:
            resource.setrlimit(resource.RLIMIT_CPU, (cpu_seconds, cpu_seconds))

    with tempfile.TemporaryFile("w+b") as out, tempfile.TemporaryFile("w+b") as err:
        process = subprocess.Popen([FX, *map(str, arguments)], stdout=stdout or out, stderr=err, preexec_fn=limit,
                                   env=env, cwd=cwd)
        _, state, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(state)
        out.seek(0)
        err.seek(0)
        return Outcome(process.returncode, out.read().decode(errors="replace"), err.read().decode(errors="replace"),
                       usage.ru_maxrss * 1024)


def wait_until_it_heeds_interrupts(process):
    """Until the process has installed its handler of SIGINT, however long it takes to start, or has ended."""
    status = pathlib.Path(f"/proc/{process.pid}/status")
    while process.poll() is None:
        caught = [line.split()[1] for line in status.read_text().splitlines() if line.startswith("SigCgt:")]
        if caught and int(caught[0], 16) >> (signal.SIGINT - 1) & 1:
            return
        time.sleep(0.01)


class FxTest(unittest.TestCase):
    """A test with a folder of its own."""

    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self._folder.name)

    def tearDown(self):
        self._folder.cleanup()

    def names(self):
        return sorted(path.name for path in self.folder.iterdir())

    def write(self, name, content):
        path = self.folder / name
        path.write_bytes(content.encode() if isinstance(content, str) else content)
        return path
