#!/usr/bin/env python3
"""scripts/check-all: order of steps, what ends a run, and where the next one goes on. Stand-ins for the programs that it calls."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]

# Writes its name, arguments and FXSDK_SIMD to the log, and fails where the line contains the text of the file `fault`.
STAND_IN = """#!/bin/sh
line="$(basename "$0") $* [${FXSDK_SIMD:-}]"
echo "$line" >>"$LOG"
if [ -s "$FAULT" ] && echo "$line" | grep -q -- "$(cat "$FAULT")"; then exit 1; fi
"""


class CheckAll(unittest.TestCase):
    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.addCleanup(self._folder.cleanup)
        self.root = pathlib.Path(self._folder.name) / "repository"
        programs = pathlib.Path(self._folder.name) / "programs"
        (self.root / "scripts").mkdir(parents=True)
        programs.mkdir()
        shutil.copy(ROOT / "scripts/check-all", self.root / "scripts")
        self.stand_in(*(self.root / "scripts" / name for name in ("dependencies", "make_courtyard.py", "fuzz")))
        self.stand_in(programs / "cmake", programs / "ctest")
        self.log, self.fault = programs / "log", programs / "fault"
        self.environment = os.environ | {"PATH": f"{programs}:{os.environ['PATH']}", "LOG": str(self.log), "FAULT": str(self.fault)}
        self.environment.pop("FXSDK_SIMD", None)
        for folder in ("build", "build/asan", "build/clang"):
            self.write_hashes(folder, "1\n2\n")
        (self.root / ".gitignore").write_text("build\n")
        (self.root / "source.cpp").write_text("int x;\n")
        for command in (("init", "-q"), ("add", "."), ("-c", "user.name=a", "-c", "user.email=a@b", "commit", "-q", "-m", "a")):
            subprocess.run(["git", *command], cwd=self.root, check=True)

    def stand_in(self, *paths):
        for path in paths:
            path.write_text(STAND_IN)
            path.chmod(0o755)

    def write_hashes(self, folder, text):
        path = self.root / folder / "tests/api/library_hashes.txt"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def run_steps(self, *arguments, fault=""):
        """Exit code, names of the steps that ran with their results, all output, and the calls of stand-ins."""
        self.fault.write_text(fault)
        self.log.write_text("")
        done = subprocess.run(["scripts/check-all", *arguments], cwd=self.root, env=self.environment, capture_output=True, text=True)
        ran = [tuple(line.split()[:2]) for line in done.stdout.split("\n") if " min " in line]
        return done.returncode, ran, done.stdout + done.stderr, self.log.read_text().split("\n")

    def names(self):
        return [line.split()[0] for line in self.run_steps("--list")[2].strip().split("\n")]

    def test_all_steps_run_in_the_order_of_the_list(self):
        code, ran, output, _ = self.run_steps()
        self.assertEqual(code, 0, output)
        self.assertEqual(list(dict.fromkeys(ran)), [(name, "passed") for name in self.names()])
        self.assertEqual({"tsan", "asan", "clang", "fuzz"} - set(self.names()), set())

    def test_a_failure_ends_the_run_and_the_next_run_goes_on_there(self):
        code, ran, _, _ = self.run_steps(fault="--test-dir build/clang")
        self.assertEqual(code, 1)
        self.assertEqual(ran[-1], ("clang", "failed"))
        before = self.names().index("clang")
        self.assertEqual(ran[:-1], [(name, "passed") for name in self.names()[:before]])
        code, _, output, calls = self.run_steps()
        self.assertEqual(code, 0, output)
        self.assertFalse([call for call in calls if "build/tsan" in call])
        self.assertTrue([call for call in calls if "build/clang" in call])

    def test_changed_sources_and_restart_begin_with_the_first_step(self):
        self.run_steps(fault="--test-dir build/clang")
        (self.root / "source.cpp").write_text("int y;\n")
        self.assertTrue([call for call in self.run_steps()[3] if "build/tsan" in call])
        self.assertFalse([call for call in self.run_steps()[3] if "build/tsan" in call])
        self.assertTrue([call for call in self.run_steps("--restart")[3] if "build/tsan" in call])

    def test_an_error_in_the_middle_of_a_step_fails_it(self):
        for step, fault in (("tsan", "tests_unit"), ("asan", "cmake --build build/asan"), ("sets", r"\[sse4\]"), ("fuzz", "^fuzz")):
            code, ran, output, calls = self.run_steps(step, fault=fault)
            self.assertEqual((code, ran), (1, [(step, "failed")]), output)
            self.assertRegex([call for call in calls if call][-1], fault) # nothing runs after it

    def test_single_steps_run_in_the_order_given(self):
        code, ran, output, calls = self.run_steps("sets", "allocations")
        self.assertEqual((code, ran), (0, [("sets", "passed"), ("allocations", "passed")]), output)
        self.assertEqual([call[-10:].split("[")[1] for call in calls if call.startswith("ctest")], ["scalar]", "sse4]", "avx2]", "]"])
        code, ran, output, _ = self.run_steps("sets", "no-such-step")
        self.assertEqual((code, ran), (2, []))
        self.assertIn("no-such-step", output)

    def test_compilers_that_disagree_in_a_bit_are_reported(self):
        self.assertEqual(self.run_steps("hashes")[0], 0)
        for folder in ("build/asan", "build/clang"):
            self.write_hashes(folder, "1\n3\n")
            code, ran, output, _ = self.run_steps("hashes")
            self.assertEqual((code, ran), (1, [("hashes", "failed")]), output)
            self.assertIn(folder, output)
            self.write_hashes(folder, "1\n2\n")


if __name__ == "__main__":
    unittest.main()
