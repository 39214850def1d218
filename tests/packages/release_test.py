#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Feature: files of a release
"""debian/release.sh, on repositories with files of this one: refusals, archive, site. Builds no package."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["MTSTEREO_SOURCE"])
VERSION = re.search(r"version: '(.*)',", (SOURCE / "meson.build").read_text()).group(1)
AUTHOR = ["-c", "user.name=test", "-c", "user.email=test@localhost", "-c", "commit.gpgsign=false"]
FEW_FILES = ["CHANGELOG.md", "README.md", "debian/changelog", "debian/release.sh", "meson.build",
             "tests/packages/rooms.sh"]
FAST = ["--without", "packages", "--without", "abi"]


def run(command, folder, **environment):
    return subprocess.run(list(map(str, command)), cwd=folder, text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, env={**os.environ, **environment})


def tracked_files():
    done = subprocess.run(["git", "-C", SOURCE, "ls-files", "-z"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    return [name for name in done.stdout.decode().split("\0") if (SOURCE / name).is_file()]


def make_repository(folder, names):
    """A repository with copies of some files of this one, as for a release: without changes that have no version."""
    for name in names:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(SOURCE / name, folder / name)
    changes = (folder / "CHANGELOG.md").read_text()
    (folder / "CHANGELOG.md").write_text(re.sub(r"^## \[Unreleased\]", f"## [{VERSION}]", changes, flags=re.MULTILINE))
    for command in (["init", "-q"], ["add", "-A"], [*AUTHOR, "commit", "-q", "-m", "all"]):
        done = run(["git", *command], folder)
        assert done.returncode == 0, done.stdout


class Release(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="mtstereo-")
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name).resolve()
        self.repository, self.out = self.folder / "repository", self.folder / "out"
        make_repository(self.repository, FEW_FILES)

    def release(self, *arguments, **environment):
        return run([self.repository / "debian/release.sh", *arguments], self.folder, **environment)

    def change(self, name, old, new):
        """Commits a change to a file."""
        text = (self.repository / name).read_text()
        self.assertIn(old, text)
        (self.repository / name).write_text(text.replace(old, new, 1))
        self.assertEqual(run(["git", *AUTHOR, "commit", "-qam", "changed"], self.repository).returncode, 0)

    def assert_refuses(self, message, *arguments, status=1):
        done = self.release(*arguments)
        self.assertEqual((done.returncode, done.stdout.splitlines()[0]), (status, f"release.sh: {message}"))
        self.assertFalse((self.out / "SHA256SUMS").exists())

    def test_wrong_options_are_refused(self):
        self.assert_refuses("expected the folder to make (--help)", status=2)
        self.assert_refuses("there is no option --fast (--help lists them)", "--fast", self.out, status=2)
        self.assert_refuses("expected one folder, got a and b", "a", "b", status=2)
        for words in (["--without"], ["--without", "archive"], ["--without", ""]):
            self.assert_refuses("--without needs a part: site, packages or abi", self.out, *words, status=2)

    def test_changes_that_are_not_committed_are_refused(self):
        (self.repository / "new").touch()
        self.assert_refuses("commit or remove these changes first:", self.out)
        (self.repository / "new").unlink()
        with open(self.repository / "README.md", "a") as file:
            file.write("changed\n")
        self.assert_refuses("commit or remove these changes first:", self.out)

    def test_sources_without_git_are_refused(self):
        shutil.rmtree(self.repository / ".git")
        self.assert_refuses(f"{self.repository} is not a git checkout", self.out)

    def test_versions_that_differ_are_refused(self):
        self.change("CHANGELOG.md", f"## [{VERSION}]", "## [Unreleased]")
        self.assert_refuses(f"CHANGELOG.md begins with Unreleased, but meson.build has version {VERSION}",
                            self.out)
        self.change("CHANGELOG.md", "## [Unreleased]", f"## [{VERSION}]")
        self.change("debian/changelog", f"({VERSION})", "(0.0.1)")
        self.assert_refuses(f"debian/changelog begins with 0.0.1, but meson.build has version {VERSION}: "
                            f"debian/set-version.sh {VERSION}", self.out)
        self.change("meson.build", f"version: '{VERSION}'", "version: '0.0.1'")
        self.assert_refuses(f"CHANGELOG.md begins with {VERSION}, but meson.build has version 0.0.1", self.out)

    def test_nothing_is_replaced(self):
        self.out.mkdir()
        (self.out / "mine").write_text("mine")
        for place in (self.out, self.out / "mine"):
            self.assert_refuses(f"{place} exists and is not an empty folder: name another one", place)
        self.assertEqual([(file.name, file.read_text()) for file in self.out.iterdir()], [("mine", "mine")])

    def test_the_archive_has_the_files_of_the_commit_and_is_the_same_again(self):
        sums = []
        for out in (self.out, self.folder / "again"):
            out.mkdir()  # an empty folder is taken
            done = self.release(out, *FAST, "--without", "site")
            self.assertEqual(done.returncode, 0, done.stdout)
            sums.append((out / "SHA256SUMS").read_text())
            self.assertEqual(run(["sha256sum", "--check", "--strict", "SHA256SUMS"], out).returncode, 0)
        self.assertEqual(sums[0], sums[1])
        self.assertEqual(sorted(file.name for file in self.out.iterdir()),
                         ["SHA256SUMS", f"mtstereo-{VERSION}.tar.gz"])
        with tarfile.open(self.out / f"mtstereo-{VERSION}.tar.gz") as archive:
            names = {entry.name.partition("/")[2] for entry in archive if entry.isfile()}
        self.assertEqual(names, set(FEW_FILES))

    def test_the_site_is_in_it_unless_its_tools_are_missing(self):
        self.repository = self.folder / "all"
        make_repository(self.repository, tracked_files())
        done = self.release(self.out, *FAST)
        if done.returncode == 3 and "skipped: site: " in done.stdout:
            self.skipTest(done.stdout.splitlines()[-1])
        self.assertEqual(done.returncode, 0, done.stdout)
        with tarfile.open(self.out / f"mtstereo-{VERSION}-site.tar.gz") as site:
            names = site.getnames()
        for name in ("index.html", "docs/quickstart.html", "api/index.html", "search/search_index.js"):
            self.assertIn(f"mtstereo-{VERSION}-site/{name}", names)

    def replace_builder(self, text):
        """Replaces the script that builds the packages, and what says whether it can."""
        (self.repository / "tests/packages/rooms.sh").write_text("what_is_missing() { :; }\n")
        builder = self.repository / "tests/packages/run.sh"
        builder.write_text("#!/bin/sh\n" + text)
        builder.chmod(0o755)
        run(["git", "add", "-A"], self.repository)
        self.assertEqual(run(["git", *AUTHOR, "commit", "-qm", "builder"], self.repository).returncode, 0)

    def test_the_packages_are_those_of_the_commit(self):
        self.replace_builder('echo "$1 $2"; mkdir "$3"; git -C "${0%/*}" rev-parse HEAD >"$3/a.deb"\n')
        done = self.release(self.out, "--without", "site", "--without", "abi")
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn("--twice --out\n", done.stdout)
        self.assertEqual((self.out / "a.deb").read_text(), run(["git", "rev-parse", "HEAD"], self.repository).stdout)
        self.assertIn("  a.deb\n", (self.out / "SHA256SUMS").read_text())

    def test_the_packages_of_the_release_before_are_upgraded(self):
        before = self.folder / "before"
        before.mkdir()
        for words in (["--before"], ["--before", before], ["--before", self.folder / "none"]):
            got = words[1] if len(words) > 1 else ""
            self.assert_refuses(f"--before needs a folder with packages, got '{got}'", self.out, *words, status=2)
        (before / "old.deb").touch()
        self.replace_builder('echo "$@"; mkdir "$5"; touch "$5/new.deb"\n')
        done = self.release("before/../out", "--before", "before", "--without", "site", "--without", "abi")
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn(f"--twice --before {before} --out /", done.stdout)
        self.assertTrue((self.out / "new.deb").is_file())
        self.assertFalse((self.out / "old.deb").exists())

    def test_a_part_that_fails_leaves_nothing(self):
        self.replace_builder("echo no compiler; exit 1\n")
        done = self.release(self.out, "--without", "site", "--without", "abi")
        self.assertEqual((done.returncode, done.stdout.splitlines()[-1]), (1, "no compiler"))
        self.assertFalse(self.out.exists())

    def test_parts_without_their_tools_are_named(self):
        programs = self.folder / "programs"
        programs.mkdir()
        for program in pathlib.Path("/usr/bin").iterdir():
            if program.name not in ("mkdocs", "abidiff", "mmdebstrap"):
                (programs / program.name).symlink_to(program)
        done = self.release(self.out, PATH=str(programs))
        self.assertEqual(done.returncode, 3, done.stdout)
        self.assertEqual(done.stdout.splitlines()[-3:], [
            "skipped: site: mkdocs is missing",
            "skipped: packages: mmdebstrap is missing: ./pipelines/install-packages.sh debian",
            "skipped: abi: abidiff is missing"])
        self.assertEqual(len(list(self.out.iterdir())), 2)


if __name__ == "__main__":
    if not tracked_files():
        print("skipped: the sources are not a git checkout")
        sys.exit(77)
    unittest.main(verbosity=2)
