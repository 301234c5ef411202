#!/usr/bin/env python3
"""The page for authors of particle effects: its tables are those of the schema, and fx accepts every snippet."""
import json
import pathlib
import re
import subprocess
import sys
import unittest

from fx_program import ROOT, FxTest, fx

PAGE = ROOT / "docs/howto/particles.md"
SNIPPET = re.compile(r"^```json\n(.*?)^```$", re.S | re.M)


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


if __name__ == "__main__":
    unittest.main()
