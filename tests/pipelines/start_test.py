#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""start_test.py MODULE PROGRAM...: programs load the libraries of image formats for the first image, not at
their start, which would take ten times as long; they end with an error if what they print cannot be written."""
import subprocess
import sys
import unittest

MODULE, *PROGRAMS = sys.argv[1:]
del sys.argv[1:]


def loaded_by(file):
    """The libraries that the dynamic linker loads with a program or library."""
    done = subprocess.run(["ldd", file], check=True, text=True, stdout=subprocess.PIPE)
    return {line.split()[0].split(".so")[0] for line in done.stdout.splitlines()}


class Start(unittest.TestCase):
    def test_programs_load_no_image_formats(self):
        self.assertTrue(PROGRAMS)
        for program in PROGRAMS:
            libraries = loaded_by(program)
            self.assertIn("libopencv_core", libraries, program)
            unwanted = libraries & {"libmtstereo-images", "libopencv_imgcodecs", "libopencv_videoio", "libgdal"}
            self.assertEqual(unwanted, set(), program)

    def test_programs_report_output_that_is_lost(self):
        for program in PROGRAMS:
            with open("/dev/full", "wb") as full:
                done = subprocess.run([program, "--help"], stdout=full, stderr=subprocess.PIPE, text=True, check=False)
            self.assertNotEqual(done.returncode, 0, program)
            self.assertIn("standard output: cannot be written", done.stderr, program)

    def test_the_module_loads_them(self):
        self.assertIn("libopencv_imgcodecs", loaded_by(MODULE))


if __name__ == "__main__":
    unittest.main(verbosity=2)
