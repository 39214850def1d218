#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Links and images of the pages exist, every page can be reached, and sources name pages that exist."""
import os
import pathlib
import re
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["MTSTEREO_SOURCE"])
DOCS = SOURCE / "docs"
PAGES = [SOURCE / "README.md", SOURCE / "CONTRIBUTING.md", SOURCE / "CHANGELOG.md", *sorted(DOCS.rglob("*.md"))]
README_LINES = 120

LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")
MENTION = re.compile(r"(?<![\w/.])docs/[\w/.-]*\w\.(?:md|py|sh)\b")
CODE = (".build", ".c", ".cpp", ".hpp", ".py", ".sh", ".txt")


def without_code(text):
    """The text without code blocks and inline code."""
    return re.sub(r"^```.*?^```$|`[^`\n]*`", "", text, flags=re.MULTILINE | re.DOTALL)


def anchors(page):
    """The anchors of the headings of a page, as on the web."""
    text = re.sub(r"^```.*?^```$", "", page.read_text(), flags=re.MULTILINE | re.DOTALL)
    titles = re.findall(r"^#+ (.*)$", text, re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


def targets(page):
    """The files and anchors that a page links to; links to the web are left out."""
    for target in LINK.findall(without_code(page.read_text())):
        if not re.match(r"[a-z]+:", target):
            path, _, anchor = target.partition("#")
            yield target, (page.parent / path).resolve() if path else page, anchor


def broken_links(page):
    for target, file, anchor in targets(page):
        if not file.exists():
            yield f"{target}: there is no such file"
        elif anchor and file.suffix == ".md" and anchor not in anchors(file):
            yield f"{target}: there is no such heading"


class Links(unittest.TestCase):
    def test_lead_to_files_and_headings_that_exist(self):
        for page in PAGES:
            with self.subTest(page.relative_to(SOURCE)):
                self.assertEqual(list(broken_links(page)), [])

    def test_every_page_and_image_is_reached_from_the_readme(self):
        reached, waiting = set(), [SOURCE / "README.md"]
        while waiting:
            page = waiting.pop()
            if page in reached:
                continue
            reached.add(page)
            if page.suffix == ".md" and page.exists():
                waiting += [file for _, file, _ in targets(page)]
        wanted = {*DOCS.rglob("*.md"), *DOCS.rglob("*.png")}
        self.assertEqual(sorted(str(file.relative_to(SOURCE)) for file in wanted - reached), [])

    def test_sources_name_pages_that_exist(self):
        folders = (SOURCE / name for name in ("core", "docs", "gst", "pipelines", "tests"))
        files = [file for folder in folders for file in folder.rglob("*") if file.suffix in CODE]
        for file in files:
            if file == pathlib.Path(__file__).resolve():
                continue
            for mention in MENTION.findall(file.read_text(errors="replace")):
                with self.subTest(file.relative_to(SOURCE)):
                    self.assertTrue((SOURCE / mention).exists(), f"{mention} does not exist")

    def test_broken_links_are_found(self):
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder) / "page.md"
            page.write_text("# A heading\n[a](#a-heading) [b](#b) ![c](c.png) `[d](d)` [e](https://e)\n```\n# F\n```\n")
            self.assertEqual(list(broken_links(page)),
                             ["#b: there is no such heading", "c.png: there is no such file"])
        self.assertEqual(MENTION.findall("see docs/a.md, and docs/b/c.py."), ["docs/a.md", "docs/b/c.py"])


class Readme(unittest.TestCase):
    def test_is_short(self):
        self.assertLessEqual(len((SOURCE / "README.md").read_text().splitlines()), README_LINES)


if __name__ == "__main__":
    unittest.main(verbosity=2)
