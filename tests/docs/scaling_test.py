#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The tables of docs/appendix/scaling.md are those of its model, and the model is plausible."""
import os
import pathlib
import re
import subprocess
import sys
import types
import unittest

SOURCE = pathlib.Path(os.environ["MTSTEREO_SOURCE"])
MODEL = SOURCE / "docs/figures/scaling.py"
NUMBERS = dict(hours=10, rate=30, pair=0.1, start=1, length=3000, bytes_in=50, bytes_out=100,
               storage=1e6, index=1e6, plan_jobs=1, merge=1e6, merge_jobs=1, recordings=1, prepare=2)


def load_model():
    module = types.ModuleType("scaling")
    exec(compile(MODEL.read_text(), MODEL, "exec"), module.__dict__)  # without a cache beside it
    return module


def parts(processors, **changes):
    inputs = types.SimpleNamespace(**{**NUMBERS, **changes})
    return load_model().hours(processors, 3, inputs)


class Scaling(unittest.TestCase):
    def test_the_page_has_the_tables_of_the_model(self):
        page = (SOURCE / "docs/appendix/scaling.md").read_text()
        found = re.search(r"<!-- scaling begin -->\n(.*)<!-- scaling end -->", page, re.DOTALL)
        printed = subprocess.run([sys.executable, MODEL], capture_output=True, text=True, check=True)
        self.assertEqual(found[1], printed.stdout)

    def test_fast_storage_makes_tasks_proportional_to_processors(self):
        _, one, _ = parts(1)
        _, four, _ = parts(4)
        self.assertAlmostEqual(one, 360 * (1 + 3000 * 0.1) / 3600)
        self.assertAlmostEqual(one / four, 4)

    def test_more_processors_than_tasks_do_not_help(self):
        self.assertEqual(parts(360), parts(1000))
        self.assertGreater(parts(359)[1], parts(360)[1])

    def test_the_plan_prepares_each_recording(self):
        plan, _, _ = parts(1, recordings=900, storage=1e12, index=1e12)
        self.assertAlmostEqual(plan, 900 * 2 / 3600)
        self.assertAlmostEqual(parts(1, recordings=900, plan_jobs=2, storage=1e12, index=1e12)[0],
                               plan / 2)

    def test_slow_storage_limits_tasks_and_merge(self):
        bytes_of_all = 10 * 3600 * 30 * (50 + 100)  # [KB]
        _, tasks, merge = parts(100, storage=1, start=0, length=300)
        self.assertAlmostEqual(tasks, bytes_of_all / 1000 / 3600)
        self.assertAlmostEqual(merge, 3 * 10 * 3600 * 30 * 100 / 1000 / 3600)


if __name__ == "__main__":
    unittest.main(verbosity=2)
