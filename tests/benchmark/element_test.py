#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The benchmark of the element runs and rejects invalid options. No time is judged."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM = pathlib.Path(sys.argv.pop(1)).resolve()
SLOW = float(os.environ.get("MTSTEREO_SLOW", "1"))  # how much slower a sanitized build may be


def run(*arguments, **environment):
    known = {name: value for name, value in os.environ.items()
             if not name.startswith("BENCHMARK_")}
    return subprocess.run([PROGRAM, *map(str, arguments)], check=False, capture_output=True,
                          text=True, timeout=200 * SLOW, env={**known, **environment})


class Element(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def test_quick_run_reports_library_element_and_overhead(self):
        file = self.folder / "result.json"
        done = run("--quick", f"--benchmark_out={file}")
        self.assertEqual(0, done.returncode, done.stdout + done.stderr)
        entries = json.loads(file.read_text(encoding="utf-8"))["benchmarks"]
        for threads in (1, 2):
            single = [entry for entry in entries if entry["run_type"] == "iteration"
                      and f"/threads:{threads}/" in entry["run_name"]]
            self.assertEqual(2, len(single))
            for entry in single:
                self.assertGreater(entry["library_ms"], 0)
                self.assertAlmostEqual(
                    (entry["real_time"] / entry["library_ms"] - 1) * 100,
                    entry["overhead_percent"], places=3)
        self.assertEqual(2, done.stdout.count("\nstreet-320x240-32 "), done.stdout)

    def test_filter_selects(self):
        done = run("--quick", "--benchmark_filter=threads:2")
        self.assertEqual(0, done.returncode, done.stdout + done.stderr)
        self.assertEqual(1, done.stdout.count("\nstreet-320x240-32 "), done.stdout)

    def test_missing_plugin_is_reported_with_a_solution(self):
        done = run("--quick", GST_PLUGIN_PATH=str(self.folder),
                   GST_PLUGIN_SYSTEM_PATH_1_0=str(self.folder),
                   GST_REGISTRY=str(self.folder / "registry.bin"))
        self.assertEqual(1, done.returncode)
        self.assertIn("mtstereo", done.stderr)
        self.assertIn("GST_PLUGIN_PATH", done.stderr)

    def test_unknown_options_and_filters_without_a_match_fail(self):
        for words, arguments in (("--speed", ["--quick", "--speed"]), ("element", ["element"]),
                                 ("no benchmark was run", ["--benchmark_filter=bicycle"])):
            with self.subTest(words):
                done = run(*arguments)
                self.assertEqual(1, done.returncode)
                self.assertIn(words, done.stderr)

    def test_help_lists_both_kinds_of_options(self):
        done = run("--help")
        self.assertEqual(0, done.returncode)
        self.assertIn("--quick", done.stdout)
        self.assertIn("--benchmark_filter", done.stdout)


if __name__ == "__main__":
    unittest.main()
