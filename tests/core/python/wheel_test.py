# SPDX-License-Identifier: LGPL-2.1-or-later
"""The options that the wheel is built with exist."""
import pathlib
import re
import unittest

SOURCE = pathlib.Path(__file__).parents[3]
BUILTIN = {"default_library", "buildtype"}


class Wheel(unittest.TestCase):
    def test_is_built_with_options_that_exist(self):
        try:
            import tomllib
        except ImportError:
            self.skipTest("this Python cannot read TOML")
        project = tomllib.loads((SOURCE / "core/python/pyproject.toml").read_text())
        options = set(re.findall(r"^option\('(\w+)'", (SOURCE / "meson_options.txt").read_text(), re.MULTILINE))
        used = {re.fullmatch(r"-D(\w+)=\w+", word)[1] for word in project["tool"]["meson-python"]["args"]["setup"]}
        self.assertLessEqual(used, options | BUILTIN)
        self.assertIn("python", used)


if __name__ == "__main__":
    unittest.main(verbosity=2)
