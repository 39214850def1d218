# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hooks of mkdocs: the site has the layout of the source tree, so that links need no change, and the order of
docs/README.md. Adds what the API reference and a search without a server need."""
import logging
import pathlib
import re
import shutil
import subprocess

from mkdocs.structure.files import File, Files
from mkdocs.structure.nav import Link

ROOT = pathlib.Path(__file__).resolve().parents[2]
INDEX = "docs/README.md"
OTHER_PAGES = ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "tests/README.md")
# What pages link to besides pages and images; a link to another file is an error.
LINKED_FILES = ("COPYING", "pipelines/demo.sh", "tests/abi/libmtstereo.abi")
DOXYGEN = shutil.which("doxygen")
log = logging.getLogger("mkdocs.site")


def anchor(title, separator):
    """The anchor of a heading, as code hosts make it."""
    return re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", separator)


def first_links(text):
    """The pages that the first cells of the tables of an index name."""
    return re.findall(r"^\| \[[^\]]*\]\(([^)#]+)\)", text, re.MULTILINE)


def pages_of(index):
    """The pages that an index lists, as paths in the tree; a page that lists others itself becomes a section."""
    folder = (ROOT / index).parent
    for link in first_links((ROOT / index).read_text()):
        page = str((folder / link).resolve().relative_to(ROOT))
        title = re.match(r"# ([^:\n]*)", (ROOT / page).read_text()).group(1)
        listed = list(pages_of(page)) if page.endswith("/README.md") else []
        yield {title: [{"Overview": page}, *listed]} if listed else page


def navigation():
    """First page, a section for each heading of the index, and the index."""
    sections = re.split(r"^## ", (ROOT / INDEX).read_text(), flags=re.MULTILINE)[1:]
    pages = pages_of(INDEX)
    return [{"Overview": "README.md"}, *({section.partition("\n")[0]: [next(pages) for _ in first_links(section)]}
                                         for section in sections), INDEX]


def on_config(config):
    config["nav"] = navigation()
    config["mdx_configs"]["toc"]["slugify"] = anchor
    version = re.search(r"^  version: '(.*)'", (ROOT / "meson.build").read_text(), re.MULTILINE).group(1)
    config["extra"]["mtstereo_version"] = version
    config["copyright"] = f"mtstereo {version}, LGPL-2.1-or-later"
    return config


def on_files(files, config):
    """Pages and images at their paths in the tree, and the files of the theme."""
    docs = ROOT / "docs"
    of_docs = [pathlib.Path(file.src_uri) for file in files if (docs / file.src_uri).is_file()]
    of_theme = [file for file in files if not (docs / file.src_uri).is_file()]
    shown = [f"docs/{path}" for path in of_docs if path.suffix in (".md", ".png")]
    return Files([*of_theme, *(File(path, str(ROOT), config["site_dir"], config["use_directory_urls"])
                               for path in (*OTHER_PAGES, *LINKED_FILES, *shown))])


def on_nav(nav, config, files):
    if DOXYGEN:
        nav.items.append(Link("API reference", "api/index.html"))


def on_post_build(config):
    site = pathlib.Path(config["site_dir"])
    # A page that was opened as a file may not read other files, but may run scripts.
    index = (site / "search/search_index.json").read_text()
    (site / "search/search_index.js").write_text(f"__search.found({index});\n")
    if DOXYGEN:
        write_api_reference(site, config["extra"]["mtstereo_version"])
    else:
        log.info("doxygen is missing: the site has no API reference")


def write_api_reference(site, version):
    settings = (ROOT / "docs/api/Doxyfile.in").read_text()
    for name, value in (("version", version), ("source", str(ROOT)), ("output", str(site))):
        settings = settings.replace(f"@{name}@", value)
    done = subprocess.run([DOXYGEN, "-"], input=settings + "HTML_OUTPUT = api\n", text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode:
        log.warning("doxygen ended with %d: %s", done.returncode, done.stdout)
