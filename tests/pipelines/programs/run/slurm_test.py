#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The commands of docs/cluster.md in a real Slurm of four nodes on this machine; one task is killed.

usage: slurm_test.py FAKE_RUN
FAKE_RUN has the subcommands of mtstereo-run, with lines of text in place of maps.
"""
import os
import pathlib
import re
import signal
import sys
import tempfile
import time
import unittest

from local_slurm import LocalSlurm, NotRunning, missing_programs

FAKE_RUN = os.path.abspath(sys.argv.pop(1))
SKIPPED = 77
RESULTS = {"a": "".join(f"a {i}: {i} {i + 7}\n" for i in range(10)),
           "b": "".join(f"b {i}: {i} {i + 7}\n" for i in range(7))}


class Tasks(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="mtstereo-slurm-", ignore_cleanup_errors=True)
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.plan = self.folder / "plan"
        self.cluster = LocalSlurm(self.folder / "slurm")
        self.addCleanup(self.cluster.stop)
        try:
            self.cluster.start()
        except NotRunning as reason:
            self.skipTest(f"Slurm cannot run here: {reason}")
        self.cluster.environment["MTSTEREO_FAKE_MS"] = "200"
        self.check(self.cluster.run(FAKE_RUN, "plan", self.plan))

    def check(self, done):
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout.strip()

    def submit(self, command, *options):
        return self.check(self.cluster.run(
            "sbatch", "--parsable", f"--output={self.folder}/%x-%j.log", *options,
            f"--wrap={FAKE_RUN} {command} --plan {self.plan}"))

    def logs(self):
        return "".join(file.read_text() for file in sorted(self.folder.glob("*.log")))

    def kill_a_task(self):
        """Kills one that runs, and returns its number."""
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline:
            for folder in self.plan.glob("unfinished/piece-*"):
                task, pid = re.fullmatch(r"piece-(\d+)-.*-(\d+)-\d+", folder.name).groups()
                os.kill(int(pid), signal.SIGKILL)
                return task
            time.sleep(0.001)
        raise AssertionError("no task runs\n" + self.logs())

    # Feature: archives on a cluster
    def test_a_task_that_is_killed_is_done_again(self):
        array = self.submit("task", "--array=0-4")
        merge = self.submit("merge", f"--dependency=afterany:{array}")
        task = self.kill_a_task()
        self.cluster.wait_for_jobs()
        self.assertEqual(self.cluster.state_of(merge), "FAILED 3:0", self.logs())
        self.assertIn(f"1 task is missing: {task};", self.logs())
        array = self.submit("task", f"--array={task}")
        merge = self.submit("merge", f"--dependency=afterany:{array}")
        self.cluster.wait_for_jobs()
        self.assertEqual(self.cluster.state_of(merge), "COMPLETED 0:0", self.logs())
        for name, text in RESULTS.items():
            joined = self.plan / "recordings" / name / "disparity.txt"
            self.assertEqual(joined.read_text(), text, self.logs())


if __name__ == "__main__":
    if missing_programs():
        print(f"skipped: {', '.join(missing_programs())} not installed (packages slurm-wlm and munge)")
        sys.exit(SKIPPED)
    unittest.main(verbosity=2)
