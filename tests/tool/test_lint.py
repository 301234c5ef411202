#!/usr/bin/env python3
"""scripts/lint: each rule refuses a file that breaks it. Runs on a copy of the script in an empty repository."""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "lint"


class Lint(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = pathlib.Path(self.folder.name)
        (self.root / "scripts").mkdir()
        shutil.copy(SCRIPT, self.root / "scripts/lint")
        shutil.copy(SCRIPT.parents[1] / ".clang-format", self.root)

    def tearDown(self):
        self.folder.cleanup()

    def lint(self, check, files):
        for name, text in files.items():
            path = self.root / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)
        return subprocess.run([sys.executable, self.root / "scripts/lint", check], capture_output=True, text=True)

    def refused(self, check, files, expected):
        result = self.lint(check, files)
        self.assertEqual(result.returncode, 1, result.stdout)
        self.assertIn(expected, result.stdout)

    def accepted(self, check, files):
        result = self.lint(check, files)
        self.assertEqual(result.returncode, 0, result.stdout)

    def test_unfinished_marks_and_disabled_code_are_refused(self):
        self.refused("words", {"a.cpp": "// " + "TO" + "DO: later\n"}, "a.cpp:1: unfinished mark")
        self.refused("words", {"a.cpp": "int x;\n#if" + " 0\n#endif\n"}, "a.cpp:2: disabled code")
        self.accepted("words", {"a.cpp": "// autodoc\n#if 01\n#endif\n"})

    def test_paths_from_outside_are_refused(self):
        self.refused("words", {"docs/a.md": "see .." + "/shared/notes.md\n"}, "docs/a.md:1")

    def test_the_simulation_may_not_depend_on_the_library_it_is_built_with(self):
        for line in ("std::mt19937 g;", "int x = std::rand();", "std::sort(a, b);", "std::unordered_map<int, int> m;"):
            self.refused("simulation", {"simulation/a.cpp": line + "\n"}, "simulation/a.cpp:1")
            self.accepted("simulation", {"simulation/a.cpp": "std::stable_sort(a, b);\n", "rendering/a.cpp": line + "\n"})

    def test_the_simulation_has_its_own_elementary_functions(self):
        for line in ("float x = std::tan(a);", "double x = std::cbrt(3.0 * a);", "auto v = glm::pow(a, b);", "std::expf (x);"):
            self.refused("simulation", {"simulation/a.cpp": line + "\n"}, "simulation/a.cpp:1: its last bits differ")
        self.accepted("simulation", {"simulation/a.cpp": "x = std::sqrt(base::naturalExp(y)) + std::floor(z);\n",
                                     "simulation/verification/b.cpp": "x = std::exp(y);\n"})

    def test_includes_follow_the_layers(self):
        self.refused("arrows", {"simulation/a.h": '#include "rendering/frame/view_types.h"\n'},
                     "simulation/ must not include rendering/")
        self.refused("arrows", {"simulation/a.h": "", "foundation/b.h": '#include "simulation/world/world.h"\n'}, "foundation/b.h:1")
        self.accepted("arrows", {"foundation/b.h": "", "fxsdk/a.h": '#include "rendering/frame/view_types.h"\n'})

    def test_only_measurements_include_measurements_and_only_tools_include_tools(self):
        self.refused("arrows", {"fxsdk/api/a.h": '#include "fxsdk/cli/support/machine.h"\n'}, "fxsdk/ must not include fxsdk/cli/")
        self.refused("arrows", {"fxsdk/api/a.h": "", "fxsdk/cli/render/a.cpp": '#include "benchmarks/bench/bench_row.h"\n'},
                     "fxsdk/cli/ must not include benchmarks/")
        self.refused("arrows", {"fxsdk/cli/render/a.cpp": "", "rendering/a.h": '#include "benchmarks/bench/bench_row.h"\n'},
                     "rendering/ must not include benchmarks/")
        self.accepted("arrows", {"rendering/a.h": "", "fxsdk/cli/render/a.cpp": '#include "fxsdk/cli/support/machine.h"\n',
                                 "benchmarks/a.cpp": '#include "fxsdk/cli/support/machine.h"\n#include "benchmarks/b.h"\n'})

    def test_only_tests_include_tests(self):
        self.refused("arrows", {"benchmarks/a.cpp": '#include "tests/simulation/stage.h"\n'}, "benchmarks/ must not include tests/")
        self.accepted("arrows", {"benchmarks/a.cpp": "", "tests/a.cpp": '#include "tests/simulation/stage.h"\n'})

    def test_includes_of_the_simulation_follow_the_modules(self):
        modules = {"simulation/low/CMakeLists.txt": "# low\nfx_module(NAME low LAYER 2 SOURCES a.cpp DEPENDS foundation)\n",
                   "simulation/low/a.h": "", "simulation/plain/c.h": "", "simulation/high/b.h": "",
                   "simulation/high/CMakeLists.txt": "fx_module(NAME high LAYER 2\n    SOURCES\n        b.cpp\n    DEPENDS low)\n"}
        self.refused("arrows", modules | {"simulation/low/a.cpp": '#include "simulation/high/b.h"\n'},
                     "simulation/low/a.cpp:1: low does not depend on high")
        self.refused("arrows", modules | {"simulation/plain/c.h": '#include "simulation/low/a.h"\n'}, "simulation/plain/c.h:1")
        self.accepted("arrows", modules | {"simulation/low/a.cpp": "", "simulation/plain/c.h": "",
                                           "simulation/high/b.cpp": '#include "simulation/low/a.h"\n#include "simulation/plain/c.h"\n'})

    def test_examples_include_what_a_host_can(self):
        public = {"fxsdk/include/fxsdk/fx_view.h": "", "fxsdk/cli/main.h": ""}
        for line in ('#include "rendering/gl/gl_device.h"', "#include <foundation/time/ticks.h>", '#include "fxsdk/cli/main.h"'):
            self.refused("examples", public | {"examples/a/main.cpp": line + "\n"}, "examples/a/main.cpp:1")
        self.accepted("examples", public | {"examples/a/main.cpp": '#include "fxsdk/fx_view.h"\n#include <fxsdk/fx_view.h>\n'
                                            '#include "own.h"\n#include <GLFW/glfw3.h>\n'})

    def test_a_file_that_is_too_long_is_refused(self):
        self.refused("sizes", {"a.cpp": "\n" * 501}, "a.cpp:501")
        self.accepted("sizes", {"a.cpp": "\n" * 500})

    def test_links_must_lead_somewhere(self):
        self.refused("links", {"docs/a.md": "[b](b.md)\n"}, "docs/a.md:1: the link to b.md leads nowhere")
        self.refused("links", {"docs/b.md": "# Title\n", "docs/a.md": "[b](b.md#other)\n"}, "no heading for #other")
        self.accepted("links", {"docs/a.md": "[b](b.md#title) [c](https://example.org/x) `[d](e.md)`\n"})

    def test_code_that_clang_format_would_change_is_refused(self):
        if shutil.which("clang-format-14") is None:
            self.skipTest("clang-format-14 is not installed")
        self.refused("format", {"a.cpp": "int  x;\n"}, "a.cpp:1")
        self.accepted("format", {"a.cpp": "int x;\n"})


if __name__ == "__main__":
    unittest.main()
