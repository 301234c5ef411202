#!/usr/bin/env python3
"""scripts/check_formulas.py: a whole block passes, and a block with any part broken is refused by name."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "check_formulas.py"

BLOCK = """/// @formula ball-path
/// Length of a ray inside a ball.
///
/// symbol    unit   meaning
///   r       m      radius
/// @derivation
///   s = 2 r                                     (1)
/// @source    [Abc06] eq. (4)
/// @deviation none
/// @valid     r > 0
/// @accuracy  exact
/// @tests     tests/test_ball.cpp
float path(float r)
{
    return 2.0f * r; // (1)
}
"""


class CheckFormulas(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = pathlib.Path(self.folder.name)
        for name in ("docs", "tests", "rendering"):
            (self.root / name).mkdir()
        (self.root / "docs/references.md").write_text("| [Abc06] | a book |\n")
        (self.root / "tests/test_ball.cpp").write_text("")

    def tearDown(self):
        self.folder.cleanup()

    def run_on(self, text, *options):
        (self.root / "rendering/ball.h").write_text(text)
        return subprocess.run([sys.executable, SCRIPT, *options, self.root], capture_output=True, text=True)

    def refused(self, text, expected):
        result = self.run_on(text)
        self.assertEqual(result.returncode, 1, result.stdout)
        self.assertIn(expected, result.stdout)
        self.assertIn("rendering/ball.h:", result.stdout)

    def test_a_whole_block_passes(self):
        self.assertEqual(self.run_on(BLOCK).returncode, 0)

    def test_each_missing_tag_is_named(self):
        for tag in ("derivation", "source", "deviation", "valid", "accuracy", "tests"):
            lines = [line for line in BLOCK.split("\n") if f"@{tag}" not in line]
            self.refused("\n".join(lines), f"lacks @{tag}")

    def test_an_empty_tag_counts_as_missing(self):
        self.refused(BLOCK.replace("exact", ""), "lacks @accuracy")

    def test_a_block_without_a_symbol_table_is_refused(self):
        self.refused(BLOCK.replace("symbol    unit   meaning", "some symbols"), "symbol unit meaning")

    def test_an_unknown_reference_is_refused(self):
        self.refused(BLOCK.replace("Abc06", "Xyz99"), "[Xyz99]")

    def test_a_source_without_a_key_is_refused_unless_it_is_our_own(self):
        self.refused(BLOCK.replace("[Abc06] eq. (4)", "somewhere"), "names no [KEY]")
        self.assertEqual(self.run_on(BLOCK.replace("[Abc06] eq. (4)", "own")).returncode, 0)

    def test_a_test_file_that_does_not_exist_is_refused(self):
        self.refused(BLOCK.replace("test_ball.cpp", "test_gone.cpp"), "tests/test_gone.cpp does not exist")

    def test_an_equation_number_without_a_derivation_is_refused(self):
        self.refused(BLOCK.replace("r; // (1)", "r; // (2)"), "equation (2)")

    def test_two_formulas_of_one_name_are_refused(self):
        self.refused(BLOCK + BLOCK, "has the name of the block at")

    def test_the_written_page_is_up_to_date_until_a_formula_changes(self):
        self.assertEqual(self.run_on(BLOCK, "--check").returncode, 1)
        self.assertEqual(self.run_on(BLOCK, "--write").returncode, 0)
        self.assertIn("ball-path", (self.root / "docs/formulas.md").read_text())
        self.assertEqual(self.run_on(BLOCK, "--check").returncode, 0)
        self.assertEqual(self.run_on(BLOCK.replace("exact", "1e-6"), "--check").returncode, 1)


if __name__ == "__main__":
    unittest.main()
