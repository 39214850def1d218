#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The subcommands of mtstereo-run for plans, with lines of text in place of maps (fake_run.cpp)."""
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

from processes import is_running

FAKE_RUN = os.path.abspath(sys.argv.pop(1))
SOURCE = pathlib.Path(__file__).resolve().parents[4]
INDEXES = ("SLURM_ARRAY_TASK_ID", "JOB_COMPLETION_INDEX", "AWS_BATCH_JOB_ARRAY_INDEX",
           "SLURM_CPUS_PER_TASK", "SLURM_CPUS_ON_NODE")
RESULTS = {"a": "".join(f"a {i}: {i} {i + 7}\n" for i in range(10)),
           "b": "".join(f"b {i}: {i} {i + 7}\n" for i in range(7))}


class Program(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="mtstereo-run-")
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.plan = self.folder / "plan"
        self.log = self.folder / "log"
        self.environment = {name: value for name, value in os.environ.items() if name not in INDEXES}
        self.environment["MTSTEREO_FAKE_LOG"] = str(self.log)
        self.run_program("plan", self.plan, expected=0)

    def run_program(self, *arguments, expected, **variables):
        done = subprocess.run([FAKE_RUN, *map(str, arguments)], capture_output=True, text=True,
                              timeout=60, check=False, cwd=self.folder,
                              env={**self.environment, **variables})
        self.assertEqual(done.returncode, expected, done.stdout + done.stderr)
        return done

    def log_lines(self, preparation=False):
        return sorted(line for line in self.log.read_text().splitlines()
                      if line.startswith("prepare ") == preparation)

    def done_ranges(self):
        return self.log_lines()

    def check_results(self):
        for name, text in RESULTS.items():
            found = (self.plan / "recordings" / name / "disparity.txt").read_text()
            self.assertEqual(found, text)

    def test_tasks_and_merge_give_the_whole(self):
        for number in range(5):
            done = self.run_program("task", number, "--plan", self.plan, expected=0)
            self.assertRegex(done.stdout, rf"^task {number}: [34] pairs")
        self.run_program("task", 4, "--plan", self.plan, expected=0)
        done = self.run_program("merge", "--plan", self.plan, expected=0)
        self.assertIn("2 of 2 recordings joined, 17 pairs", done.stdout)
        self.check_results()
        self.assertEqual(self.done_ranges(), ["a 0", "a 4", "a 7", "b 0", "b 4"])

    def test_the_number_comes_from_the_index_of_the_scheduler(self):
        for number, name in enumerate(INDEXES[:3]):
            done = self.run_program("task", "--plan", self.plan, expected=0, **{name: str(number)})
            self.assertIn(f"task {number}:", done.stdout)
        done = self.run_program("task", "--plan", self.plan, "--first", 2, expected=0,
                                SLURM_ARRAY_TASK_ID="1")
        self.assertIn("task 3:", done.stdout)
        done = self.run_program("task", "4", "--plan", self.plan, expected=0,
                                SLURM_ARRAY_TASK_ID="1")
        self.assertIn("task 4:", done.stdout)
        self.run_program("merge", "--plan", self.plan, expected=0)
        self.check_results()

    def test_wrong_commands_are_refused(self):
        for arguments in (["task"], ["task", "x"], ["task", "-1"], ["task", "1", "--threads", "-1"],
                          ["task", "1", "2"], ["merge", "x"], ["merge", "--jobs", "0"],
                          ["slurm"]):
            with self.subTest(arguments):
                self.run_program(*arguments, expected=2)
        self.run_program("task", "--plan", self.plan, expected=2, SLURM_ARRAY_TASK_ID="x")

    def test_help_is_no_error(self):
        for name in ("task", "merge"):
            done = self.run_program(name, "--help", expected=0)
            self.assertIn(f"Usage: mtstereo-run {name} ", done.stdout)
            self.assertLessEqual(max(map(len, done.stdout.splitlines())), 100)

    def test_errors_name_their_reason(self):
        done = self.run_program("task", "0", "--plan", "nowhere", expected=1)
        self.assertIn("nowhere/plan.json: there is no plan", done.stderr)
        done = self.run_program("task", "9", "--plan", self.plan, expected=1)
        self.assertIn("there is no task 9", done.stderr)

    def test_missing_tasks_are_stated(self):
        self.run_program("task", 1, "--plan", self.plan, expected=0)
        done = self.run_program("merge", "--plan", self.plan, expected=3)
        self.assertIn("4 tasks are missing: 0,2-4; do them and merge again", done.stderr)
        summary = json.loads((self.plan / "summary.json").read_text())
        self.assertEqual(summary["missing_tasks"], [0, 2, 3, 4])

    def start_slow(self, *arguments):
        return subprocess.Popen([FAKE_RUN, *map(str, arguments)], stdout=subprocess.DEVNULL,
                                stderr=subprocess.DEVNULL, cwd=self.folder,
                                env={**self.environment, "MTSTEREO_FAKE_MS": "400"})

    def wait_for(self, pattern):
        """Waits for a file in the plan."""
        deadline = time.monotonic() + 30
        while not list(self.plan.glob(pattern)):
            self.assertLess(time.monotonic(), deadline, f"there is no {pattern}")
            time.sleep(0.01)

    def wait_for_unfinished(self):
        self.wait_for("unfinished/*/disparity.txt")

    def test_a_killed_task_is_done_by_the_next_run(self):
        task = self.start_slow("task", 0, "--plan", self.plan)
        self.wait_for_unfinished()
        task.kill()
        task.wait()
        self.assertFalse((self.plan / "pieces/0").exists())
        done = self.run_program("jobs", self.folder, 2, expected=0)
        self.assertIn("5 of 5 tasks", done.stderr)
        self.check_results()
        self.assertEqual(self.done_ranges(), ["a 0", "a 4", "a 7", "b 0", "b 4"])
        self.assertFalse((self.plan / "unfinished").exists())

    def test_a_terminated_task_removes_what_is_unfinished(self):
        environment = {**self.environment, "MTSTEREO_FAKE_MS": "100"}
        with subprocess.Popen([FAKE_RUN, "task", "0", "--plan", self.plan], env=environment,
                              stderr=subprocess.PIPE, text=True) as task:
            self.wait_for_unfinished()
            task.send_signal(signal.SIGTERM)
            time.sleep(0.03)  # until it is handled
            task.send_signal(signal.SIGSTOP)  # as if the machine were busy
            time.sleep(3)
            task.send_signal(signal.SIGCONT)
            _, errors = task.communicate(timeout=30)
        self.assertEqual(task.returncode, 1, errors)
        self.assertIn("task 0 (a): stopped after", errors)
        self.assertEqual(list((self.plan / "unfinished").iterdir()), [])

    def test_planning_that_was_killed_keeps_what_is_prepared(self):
        self.plan = self.folder / "second"
        self.log.unlink()
        planning = self.start_slow("plan", self.plan)
        self.wait_for("works/a.key")
        planning.kill()
        planning.wait()
        self.assertFalse((self.plan / "plan.json").exists())
        done = self.run_program("plan", self.plan, expected=0)
        self.assertIn("a: 10 pairs, 3 tasks, prepared before\n", done.stderr)
        self.assertIn("b: 7 pairs, 2 tasks\n", done.stderr)
        self.assertEqual(self.log_lines(preparation=True), ["prepare a", "prepare b"])

    def test_planning_again_keeps_what_is_done(self):
        before = (self.plan / "plan.json").read_text()
        self.run_program("task", 1, "--plan", self.plan, expected=0)
        done = self.run_program("plan", self.plan, expected=1)
        self.assertIn("has a plan already", done.stderr)
        self.run_program("replan", self.plan, expected=0)
        self.assertEqual((self.plan / "plan.json").read_text(), before)
        self.run_program("jobs", self.folder, 2, expected=0)
        self.check_results()
        self.assertEqual(self.done_ranges(), ["a 0", "a 4", "a 7", "b 0", "b 4"])

    def test_jobs_leave_the_files_of_a_run_without_them(self):
        for _ in range(2):
            self.run_program("jobs", self.folder, 2, expected=0)
            for name, text in RESULTS.items():
                self.assertEqual((self.folder / name / "disparity.txt").read_text(), text)
                self.assertEqual(sorted(file.name for file in (self.folder / name).iterdir()),
                                 ["disparity.txt", "run.json"])

    def test_jobs_do_nothing_twice(self):
        self.run_program("task", 1, "--plan", self.plan, expected=0)
        done = self.run_program("jobs", self.folder, 3, expected=0)
        self.assertIn("4 of 4 tasks", done.stderr)
        self.check_results()
        self.run_program("jobs", self.folder, 3, expected=0)
        self.assertEqual(self.done_ranges(), ["a 0", "a 4", "a 7", "b 0", "b 4"])

    def test_jobs_end_with_their_parent(self):
        parent = self.start_slow("jobs", self.folder, 2)
        self.wait_for_unfinished()
        children = pathlib.Path(f"/proc/{parent.pid}/task").glob("*/children")
        pids = [int(pid) for file in children for pid in file.read_text().split()]
        parent.kill()
        parent.wait()
        self.assertTrue(pids)
        deadline = time.monotonic() + 30
        while any(is_running(pid) for pid in pids):
            self.assertLess(time.monotonic(), deadline, "a process still runs")
            time.sleep(0.05)

    def test_a_task_that_fails_does_not_stop_the_others(self):
        (self.plan / "works/a.json").write_text('{"kind":"work of mtstereo-run"')  # cut off
        done = self.run_program("jobs", self.folder, 2, expected=3)
        self.assertRegex(done.stderr, r"(?m)^mtstereo-run: task 0 \(a\): .*works/a.json: is damaged")
        self.assertIn("mtstereo-run: 3 tasks are missing: 0-2; --resume does them", done.stderr)
        found = (self.folder / "b/disparity.txt").read_text()
        self.assertEqual(found, RESULTS["b"])

    def test_commands_of_the_page_do_what_it_states(self):
        page = (SOURCE / "docs/cluster.md").read_text()
        lists = re.findall(r'"?command"?: (\["mtstereo-run".*\])', page)
        commands = [json.loads(text)[1:] for text in lists]
        self.assertEqual([command[0] for command in commands], ["task", "merge"])
        task, merge = ([str(self.plan) if word == "/results/plan" else word for word in command]
                       for command in commands)
        for variable, numbers in ("JOB_COMPLETION_INDEX", range(3)), ("AWS_BATCH_JOB_ARRAY_INDEX", range(3, 5)):
            for number in numbers:
                self.run_program(*task, expected=0, **{variable: str(number)})
        self.run_program(*merge, expected=0)
        self.check_results()
        self.assertEqual(self.done_ranges(), ["a 0", "a 4", "a 7", "b 0", "b 4"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
