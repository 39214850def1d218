# SPDX-License-Identifier: LGPL-2.1-or-later
"""Threads of Python: the same results, and others run while one matches. Memory does not grow."""
import concurrent.futures
import os
import pathlib
import threading
import time
import unittest

import mtstereo
import numpy as np

from support import views


def resident():
    """The memory of this process that is in use [bytes]."""
    return int(pathlib.Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


PAIRS = [views(161, 75, seed=seed) for seed in range(1, 9)]


def maps_of(matcher):
    return [matcher(*pair).disparity.tobytes() for pair in PAIRS]


class Threads(unittest.TestCase):
    def setUp(self):
        self.expected = maps_of(mtstereo.Matcher(max_disparity=32))

    # Feature: threads, processes and sub-interpreters
    def test_with_a_matcher_each_get_the_same_maps(self):
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            matchers = [mtstereo.Matcher(max_disparity=32, threads=1) for _ in range(2)]
            self.assertEqual(list(pool.map(maps_of, matchers)), [self.expected] * 2)

    # Feature: threads, processes and sub-interpreters
    def test_that_share_a_matcher_wait_for_each_other(self):
        matcher = mtstereo.Matcher(max_disparity=32)
        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            self.assertEqual(list(pool.map(maps_of, [matcher] * 4)), [self.expected] * 4)

    # Feature: threads, processes and sub-interpreters
    def test_run_while_another_one_matches(self):
        matcher, times, matched = mtstereo.Matcher(mode="full", max_disparity=256, threads=1), [], []
        pair = views(1280, 960)

        def match():
            begin = time.monotonic()
            matcher(*pair)
            matched.append(time.monotonic() - begin)

        worker = threading.Thread(target=match)
        worker.start()
        while not matched:
            times.append(time.monotonic())
        worker.join()
        self.assertLess(np.diff(times).max(), matched[0] / 2)

    def test_may_set_parameters_while_another_one_matches(self):
        matcher = mtstereo.Matcher(max_disparity=32)
        with concurrent.futures.ThreadPoolExecutor(1) as pool:
            running = pool.submit(maps_of, matcher)
            while not running.done():
                matcher.set(threads=1)
                matcher.set(threads=2)
            self.assertEqual(running.result(), self.expected)


class Memory(unittest.TestCase):
    # Feature: no leak
    def test_does_not_grow(self):
        """Each call that leaked a map, or an array of another layout, would leak 60 KB."""
        matcher, alignment = mtstereo.Matcher(max_disparity=16, threads=1), mtstereo.Alignment()
        left, right = (np.asfortranarray(view) for view in views(160, 96))

        def use(times):
            for _ in range(times):
                matcher(left, right)
                alignment.watch(left, right)
                for wrong in (None, left[:5], left.astype(float)):
                    try:
                        matcher(wrong, right)
                    except (TypeError, ValueError):
                        pass

        use(50)
        before = resident()
        use(400)
        self.assertLess(resident() - before, 8e6)


if __name__ == "__main__":
    unittest.main(verbosity=2)
