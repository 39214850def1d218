#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tasks and merge in a real Slurm of four nodes on this machine, also if parts of it are killed.

usage: slurm_test.py FAKE_RUN [WORD...]
FAKE_RUN has the subcommands of mtstereo-run, with lines of text in place of maps. With words, only
tests whose names have one of them.
"""
import os
import signal
import sys
import time

from cluster_case import Cluster, continue_tasks, run_tests

FAKE_RUN = os.path.abspath(sys.argv.pop(1))
RESULTS = {"a": "".join(f"a {i}: {i} {i + 7}\n" for i in range(10)),
           "b": "".join(f"b {i}: {i} {i + 7}\n" for i in range(7))}
RANGES = ["a 0", "a 4", "a 7", "b 0", "b 4"]


class FakeMaps(Cluster):
    """Tasks whose length the test chooses."""
    program = FAKE_RUN

    def setUp(self):
        super().setUp()
        self.log = self.folder / "log"
        self.cluster.environment["MTSTEREO_FAKE_LOG"] = str(self.log)
        self.slow_down(1)
        self.run_program(FAKE_RUN, "plan", self.plan)

    def slow_down(self, milliseconds):
        self.cluster.environment["MTSTEREO_FAKE_MS"] = str(milliseconds)

    def stop_some(self, number=1):
        """Stops tasks that have written a line."""
        return self.stop_tasks(number, lambda folder: (folder / "disparity.txt").exists())

    def done_ranges(self):
        return sorted(line for line in self.log.read_text().splitlines()
                      if not line.startswith("prepare "))

    def check_whole(self):
        """The bytes of an uncut run, and no task done twice."""
        for name, text in RESULTS.items():
            file = self.plan / "recordings" / name / "disparity.txt"
            self.assertTrue(file.exists(), self.logs())
            self.assertEqual(file.read_text(), text)
        self.assertEqual(self.done_ranges(), RANGES, self.logs())
        self.assertFalse((self.plan / "unfinished").exists())

    def test_array_and_merge_give_the_whole(self):
        submitted, _, _, merge = self.submit()
        self.assertEqual(submitted, 5)
        self.cluster.wait_for_jobs()
        self.check_whole()
        self.assertEqual(self.cluster.state_of(merge), "COMPLETED 0:0", self.logs())
        self.assertEqual(self.submit(), (0, 0, 5, None))

    def test_a_second_call_submits_nothing_that_is_queued_or_running(self):
        self.slow_down(100)
        self.submit()
        tasks = self.stop_some()
        submitted, active, done, merge = self.submit()
        self.assertEqual((submitted, active + done, merge), (0, 5, None))
        self.assertGreater(active, 0)
        continue_tasks(tasks)
        self.cluster.wait_for_jobs()
        self.check_whole()

    def test_tasks_run_on_all_nodes_at_the_same_time(self):
        self.slow_down(500)
        self.submit()
        continue_tasks(self.stop_some(4))
        self.cluster.wait_for_jobs()
        self.check_whole()

    def test_options_reach_sbatch(self):
        self.slow_down(100)
        self.submit("--limit", "1", "--", "--comment=mine", "--nice=7")
        tasks = self.stop_some()
        jobs = self.cluster.call("scontrol", "show", "job")
        continue_tasks(tasks)
        self.assertIn("ArrayTaskThrottle=1", jobs)
        self.assertEqual(jobs.count("Comment=mine"), jobs.count("Nice=7"))
        self.assertGreaterEqual(jobs.count("Comment=mine"), 2)
        self.cluster.wait_for_jobs()
        self.check_whole()

    def test_after_kill_9_of_a_task_only_it_is_submitted_again(self):
        self.slow_down(100)
        _, _, _, merge = self.submit()
        (task,) = self.stop_some()
        os.kill(task, signal.SIGKILL)
        self.cluster.wait_for_jobs()
        self.assertEqual(self.cluster.state_of(merge), "FAILED 3:0", self.logs())
        self.assertIn("1 task is missing", self.logs())
        self.slow_down(1)
        submitted, active, done, _ = self.submit()
        self.assertEqual((submitted, active, done), (1, 0, 4))
        self.cluster.wait_for_jobs()
        self.check_whole()

    def test_after_kill_9_of_a_slurmd_the_result_is_whole(self):
        self.slow_down(500)
        self.submit()
        tasks = self.stop_some(4)
        self.cluster.kill("n1")
        continue_tasks(tasks)
        self.cluster.start_node("n1")
        self.cluster.wait_for_jobs()
        self.check_whole()

    def test_after_kill_9_of_slurmctld_the_result_is_whole(self):
        self.slow_down(100)
        self.submit()
        tasks = self.stop_some()
        # slurmctld loses jobs that it did not store, which it does after some seconds.
        running = time.time()
        state = self.cluster.folder / "state/job_state"
        self.cluster.wait(lambda: state.exists() and state.stat().st_mtime > running,
                          "slurmctld stores nothing")
        self.cluster.kill("slurmctld")
        continue_tasks(tasks)
        self.cluster.start_controller()
        self.cluster.wait_for_jobs()
        self.check_whole()

    def test_a_damaged_piece_is_done_again(self):
        self.submit()
        self.cluster.wait_for_jobs()
        (self.plan / "pieces/1/disparity.txt").write_text("a 4: 4 11\n")
        (self.plan / "recordings/a/disparity.txt").unlink()
        submitted, _, _, _ = self.submit()
        self.assertEqual(submitted, 1)
        self.cluster.wait_for_jobs()
        found = (self.plan / "recordings/a/disparity.txt").read_text()
        self.assertEqual(found, RESULTS["a"])
        self.assertEqual(self.done_ranges(), sorted(RANGES + ["a 4"]))


if __name__ == "__main__":
    sys.exit(run_tests([FakeMaps], sys.argv[1:]))
