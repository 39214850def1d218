#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""figures.py writes the figures of a result between its marks, and keeps the page on errors."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

FIGURES = pathlib.Path(__file__).resolve().parent / "figures.py"
PAGE = ("# Benchmark\n\nText before.\n\n<!-- figures: begin -->\nold figures\n"
        "<!-- figures: end -->\n\nText after.\n")
CONTEXT = {"date": "2030-01-02T03:04:05+00:00", "host_name": "secret-host", "num_cpus": 2,
           "mhz_per_cpu": 2500, "processor": "Some CPU", "mtstereo": "9.8.7", "opencv": "4.6.0",
           "executable": "/secret/folder/program",
           "caches": [{"type": "Data", "level": 1, "size": 49152, "num_sharing": 1},
                      {"type": "Unified", "level": 3, "size": 1048576, "num_sharing": 2}]}


def one(name, time, unit="ms", cpu=None, spread=0.01, **counters):
    """A benchmark as its median and spread, after a repetition that does not count."""
    entry = {"run_name": name, "time_unit": unit, "real_time": time,
             "cpu_time": time if cpu is None else cpu, **counters}
    return [{**entry, "name": name, "run_type": "iteration", "real_time": 10 * time},
            {**entry, "name": name + "_median", "run_type": "aggregate",
             "aggregate_name": "median"},
            {**entry, "name": name + "_cv", "run_type": "aggregate", "aggregate_name": "cv",
             "real_time": spread}]


def frame(method, threads, time, cpu=None, **more):
    return one(f"frame/street-640x480-64/{method}/threads:{threads}/process_time/real_time", time,
               cpu=time * threads if cpu is None else cpu, density=0.625,
               **{"s/MP": time / 1e3 / 0.3072}, **more)


def growth(what, name, pixels, disparities, time):
    return one(f"scaling/{what}/{name}/real_time", time, pixels=pixels, disparities=disparities)


FRAMES = (frame("semi-dense", 1, 90) + frame("fast", 1, 30) + frame("sgbm-3way", 1, 60)
          + frame("bm", 1, 25) + frame("semi-dense", 2, 50))
GROWTH = (growth("pixels", "320x240", 76800, 64, 10) + growth("pixels", "640x480", 307200, 64, 40)
          + growth("disparities", 32, 307200, 32, 10) + growth("disparities", 128, 307200, 128, 20))
OTHERS = (one("stage/street-640x480-64/semi-dense/census/manual_time", 1500, "us", **{"ns/px": 5})
          + one("stage/street-640x480-64/semi-dense/max-trees/manual_time", 500, "us",
                **{"ns/px": 2})
          + one("target/street-640x480-64/AVX2/real_time", 40)
          + one("target/street-640x480-64/EMU128/real_time", 60)
          + one("memory/first-frame-640x480x64/iterations:1/repeats:3/manual_time", 46,
                peak_MiB=31.5)
          + one("memory/first-frame-640x480x64/preset=paper/cost-volume=full/iterations:1"
                "/repeats:3/manual_time", 94, peak_MiB=65))
ELEMENT = one("element/street-1242x375-100/threads:2/iterations:1/manual_time", 41.2,
              library_ms=40, overhead_percent=3)


class Figures(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.build = pathlib.Path(folder.name) / "build"
        self.page = pathlib.Path(folder.name) / "docs/benchmark.md"
        self.page.parent.mkdir()
        self.page.write_text(PAGE, encoding="utf-8")
        self.build.mkdir()

    def write(self, name, entries, context=None):
        file = self.build / name
        data = entries if isinstance(entries, str) else json.dumps(
            {"context": CONTEXT if context is None else context, "benchmarks": entries})
        file.write_text(data, encoding="utf-8")
        return file

    def run_script(self, *arguments):
        return subprocess.run([sys.executable, FIGURES, self.build, "--page", self.page,
                               *map(str, arguments)],
                              check=False, capture_output=True, text=True, timeout=120)

    def figures_of(self, entries, element=None):
        """The page after a successful run."""
        self.write("benchmark.json", entries)
        if element:
            self.write("benchmark-element.json", element,
                       {**CONTEXT, "gstreamer": "GStreamer 1.22.0"})
        done = self.run_script("--no-run")
        self.assertEqual(0, done.returncode, done.stderr)
        self.said = done
        return self.page.read_text(encoding="utf-8")

    def expect_rejection(self, status, words, *arguments):
        done = self.run_script(*arguments)
        self.assertEqual(status, done.returncode, done.stdout + done.stderr)
        self.assertIn(words, done.stderr)
        self.assertNotIn("Traceback", done.stderr)

    def tearDown(self):
        text = self.page.read_text(encoding="utf-8")
        self.assertTrue(text.startswith("# Benchmark"))


class Page(Figures):
    def test_only_text_between_the_marks_changes(self):
        text = self.figures_of(FRAMES)
        self.assertTrue(text.startswith(PAGE.split("old figures")[0]))
        self.assertTrue(text.endswith("<!-- figures: end -->\n\nText after.\n"))
        self.assertNotIn("old figures", text)

    def test_the_same_result_gives_the_same_page(self):
        everything = FRAMES + GROWTH + OTHERS
        self.assertEqual(self.figures_of(everything, ELEMENT),
                         self.figures_of(everything, ELEMENT))

    def test_machine_is_described_without_host_name_and_folders(self):
        text = self.figures_of(FRAMES, ELEMENT)
        for words in ("Some CPU, 2 CPUs of 2500 MHz", "L1 data 48 KiB,",
                      "L3 unified 1024 KiB (for 2 CPUs)", "2030-01-02", "mtstereo 9.8.7",
                      "OpenCV 4.6.0", "GStreamer 1.22.0"):
            self.assertIn(words, text)
        self.assertNotIn("secret", text)

    def test_frames_have_speedup_and_ratios_of_medians(self):
        text = self.figures_of(FRAMES)
        self.assertIn("| `semi-dense` | 1 | 90.0 | 1.0 | 0.293 | 11.1 | 62.5 | 1.00 | 1.00 | 1.00 "
                      "| 1.50 | 3.60 |", text)
        self.assertIn("| `fast` | 1 | 30.0 | 1.0 | 0.098 | 33.3 | 62.5 | 1.00 | 1.00 | 0.33 | 0.50 "
                      "| 1.20 |", text)
        self.assertIn("| `semi-dense` | 2 | 50.0 | 1.0 | 0.163 | 20.0 | 62.5 | 2.00 | 1.80 | 1.00 "
                      "| - | - |", text)

    def test_other_tables_have_their_figures(self):
        text = self.figures_of(OTHERS, ELEMENT)
        self.assertIn("| `census` | `semi-dense` | 5.00 | 1.50 | 1.0 |", text)
        self.assertIn("| all of `semi-dense` |  | 7.00 | 2.00 |  |", text)
        self.assertIn("| EMU128 | 60.0 | 1.0 | 1.50 | 1.50 |", text)
        self.assertIn("| 640x480x64 | defaults | 31.5 | 46.0 |", text)
        self.assertIn("| 640x480x64 | `preset=paper cost-volume=full` | 65.0 | 94.0 |", text)
        self.assertIn("| street-1242x375-100 | 2 | 40.00 | 41.20 | 3.00 |", text)

    def test_missing_measurements_have_no_heading(self):
        text = self.figures_of(FRAMES)
        for heading in ("Stages", "SIMD", "Growth", "Memory", "Element"):
            self.assertNotIn(f"### {heading}", text)

    def test_repetitions_without_aggregates_give_their_median(self):
        name = "target/street-640x480-64/AVX2/real_time"
        text = self.figures_of([entry for time in (1, 2, 9) for entry in one(name, time / 10)[:1]])
        self.assertIn("| AVX2 | 2.0 | - | 1.00 | 1.00 |", text)

    def test_noisy_benchmarks_are_named(self):
        self.figures_of(FRAMES)
        self.assertEqual("", self.said.stderr)
        self.figures_of(frame("bm", 1, 10, spread=0.07) + frame("bm", 2, 10, cpu=5))
        self.assertRegex(self.said.stderr, r"bm/threads:1/.*: spread 7\.0 %")
        self.assertRegex(self.said.stderr, r"bm/threads:2/.*: 0\.50 CPUs")


class Growth(Figures):
    def test_exponent_is_the_slope_of_the_logarithms(self):
        text = self.figures_of(GROWTH)
        self.assertIn("Exponent over pixels: 1.00.", text)
        self.assertIn("Exponent over disparities: 0.50.", text)

    def test_one_point_is_no_growth(self):
        self.assertNotIn("Growth", self.figures_of(GROWTH[:3]))

    def test_one_variable_is_enough(self):
        text = self.figures_of(GROWTH[:6])
        self.assertIn("Exponent over pixels", text)
        self.assertNotIn("Exponent over disparities", text)


class Rejections(Figures):
    def tearDown(self):
        self.assertEqual(self.expected, self.page.read_text(encoding="utf-8"))

    def setUp(self):
        super().setUp()
        self.expected = PAGE

    def test_files_that_are_not_results_are_named(self):
        for broken in ("", "{", "[]", "{}", '{"benchmarks": []}',
                       '{"context": {}, "benchmarks": [{}]}', '{"context": 1, "benchmarks": 1}'):
            with self.subTest(broken):
                self.write("benchmark.json", broken)
                self.expect_rejection(2, "benchmark.json: is not a result", "--no-run")

    def test_missing_figures_are_reported(self):
        no_density = [{key: value for key, value in entry.items() if key != "density"}
                      for entry in FRAMES]
        for entries, context in ((no_density, CONTEXT), (FRAMES, {}),
                                 (one("frame", 1), CONTEXT), (one("scaling/pixels/a", 1), CONTEXT)):
            self.write("benchmark.json", entries, context)
            self.expect_rejection(2, "benchmark.json", "--no-run")

    def test_failed_benchmarks_are_named(self):
        self.write("benchmark.json", FRAMES + [
            {"name": "frame/f/bm", "run_name": "frame/f/bm", "run_type": "iteration",
             "error_occurred": True, "error_message": "no disparity"}])
        self.expect_rejection(2, "frame/f/bm failed: no disparity", "--no-run")

    def test_missing_files_are_named(self):
        self.expect_rejection(2, "benchmark.json: cannot be read", "--no-run")
        self.write("benchmark.json", FRAMES)
        self.expect_rejection(2, "none.json: cannot be read", "--no-run", "--element-result",
                            self.build / "none.json")

    def test_page_without_its_marks_is_rejected(self):
        self.write("benchmark.json", FRAMES)
        begin, end = "<!-- figures: begin -->", "<!-- figures: end -->"
        for page in ("# Benchmark\n", f"# Benchmark\n{begin}\n", f"# Benchmark\n{end}{begin}",
                     f"# Benchmark\n{begin}{begin}{end}"):
            with self.subTest(page):
                self.expected = page
                self.page.write_text(page, encoding="utf-8")
                self.expect_rejection(2, "benchmark.md: must contain", "--no-run")

    def test_build_without_the_programs_is_named(self):
        self.expect_rejection(1, "mtstereo-benchmark")


class Runs(Figures):
    def program(self, name, code):
        file = self.build / "tests/benchmark" / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(f"#!{sys.executable}\nimport os, pathlib, sys\n{code}\n", encoding="utf-8")
        file.chmod(0o755)

    def writer(self, name, entries):
        source = self.write(f"{name}-source.json", entries,
                            {**CONTEXT, "gstreamer": "GStreamer 1.22.0"})
        self.program(name, f"out = sys.argv[1].removeprefix('--benchmark_out=')\n"
                           f"pathlib.Path(out).write_text(pathlib.Path({str(source)!r})"
                           f".read_text())\nprint(os.environ.get('GST_PLUGIN_PATH', ''))")

    def test_both_programs_are_run_and_the_plugin_is_found(self):
        self.writer("mtstereo-benchmark", FRAMES)
        self.writer("mtstereo-benchmark-element", ELEMENT)
        done = self.run_script()
        self.assertEqual(0, done.returncode, done.stderr)
        text = self.page.read_text(encoding="utf-8")
        self.assertIn("| street-1242x375-100 | 2 |", text)
        self.assertIn("`fast`", text)
        self.assertIn(str(self.build / "gst"), done.stdout)

    def test_without_the_plugin_its_older_figures_are_not_used(self):
        self.writer("mtstereo-benchmark", FRAMES)
        self.write("benchmark-element.json", ELEMENT, {**CONTEXT, "gstreamer": "GStreamer"})
        done = self.run_script()
        self.assertEqual(0, done.returncode, done.stderr)
        self.assertNotIn("### Element", self.page.read_text(encoding="utf-8"))

    def test_failed_program_keeps_the_page(self):
        self.writer("mtstereo-benchmark", FRAMES)
        self.program("mtstereo-benchmark-element", "sys.exit(1)")
        self.expect_rejection(1, "mtstereo-benchmark-element")
        self.assertEqual(PAGE, self.page.read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main()
