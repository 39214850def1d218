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
SKIPPED = 77


def run(*arguments):
    return subprocess.run(
        [PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=120, check=False
    )


def make_video(file, column, frames=FRAMES):
    """A part of a moving test image by ffmpeg: views whose columns differ are a stereo pair."""
    subprocess.run(
        ["ffmpeg", "-v", "error", "-y", "-f", "lavfi", "-i", "testsrc2=size=168x96:rate=30"]
        + ["-frames:v", str(frames), "-vf", f"crop=160:96:{column}:0"]
        + ["-c:v", "libx264", "-preset", "veryfast", "-bf", "2", "-g", "30", str(file)],
        check=True,
        stdin=subprocess.DEVNULL,
    )


class ProgramCase(unittest.TestCase):
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
