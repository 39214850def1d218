#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tests structure.py with small trees, and the tree of the project with it.

usage: structure_test.py REPOSITORY
"""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

REPOSITORY = sys.argv.pop()
SCRIPT = Path(__file__).with_name('structure.py')


def check(repository):
    done = subprocess.run([sys.executable, SCRIPT, repository], capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


class Structure(unittest.TestCase):
    def check_tree(self, files):
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                path = Path(folder, name)
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(text, encoding='utf-8')
            return check(folder)

    def test_the_project_has_no_cycles_and_includes_no_private_headers(self):
        self.assertEqual(check(REPOSITORY), (0, '\n'))

    def test_units_in_a_cycle_are_named(self):
        status, output = self.check_tree({
            'core/a.hpp': '', 'core/a.cpp': '#include "a.hpp"\n#include "stages/b.hpp"\n',
            'core/stages/b.hpp': '  # include "c.hpp"\n', 'core/stages/c-inl.hpp': '#include "a.hpp"\n',
            'core/stages/c.hpp': '', 'core/d.hpp': '#include "a.hpp"\n'})
        self.assertEqual((status, output),
                         (1, 'These units include each other: core/a, core/stages/b, core/stages/c\n'))

    def test_private_headers_of_other_rooms_are_named(self):
        status, output = self.check_tree({
            'core/include/mtstereo/a.hpp': '', 'core/b.hpp': '', 'gst/shared/c.hpp': '',
            'gst/e.cpp': '#include "b.hpp"\n#include "mtstereo/a.hpp"\n',
            'pipelines/run/f.cpp': '#include "shared/c.hpp"\n#include "b.hpp"\n'})
        self.assertEqual((status, output),
                         (1, 'gst/e.cpp includes core/b.hpp, a private header of another room\n'
                             'pipelines/run/f.cpp includes core/b.hpp, a private header of another room\n'))

    def test_test_files_without_a_namespace_of_their_own_are_named(self):
        status, output = self.check_tree({
            'core/a.hpp': '', 'core/a.cpp': '#include "a.hpp"\n',
            'tests/core/a_test.cpp': 'namespace mtstereo::a_test {\n', 'tests/core/support/c.cpp': '',
            'tests/core/b_test.cpp': '// a_test {\nnamespace mtstereo {\nnamespace {\n'})
        self.assertEqual((status, output),
                         (1, 'tests/core/b_test.cpp has no namespace b_test: '
                             'open it as namespace mtstereo::b_test\n'))

    def test_layers_pass(self):
        self.assertEqual(self.check_tree({
            'core/a.hpp': '', 'core/a.cpp': '#include "a.hpp"\n#include "b.hpp"\n#include <vector>\n',
            'core/b.hpp': '#include "outside.hpp"\n'}), (0, '\n'))

    def test_a_folder_without_sources_is_an_error(self):
        self.assertNotEqual(0, self.check_tree({'core/a.txt': ''})[0])


if __name__ == '__main__':
    unittest.main()
