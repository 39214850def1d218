#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""compare.py reports regressions and rejects files that are not results."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

COMPARE = pathlib.Path(__file__).resolve().parent / "compare.py"


def repetition(name, time, unit="ms", **more):
    return {"name": name, "run_name": name, "run_type": "iteration", "real_time": time,
            "time_unit": unit, **more}


def aggregate(kind, name, time, unit="ms", **more):
    return {"name": f"{name}_{kind}", "run_name": name, "run_type": "aggregate",
            "aggregate_name": kind, "real_time": time, "time_unit": unit, **more}


class Compare(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def write(self, name, entries):
        file = self.folder / name
        file.write_text(entries if isinstance(entries, str)
                        else json.dumps({"context": {}, "benchmarks": entries}), encoding="utf-8")
        return file

    def compare(self, before, after, *options):
        files = [self.write("before.json", before), self.write("after.json", after)]
        return self.run_with(*files, *options)

    def run_with(self, *arguments):
        return subprocess.run([sys.executable, COMPARE, *map(str, arguments)], check=False,
                              capture_output=True, text=True, timeout=60)

    def test_equal_results_pass(self):
        done = self.compare([repetition("a", 5)], [repetition("a", 5)])
        self.assertEqual(0, done.returncode, done.stderr)
        self.assertRegex(done.stdout, r"(?m)^a \[ms\] +5\.000 +5\.000 +1\.000$")

    def test_slower_beyond_the_threshold_fails_and_is_named(self):
        before = [repetition("a", 10), repetition("b", 10)]
        after = [repetition("a", 12), repetition("b", 10)]
        done = self.compare(before, after)
        self.assertEqual(1, done.returncode)
        self.assertIn("a [ms]: 1.200 times as much", done.stderr)
        self.assertNotIn("b [ms]", done.stderr)
        self.assertEqual(0, self.compare(before, after, "--threshold", "1.3").returncode)

    def test_faster_passes(self):
        self.assertEqual(0, self.compare([repetition("a", 10)], [repetition("a", 1)]).returncode)

    def test_compares_medians_not_means(self):
        before = [aggregate("mean", "a", 100), aggregate("median", "a", 10)]
        after = [aggregate("mean", "a", 10), aggregate("median", "a", 20)]
        done = self.compare(before, after)
        self.assertEqual(1, done.returncode)
        self.assertRegex(done.stdout, r"10\.000 +20\.000 +2\.000")

    def test_computes_the_median_of_repetitions(self):
        before = [repetition("a", 10), repetition("a", 10), repetition("a", 90)]
        done = self.compare(before, [repetition("a", 10)])
        self.assertRegex(done.stdout, r"10\.000 +10\.000 +1\.000")

    def test_units_may_differ(self):
        done = self.compare([repetition("a", 2, "ms")], [repetition("a", 2000, "us")])
        self.assertRegex(done.stdout, r"2\.000 +2\.000 +1\.000")

    def test_more_memory_fails(self):
        done = self.compare([repetition("m", 1, peak_MiB=100.0)],
                            [repetition("m", 1, peak_MiB=150.0)])
        self.assertEqual(1, done.returncode)
        self.assertIn("m [MiB]: 1.500 times", done.stderr)

    def test_missing_benchmark_fails(self):
        both = [repetition("a", 1), repetition("b", 1)]
        done = self.compare(both, both[:1])
        self.assertEqual(1, done.returncode)
        self.assertIn("b [ms]: is missing in the second file", done.stderr)
        self.assertEqual(0, self.compare(both[:1], both).returncode)

    def test_failed_benchmark_fails(self):
        failed = {"name": "b", "run_name": "b", "run_type": "iteration", "error_occurred": True,
                  "error_message": "no disparity"}
        done = self.compare([repetition("a", 1)], [repetition("a", 1), failed])
        self.assertEqual(1, done.returncode)
        self.assertIn("after: b: no disparity", done.stderr)

    def test_results_without_common_benchmarks_are_rejected(self):
        done = self.compare([repetition("a", 1)], [repetition("b", 1)])
        self.assertEqual(2, done.returncode)
        self.assertIn("no benchmark in common", done.stderr)

    def test_files_that_are_not_results_are_rejected_by_name(self):
        good = [repetition("a", 1)]
        for broken in ("", "{", "[]", "{}", '{"benchmarks": 3}', '{"benchmarks": [{}]}',
                       '{"benchmarks": [7]}'):
            with self.subTest(broken):
                done = self.compare(good, broken)
                self.assertEqual(2, done.returncode)
                self.assertIn("after.json: is not a result", done.stderr)
                self.assertNotIn("Traceback", done.stderr)

    def test_bytes_that_are_not_text_are_rejected(self):
        good = self.write("good.json", [repetition("a", 1)])
        binary = self.folder / "binary.json"
        binary.write_bytes(b"\xff\xfe\x00")
        self.assertEqual(2, self.run_with(good, binary).returncode)

    def test_a_missing_file_is_named(self):
        done = self.run_with(self.folder / "none.json", self.folder / "none.json")
        self.assertEqual(2, done.returncode)
        self.assertIn("none.json: cannot be read", done.stderr)

    def test_thresholds_that_are_not_ratios_are_rejected(self):
        for wrong in ("0", "-1", "inf", "nan", "much"):
            with self.subTest(wrong):
                done = self.compare([repetition("a", 1)], [repetition("a", 1)],
                                    f"--threshold={wrong}")
                self.assertEqual(2, done.returncode)


if __name__ == "__main__":
    unittest.main()
