#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""docs/features.md names tests that exist, and every row has one; all links of the pages lead somewhere."""
import os
import pathlib
import re
import unittest

SOURCE = pathlib.Path(os.environ["MTSTEREO_SOURCE"])
FEATURES = SOURCE / "docs/features.md"
PAGES = [SOURCE / "README.md", SOURCE / "CONTRIBUTING.md", *sorted((SOURCE / "docs").glob("*.md"))]

LINK = re.compile(r"\[([^\]]+)\]\(([^)\s]+)\)")
NAME = re.compile(r"`([^`]+)`")
PYTHON_TEST = re.compile(r"\bdef (test_\w+)\(")
CPP_TEST = re.compile(r"\bTEST(?:_F|_P)?\(\s*(\w+),\s*(\w+)\)")


def rows():
    """The cells of every row of the tables of docs/features.md, without the headings."""
    lines = [line for line in FEATURES.read_text().splitlines() if line.startswith("| ")]
    cells = [[cell.strip() for cell in line.strip("|").split(" | ")] for line in lines]
    return [row for row in cells if row[0] not in ("#", "---")]


def names_of(file, text):
    """The tests that a file defines: Suite.Name (C++) or name (Python), and the file itself."""
    if file.suffix == ".py":
        return {file.name, *PYTHON_TEST.findall(text)}
    return {file.name, *(f"{suite}.{test}" for suite, test in CPP_TEST.findall(text))}


def all_tests():
    files = [file for file in (SOURCE / "tests").rglob("*") if file.suffix in (".py", ".cpp", ".sh")]
    return set().union(*(names_of(file, file.read_text()) for file in files))


class Features(unittest.TestCase):
    def test_rows_are_complete_and_in_order(self):
        names = [row[0] for row in rows()]
        expected = [str(number) for number in range(1, 78)]
        for before, more in ("15", ["14b", "14c", "14d"]), ("32", ["31b"]):
            place = expected.index(before)
            expected[place:place] = more
        self.assertEqual(names, expected)

    def test_every_row_has_a_proof(self):
        for row in rows():
            with self.subTest(row[0]):
                self.assertEqual(len(row), 4)
                self.assertTrue(NAME.search(row[3]), "no test is named")

    def test_named_tests_exist(self):
        tests = all_tests()
        for row in rows():
            for name in NAME.findall(row[3]):
                with self.subTest(row[0]):
                    self.assertIn(name, tests)

    def test_a_name_that_is_wrong_is_found(self):
        text = "TEST_F(Plugin, RegistersItsElements) {\n  TEST(Other,\n      IsBroken) {"
        self.assertEqual(names_of(pathlib.Path("a_test.cpp"), text),
                         {"a_test.cpp", "Plugin.RegistersItsElements", "Other.IsBroken"})
        self.assertEqual(names_of(pathlib.Path("a.py"), "def test_one(self):\ndef helper():"),
                         {"a.py", "test_one"})
        self.assertIn("test_a_name_that_is_wrong_is_found", all_tests())
        self.assertNotIn("Plugin.RegistersNothing", all_tests())


def anchors(page):
    """The anchors of the headings of a page, as on the web."""
    text = re.sub(r"^```.*?^```$", "", page.read_text(), flags=re.MULTILINE | re.DOTALL)
    titles = re.findall(r"^#+ (.*)$", text, re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


class Links(unittest.TestCase):
    def test_lead_to_files_and_headings_that_exist(self):
        for page in PAGES:
            for _, target in LINK.findall(page.read_text()):
                if re.match(r"[a-z]+:", target):
                    continue
                path, _, anchor = target.partition("#")
                file = (page.parent / path).resolve() if path else page
                with self.subTest(f"{page.name}: {target}"):
                    self.assertTrue(file.exists(), "there is no such file")
                    if anchor and file.suffix == ".md":
                        self.assertIn(anchor, anchors(file))

    def test_every_page_is_linked_from_the_readme(self):
        text = (SOURCE / "README.md").read_text()
        for page in sorted((SOURCE / "docs").glob("*.md")):
            with self.subTest(page.name):
                self.assertTrue(f"docs/{page.name}" in text, "README.md has no link to it")


if __name__ == "__main__":
    unittest.main(verbosity=2)
