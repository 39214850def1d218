#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Archives with mtstereo-run: processes that are killed, and recordings that are damaged."""

import contextlib
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from processes import is_running

PROGRAM = None  # set below
FRAMES = 120
SKIPPED = 77
OPTIONS = ["--max-disparity", "16"]
VIEWS = {"left": 0, "right": 8}  # columns of a moving test image


def run(*arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True,
                          timeout=120, check=False)


def ffmpeg(*arguments):
    subprocess.run(["ffmpeg", "-v", "error", "-y", *map(str, arguments)], check=True,
                   stdin=subprocess.DEVNULL)


def truncate(file):
    """Keeps the first two thirds."""
    os.truncate(file, file.stat().st_size * 2 // 3)


class Archive(unittest.TestCase):
    """Two recordings: H.264 with B-frames in mp4, and the same in mkv. Each test has a copy."""

    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="mtstereo-archive-"))
        cls.original = cls.folder / "original"
        cls.original.mkdir()
        for view, column in VIEWS.items():
            first = cls.original / f"first-{view}.mp4"
            ffmpeg("-f", "lavfi", "-i", "testsrc2=size=168x96:rate=30", "-frames:v", FRAMES, "-vf",
                   f"crop=160:96:{column}:0", "-c:v", "libx264", "-preset", "veryfast", "-bf", 2,
                   "-g", 30, first)
            ffmpeg("-i", first, "-c", "copy", cls.original / f"second-{view}.mkv")
        cls.whole = cls.folder / "whole"
        done = run(cls.original, "--out", cls.whole, *OPTIONS)
        assert done.returncode == 0, done.stderr

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def setUp(self):
        own = self.folder / self.id().rsplit(".", 1)[1]
        self.archive, self.out = own / "archive", own / "out"
        shutil.copytree(self.original, self.archive)

    def run_program(self, *arguments, expected):
        done = run(*arguments)
        self.assertEqual(done.returncode, expected, done.stdout + done.stderr)
        return done

    def assert_same(self, found, recording):
        self.assertEqual((found / "disparity.mkv").read_bytes(),
                         (self.whole / recording / "disparity.mkv").read_bytes())


class Jobs(Archive):
    """A run with processes that is killed in the middle."""

    def setUp(self):
        super().setUp()
        self.command = [PROGRAM, self.archive, "--out", self.out, "--jobs", 2, *OPTIONS]
        self.process = subprocess.Popen([str(word) for word in self.command], text=True,
                                        stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)

    def stopped_tasks(self, number):
        """The processes of tasks that are stopped in the middle of their pairs."""
        deadline = time.monotonic() + 60
        stopped = []
        while len(stopped) < number:
            self.assertLess(time.monotonic(), deadline, "no task was found in the middle")
            for journal in self.out.glob("plan/unfinished/piece-*/unfinished/journal"):
                pid = int(re.fullmatch(r"piece-\d+-.*-(\d+)-\d+", journal.parts[-3])[1])
                if len(stopped) == number or pid in stopped or not self.is_in_the_middle(journal):
                    continue
                with contextlib.suppress(ProcessLookupError):  # it has just ended
                    os.kill(pid, signal.SIGSTOP)
                    if self.is_in_the_middle(journal):
                        stopped.append(pid)
                    else:
                        os.kill(pid, signal.SIGCONT)
            time.sleep(0.001)
        return stopped

    @staticmethod
    def is_in_the_middle(journal):
        try:
            return journal.read_text().count("\n") > 3
        except FileNotFoundError:
            return False

    def pieces(self):
        return {file: file.stat().st_mtime_ns for file in self.out.glob("plan/pieces/*/*")}

    def check_resumed(self):
        """The rest is done, and nothing else, with the bytes of a run of one process."""
        tasks = len(json.loads((self.out / "plan/plan.json").read_text())["tasks"])
        before = self.pieces()
        missing = tasks - len(list(self.out.glob("plan/pieces/*")))
        self.assertGreater(missing, 0)
        done = self.run_program(*self.command[1:], "--resume", expected=0)
        self.assertIn(f"{missing} of {missing} task", done.stderr)
        self.assertEqual({file: time for file, time in self.pieces().items() if file in before}, before)
        for recording in ("first", "second"):
            self.assert_same(self.out / recording, recording)
        self.assertFalse((self.out / "plan/unfinished").exists())

    def end_parent(self, number):
        """Ends the parent by a signal in the middle of its tasks, which end too. Its messages."""
        tasks = self.stopped_tasks(2)
        self.process.send_signal(number)
        _, messages = self.process.communicate(timeout=60)
        for pid in tasks:
            os.kill(pid, signal.SIGCONT)
        deadline = time.monotonic() + 60
        while any(is_running(pid) for pid in tasks):
            self.assertLess(time.monotonic(), deadline, "a task still runs")
            time.sleep(0.02)
        return messages

    # Feature: archives on a cluster
    def test_killed_parent_ends_its_tasks_and_is_resumed(self):
        self.end_parent(signal.SIGKILL)
        self.check_resumed()

    def test_interrupted_parent_ends_its_tasks_and_is_resumed(self):
        messages = self.end_parent(signal.SIGINT)
        self.assertEqual(self.process.returncode, 3, messages)
        self.assertTrue(messages.endswith("mtstereo-run: interrupted; --resume continues\n"), messages)
        self.assertEqual(list(self.out.glob("plan/unfinished/*")), [])
        self.check_resumed()

    def test_killed_task_is_named_and_resumed(self):
        (task,) = self.stopped_tasks(1)
        os.kill(task, signal.SIGKILL)
        _, messages = self.process.communicate(timeout=120)
        self.assertEqual(self.process.returncode, 3, messages)
        self.assertRegex(messages, r"mtstereo-run: task \d+ was ended by signal 9\n")
        self.assertRegex(messages, r"1 task is missing: \d+; --resume does them")
        self.check_resumed()

    def test_results_of_other_options_are_not_continued(self):
        _, messages = self.process.communicate(timeout=120)
        self.assertEqual(self.process.returncode, 0, messages)
        before = self.pieces()
        for other in ([self.archive, "--max-disparity", 48], [self.archive / "first-left.mp4",
                      self.archive / "first-right.mp4", *OPTIONS]):
            done = self.run_program(*other, "--out", self.out, "--jobs", 2, "--resume", expected=1)
            self.assertIn("has results of another input or other options", done.stderr)
        self.assertEqual(self.pieces(), before)
        # A recording that is new is added; what is joined stays.
        for view in VIEWS:
            shutil.copy(self.archive / f"first-{view}.mp4", self.archive / f"third-{view}.mp4")
        done = self.run_program(*self.command[1:], "--resume", expected=0)
        self.assertIn(f"first: {FRAMES} pairs, 2 tasks, prepared before", done.stderr)
        self.assertIn("2 of 2 tasks", done.stderr)
        self.assert_same(self.out / "third", "first")


class Damage(Archive):
    """Recordings that cannot be read, or not to their end."""

    def plan(self, expected):
        done = self.run_program("plan", self.archive, "--out", self.out, "--pairs-per-task", 60,
                                *OPTIONS, expected=expected)
        self.tasks = json.loads((self.out / "plan.json").read_text())["tasks"]
        return done

    def do_tasks(self, expected=0):
        return "".join(self.run_program("task", number, "--plan", self.out, expected=expected).stderr
                       for number in range(len(self.tasks)))

    def merge(self):
        """The messages and the summary of a merge that is not complete."""
        done = self.run_program("merge", "--plan", self.out, expected=3)
        return done.stderr, json.loads((self.out / "summary.json").read_text())

    def test_truncated_recording_is_named_and_done_to_its_end(self):
        file = self.archive / "second-right.mkv"
        truncate(file)
        self.assertRegex(self.plan(expected=3).stderr,
                         rf"mtstereo-run: {file}: the file is truncated after \d\.\d+ s")
        self.assertEqual(self.do_tasks(), "")
        messages, summary = self.merge()
        self.assertIn(f"{file}: the file is truncated", messages)
        self.assertEqual([each["input"] for each in summary["damaged"]], [str(file)])
        self.assertEqual(summary["missing_tasks"], [])
        self.assert_same(self.out / "recordings/first", "first")
        uncut = self.folder / "uncut"
        self.run_program(self.archive / "second-left.mkv", file, "--out", uncut, *OPTIONS, expected=3)
        self.assertEqual((self.out / "recordings/second/disparity.mkv").read_bytes(),
                         (uncut / "disparity.mkv").read_bytes())
        pairs = {each["name"]: each["pairs"] for each in summary["recordings"]}
        self.assertEqual(pairs["first"], FRAMES)
        self.assertTrue(FRAMES // 3 < pairs["second"] < FRAMES, pairs)

    def test_frames_that_cannot_be_decoded_are_named_by_task_and_merge(self):
        self.plan(expected=0)
        file = self.archive / "second-right.mkv"
        with open(file, "r+b") as stream:  # in the middle, where the plan decodes nothing
            stream.seek(file.stat().st_size // 2)
            stream.write(bytes(3000))
        self.assertRegex(self.do_tasks(), r"task \d: .*right view .*cannot be decoded")
        messages, summary = self.merge()
        self.assertRegex(messages, r"mtstereo-run: second: .*right view .*cannot be decoded")
        self.assertEqual([each["input"] for each in summary["damaged"]], ["second"])
        first, second = summary["recordings"]
        self.assertEqual(first["damage"], "")
        self.assertRegex(second["damage"], "cannot be decoded")
        self.assertTrue(FRAMES // 2 < second["pairs"] < FRAMES, second)
        self.assert_same(self.out / "recordings/first", "first")

    def test_recording_that_is_exchanged_after_the_plan_is_not_taken_for_damaged(self):
        self.plan(expected=0)
        truncate(self.archive / "second-right.mkv")
        done = self.run_program("task", len(self.tasks) - 1, "--plan", self.out, expected=1)
        self.assertIn("second-right.mkv: has another size than when it was planned", done.stderr)
        self.assertFalse((self.out / "pieces").exists())

    def test_unreadable_recording_is_left_out_and_named(self):
        file = self.archive / "first-left.mp4"
        file.write_text("no video")
        self.assertIn(f"mtstereo-run: {file}: the video cannot be read", self.plan(expected=3).stderr)
        self.do_tasks()
        messages, summary = self.merge()
        self.assertIn(f"{file}: the video cannot be read", messages)
        self.assertEqual([each["input"] for each in summary["problems"]], [str(file)])
        self.assertEqual([each["name"] for each in summary["recordings"]], ["second"])
        self.assert_same(self.out / "recordings/second", "second")

    def test_recording_that_is_removed_after_the_plan_is_named_by_its_tasks(self):
        self.plan(expected=0)
        file = self.archive / "first-left.mp4"
        file.unlink()
        for number, task in enumerate(self.tasks):
            missing = task["recording"] == "first"
            done = self.run_program("task", number, "--plan", self.out, expected=int(missing))
            self.assertEqual(str(file) in done.stderr, missing)
        messages, summary = self.merge()
        self.assertIn("2 tasks are missing: 0-1; do them and merge again", messages)
        self.assertEqual(summary["missing_tasks"], [0, 1])
        self.assert_same(self.out / "recordings/second", "second")


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    if shutil.which("ffmpeg") is None:
        print("ffmpeg is not installed")
        sys.exit(SKIPPED)
    unittest.main(verbosity=2)
