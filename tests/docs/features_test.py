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
PROOF = re.compile(r"\[`([^`]+)`\]\(([^)]+)\)")


def rows():
    """The cells of every row of the tables of docs/features.md, without the headings."""
    lines = [line for line in FEATURES.read_text().splitlines() if line.startswith("| ")]
    cells = [[cell.strip() for cell in line.strip("|").split(" | ")] for line in lines]
    return [row for row in cells if row[0] not in ("#", "---")]


def has_test(file, name):
    """Whether a file of tests defines the test Suite.Name (C++) or name (Python). Of another file its own name."""
    if name == file.name:
        return True
    text = file.read_text()
    if file.suffix == ".py":
        return re.search(rf"\bdef {re.escape(name)}\(", text) is not None
    suite, _, test = name.partition(".")
    return re.search(rf"\bTEST(_F|_P)?\(\s*{re.escape(suite)},\s*{re.escape(test)}\)", text) is not None


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
                self.assertTrue(PROOF.search(row[3]), "no test is named")

    def test_named_tests_exist(self):
        for row in rows():
            for name, target in PROOF.findall(row[3]):
                file = (FEATURES.parent / target).resolve()
                with self.subTest(f"{row[0]}: {name}"):
                    self.assertTrue(file.is_file(), f"there is no {target}")
                    self.assertTrue(has_test(file, name), f"{target} has no test {name}")

    def test_a_name_that_is_wrong_is_found(self):
        file = SOURCE / "tests/gst/pipelines/plugin_test.cpp"
        self.assertTrue(has_test(file, "Plugin.RegistersItsElements"))
        self.assertFalse(has_test(file, "Plugin.RegistersNothing"))
        self.assertTrue(has_test(pathlib.Path(__file__), "test_named_tests_exist"))
        self.assertFalse(has_test(pathlib.Path(__file__), "test_named"))


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
