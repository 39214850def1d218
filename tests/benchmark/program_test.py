#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""All benchmarks run to the end, and invalid options are rejected.

No time is judged here.
"""
import json
import os
import pathlib
import random
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

PROGRAM = pathlib.Path(sys.argv.pop(1)).resolve()
SLOW = float(os.environ.get("MTSTEREO_SLOW", "1"))  # how much slower a sanitized build may be
COMPARE = pathlib.Path(__file__).resolve().parent / "compare.py"
METHODS = ("semi-dense", "fast", "sparse", "dense", "full", "paper", "sgbm", "sgbm-3way", "bm")
STAGES = ("preprocessing", "max-trees", "cost-volume", "node-matching",
          "node-drawing", "node-extrapolation", "census", "speckle-removal",
          "confidence", "node-outliers", "gradient-matching",
          "halving", "smoothing", "enlarging", "input-census", "refinement")


def run(*arguments, **environment):
    known = {name: value for name, value in os.environ.items()
             if not name.startswith(("BENCHMARK_", "MTSTEREO_"))}
    return subprocess.run([PROGRAM, *map(str, arguments)], check=False, capture_output=True,
                          text=True, timeout=280 * SLOW, env={**known, **environment})


@unittest.skipIf(SLOW > 1, "the tests of the parts run the same code")
class QuickRun(unittest.TestCase):
    """One run of all benchmarks, whose outputs all tests of this class check."""

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.file = pathlib.Path(folder.name) / "result.json"
        cls.done = run("--quick", f"--benchmark_out={cls.file}")
        assert cls.done.returncode == 0, cls.done.stdout + cls.done.stderr
        cls.result = json.loads(cls.file.read_text(encoding="utf-8"))

    def medians(self, part):
        return {entry["run_name"]: entry for entry in self.result["benchmarks"]
                if entry["run_name"].startswith(part) and entry.get("aggregate_name") == "median"}

    def test_has_every_method_with_one_and_two_threads(self):
        medians = self.medians("frame/street-640x480-64/")
        for method in METHODS:
            for threads in (1, 2):
                found = [entry for name, entry in medians.items()
                         if f"/{method}/threads:{threads}/" in name]
                self.assertEqual(1, len(found), f"{method} with {threads} threads")
                self.assertGreater(found[0]["density"], 0)
                self.assertLessEqual(found[0]["density"], 1)
        self.assertEqual(2 * len(METHODS), len(medians))

    def test_states_the_time_and_the_rate_of_each_repetition(self):
        found = [entry for entry in self.result["benchmarks"]
                 if entry["run_name"].startswith("frame/street-640x480-64/") and entry["run_type"] == "iteration"]
        self.assertTrue(found)
        for entry in found:
            seconds = entry["s/MP"] * 640 * 480 / 1e6
            self.assertAlmostEqual(1, seconds * entry["frames/s"], places=3)

    def test_has_every_stage_once(self):
        names = [name.split("/")[3] for name in self.medians("stage/")]
        for stage in STAGES:
            self.assertEqual(1, names.count(stage), stage)
        for entry in self.medians("stage/").values():
            self.assertGreater(entry["ns/px"], 0)

    def test_has_the_memory_or_reports_why_not(self):
        found = [entry for entry in self.result["benchmarks"]
                 if entry["run_name"].startswith("memory/")]
        if not found:
            self.assertIn("memory is not measured", self.done.stderr)
            return
        peaks = {entry["run_name"].split("/iterations")[0].split("first-frame-")[1]:
                 entry["peak_MiB"] for entry in found}
        # The census words of two views at 640x480 alone take 2.3 MiB; half a cost volume with 64
        # disparities takes 9.4 MiB, a full one 37.5 MiB.
        self.assertGreater(peaks["640x480x64"], 2)
        self.assertGreater(peaks["640x480x64/preset=paper"], 9)
        self.assertGreater(peaks["640x480x64/preset=paper/cost-volume=full"], 37)
        for settings in ("cost=gradient/cost-volume=full", "preset=fast", "mode=sparse",
                         "mode=dense", "threads=2"):
            self.assertIn(f"640x480x64/{settings}", peaks)

    def test_has_every_target_of_the_processor(self):
        names = [name.split("/")[2] for name in self.medians("target/street-640x480-64/")]
        self.assertEqual(len(names), len(set(names)))
        self.assertGreaterEqual(len(names), 1)
        rows = self.done.stdout.split("time / AVX2")[1].splitlines()[1:]
        self.assertEqual(names, [row.split()[0] for row in rows if row])

    def test_has_points_of_both_scaling_variables(self):
        pixels = self.medians("scaling/pixels/").values()
        self.assertEqual([320 * 240, 640 * 480], [entry["pixels"] for entry in pixels])
        self.assertEqual({64}, {entry["disparities"] for entry in pixels})
        disparities = self.medians("scaling/disparities/").values()
        self.assertEqual([32, 64], [entry["disparities"] for entry in disparities])
        self.assertEqual({640 * 480}, {entry["pixels"] for entry in disparities})

    def test_context_names_the_processor(self):
        self.assertTrue(self.result["context"]["processor"])

    def test_ends_with_a_comparison_table(self):
        table = self.done.stdout.split("time / bm\n")[1].split("\n\n")[0].splitlines()
        self.assertEqual(2 * len(METHODS), len(table), self.done.stdout)
        for line in table:
            self.assertNotIn("-", line.split()[-4:], line)  # speedup and the ratios

    def test_result_can_be_compared(self):
        done = subprocess.run([sys.executable, COMPARE, self.file, self.file], check=False,
                              capture_output=True, text=True, timeout=60)
        self.assertEqual(0, done.returncode, done.stderr)
        self.assertIn("frame/street-640x480-64/semi-dense/threads:1", done.stdout)


class Rejections(unittest.TestCase):
    def expect_failure(self, words, *arguments, **environment):
        done = run(*arguments, **environment)
        self.assertEqual(1, done.returncode, done.stdout + done.stderr)
        self.assertIn(words, done.stderr)

    def test_unknown_options_are_named(self):
        self.expect_failure("--speed", "--quick", "--speed")
        self.expect_failure("frame", "frame")

    def test_filter_without_a_match_fails(self):
        self.expect_failure("no benchmark was run", "--quick", "--benchmark_filter=bicycle")

    def test_output_that_cannot_be_written_fails(self):
        self.expect_failure("/no/such/folder/file", "--quick",
                            "--benchmark_out=/no/such/folder/file")

    def test_invalid_sizes_are_rejected(self):
        for size in ("", "640", "640x480", "640x480x64x", "axbxc"):
            with self.subTest(size):
                self.expect_failure("WIDTHxHEIGHTxDISPARITIES", f"--measure-memory={size}")
        for size in ("0x480x64", "-1x-1x64", "640x480x0", "64x48x65"):
            with self.subTest(size):
                self.expect_failure("error: ", f"--measure-memory={size}")

    def test_invalid_settings_are_rejected_by_name(self):
        for setting in ("speed=1", "mode", "mode=", "mode=fair", "threads=-1", "", "="):
            with self.subTest(setting):
                name = setting.split("=")[0] or 'parameter "" does not exist'
                self.expect_failure(name, f"--measure-memory=64x48x16/{setting}")
                self.expect_failure(name, f"--measure-memory=64x48x16/mode=dense/{setting}")

    def test_folder_without_the_real_pair_is_reported(self):
        done = run("--benchmark_list_tests", MTSTEREO_TEST_DATA="/no/such/folder")
        self.assertEqual(0, done.returncode, done.stderr)
        self.assertIn("/no/such/folder", done.stderr)
        self.assertIn("frame/street-1920x1080-128/", done.stdout)
        self.assertNotIn("kitti", done.stdout)


def write_png(file, rows, bits):
    """A gray PNG file; `rows` are lists of numbers."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I",
                                                                        zlib.crc32(kind + data))
    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), bits, 0, 0, 0, 0)
    pixel = "B" if bits == 8 else "H"
    lines = b"".join(b"\0" + struct.pack(f">{len(row)}{pixel}", *row) for row in rows)
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header)
                     + chunk(b"IDAT", zlib.compress(lines)) + chunk(b"IEND", b""))


class PairFromFolder(unittest.TestCase):
    """A synthetic pair in place of the real one, for the benchmark's check of its result."""

    WIDTH, HEIGHT, SHIFT = 160, 48, 7

    def run_on(self, rows):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        training = pathlib.Path(folder.name) / "kitti2015/training"
        views = {"image_2": [row[:self.WIDTH] for row in rows],
                 "image_3": [row[self.SHIFT:self.WIDTH + self.SHIFT] for row in rows]}
        for name, view in views.items():
            write_png(training / name / "000046_10.png", view, 8)
        truth = [[self.SHIFT * 256] * self.WIDTH] * self.HEIGHT
        write_png(training / "disp_occ_0/000046_10.png", truth, 16)
        return run("--benchmark_filter=frame/kitti-160x48-100/semi-dense/",
                   "--benchmark_repetitions=1", "--benchmark_min_time=0.001",
                   MTSTEREO_TEST_DATA=folder.name)

    def test_is_timed_if_disparities_are_found(self):
        numbers = random.Random(1)
        done = self.run_on([[numbers.randrange(256) for _ in range(self.WIDTH + self.SHIFT)]
                            for _ in range(self.HEIGHT)])
        self.assertEqual(0, done.returncode, done.stdout + done.stderr)
        self.assertEqual(2, done.stdout.count("\nkitti-160x48-100  semi-dense"), done.stdout)

    def test_fails_if_no_disparity_is_found(self):
        done = self.run_on([[100] * (self.WIDTH + self.SHIFT)] * self.HEIGHT)
        self.assertEqual(1, done.returncode, done.stdout + done.stderr)
        for threads in (1, 2):
            self.assertRegex(done.stderr, rf"error: frame/kitti-160x48-100/semi-dense/"
                                          rf"threads:{threads}/.*: the result has no disparity")
        self.assertNotIn("time / bm", done.stdout)


class Help(unittest.TestCase):
    def test_lists_both_kinds_of_options(self):
        done = run("--help")
        self.assertEqual(0, done.returncode)
        self.assertIn("--quick", done.stdout)
        self.assertIn("--benchmark_filter", done.stdout)


if __name__ == "__main__":
    unittest.main()
