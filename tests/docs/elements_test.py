#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every element of the plugin has a page, whose tables have its properties and no others, with their defaults."""
import os
import pathlib
import re
import subprocess
import unittest

DOCS = pathlib.Path(os.environ["MTSTEREO_SOURCE"]) / "docs"
PAGES = DOCS / "elements"
PROPERTY = re.compile(r"^  ([\w-]+) *: ", re.MULTILINE)
# Properties of base classes, and those of the pads of mtstereo.
INHERITED = {"name", "parent", "qos", "emit-signals", "min-upstream-latency", "start-time", "start-time-selection",
             "async", "blocksize", "enable-last-sample", "last-sample", "max-bitrate", "max-lateness",
             "processing-deadline", "render-delay", "stats", "sync", "throttle-time", "ts-offset"}
OF_PADS = {"sink_left::offset", "sink_right::offset"}


def inspect(*arguments):
    return subprocess.run(["gst-inspect-1.0", *arguments], check=True, capture_output=True, text=True).stdout


def elements():
    return re.findall(r"^mtstereo: +(\w+):", inspect(), re.MULTILINE)


def properties(element):
    """The properties that gst-inspect-1.0 lists, and its text."""
    text = inspect(element)
    return set(PROPERTY.findall(text[text.index("Element Properties:"):])), text


def table_of_properties(page):
    """{property: default} of the table whose second column is the type."""
    text = page.read_text()
    tables = re.findall(r"^\| property \| type \| default \|.*\n\| ---.*\n((?:\|.*\n)+)", text, re.MULTILINE)
    found = {}
    for row in "".join(tables).splitlines():
        names, _, default = (cell.strip() for cell in row.split("|")[1:4])
        found.update((name, default) for name in re.findall(r"`([\w:-]+)`", names))
    return found


class Elements(unittest.TestCase):
    def test_each_has_a_page_and_each_page_an_element(self):
        pages = {page.stem for page in PAGES.glob("*.md")} - {"README"}
        self.assertEqual(pages, set(elements()))
        index = (PAGES / "README.md").read_text()
        for page in pages:
            self.assertIn(f"[`{page}`]({page}.md)", index)

    def test_pages_have_the_properties_of_their_element(self):
        parameters = set(re.findall(r"^\| `([\w-]+)` \|", (DOCS / "parameters.md").read_text(), re.MULTILINE))
        for element in elements():
            with self.subTest(element):
                stated = set(table_of_properties(PAGES / f"{element}.md"))
                existing, _ = properties(element)
                if element == "mtstereo":
                    self.assertLessEqual(OF_PADS, stated)
                    stated = (stated - OF_PADS) | parameters
                self.assertEqual(existing - stated - INHERITED, set(), "the page does not have these properties")
                self.assertEqual(stated - existing, set(), "the element does not have these properties")

    def test_defaults_that_are_numbers_are_those_of_the_element(self):
        for element in elements():
            existing, text = properties(element)
            for name, default in table_of_properties(PAGES / f"{element}.md").items():
                if name not in existing or not re.fullmatch(r"[-−\d.]+", default):
                    continue
                with self.subTest(f"{element}: {name}"):
                    entry = text[re.search(rf"^  {name} *:", text, re.MULTILINE).start():]
                    actual = re.search(r"Default: +(\S+)", entry)[1]
                    self.assertEqual(float(default.replace("−", "-")), float(actual))

    def test_a_table_is_read(self):
        self.assertEqual(table_of_properties(PAGES / "mtsplit.md"), {"layout": "side-by-side", "swap": "false"})


if __name__ == "__main__":
    unittest.main(verbosity=2)
