#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The program mtstereo-run from outside: exit statuses, messages, interruptions."""

import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = None  # set below
FRAMES = 240
SKIPPED = 77


def run(*arguments):
    return subprocess.run(
        [PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=120, check=False
    )


def make_video(file, column, frames=FRAMES):
    """A part of a moving test picture by ffmpeg: views whose columns differ are a stereo pair."""
    subprocess.run(
        ["ffmpeg", "-v", "error", "-y", "-f", "lavfi", "-i", "testsrc2=size=336x192:rate=30"]
        + ["-frames:v", str(frames), "-vf", f"crop=320:192:{column}:0"]
        + ["-c:v", "libx264", "-preset", "veryfast", "-bf", "2", "-g", "30", str(file)],
        check=True,
        stdin=subprocess.DEVNULL,
    )


class Program(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="mtstereo-run-"))
        cls.left = cls.folder / "left.mp4"
        cls.right = cls.folder / "right.mp4"
        make_video(cls.left, 0)
        make_video(cls.right, 8)
        cls.whole = cls.folder / "whole"
        cls.first = run(cls.left, cls.right, "--out", cls.whole, "--max-disparity", 32)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def out(self):
        return self.folder / self.id().rsplit(".", 1)[1]

    def command(self, *options):
        return [self.left, self.right, "--out", self.out(), "--max-disparity", 32, *options]

    def journal_lines(self):
        journal = self.out() / "unfinished" / "journal"
        return len(journal.read_text().splitlines()) if journal.exists() else 0

    def start_and_send(self, number, options):
        """Starts a run, and sends a signal in the middle. Returns the process after its end."""
        command = [PROGRAM, *map(str, self.command(*options))]
        process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
        deadline = time.monotonic() + 60
        while self.journal_lines() < 20 and time.monotonic() < deadline:
            time.sleep(0.001)
        process.send_signal(number)
        _, process.messages = process.communicate(timeout=60)
        return process

    def assert_as_whole(self):
        self.assertEqual(
            (self.out() / "disparity.mkv").read_bytes(),
            (self.whole / "disparity.mkv").read_bytes(),
        )
        self.assertEqual(
            sorted(path.name for path in self.out().iterdir()), ["disparity.mkv", "run.json"]
        )

    def test_writes_results_and_report(self):
        self.assertEqual(self.first.returncode, 0, self.first.stderr)
        self.assertIn("240 pairs", self.first.stdout)
        self.assertIn("240 of 240 pairs (100 %)", self.first.stderr)
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

    def test_says_that_results_are_of_no_use(self):
        remedy = r"results are of no use: The left and the right view are exchanged: .*--swap"
        result = run(self.right, self.left, "--out", self.out(), "--max-disparity", 32)
        self.assertEqual(result.returncode, 4, result.stderr)
        self.assertRegex(result.stderr, remedy)
        self.assertIn("exchanged", json.loads((self.out() / "run.json").read_text())["doubt"])
        again = run(self.right, self.left, "--out", self.out(), "--max-disparity", 32, "--resume")
        self.assertEqual(again.returncode, 4, again.stderr)
        self.assertRegex(again.stderr, remedy)
        options = ["--overwrite", "--swap", "--max-disparity", 32]
        swapped = run(self.right, self.left, "--out", self.out(), *options)
        self.assertEqual(swapped.returncode, 0, swapped.stderr)
        self.assertEqual(json.loads((self.out() / "run.json").read_text())["doubt"], "")

    def test_says_that_results_of_an_archive_are_of_no_use(self):
        archive = self.folder / "exchanged-archive"
        for name, left, right in (("good", "left", "right"), ("bad", "right", "left")):
            (archive / name).mkdir(parents=True)
            shutil.copy(self.left, archive / name / (left + ".mp4"))
            shutil.copy(self.right, archive / name / (right + ".mp4"))
        for jobs in (1, 2):
            out = self.out() / str(jobs)
            result = run(archive, "--out", out, "--max-disparity", 32, "--jobs", jobs)
            self.assertEqual(result.returncode, 4, result.stderr)
            self.assertRegex(result.stderr, "mtstereo-run: bad: the results are of no use")
            self.assertNotIn("good: the results", result.stderr)

    def test_processes_truncated_files(self):
        for name in ("cut.mkv", "cut.mp4", "cut.ts"):
            with self.subTest(name):
                cut = self.folder / name
                subprocess.run(
                    ["ffmpeg", "-v", "error", "-y", "-i", self.right, "-frames:v", "90"]
                    + ["-c", "copy", "-movflags", "faststart", cut],
                    check=True,
                )
                # Within a packet of MPEG-TS: a cut between two packets cannot be seen for certain.
                length = cut.stat().st_size * 2 // 3 // 188 * 188 + 100
                cut.write_bytes(cut.read_bytes()[:length])
                out = self.out() / name
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
        self.assertIn("Input: two video files, 320x192 px, 240 pairs, 30 per second.", self.first.stderr)
        self.assertIn("Matching: mode semi-dense, disparities 0 to 31 px.", self.first.stderr)
        self.assertIn("Results: disparity (mkv).", self.first.stderr)
        quiet = run(*self.command("--max-disparity", 16, "--what", "stats", "--quiet"))
        self.assertNotIn("Input:", quiet.stderr)

    def test_finds_the_range(self):
        command = [self.left, self.right, "--out", self.out(), "--max-disparity", "auto"]
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

    def pipe(self):
        pipe = self.folder / "pipe"
        if not pipe.exists():
            os.mkfifo(pipe)
        return pipe

    def test_replaces_no_input(self):
        out = self.out()
        out.mkdir()
        left = shutil.copy(self.left, out / "color.mkv")
        os.link(self.right, out / "right.mkv")
        os.link(self.right, out / "disparity.mkv")
        before = {path: path.read_bytes() for path in out.iterdir()}
        for inputs, what in (
            ((left, self.right), "color"),
            ((self.left, self.right), "disparity"),
            ((self.left, out / "right.mkv"), "disparity"),
        ):
            for option in ("--resume", "--overwrite", "--quiet"):
                for more in ([], ["--jobs", 2]):
                    result = run(*inputs, "--out", out, "--what", what, option, *more)
                    self.assertEqual(result.returncode, 1, result.stderr)
                    self.assertIn(f"{what}.mkv is an input", result.stderr)
        self.assertEqual({path: path.read_bytes() for path in out.iterdir()}, before)

    def test_names_what_is_in_the_way(self):
        for name in ("disparity.mkv", "run.json", "unfinished/journal", "plan/works/a.json"):
            file = self.out() / name
            file.parent.mkdir(parents=True)
            file.write_text("mine")
            more = ["--jobs", 2] if name.startswith("plan/") else []
            for option in ("--resume", "--overwrite", "--quiet"):
                result = run(*self.command(option, *more))
                self.assertEqual(result.returncode, 1, result.stderr)
                self.assertRegex(result.stderr, f"{name.split('/', maxsplit=1)[0]}.* is in the way")
            self.assertEqual(file.read_text(), "mine")
            shutil.rmtree(self.out())

    def test_one_run_at_a_time_writes_into_a_folder(self):
        first = subprocess.Popen([PROGRAM, *map(str, self.command())], stderr=subprocess.DEVNULL)
        while self.journal_lines() < 2:
            time.sleep(0.001)
        first.send_signal(signal.SIGSTOP)
        for option in ("--quiet", "--resume", "--overwrite"):
            for more in ([], ["--jobs", 2]):
                second = run(*self.command(option, *more))
                self.assertEqual(second.returncode, 1, second.stderr)
                self.assertRegex(second.stderr, rf"process {first.pid} \(.*--out.*\) writes into this folder")
        first.send_signal(signal.SIGCONT)
        self.assertEqual(first.wait(timeout=60), 0)
        self.assert_as_whole()

    def test_checks_what_was_done_before(self):
        result = run(*self.command())
        self.assertEqual(result.returncode, 0, result.stderr)
        video = self.out() / "disparity.mkv"
        for damage, text in (
            (video.unlink, "disparity.mkv is missing"),
            (lambda: os.truncate(video, 1000), "disparity.mkv has 1000 of"),
            (lambda: os.truncate(video, 0), "disparity.mkv has 0 of"),
        ):
            damage()
            result = run(*self.command("--resume"))
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn(text, result.stderr)
            self.assertIn("it is done again", result.stderr)
            self.assert_as_whole()
        video.unlink()
        video.write_text("mine")
        result = run(*self.command("--resume"))
        self.assertEqual(result.returncode, 1)
        self.assertIn("disparity.mkv was changed since it was written", result.stderr)
        self.assertEqual(video.read_text(), "mine")

    def test_names_need_not_be_text(self):
        archive = os.fsencode(self.folder / "names")
        for name in (b"bad\xff", b"red\x1b[31m", b"good"):
            os.makedirs(archive + b"/" + name)
            shutil.copy(os.fsencode(self.left), archive + b"/" + name)
            shutil.copy(os.fsencode(self.right), archive + b"/" + name)
        with open(archive + b"/good/right.mp4", "ab") as stream:  # a box with an impossible name
            stream.write(b"\0\1\x86\xa0\xff\x1b\0\xfcxxxx")
        for more in ([], ["--jobs", "2"]):
            out = self.out().with_suffix(f".{len(more)}")
            result = subprocess.run(
                [PROGRAM, archive, "--out", out, "--max-disparity", "32", *more],
                capture_output=True, timeout=120, check=False,
            )
            messages = (result.stdout + result.stderr).decode()  # valid UTF-8
            self.assertEqual(result.returncode, 3, messages)
            self.assertIn(r"bytes of its box '\xff\x1b\x00\xfc' are missing", messages)
            self.assertNotIn("\x1b", messages)
            for name in (r"bad\xff", r"red\x1b[31m", "good"):
                report = json.loads((out / name / "run.json").read_text())
                self.assertEqual(report["processed_pairs"], FRAMES)
            self.assertIn(r"bad\xff/left.mp4", (out / r"bad\xff/run.json").read_text().replace(r"\\", "\\"))

    def wait_for_handler(self, pid, number):
        caught = 0
        while caught >> (number - 1) & 1 == 0:
            status = pathlib.Path(f"/proc/{pid}/status").read_text()
            caught = int(status.partition("SigCgt:")[2].split()[0], 16)

    def test_one_signal_ends_the_search(self):
        archive = self.folder / "long"
        for number in range(100):
            (archive / str(number)).mkdir(parents=True)
            for file in (self.left, self.right):
                os.link(file, archive / str(number) / file.name)
        for command in ([archive], ["plan", archive], [archive, "--jobs", 2]):
            for number in (signal.SIGINT, signal.SIGTERM):
                process = subprocess.Popen(
                    [PROGRAM, *map(str, command), "--out", str(self.out())], stderr=subprocess.PIPE, text=True
                )
                self.wait_for_handler(process.pid, number)
                process.send_signal(number)
                _, messages = process.communicate(timeout=60)
                self.assertEqual(process.returncode, 3, messages)
                self.assertEqual(messages, "mtstereo-run: interrupted; --resume continues\n")
                self.assertFalse(self.out().exists())

    def test_lists_recordings(self):
        result = run(self.left, self.right, "--list")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("two video files", result.stdout)


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    if shutil.which("ffmpeg") is None:
        print("ffmpeg is not installed")
        sys.exit(SKIPPED)
    unittest.main()
