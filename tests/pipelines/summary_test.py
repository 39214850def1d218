#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""tests/run.sh adds up the results of several runs of 'meson test' and fails if one failed."""
import pathlib
import tempfile
import unittest

from support import SOURCE, run

RESULTS = """ 1/3 core / trees  OK  0.10s
Ok:                 {ok}
Expected Fail:      {expected}
Fail:               {fail}
Unexpected Pass:    {unexpected}
Skipped:            {skipped}
Timeout:            {timeout}

Full log written to testlog.txt
"""


def results(ok=0, expected=0, fail=0, unexpected=0, skipped=0, timeout=0):
    return RESULTS.format(ok=ok, expected=expected, fail=fail, unexpected=unexpected,
                          skipped=skipped, timeout=timeout)


class Summary(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory(prefix="mtstereo-")
        self.folder = pathlib.Path(self.temporary.name)
        self.addCleanup(self.temporary.cleanup)

    def summarize(self, *texts):
        names = []
        for i, text in enumerate(texts):
            names.append(self.folder / f"{i}.txt")
            names[-1].write_text(text)
        return run([SOURCE / "tests/run.sh", "--summarize", *names], self.folder)

    def assert_says(self, done, line, status):
        self.assertEqual(done.output.splitlines()[-1], line, str(done))
        self.assertEqual(done.status, status, str(done))

    def test_runs_are_added(self):
        done = self.summarize(results(ok=12, skipped=1), results(ok=30, expected=2))
        self.assert_says(done, "44 passed, 0 failed, 1 skipped", 0)

    def test_every_kind_of_failure_counts(self):
        done = self.summarize(results(ok=5, fail=1, unexpected=2, timeout=4))
        self.assert_says(done, "5 passed, 7 failed, 0 skipped", 1)

    def test_output_without_results_is_a_failure(self):
        self.assert_says(self.summarize("ninja: error\n"), "0 passed, 1 failed, 0 skipped", 1)

    def test_wrong_usage_is_reported(self):
        for words, says in ((["--summarize"], "needs a file"),
                            (["--summarize", "/nowhere/log"], "/nowhere/log"),
                            (["--slow"], "--slow")):
            done = run([SOURCE / "tests/run.sh", *words], self.folder)
            self.assertEqual(done.status, 2, str(done))
            self.assertIn(says, done.errors, str(done))


if __name__ == "__main__":
    unittest.main(verbosity=2)
