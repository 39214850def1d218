# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the tests of Slurm share: a cluster for each test, and tests that run at the same time."""
import concurrent.futures
import contextlib
import os
import pathlib
import re
import signal
import tempfile
import time
import unittest

from local_slurm import LocalSlurm, NotRunning, missing_programs

SKIPPED = 77
# Tests wait for the scheduler most of the time, which looks for work once a second.
TESTS_AT_THE_SAME_TIME = 5


class Cluster(unittest.TestCase):
    """A cluster for each test, and a folder for a plan."""
    program = None
    cluster_options = {}

    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="mtstereo-slurm-", ignore_cleanup_errors=True)
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.plan = self.folder / "a plan"
        self.cluster = LocalSlurm(self.folder / "slurm", **self.cluster_options)
        self.addCleanup(self.cluster.stop)
        self.cluster.start()

    def run_program(self, program, *arguments):
        done = self.cluster.run(program, *arguments)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def submit(self, *options):
        """Submits what is missing; the numbers of tasks (submitted, active, done) and the merge."""
        text = self.run_program(self.program, "slurm", "--plan", self.plan, *options)
        found = re.search(r"\d tasks: (\d+) done, (\d+) queued or running, (\d+) submitted", text)
        merge = re.search(r"merge: job (\d+)", text)
        done, active, submitted = map(int, found.groups())
        return submitted, active, done, merge and merge[1]

    def logs(self):
        return "".join(f"== {file.name}\n{file.read_text()}"
                       for file in sorted(self.plan.glob("log/*")))

    def running_tasks(self):
        """The processes of tasks that run, with their folders of unfinished files."""
        for folder in self.plan.glob("unfinished/piece-*"):
            pid = int(re.fullmatch(r"piece-\d+-.*-(\d+)-\d+", folder.name)[1])
            if is_running(pid):
                yield pid, folder

    def stop_tasks(self, number, in_the_middle):
        """Stops tasks that run, so that what follows happens in the middle of them. Their processes.

        in_the_middle(folder): whether a task has begun with its pairs and has more to do.
        """
        deadline = time.monotonic() + 60
        stopped = []
        while time.monotonic() < deadline:
            for pid, folder in self.running_tasks():
                if pid in stopped or not in_the_middle(folder):
                    continue
                with contextlib.suppress(ProcessLookupError):  # it has just ended
                    os.kill(pid, signal.SIGSTOP)
                    self.addCleanup(end_if_stopped, pid)
                    if in_the_middle(folder):
                        stopped.append(pid)
                    else:
                        os.kill(pid, signal.SIGCONT)
                if len(stopped) == number:
                    return stopped
            time.sleep(0.001)
        raise AssertionError(f"{len(stopped)} of {number} tasks were stopped\n" + self.logs())


def continue_tasks(pids):
    for pid in pids:
        os.kill(pid, signal.SIGCONT)


def state_of(pid):
    """The letter of a process's state; X: there is none."""
    try:
        return pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
    except (FileNotFoundError, ProcessLookupError):
        return "X"


def is_running(pid):
    return state_of(pid) not in "ZX"


def end_if_stopped(pid):
    if state_of(pid) == "T":
        os.kill(pid, signal.SIGKILL)


def reason_to_skip():
    """Why Slurm cannot run on this machine; empty if it can."""
    missing = missing_programs()
    if missing:
        return f"{', '.join(missing)} not installed (packages slurm-wlm and munge)"
    with tempfile.TemporaryDirectory(prefix="mtstereo-slurm-", ignore_cleanup_errors=True) as folder:
        cluster = LocalSlurm(pathlib.Path(folder) / "slurm")
        try:
            cluster.start()
        except NotRunning as reason:
            return f"Slurm cannot run here: {reason}"
        finally:
            cluster.stop()
    return ""


def tests_of(suite, words):
    """All tests of a suite, or those whose name has one of the words."""
    for test in suite:
        if isinstance(test, unittest.TestSuite):
            yield from tests_of(test, words)
        elif not words or any(word in test.id() for word in words):
            yield test


def run_one(test):
    start = time.monotonic()
    result = unittest.TestResult()
    test.run(result)
    failures = "".join(text for _, text in result.failures + result.errors)
    print(f"{test.id()}: {'failed' if failures else 'ok'}, {time.monotonic() - start:.1f} s\n{failures}",
          end="", flush=True)
    return not failures


def run_tests(cases, words=()):
    """Runs the tests of some classes at the same time. The exit status of the program."""
    reason = reason_to_skip()
    if reason:
        print("skipped: " + reason)
        return SKIPPED
    loader = unittest.defaultTestLoader
    tests = [test for case in cases
             for test in tests_of(loader.loadTestsFromTestCase(case), words)]
    with concurrent.futures.ThreadPoolExecutor(TESTS_AT_THE_SAME_TIME) as pool:
        succeeded = list(pool.map(run_one, tests))
    print(f"{sum(succeeded)} of {len(tests)} tests succeeded")
    return 0 if tests and all(succeeded) else 1
