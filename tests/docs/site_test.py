#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Feature: pages as a site, with a search without a network
"""The site of docs/site/ is complete, can be read without a server and loads nothing from other hosts."""
import html.parser
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import urllib.parse

SOURCE = pathlib.Path(os.environ["MTSTEREO_SOURCE"])
PAGES = [*SOURCE.glob("*.md"), *SOURCE.glob("docs/**/*.md")]
MKDOCS = shutil.which("mkdocs")
LOADED = {"src", "srcset", "data", "poster"}
INLINE = re.compile(r"(?:data|javascript):")
LEFT_OVER = re.compile(r"^(?:[-*|] |\d+\. |```|#+ ).*", re.MULTILINE)


class Page(html.parser.HTMLParser):
    """What a page loads, where it links to, its anchors, its navigation, and Markdown that was left as text."""

    def __init__(self, text):
        super().__init__()
        self.loaded, self.links, self.anchors, self.entries, self.left_over = [], [], set(), [], []
        self.in_paragraph = False
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.loaded += [given[name] for name in LOADED & given.keys() if tag != "object" or name == "data"]
        if tag == "link" and given.get("rel") != "canonical":
            self.loaded.append(given["href"])
        if tag == "a" and given.get("href"):
            self.links.append(given["href"])
            if "md-nav__link" in given.get("class", ""):
                self.entries.append(given["href"])
        self.anchors |= {given[name] for name in ("id", "name") if given.get(name)}
        self.in_paragraph |= tag == "p"

    def handle_endtag(self, tag):
        self.in_paragraph &= tag != "p"

    def handle_data(self, data):
        if self.in_paragraph:
            self.left_over += LEFT_OVER.findall(data)


def target(file, link):
    """The file and the anchor that a link leads to; None for another host."""
    parts = urllib.parse.urlsplit(link)
    if parts.scheme or parts.netloc:
        return None
    path = urllib.parse.unquote(parts.path)
    return (file.parent / path).resolve() if path else file, urllib.parse.unquote(parts.fragment)


def problems(site, file, pages):
    page = pages[file]
    for link in page.loaded:
        found = target(file, link)
        if not found and not INLINE.match(link):
            yield f"loads {link} from another host"
        elif found and not (found[0].is_file() and found[0].is_relative_to(site)):
            yield f"{link} is missing"
    for found, link in ((target(file, link), link) for link in page.links):
        if found and not found[0].is_file():
            yield f"links to {link}, which is missing"
        elif found and found[1] and found[0] in pages and found[1] not in pages[found[0]].anchors:
            yield f"links to {link}: there is no such anchor"
    yield from (f"is not formatted: {text}" for text in page.left_over)


def build(source, site):
    return subprocess.run([MKDOCS, "build", "--strict", "-f", source / "docs/site/mkdocs.yml", "-d", site],
                          text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)


def read_pages(site):
    # 404.html is for servers, which state where the site begins.
    return {file: Page(file.read_text()) for file in sorted(site.rglob("*.html"))
            if file != site / "404.html" and not file.is_relative_to(site / "api")}


def place(page):
    """Where a page of the source tree is in the site."""
    path = page.relative_to(SOURCE)
    return path.with_name("index.html" if path.name == "README.md" else path.stem + ".html")


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory(prefix="mtstereo-")
        cls.addClassCleanup(temporary.cleanup)
        cls.site = pathlib.Path(temporary.name).resolve() / "site"
        done = build(SOURCE, cls.site)
        if done.returncode:
            raise RuntimeError(f"mkdocs ended with {done.returncode}: {done.stdout}")
        cls.pages = read_pages(cls.site)

    def test_pages_are_formatted_and_what_they_name_is_in_the_site(self):
        self.assertGreaterEqual(len(self.pages), len(PAGES))
        for file in self.pages:
            with self.subTest(file.relative_to(self.site)):
                self.assertEqual(list(problems(self.site, file, self.pages)), [])

    def test_style_sheets_load_nothing_from_other_hosts(self):
        for file in self.site.rglob("*.css"):
            with self.subTest(file.name):
                self.assertEqual(re.findall(r"(?:url\(|@import )[\"']?(?:https?:)?//[^)\"']*", file.read_text()), [])

    def test_every_page_is_in_the_navigation(self):
        first = self.pages[self.site / "index.html"]
        self.assertEqual(sorted({str(place(page)) for page in PAGES} - set(first.entries)), [])
        self.assertEqual(first.entries[0], "index.html")

    def test_every_page_is_found_by_the_search_with_and_without_a_server(self):
        text = (self.site / "search/search_index.json").read_text()
        found = {entry["location"] for entry in json.loads(text)["docs"]}
        self.assertEqual(sorted({str(place(page)) for page in PAGES} - found), [])
        self.assertEqual((self.site / "search/search_index.js").read_text(), f"__search.found({text});\n")

    def test_the_api_reference_is_there_if_doxygen_is(self):
        linked = "api/index.html" in self.pages[self.site / "index.html"].entries
        self.assertEqual(linked, shutil.which("doxygen") is not None)
        if linked:
            self.assertTrue((self.site / "api/classmtstereo_1_1Matcher.html").is_file())
            for file in (self.site / "api").rglob("*.html"):
                loaded = [link for link in Page(file.read_text()).loaded if not INLINE.match(link)]
                self.assertEqual([link for link in loaded if not target(file, link)], [], file)


class Strictness(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="mtstereo-")
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name).resolve()

    def test_a_dead_link_fails_the_build(self):
        shutil.copytree(SOURCE / "docs/site", self.folder / "docs/site")
        for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "tests/README.md", "docs/quickstart.md", "COPYING",
                     "pipelines/demo.sh", "tests/abi/libmtstereo.abi"):
            (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
            (self.folder / name).write_text("# Title\n")
        (self.folder / "docs/api").mkdir()
        (self.folder / "docs/api/Doxyfile.in").write_text("GENERATE_HTML = NO\nGENERATE_LATEX = NO\n")
        (self.folder / "meson.build").write_text("project('a',\n  version: '1.2.3',\n")
        (self.folder / "docs/README.md").write_text("# All\n## Some\n| [page](quickstart.md) | |\n")
        done = build(self.folder, self.folder / "site")
        self.assertEqual(done.returncode, 0, done.stdout)
        (self.folder / "docs/quickstart.md").write_text("# Title\n[dead](gone.md)\n")
        done = build(self.folder, self.folder / "site")
        self.assertNotEqual(done.returncode, 0)
        self.assertRegex(done.stdout, "quickstart.md' contains a link to '.*gone.md' which is not found")

    def test_wrong_pages_are_found(self):
        file = self.folder / "page.html"
        file.write_text('<link href="//cdn/a.css"><script src="https://cdn/a.js"></script><img src="no.png">'
                        '<h2 id="here"></h2><a href="#here"></a><a href="#gone"></a><a href="no.html"></a>'
                        '<a href="https://elsewhere/"></a><p>A list:\n- that is none</p>')
        self.assertEqual(sorted(problems(self.folder, file, read_pages(self.folder))), [
            "is not formatted: - that is none", "links to #gone: there is no such anchor",
            "links to no.html, which is missing", "loads //cdn/a.css from another host",
            "loads https://cdn/a.js from another host", "no.png is missing"])


if __name__ == "__main__":
    if not MKDOCS or b"material" not in subprocess.run([MKDOCS, "build", "--help"], stdout=subprocess.PIPE).stdout:
        print("skipped: mkdocs or mkdocs-material is missing (pipelines/packages.txt, mark checks)")
        sys.exit(77)
    unittest.main(verbosity=2)
