#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Feature: Debian packages
"""lists_test.py MESON...: what debian/ says agrees with the rest of the source tree. Builds no package."""
import fnmatch
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["MTSTEREO_SOURCE"])
DEBIAN = SOURCE / "debian"
MESON = sys.argv[1:]
del sys.argv[1:]

DEPENDENCY_FIELDS = ("Build-Depends", "Build-Depends-Indep", "Depends", "Recommends")


def paragraphs(file):
    """The paragraphs of a control file, each as a dictionary of its fields."""
    for text in re.split(r"\n{2,}", file.read_text()):
        fields = re.findall(r"^([\w-]+):((?:.*\n?)(?:[ \t].*\n?)*)", text, re.MULTILINE)
        if fields:
            yield {name: value.strip() for name, value in fields}


CONTROL = list(paragraphs(DEBIAN / "control"))
PACKAGES = [fields["Package"] for fields in CONTROL if "Package" in fields]


def names_in(field):
    """The packages that a field names, without their versions and without ${variables}."""
    words = (re.split(r"[\s(<|:]", part.strip())[0] for part in field.split(","))
    return {word for word in words if word and not word.startswith("$")}


def version():
    return re.search(r"^  version: '([^']*)'", (SOURCE / "meson.build").read_text(), re.MULTILINE).group(1)


def installed_files():
    """What the build of the packages installs, relative to /."""
    options = re.search(r"dh_auto_configure -- (.*)", (DEBIAN / "rules").read_text()).group(1).split()
    with tempfile.TemporaryDirectory(prefix="mtstereo-") as folder:
        setup = [*MESON, "setup", folder, SOURCE, "--prefix", "/usr", "--libexecdir", "libexec", *options]
        done = subprocess.run(setup, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        if done.returncode:
            raise RuntimeError(done.stdout)
        listed = subprocess.run([*MESON, "introspect", "--installed", folder], check=True, stdout=subprocess.PIPE)
    return {path.lstrip("/") for path in json.loads(listed.stdout).values()}


def patterns(package):
    """The installed files and folders that a package takes; others come from debian/."""
    file = DEBIAN / f"{package}.install"
    lines = file.read_text().splitlines() if file.exists() else []
    return [line.split()[0] for line in lines if not line.startswith("debian/")]


def takes(pattern, path):
    """A file, or what is in a folder; as with dh_install, * stands for a part of one name."""
    words, names = pattern.split("/"), path.split("/")
    return len(words) <= len(names) and all(map(fnmatch.fnmatchcase, names, words))


class Lists(unittest.TestCase):
    def test_version_is_that_of_the_build(self):
        first = (DEBIAN / "changelog").read_text().splitlines()[0]
        self.assertEqual(re.fullmatch(r"mtstereo \(([^)]*)\) \w+; urgency=\w+", first).group(1), version(),
                         "run debian/set-version.sh VERSION")

    def test_packages_of_libraries_have_the_names_of_their_sonames(self):
        soversion = version().rpartition(".")[0]
        libraries = {name for name in PACKAGES if re.fullmatch(r"libmtstereo(-geometry)?[\d.]+", name)}
        self.assertEqual(libraries, {f"libmtstereo{soversion}", f"libmtstereo-geometry{soversion}"},
                         "run debian/set-version.sh VERSION")

    def test_what_they_need_is_in_packages_txt(self):
        lines = (line.split() for line in (SOURCE / "pipelines/packages.txt").read_text().splitlines()
                 if line and not line.startswith("#"))
        listed = {name for name, *marks in lines if not marks or "debian" in marks}
        needed = set().union(*(names_in(fields.get(field, "")) for fields in CONTROL for field in DEPENDENCY_FIELDS))
        needed = {name.replace("debhelper-compat", "debhelper") for name in needed - set(PACKAGES)}
        self.assertIn("meson", needed)
        self.assertEqual(needed - listed, set())

    def test_every_installed_file_is_in_one_package(self):
        installed, taken = installed_files(), {name: patterns(name) for name in PACKAGES}
        self.assertGreater(len(installed), 30)
        for path in sorted(installed):
            takers = [name for name in PACKAGES if any(takes(pattern, path) for pattern in taken[name])]
            self.assertEqual(len(takers), 1, f"{path} is in the packages {takers} (debian/*.install)")
        for name in PACKAGES:
            for pattern in taken[name]:
                self.assertTrue(any(takes(pattern, path) for path in installed), f"{name}: nothing matches {pattern}")

    def test_every_list_belongs_to_a_package(self):
        for file in DEBIAN.glob("*.install"):
            self.assertIn(file.stem, PACKAGES, file.name)


if __name__ == "__main__":
    unittest.main(verbosity=2)
