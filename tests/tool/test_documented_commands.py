#!/usr/bin/env python3
"""Every command of README.md, CONTRIBUTING.md, benchmarks/README.md and docs/ works, and so does every measurement of fx bench.

Each runs once, at a small size.
"""
import os
import pathlib
import re
import shlex
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import unittest

from documented_commands import alternatives, commands_in, files_in, made_small, options_in, words_of
from fx_program import FX, ROOT

DOCUMENTS = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / "benchmarks/README.md", *sorted((ROOT / "docs").rglob("*.md"))]

# What is not run here, and why.
EXCEPTIONS = {
    "./scripts/demo": "installs packages and builds",
    "./scripts/test": "installs packages, builds, and runs this test",
    "cmake -G Ninja -B build -DFXSDK_BUILD_TOOLS=OFF -DFXSDK_BUILD_EXAMPLES=OFF -DFXSDK_BUILD_TESTS=OFF": "builds; packages.Sources configures so",
    "cmake --build build": "builds",
    "cmake --install build --prefix /usr/local": "writes to the system; the tests packages.* install",
    "build/bin/host_ldr --headless ldr.png --frames 30 --size 64x36": "tool.example_hosts",
    "scripts/host_table.py --size 64x36 --frames 80 ldr": "tool.example_hosts",
    "./scripts/package": "the tests packages.*",
    "./scripts/package --archive": "packages.Archive",
    "cc -std=c99 game.c $(pkg-config --cflags --libs fxsdk) -o game": "packages.DebianPackages",
    "c++ -std=c++20 game.cpp $(pkg-config --cflags --libs fxsdk-static) -o game": "packages.DebianPackages",
    "python3 -m fxsdk explosion --time 0.6 -o explosion.png": "packages.DebianPackages",
    "cmake --preset tsan": "configures another build",
    "cmake --build build/tsan --target test_api_threads": "builds",
    "build/tsan/tests/test_api_threads": "of that build",
    "build/bin/04_live_link my-effect.fx.json --link my-game": "runs without end; tool.fx_link",
    "scripts/fit_multiple_scattering.py": "takes minutes",
    "scripts/fit_multiple_scattering.py --fit": "takes minutes",
    "scripts/fit_multiple_scattering.py --check": "tool.multiple_scattering",
}

# Of which only the options are looked at, because a program of their own runs them.
TESTED_ELSEWHERE = {
    ("fx", "edit", "FILE"): "opens a window; without one, tool.fx_edit",
    ("fx", "edit", "my-effect.fx.json"): "opens a window",
    ("fx", "edit", "library:sparks"): "opens a window",
    ("fx", "edit", "torch.fx.json"): "opens a window",
    ("fx", "link", "send"): "needs a running game; tool.fx_link",
    ("fx", "bench", "idle"): "counts instructions with valgrind; tool.idle_cost, tool.idle_cost_gl",
    ("fx", "bench", "soak"): "counts instructions with valgrind; tool.soak",
    ("fx", "accuracy", "all"): "takes minutes; each technique is run by itself",
    ("fx", "accuracy", "path"): "takes minutes; test_accuracy.py at a small size",
    ("fx", "accuracy", "fit"): "takes a minute; test_accuracy.py",
    ("fx", "accuracy", "light"): "takes minutes; test_accuracy.py at a small size",
    ("fx", "accuracy", "flights"): "takes minutes; test_accuracy.py at a small size",
    ("fx", "accuracy", "block-flights"): "takes minutes; test_accuracy.py at a small size",
    ("fx", "accuracy", "sph"): "takes half a minute; test_fx_verify.py",
}

# Of which only the options are looked at where fx was built without the library.
NEEDS_OPENVDB = (["fx", "export"], ["fx", "import"])
HAS_OPENVDB = os.environ.get("FX_HAS_OPENVDB", "1") == "1"

# What each subcommand cannot do without.
NEEDS = {"render": ("-o", "--output"), "export": ("-o", "--output"), "stability": ("-o", "--output"), "validate": ("POSITIONAL",), "verify": ("POSITIONAL",),
         "accuracy": ("POSITIONAL",), "explain": ("POSITIONAL",), "grid": ("POSITIONAL",), "dazzle": ("POSITIONAL",), "import": ("POSITIONAL",),
         "bench": ("POSITIONAL", "--plot"), "calibrate": ("-o",), "gallery": ("-o", "--output")}

# In place of the placeholders of a synopsis.
VALUES = {"FILE": "tiny.fx.json", "DIR": "out/gallery", "OUT": "out/a.png", "OUT.png": "out/b.png", "OUT.exr": "out/a.exr", "IN.exr": "in.exr",
          "CASE": "sod", "TECHNIQUE": "furnace", "OUT.vdb": "out/a.vdb", "IN.vdb": "in.vdb", "IN.%04d.vdb": "in.%04d.vdb",
          "PRESET.fx.json": "out/cloud.fx.json", "FOLDER": "out/maps", "FILE.svg": "out/a.svg", "OUT.fxgrid": "out/a.fxgrid",
          "POINTS.csv": "points.csv", "NUMBERS.raw": "numbers.raw", "library:NAME": "library:sparks",
          "NX": "2", "NY": "2", "NZ": "2"}

TINY = """{"version": 1, "emitters": [{"maxParticles": 20, "emission": {"rate": 40}, "lifetime": 1, "radius": 0.3, "speed": 1}]}"""


# Stands for a program, so that what a shell makes of a document's text is small too.
STAND_IN = """#!{python}
import os, sys
sys.path.insert(0, {folder!r})
from documented_commands import made_small
os.execv({program!r}, [{program!r}, *made_small([{name!r}, *sys.argv[1:]])[1:]])
"""


class Workplace:
    """A folder that looks like the repository after a build, in which commands write."""

    def __init__(self):
        self._folder = tempfile.TemporaryDirectory()
        self.root = pathlib.Path(self._folder.name)
        for folder in ("build/bin", "out", "docs/plots"):
            (self.root / folder).mkdir(parents=True)
        program = pathlib.Path(FX).resolve()
        stand_in = self.root / "build/bin" / program.name
        stand_in.write_text(STAND_IN.format(python=sys.executable, folder=str(pathlib.Path(__file__).parent),
                                            program=str(program), name=program.name))
        stand_in.chmod(0o755)
        shutil.copytree(ROOT / "examples/scenes", self.root / "examples/scenes")
        subprocess.run([sys.executable, ROOT / "scripts/make_courtyard.py", self.root / "examples/scenes"], check=True,
                       stdout=subprocess.DEVNULL)
        (self.root / "tiny.fx.json").write_text(TINY)
        (self.root / "torch.fx.json").write_text(TINY)
        for document in DOCUMENTS:
            for name, content in files_in(document.read_text(encoding="utf-8")):
                (self.root / name).write_text(content)
        (self.root / "points.csv").write_text("x,y,z,value\n" + "".join(
            f"{x},{y},{z},1\n" for z in (0, 1) for y in (0, 1) for x in (0, 1)))
        (self.root / "numbers.raw").write_bytes(struct.pack("<8f", *range(8)))
        self.run(["fx", "render", "tiny.fx.json", "-o", "in.exr", "--size", "16x16"])
        if HAS_OPENVDB:
            for name in ("in.vdb", "in.0001.vdb", "in.0002.vdb"):
                self.run(["fx", "export", "tiny.fx.json", "-o", name, "--voxel-size", "0.2"])

    def close(self):
        self._folder.cleanup()

    def run(self, command):
        """@param command words, or a line for the shell. @return exit code and what was said"""
        line = command if isinstance(command, str) else shlex.join(map(str, command))
        path = f"{self.root / 'build/bin'}:{os.environ['PATH']}"
        ran = subprocess.run(["bash", "-c", line], cwd=self.root, env=os.environ | {"PATH": path}, text=True,
                             capture_output=True, timeout=1500)
        return ran.returncode, ran.stdout + ran.stderr


class Checker:
    """Runs commands of documents; each line that comes out the same at a small size runs once."""

    def __init__(self, workplace):
        self.workplace = workplace
        self.done = {}
        self.helps = {}
        self.seconds = {}

    def help_of(self, words):
        """What `fx SUBCOMMAND... --help` prints for the subcommands that `words` begins with; None: there is no such."""
        names = [word for word in words[1:3] if not word.startswith("-")][: 2 if words[1:2] in (["bench"], ["link"]) else 1]
        key = tuple(names)
        if key not in self.helps:
            parent = self.help_of(["fx", *names[:-1]]) if names else ""
            is_known = not names or (parent and re.search(rf"^  {re.escape(names[-1])}\s", parent, re.M))
            code, said = self.workplace.run(["fx", *names, "--help"]) if is_known else (2, "")
            self.helps[key] = said if code == 0 else None
        return self.helps[key]

    def unknown_options(self, alternatives_, text):
        """Options in `text` that none of the command lines knows."""
        helps = [self.help_of(words) for words in alternatives_]
        if None in helps:
            return ["the subcommand itself"]
        return [option for option in options_in(text)
                if not any(re.search(rf"(?<![\w-]){re.escape(option)}(?![\w-])", said) for said in helps)]

    def run(self, words):
        """@return empty, or what went wrong"""
        small = made_small(words)
        return self.run_line(shlex.join(small), tuple(sorted(small)))

    def run_line(self, line, key=None):
        """@param key equal for lines that differ in the order of their options"""
        key = key or line
        if key not in self.done:
            begin = time.monotonic()
            code, said = self.workplace.run(line)
            self.seconds[line] = time.monotonic() - begin
            self.done[key] = "" if code == 0 else f"`{line}` ended with {code}: {said[-400:]}"
        return self.done[key]

    def faults(self, command):
        """What is wrong with one command: a list of lines."""
        if command.text.split("  #")[0].rstrip() in EXCEPTIONS:
            return []
        words = words_of(command.text)
        is_absent = words[:2] in NEEDS_OPENVDB and not HAS_OPENVDB
        if command.kind == "mention" or tuple(words[:3]) in TESTED_ELSEWHERE or is_absent:
            unknown = self.unknown_options([words], command.text)
            return [f"{command.place}: `{command.text}`: unknown: {name}" for name in unknown]
        if command.kind == "run":
            is_plain = words[0] == "fx" and not set(command.text) & set("$;&|<>\n")
            fault = self.run(words) if is_plain else self.run_line(command.text)
            return [f"{command.place}: {fault}"] if fault else []
        lines = alternatives(command.text, VALUES)
        unknown = self.unknown_options(lines, command.text)
        faults = [f"{command.place}: `{command.text}`: unknown: {name}" for name in unknown]
        return faults + [f"{command.place}: {fault}" for fault in map(self.run, lines) if fault]


class DocumentedCommands(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.workplace = Workplace()
        cls.checker = Checker(cls.workplace)

    @classmethod
    def tearDownClass(cls):
        cls.workplace.close()
        slowest = sorted(cls.checker.seconds.items(), key=lambda item: -item[1])[:8]
        print("slowest: " + "; ".join(f"{line} {seconds:.1f} s" for line, seconds in slowest), file=sys.stderr)

    def faults_of(self, text):
        return [fault for command in commands_in(text, "page.md", NEEDS) for fault in self.checker.faults(command)]

    def test_every_command_of_every_document_works(self):
        faults, count = [], 0
        for path in DOCUMENTS:
            for command in commands_in(path.read_text(), str(path.relative_to(ROOT)), NEEDS):
                faults += self.checker.faults(command)
                count += 1
        self.assertGreater(count, 100)
        self.assertEqual("\n".join(faults), "")

    def test_every_measurement_with_a_small_size_works_and_is_in_the_table(self):
        names = re.findall(r"^  ([\w-]+)\s", self.checker.help_of(["fx", "bench"]).partition("Subcommands:\n")[2], re.M)
        small = [name for name in names if "--small" in self.checker.help_of(["fx", "bench", name])]
        self.assertGreater(len(small), 5)
        for name in small:
            self.assertEqual(self.checker.run(["fx", "bench", name]), "")
        table = re.findall(r"^\| `fx bench ([\w-]+)` \|", (ROOT / "benchmarks/README.md").read_text(), re.M)
        self.assertEqual(sorted(table), sorted(small))

    def test_exceptions_are_still_needed(self):
        shown = {command.text.split("  #")[0].rstrip() for path in DOCUMENTS
                 for command in commands_in(path.read_text(), path.name, NEEDS)}
        self.assertEqual(set(EXCEPTIONS) - shown, set())

    def test_what_does_not_exist_or_fails_is_found(self):
        for text in ("```sh\nfx bench paper-frame --form=sphere\n```\n", "```sh\nno_such_program\n```\n", "    fx rendr a.fx.json\n",
                     "    fx render tiny.fx.json -o out/x.png --sise 9x9\n", "    fx validate missing.fx.json\n",
                     "text `fx verify sedo` text\n", "text `fx render --stat` text\n", "text `fx nothing` text\n",
                     "    fx render FILE -o OUT [--wrong N]\n", "    fx explain FILE\n                  [--wrong N]\n",
                     "    fx bench sort|particels [--count N]\n", "    for t in furnace furnac; do\n        fx accuracy $t\n    done\n",
                     "```sh\nfx doctor \\\n    --wrong\n```\n"):
            self.assertTrue(self.faults_of(text), text)

    def test_what_works_is_not_refused(self):
        for text in ("```sh\nfx validate tiny.fx.json  # a comment\n```\n", "    fx validate FILE... [--json]\n", "text `fx render --stats` text\n",
                     "    fx bench particles|sort [--count N]\n                   [--threads N] (particles)\n",
                     "    x = fx y\n", "```c\nfxScene_Update(scene, dt);\n```\n", "text `fx_view` text\n"):
            self.assertEqual(self.faults_of(text), [], text)


if __name__ == "__main__":
    unittest.main()
