#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""docs/features.md names tests that exist, and every row has one."""
import os
import pathlib
import re
import unittest

SOURCE = pathlib.Path(os.environ["MTSTEREO_SOURCE"])
FEATURES = SOURCE / "docs/features.md"
NAME = re.compile(r"`([^`]+)`")
PYTHON_TEST = re.compile(r"\bdef (test_\w+)\(")
CPP_TEST = re.compile(r"\bTEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\)")


def rows():
    """The cells of every row of the tables, without the headings."""
    lines = [line for line in FEATURES.read_text().splitlines() if line.startswith("| ")]
    cells = [[cell.strip() for cell in line.strip("|").split(" | ")] for line in lines]
    return [row for row in cells if row[0] not in ("feature", "---")]


def names_of(file, text):
    """The tests that a file defines: Suite.Name (C++) or name (Python), and the file itself."""
    if file.suffix == ".py":
        return {file.name, *PYTHON_TEST.findall(text)}
    return {file.name, *(f"{suite}.{test}" for suite, test in CPP_TEST.findall(text))}


def all_tests():
    files = [file for file in (SOURCE / "tests").rglob("*") if file.suffix in (".py", ".cpp", ".sh")]
    return set().union(*(names_of(file, file.read_text()) for file in files))


class Features(unittest.TestCase):
    def test_every_row_has_a_proof(self):
        self.assertGreater(len(rows()), 70)
        for row in rows():
            with self.subTest(row[0]):
                self.assertIn(len(row), (2, 3))
                self.assertTrue(NAME.search(row[-1]), "no test is named")

    def test_no_feature_is_listed_twice(self):
        names = [row[0] for row in rows()]
        self.assertEqual(sorted(set(names)), sorted(names))

    def test_named_tests_exist(self):
        tests = all_tests()
        for row in rows():
            for name in NAME.findall(row[-1]):
                with self.subTest(row[0]):
                    self.assertIn(name, tests)

    def test_a_name_that_is_wrong_is_found(self):
        text = "TEST_F(Plugin, RegistersItsElements) {\n  TEST(Other,\n      IsBroken) {"
        self.assertEqual(names_of(pathlib.Path("a_test.cpp"), text),
                         {"a_test.cpp", "Plugin.RegistersItsElements", "Other.IsBroken"})
        self.assertEqual(names_of(pathlib.Path("a.py"), "def test_one(self):\ndef helper():"), {"a.py", "test_one"})
        self.assertIn("test_a_name_that_is_wrong_is_found", all_tests())
        self.assertNotIn("Plugin.RegistersNothing", all_tests())


if __name__ == "__main__":
    unittest.main(verbosity=2)
