# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the tests of the program mtstereo-run share: two short videos, and a run of them."""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = None  # set by main()
FRAMES = 120
SHORT = 20
SKIPPED = 77


def run(*arguments):
    return subprocess.run(
        [PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=120, check=False
    )


def make_videos(column, files):
    """A part of a moving test image by ffmpeg: views whose columns differ are a stereo pair. `files`: their frames."""
    command = ["ffmpeg", "-v", "error", "-y", "-f", "lavfi", "-i", "testsrc2=size=168x96:rate=30"]
    for file, frames in files.items():
        command += ["-frames:v", frames, "-vf", f"crop=160:96:{column}:0", "-c:v", "libx264"]
        command += ["-preset", "veryfast", "-bf", "2", "-g", "30", file]
    subprocess.run(list(map(str, command)), check=True, stdin=subprocess.DEVNULL)


class ProgramCase(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="mtstereo-run-"))
        cls.left = cls.folder / "left.mp4"
        cls.right = cls.folder / "right.mp4"
        cls.short_left = cls.folder / "short-left.mp4"  # where the number of frames is no matter
        cls.short_right = cls.folder / "short-right.mp4"
        make_videos(0, {cls.left: FRAMES, cls.short_left: SHORT})
        make_videos(8, {cls.right: FRAMES, cls.short_right: SHORT})
        cls.whole = cls.folder / "whole"
        cls.first = run(cls.left, cls.right, "--out", cls.whole, "--max-disparity", 32)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def out(self):
        return self.folder / self.id().rsplit(".", 1)[1]

    def command(self, *options):
        return [self.left, self.right, "--out", self.out(), "--max-disparity", 32, *options]

    def pipe(self):
        pipe = self.folder / "pipe"
        if not pipe.exists():
            os.mkfifo(pipe)
        return pipe

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


def main():
    """Runs the tests of the calling script; its first argument is the program."""
    global PROGRAM
    PROGRAM = sys.argv.pop(1)
    if shutil.which("ffmpeg") is None:
        print("ffmpeg is not installed")
        sys.exit(SKIPPED)
    unittest.main()
