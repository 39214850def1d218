#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""docs/features.md has the tests that are marked as the proof of its rows, and every row has one."""
import os
import pathlib
import subprocess
import sys
import types
import unittest

PROGRAM = pathlib.Path(os.environ["MTSTEREO_SOURCE"]) / "docs/figures/features.py"
PAGE = "# Features\n\n| feature | tests |\n| --- | --- |\n| gray input | `Old.Name` |\n"


def load():
    module = types.ModuleType("features")
    module.__file__ = str(PROGRAM)
    exec(compile(PROGRAM.read_text(), PROGRAM, "exec"), module.__dict__)  # without a cache beside it
    return module


def marks(*lines):
    return list(load().marks("\n".join(lines), "folder/a_test.cpp"))


class Page(unittest.TestCase):
    def test_is_that_of_the_marks(self):
        run = subprocess.run([sys.executable, PROGRAM, "--check"], capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stderr)

    def test_has_the_marked_tests_instead_of_others(self):
        self.assertEqual(load().filled(PAGE, {"gray input": ["A.B", "test_c"]}),
                         PAGE.replace("`Old.Name`", "`A.B`, `test_c`"))

    def test_keeps_the_columns_between(self):
        page = PAGE.replace("| gray input |", "| gray input | a reason |")
        self.assertIn("| gray input | a reason | `A.B` |\n", load().filled(page, {"gray input": ["A.B"]}))

    def test_may_not_have_a_row_without_a_test_or_twice(self):
        with self.assertRaisesRegex(ValueError, "gray input.*no test"):
            load().filled(PAGE, {})
        with self.assertRaisesRegex(ValueError, "gray input: listed twice"):
            load().filled(PAGE + PAGE, {"gray input": ["A.B"]})

    def test_may_not_lack_the_row_of_a_mark(self):
        with self.assertRaisesRegex(ValueError, "no row: grey input"):
            load().filled(PAGE, {"gray input": ["A.B"], "grey input": ["A.B"]})


class Marks(unittest.TestCase):
    def test_name_the_next_test(self):
        self.assertEqual(marks("// Feature: one", "// More.", "TEST_P(Suite, Name) {"), [("one", "Suite.Name")])
        self.assertEqual(marks("// Feature: one", "TEST(Suite,", "     Name) {"), [("one", "Suite.Name")])
        self.assertEqual(marks("    # Feature: one", "    def test_a(self):"), [("one", "test_a")])

    def test_may_be_several(self):
        self.assertEqual(marks("// Feature: one", "// Feature: two", "TEST(A, B) {"), [("one", "A.B"), ("two", "A.B")])

    def test_name_the_file_if_no_test_follows(self):
        self.assertEqual(marks("// Feature: one", "", '#include "a.hpp"', "TEST(A, B) {"), [("one", "folder/a_test.cpp")])


if __name__ == "__main__":
    unittest.main(verbosity=2)
