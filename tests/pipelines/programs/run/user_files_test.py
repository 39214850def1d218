#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The program mtstereo-run keeps what it did not write, and ends when it is told to."""

import json
import os
import pathlib
import shutil
import signal
import subprocess
import time

import program_case
from program_case import SHORT, ProgramCase, run


class UserFiles(ProgramCase):
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
        first = subprocess.Popen([program_case.PROGRAM, *map(str, self.command())], stderr=subprocess.DEVNULL)
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
            shutil.copy(os.fsencode(self.short_left), archive + b"/" + name + b"/left.mp4")
            shutil.copy(os.fsencode(self.short_right), archive + b"/" + name + b"/right.mp4")
        with open(archive + b"/good/right.mp4", "ab") as stream:  # a box with an impossible name
            stream.write(b"\0\1\x86\xa0\xff\x1b\0\xfcxxxx")
        for more in ([], ["--jobs", "2"]):
            out = self.out().with_suffix(f".{len(more)}")
            result = subprocess.run(
                [program_case.PROGRAM, archive, "--out", out, "--max-disparity", "32", *more],
                capture_output=True, timeout=120, check=False,
            )
            messages = (result.stdout + result.stderr).decode()  # valid UTF-8
            self.assertEqual(result.returncode, 3, messages)
            self.assertIn(r"bytes of its box '\xff\x1b\x00\xfc' are missing", messages)
            self.assertNotIn("\x1b", messages)
            for name in (r"bad\xff", r"red\x1b[31m", "good"):
                report = json.loads((out / name / "run.json").read_text())
                self.assertEqual(report["processed_pairs"], SHORT)
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
                    [program_case.PROGRAM, *map(str, command), "--out", str(self.out())], stderr=subprocess.PIPE, text=True
                )
                self.wait_for_handler(process.pid, number)
                process.send_signal(number)
                _, messages = process.communicate(timeout=60)
                self.assertEqual(process.returncode, 3, messages)
                self.assertEqual(messages, "mtstereo-run: interrupted; --resume continues\n")
                self.assertFalse(self.out().exists())


if __name__ == "__main__":
    program_case.main()
