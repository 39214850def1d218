#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Recordings in a real Slurm whose parts are killed: the bytes of an uncut run, nothing done twice.

usage: recordings_test.py MTSTEREO_RUN MTSTEREO_RENDER [WORD...]
Two recordings of a rendered street: H.264 in mp4 with B-frames, and mkv with a variable rate. With
words, only tests whose names have one of them.
"""
import concurrent.futures
import itertools
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

from cluster_case import SKIPPED, Cluster, continue_tasks, is_running, run_tests

MTSTEREO_RUN, MTSTEREO_RENDER = (os.path.abspath(sys.argv.pop(1)) for _ in range(2))
FRAMES = 200
PAIRS_PER_TASK = 50
TASKS = 2 * FRAMES // PAIRS_PER_TASK
OPTIONS = ["--what", "disparity,confidence", "--threads", "1", "--max-disparity", "48"]
# Periods of 20 to 60 ms.
VARIABLE = "settb=1/1000,setpts=1000*(N/25+0.01*mod(N*N\\,7))"
CODINGS = {"constant.mp4": ["-vf", "null"],
           "variable.mkv": ["-vf", VARIABLE, "-vsync", "passthrough", "-enc_time_base", "1:1000"]}


def run(*arguments):
    subprocess.run([str(word) for word in arguments], check=True, stdin=subprocess.DEVNULL)


class Archive:
    """The recordings, and the results of a run of one process without pieces."""

    def __init__(self, folder):
        self.folder = folder / "archive"
        self.whole = folder / "whole"
        self.folder.mkdir()
        # Half of the frames are rendered; both halves of the recordings show them.
        run(MTSTEREO_RENDER, folder / "clip", "--size", "192x108", "--frames", FRAMES // 2, "--samples",
            "1")
        for (name, coding), side in itertools.product(CODINGS.items(), ("left", "right")):
            recording, ending = name.split(".")
            run("ffmpeg", "-v", "error", "-framerate", "25", "-stream_loop", "1", "-i",
                folder / f"clip/{side}/%06d.png", *coding, "-pix_fmt", "yuv420p", "-c:v", "libx264",
                "-preset", "veryfast", "-bf", "2", "-g", "20", self.folder / f"{recording}-{side}.{ending}")
        shutil.rmtree(folder / "clip")
        run(MTSTEREO_RUN, self.folder, "--out", self.whole, "--quiet", *OPTIONS)

    def check(self):
        """The recordings are those of the description."""
        for recording, ending in (name.split(".") for name in CODINGS):
            frames = json.loads(subprocess.run(
                ["ffprobe", "-v", "error", "-show_entries", "frame=pts_time,pict_type", "-of", "json",
                 self.folder / f"{recording}-left.{ending}"], check=True, capture_output=True).stdout)
            times = [float(frame["pts_time"]) for frame in frames["frames"]]
            periods = {round(1000 * (b - a)) for a, b in zip(times, times[1:])}
            variable = recording == "variable"
            if (len(times) != FRAMES or (len(periods) > 3) != variable or
                    not any(frame["pict_type"] == "B" for frame in frames["frames"])):
                raise AssertionError(f"{recording}: {len(times)} frames, periods {periods} ms")
        return self


ARCHIVE = concurrent.futures.Future()


def without_times(report):
    """The figures of a report but the time of the matcher."""
    return [frame[:-1] for frame in json.loads(report.read_text())["frames"]]


class Recordings(Cluster):
    """A plan of both recordings."""
    program = MTSTEREO_RUN

    def setUp(self):
        super().setUp()
        self.archive = ARCHIVE.result()
        self.run_program(MTSTEREO_RUN, "plan", self.archive.folder, "--out", self.plan,
                         "--pairs-per-task", PAIRS_PER_TASK, *OPTIONS)

    def stopped_task(self):
        """The process of a task that is stopped in the middle of its pairs, and its node."""
        (pid,) = self.stop_tasks(1, lambda folder: 3 < pairs_in(folder) < PAIRS_PER_TASK)
        return pid, environment_of(pid)["SLURMD_NODENAME"]

    def check_whole(self):
        """The bytes of an uncut run, and every pair in one task that ended once."""
        for recording in (name.split(".")[0] for name in CODINGS):
            joined, whole = self.plan / "recordings" / recording, self.archive.whole / recording
            for file in ("disparity.mkv", "confidence.mkv"):
                self.assertTrue((joined / file).exists(), self.logs())
                self.assertEqual((joined / file).read_bytes(), (whole / file).read_bytes(),
                                 f"{recording}: {file}")
            self.assertEqual(without_times(joined / "run.json"), without_times(whole / "run.json"))
        ended = re.findall(r"^task (\d+): (\d+) pairs", self.logs(), re.MULTILINE)
        self.assertEqual(sorted((int(task), int(pairs)) for task, pairs in ended),
                         [(task, PAIRS_PER_TASK) for task in range(TASKS)], self.logs())
        self.assertFalse((self.plan / "unfinished").exists())


class KilledParts(Recordings):
    """What is killed is started again."""

    def test_after_kill_9_of_a_task_only_it_is_done_again(self):
        self.assertEqual(self.submit()[:3], (TASKS, 0, 0))
        pid, _ = self.stopped_task()
        os.kill(pid, signal.SIGKILL)
        self.cluster.wait_for_jobs()
        before = {file: file.stat().st_mtime_ns for file in self.plan.glob("pieces/*/*")}
        self.assertEqual(self.submit()[:3], (1, 0, TASKS - 1), self.logs())
        self.cluster.wait_for_jobs()
        self.check_whole()
        self.assertEqual({file: file.stat().st_mtime_ns for file in before}, before)

    def test_after_kill_9_of_a_slurmd_its_task_continues(self):
        self.submit()
        pid, node = self.stopped_task()
        self.cluster.kill(node)
        continue_tasks([pid])
        self.cluster.wait(lambda: not is_running(pid), "the task does not end")
        self.cluster.start_node(node)
        self.cluster.wait_for_jobs()
        self.assertEqual(self.submit(), (0, 0, TASKS, None), self.logs())
        self.check_whole()

    def test_after_kill_9_of_slurmctld_tasks_continue(self):
        self.submit()
        pid, _ = self.stopped_task()
        # slurmctld loses jobs that it did not store, which it does after some seconds.
        stopped = time.time()
        state = self.cluster.folder / "state/job_state"
        self.cluster.wait(lambda: state.exists() and state.stat().st_mtime > stopped,
                          "slurmctld stores nothing")
        self.cluster.kill("slurmctld")
        continue_tasks([pid])
        self.cluster.wait(lambda: not is_running(pid), "the task does not end")
        self.cluster.start_controller()
        self.cluster.wait_for_jobs()
        self.assertEqual(self.submit(), (0, 0, TASKS, None), self.logs())
        self.check_whole()


class LostNode(Recordings):
    """A node that stays away."""
    cluster_options = {"node_timeout": 10, "requeue_delay": 5}

    def test_its_task_is_done_by_another_node(self):
        self.submit()
        pid, node = self.stopped_task()
        supervisor = parent_of(pid)
        self.cluster.kill(node)
        for process in (supervisor, pid):
            os.kill(process, signal.SIGKILL)
        self.cluster.wait_for_jobs()
        self.check_whole()


def pairs_in(folder):
    """The pairs that an unfinished task has done."""
    try:
        return (folder / "unfinished/journal").read_text().count("\n") - 1
    except FileNotFoundError:
        return 0


def environment_of(pid):
    words = pathlib.Path(f"/proc/{pid}/environ").read_bytes().decode(errors="replace").split("\0")
    return dict(word.split("=", 1) for word in words if "=" in word)


def parent_of(pid):
    return int(pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[1])


def make_archive(folder):
    try:
        ARCHIVE.set_result(Archive(folder).check())
    except BaseException as error:  # for the tests that wait for it
        ARCHIVE.set_exception(error)


def main():
    if shutil.which("ffmpeg") is None:
        print("skipped: ffmpeg is not installed")
        return SKIPPED
    with tempfile.TemporaryDirectory(prefix="mtstereo-archive-") as folder:
        with concurrent.futures.ThreadPoolExecutor(1) as pool:
            pool.submit(make_archive, pathlib.Path(folder))
            return run_tests([LostNode, KilledParts], sys.argv[1:])


if __name__ == "__main__":
    sys.exit(main())
