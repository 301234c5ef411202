#!/usr/bin/env python3
"""The page for authors of particle effects: its tables are those of the schema, and fx accepts every snippet."""
import json
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

from fx_program import ROOT, FxTest, fx

PAGE = ROOT / "docs/howto/particles.md"
SNIPPET = re.compile(r"^```json\n(.*?)^```$", re.S | re.M)
CODE = re.compile(r"^```c\n(.*?)^```$", re.S | re.M)
HEAD = """#include "fxsdk/fxsdk.h"
#include <stdio.h>
"""


class ParticlesPage(FxTest):
    def test_every_member_of_the_schema_stands_in_a_table(self):
        found = subprocess.run([sys.executable, ROOT / "scripts/particle_page.py"], capture_output=True, text=True)
        self.assertEqual(found.returncode, 0, found.stderr)

    def test_every_snippet_is_valid(self):
        snippets = SNIPPET.findall(PAGE.read_text())
        self.assertGreater(len(snippets), 8)
        for number, text in enumerate(snippets):
            with self.subTest(snippet=number):
                value = json.loads(text)
                if isinstance(value, list) or "version" not in value:
                    value = {"version": 1, "emitters": value if isinstance(value, list) else [value]}
                path = pathlib.Path(self.folder) / f"snippet{number}.fx.json"
                path.write_text(json.dumps(value))
                outcome = fx("validate", path)
                self.assertEqual(outcome.code, 0, text + outcome.out + outcome.err)
                self.assertNotIn("warning", outcome.out + outcome.err, text)

    @unittest.skipUnless(shutil.which("cc"), "needs a C compiler")
    def test_every_snippet_of_c_compiles(self):
        snippets = CODE.findall(PAGE.read_text())
        self.assertGreaterEqual(len(snippets), 3)
        text = HEAD + "".join(f"void snippet{i}(FxScene* scene, FxInstanceId instance)\n{{\n{code}}}\n"
                              for i, code in enumerate(snippets))
        outcome = subprocess.run(["cc", "-std=c11", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", "-I",
                                  ROOT / "fxsdk/include", self.write("snippets.c", text)], capture_output=True, text=True)
        self.assertEqual(outcome.returncode, 0, outcome.stderr)

    def test_the_messages_of_the_page_are_those_of_the_tool(self):
        told = re.findall(r"^(?:warning: )?sparks\.fx\.json:.*$", PAGE.read_text(), re.M)
        self.assertEqual(len(told), 2)
        lines = ["{", '  "version": 1,', '  "emitters": [{', '  "name": "a",', '  "speed": 1,', '  "radius": 0.1,', "{member}",
                 '  "emission": {"rate": 1},', '  "forces": {"wind": [1, 0, 0]}', "  }]", "}", ""]
        for member, message in (('  "lifetme": 1,', told[0]), ('  "lifetime": 1,', told[1])):
            self.write("sparks.fx.json", "\n".join(lines).replace("{member}", member))
            self.assertIn(message, fx("validate", "sparks.fx.json", cwd=self.folder).out)


if __name__ == "__main__":
    unittest.main()
