#!/usr/bin/env python3
"""fx validate: whatever the file, a helpful message, exit code 1, little memory and little time."""
import json
import os
import re
import unittest

from fx_program import LIBRARY, FxTest, fx

CPU_SECONDS = 10 # the system kills what needs more
MIB = 1 << 20 # [byte]
SANITIZER = 1000 * MIB if "ASAN_OPTIONS" in os.environ else 0 # [byte] of its own, freed blocks that it keeps included
MEMORY = 200 * MIB + SANITIZER # [byte]
GOOD = (LIBRARY / "explosion.fx.json").read_bytes()


def emitters(member):
    return '{"version": 1, "name": "x",\n "emitters": [{' + member + "}]}\n"


def broken_presets():
    """Name and bytes of files that must all be refused."""
    for tenth in range(1, 10):
        yield f"cut{tenth}", GOOD[: len(GOOD) * tenth // 10]
    yield "empty", b""
    yield "blank", b" \n\n"
    yield "no-object", b"[]"
    yield "wrong-type", emitters('"lifetime": "long"')
    yield "unknown-member", emitters('"lifetme": 1')
    yield "out-of-range", emitters('"capacity": -5')
    yield "no-version", '{"name": "x"}'
    yield "future-version", '{"version": 999, "name": "x"}'
    yield "version-text", '{"version": "one", "name": "x"}'
    yield "nan", '{"version": 1, "name": "x",\n "duration": NaN}'
    yield "infinity", '{"version": 1, "name": "x", "duration": Infinity}'
    yield "too-large-number", '{"version": 1, "name": "x", "duration": 1e999}'
    yield "comma", '{"version": 1,, "name": "x"}'
    yield "trailing", GOOD + b"}"
    yield "duplicate-key", '{"version": 1, "name": "x", "name": "y"}'
    yield "latin-1", b'{"version": 1, "name": "caf\xe9"}'
    yield "zero-byte", b'{"version": 1, "name": "a\x00b"}'
    yield "depth-bomb", b"[" * 1_000_000
    yield "object-bomb", b'{"a":' * 500_000
    yield "node-bomb", b'{"version": 1, "name": "x", "wind": [' + b"0," * 1_500_000 + b"0]}"
    yield "long-text", b'{"version": 1, "name": "' + b"x" * 3_000_000 + b'"}'


class FxValidate(FxTest):
    def check_refused(self, path, expected=""):
        outcome = fx("validate", path, cpu_seconds=CPU_SECONDS)
        self.assertEqual(outcome.code, 1, (path.name, outcome.out, outcome.err))
        self.assertIn(path.name, outcome.out + outcome.err)
        self.assertIn(expected, outcome.out)
        self.assertLess(outcome.peak, MEMORY, path.name)
        self.assertLess(len(outcome.out), 100_000, path.name)
        return outcome.out

    def test_every_broken_preset_is_refused_with_its_place(self):
        count = 0
        for name, content in broken_presets():
            with self.subTest(name):
                text = self.check_refused(self.write(f"{name}.fx.json", content))
                self.assertRegex(text, re.escape(name) + r"\.fx\.json(:\d+:\d+)?: ")
                count += 1
        self.assertGreaterEqual(count, 30)

    def test_the_message_names_line_and_pointer(self):
        text = self.check_refused(self.write("a.fx.json", emitters('"capacity": -5')), "/emitters/0/capacity")
        self.assertRegex(text, r"a\.fx\.json:2:\d+: ")

    def test_a_misspelt_member_is_told_the_nearest_name(self):
        self.check_refused(self.write("a.fx.json", emitters('"lifetme": 1')), "lifetime")

    def test_a_file_of_100_megabytes_is_refused_before_it_is_read(self):
        for name in ("huge.fx.json", "huge.scene.json"):
            path = self.folder / name
            with open(path, "wb") as file:
                file.truncate(100 * MIB)
            self.check_refused(path)
            self.assertLess(fx("validate", path).peak, 90 * MIB + SANITIZER)

    def test_what_is_no_file_is_refused(self):
        self.check_refused(self.folder / "missing.fx.json")
        (self.folder / "folder.fx.json").mkdir()
        self.check_refused(self.folder / "folder.fx.json")

    def test_the_library_is_valid(self):
        outcome = fx("validate", *sorted(LIBRARY.glob("*.fx.json")))
        self.assertEqual((outcome.code, outcome.err), (0, ""), outcome.out)

    def test_one_bad_file_among_good_ones_fails_the_command(self):
        bad = self.write("bad.fx.json", "{}")
        outcome = fx("validate", LIBRARY / "steam.fx.json", bad, LIBRARY / "sparks.fx.json")
        self.assertEqual(outcome.code, 1)
        self.assertIn("bad.fx.json", outcome.out)
        self.assertNotIn("steam", outcome.out)

    def test_json_is_one_object_a_file_with_every_finding(self):
        bad = self.write("bad.fx.json", emitters('"capacity": -5, "lifetme": 1'))
        outcome = fx("validate", "--json", LIBRARY / "steam.fx.json", bad)
        good_report, bad_report = (json.loads(line) for line in outcome.out.strip().split("\n"))
        self.assertEqual(outcome.code, 1)
        self.assertTrue(good_report["valid"])
        self.assertFalse(bad_report["valid"])
        self.assertGreaterEqual(len(bad_report["diagnostics"]), 2)
        for finding in bad_report["diagnostics"]:
            self.assertEqual(set(finding), {"line", "column", "pointer", "message", "severity"})
        self.assertIn("machine", bad_report)


if __name__ == "__main__":
    unittest.main()
