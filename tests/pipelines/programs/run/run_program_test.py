#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The program mtstereo-run from outside: exit statuses, messages, interruptions."""

import json
import shutil
import signal
import subprocess

import program_case
from program_case import FRAMES, ProgramCase, run


class Program(ProgramCase):
    def test_writes_results_and_report(self):
        self.assertEqual(self.first.returncode, 0, self.first.stderr)
        self.assertIn(f"{FRAMES} pairs", self.first.stdout)
        self.assertIn(f"{FRAMES} of {FRAMES} pairs (100 %)", self.first.stderr)
        report = json.loads((self.whole / "run.json").read_text())
        self.assertEqual(report["processed_pairs"], FRAMES)
        self.assertEqual(len(report["frames"]), FRAMES)
        self.assertEqual(report["parameters"]["max-disparity"], "32")
        self.assertEqual(report["files"], ["disparity.mkv"])
        median = sorted(frame[4] for frame in report["frames"])[FRAMES // 2]
        self.assertAlmostEqual(median, 8, delta=0.2)

    def test_keeps_results(self):
        before = (self.whole / "disparity.mkv").stat().st_mtime_ns
        again = run(self.left, self.right, "--out", self.whole, "--max-disparity", 32)
        self.assertEqual(again.returncode, 1)
        self.assertIn("has results already", again.stderr)
        done = run(self.left, self.right, "--out", self.whole, "--max-disparity", 32, "--resume")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("was done before", done.stdout)
        other = run(self.left, self.right, "--out", self.whole, "--resume")
        self.assertEqual(other.returncode, 1)
        self.assertIn("other options", other.stderr)
        self.assertEqual((self.whole / "disparity.mkv").stat().st_mtime_ns, before)

    def test_names_an_empty_input(self):
        done = run("", self.right, "--out", self.out())
        self.assertEqual(done.returncode, 1)
        self.assertIn("an input has an empty name", done.stderr)

    def test_does_not_take_results_of_an_input_that_was_exchanged(self):
        left = self.folder / "exchanged.mp4"
        shutil.copy(self.left, left)
        command = (left, self.right, "--out", self.out(), "--max-disparity", 32)
        self.assertEqual(run(*command).returncode, 0)
        self.assertIn("was done before", run(*command, "--resume").stdout)
        with left.open("ab") as file:
            file.write(b"\0\0\0\x64free" + bytes(92))  # a box without meaning
        again = run(*command, "--resume")
        self.assertEqual(again.returncode, 1)
        self.assertIn("results of another input", again.stderr)

    # Feature: interruptions and damaged files
    def test_continues_after_a_kill(self):
        process = self.start_and_send(signal.SIGKILL, [])
        self.assertEqual(process.returncode, -signal.SIGKILL)
        self.assertEqual([path.name for path in self.out().iterdir()], ["unfinished"])
        done = self.journal_lines() - 1
        self.assertGreater(done, 10)
        resumed = run(*self.command("--resume"))
        self.assertEqual(resumed.returncode, 0, resumed.stderr)
        self.assert_as_whole()

    def test_stops_at_an_interrupt(self):
        process = self.start_and_send(signal.SIGINT, [])
        self.assertEqual(process.returncode, 3)
        self.assertIn("--resume continues", process.messages)
        self.assertEqual([path.name for path in self.out().iterdir()], ["unfinished"])
        self.assertEqual(run(*self.command("--resume")).returncode, 0)
        self.assert_as_whole()

    # Feature: interruptions and damaged files
    def test_names_broken_inputs_and_does_the_rest(self):
        archive = self.folder / "archive"
        for name in ("good", "bad"):
            (archive / name).mkdir(parents=True)
            for file in (self.left, self.right):
                shutil.copy(file, archive / name)
        (archive / "bad" / "right.mp4").write_text("no video")
        result = run(archive, "--out", self.out(), "--max-disparity", 32)
        self.assertEqual(result.returncode, 3, result.stderr)
        self.assertIn("bad", result.stderr)
        found = list(self.out().rglob("disparity.mkv"))
        self.assertEqual(len(found), 1)
        self.assertIn("good", str(found[0]))
        self.assertEqual(found[0].read_bytes(), (self.whole / "disparity.mkv").read_bytes())

    def test_names_what_is_wrong_in_folders_without_a_usable_recording(self):
        archive = self.folder / "unusable"
        for name in ("day/one", "day/two"):
            (archive / name).mkdir(parents=True)
            shutil.copy(self.short_left, archive / name / "front.mp4")
        result = run(archive, "--out", self.out())
        self.assertEqual(result.returncode, 1, result.stderr)
        lines = result.stderr.splitlines()
        self.assertEqual(len(lines), 2, result.stderr)
        for line, name in zip(lines, ("day/one", "day/two"), strict=True):
            self.assertRegex(line, f"^mtstereo-run: {archive}/{name}/front.mp4: 160x96 px is the")

    def test_says_that_results_are_of_no_use(self):
        exchanged = [self.short_right, self.short_left, "--out", self.out()]
        remedy = r"results are useless: The left and the right view are exchanged: .*--swap"
        result = run(*exchanged, "--max-disparity", 32)
        self.assertEqual(result.returncode, 4, result.stderr)
        self.assertRegex(result.stderr, remedy)
        self.assertIn("exchanged", json.loads((self.out() / "run.json").read_text())["doubt"])
        again = run(*exchanged, "--max-disparity", 32, "--resume")
        self.assertEqual(again.returncode, 4, again.stderr)
        self.assertRegex(again.stderr, remedy)
        options = ["--overwrite", "--swap", "--max-disparity", 32]
        swapped = run(*exchanged, *options)
        self.assertEqual(swapped.returncode, 0, swapped.stderr)
        self.assertEqual(json.loads((self.out() / "run.json").read_text())["doubt"], "")

    def test_says_that_results_of_an_archive_are_of_no_use(self):
        archive = self.folder / "exchanged-archive"
        for name, left, right in (("good", "left", "right"), ("bad", "right", "left")):
            (archive / name).mkdir(parents=True)
            shutil.copy(self.short_left, archive / name / (left + ".mp4"))
            shutil.copy(self.short_right, archive / name / (right + ".mp4"))
        for jobs in (1, 2):
            out = self.out() / str(jobs)
            result = run(archive, "--out", out, "--max-disparity", 32, "--jobs", jobs)
            self.assertEqual(result.returncode, 4, result.stderr)
            self.assertRegex(result.stderr, "mtstereo-run: bad: the results are useless")
            self.assertNotIn("good: the results", result.stderr)

    def test_processes_truncated_files(self):
        cuts = [self.folder / name for name in ("cut.mkv", "cut.mp4", "cut.ts")]
        copies = [word for cut in cuts for word in ("-frames:v", "90", "-c", "copy", "-movflags", "faststart", cut)]
        subprocess.run(["ffmpeg", "-v", "error", "-y", "-i", self.right, *copies], check=True)
        for cut in cuts:
            with self.subTest(cut.name):
                # Within a packet of MPEG-TS: a cut between two packets cannot be seen for certain.
                length = cut.stat().st_size * 2 // 3 // 188 * 188 + 100
                cut.write_bytes(cut.read_bytes()[:length])
                out = self.out() / cut.name
                result = run(self.left, cut, "--out", out, "--max-disparity", 32)
                self.assertEqual(result.returncode, 3, result.stderr)
                self.assertRegex(result.stderr, r"right view: the file is truncated after \d\.\d+ s")
                report = json.loads((out / "run.json").read_text())
                self.assertGreater(report["processed_pairs"], 30)
                self.assertLess(report["processed_pairs"], 80)
                self.assertIn("truncated", report["inputs"]["right"]["damage"])
                self.assertEqual(len(report["frames"]), report["processed_pairs"])
        out = self.out() / "in processes"
        result = run(self.left, cut, "--out", out, "--max-disparity", 32, "--jobs", 2)
        self.assertEqual(result.returncode, 3, result.stderr)
        self.assertRegex(result.stderr, r"cut\.ts: the file is truncated after \d\.\d+ s")

    def test_with_processes_gives_the_same(self):
        result = run(*self.command("--jobs", 2))
        self.assertEqual(result.returncode, 0, result.stderr)
        found = list(self.out().rglob("recordings/**/disparity.mkv"))
        self.assertEqual(len(found), 1)
        self.assertEqual(found[0].read_bytes(), (self.whole / "disparity.mkv").read_bytes())

    def test_refuses_invalid_commands(self):
        for arguments in (
            [],
            [self.left, self.right],
            self.command("--what", "nothing"),
            self.command("--mode", "best"),
            self.command("--max-disparity", "automatic"),
            self.command("--alignment", "monitor"),
            self.command("--drift", "3"),
            self.command("--alpha", "1.5"),
            self.command("--alpha", "-0.5"),
            self.command("--alpha", "nan"),
            self.command("--rectified-size", "640"),
            self.command("--rectified-size", "0x480"),
            self.command("--rectified-size", "640x480x3"),
            self.command("--sync", "1", "--drift", "nan"),
            self.command("--sync", "nan"),
            self.command("--rate", "nan"),
            self.command("--rate", "inf"),
            self.command("--resume", "--overwrite"),
            self.command("--sync", "soon"),
            self.command("--no-such-option"),
            self.command("--far", "-1"),
            self.command("--far", "far"),
            self.command("--near", "5", "--far", "3"),
        ):
            result = run(*arguments)
            self.assertEqual(result.returncode, 2, arguments)
            self.assertNotEqual(result.stderr, "", arguments)
        self.assertFalse(self.out().exists())
        for mistyped, nearest in (("--max-disparty", "--max-disparity"), ("--formt", "--format")):
            self.assertIn(f"Did you mean {nearest}", run(*self.command(mistyped, "3")).stderr)

    def test_help_has_examples_and_defaults(self):
        for command in ([], ["plan"]):
            help_text = run(*command, "--help").stdout
            self.assertRegex(help_text, r"Examples:\n  mtstereo-run ")
            self.assertIn("default: 64", help_text)
            self.assertLessEqual(max(map(len, help_text.splitlines())), 110)

    def test_states_what_was_recognized(self):
        self.assertIn(f"Input: two video files, 160x96 px, {FRAMES} pairs, 30 per second.", self.first.stderr)
        self.assertIn("Matching: mode semi-dense, disparities 0 to 31 px.", self.first.stderr)
        self.assertIn("Results: disparity (mkv).", self.first.stderr)
        quiet = run(*self.command("--max-disparity", 16, "--what", "stats", "--quiet"))
        self.assertNotIn("Input:", quiet.stderr)

    def test_finds_the_range(self):
        command = [self.short_left, self.short_right, "--out", self.out(), "--max-disparity", "auto"]
        result = run(*command)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("max-disparity is 16", result.stderr)
        report = json.loads((self.out() / "run.json").read_text())
        self.assertEqual(report["parameters"]["max-disparity"], "16")
        self.assertIn("was done before", run(*command, "--resume").stdout)

    def test_states_what_is_missing(self):
        for arguments, text in (
            ([self.left, self.folder / "missing.mp4", "--out", self.out()], "missing.mp4"),
            (self.command("--what", "depth"), "calibration"),
            (self.command("--alpha", "1"), "--rectified no"),
            ([self.left, self.left, "--out", self.out()], "are the same file"),
            ([self.left, self.link(), "--out", self.out()], "are the same file"),
            ([self.pipe(), self.right, "--out", self.out()], "pipe or a device"),
            (self.command("--calibration", self.pipe()), "a calibration is a file"),
            (["/proc", "--list"], "files of the kernel"),
            (["/proc", "--out", self.out()], "files of the kernel"),
        ):
            result = run(*arguments)
            self.assertNotEqual(result.returncode, 0, result.stderr)
            self.assertIn(text, result.stderr)
        self.assertFalse(self.out().exists())

    def link(self):
        link = self.folder / "link.mp4"
        if not link.exists():
            link.symlink_to(self.left)
        return link

    def test_lists_recordings(self):
        result = run(self.left, self.right, "--list")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("two video files", result.stdout)


if __name__ == "__main__":
    program_case.main()
