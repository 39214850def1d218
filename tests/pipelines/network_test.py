#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""from-network.sh and network-sender.sh over networks with delay and loss.

The views are numbered: the disparity of a map states the difference of the frame numbers of its
pair, which must be 0. MTSTEREO_NETWORK=1 runs more networks, for longer, and prints a table.
"""
import collections
import concurrent.futures
import os
import pathlib
import shlex
import signal
import tempfile
import time
import unittest

from network_path import Network
from network_support import wait_for_port
from support import BUILD, PIPELINES, SLOW, ClipTest, free_port, launch, require, run
from support import start, stop

RATE = 30
MEASURE = bool(os.environ.get("MTSTEREO_NETWORK"))
FRAMES = 600 if MEASURE else 90
NUMBERED = BUILD / "tests/gst/numbered-views"
WIDTH, HEIGHT = 160, 32
RAW = f"rawvideoparse width={WIDTH} height={HEIGHT} framerate=30/1 format="
LOSS = 0.02
LONG = ("--latency", "1000")
PHRASE = ("--passphrase", "correct-horse-battery")


def make_views(folder):
    """left.mkv, right.mkv, and late.mkv: the right one without its first frame."""
    require(run([NUMBERED, "write", FRAMES, "left.gray", "right.gray"], folder))
    (folder / "late.gray").write_bytes((folder / "right.gray").read_bytes()[WIDTH * HEIGHT:])
    for name in ("left", "right", "late"):
        require(launch(f"filesrc location={name}.gray ! {RAW}gray8 ! avenc_ffv1 ! matroskamux ! "
                       f"filesink location={name}.mkv", folder))


def differences(recording, folder):
    """The differences of the frame numbers of the pairs in a recording, counted."""
    raw = recording.with_suffix(".raw")
    require(launch(f"filesrc location={recording} ! matroskademux ! avdec_ffv1 ! "
                   f"video/x-raw,format=GRAY16_LE ! filesink location={raw}", folder))
    counted = require(run([NUMBERED, "count", raw], folder))
    raw.unlink()
    return collections.Counter(counted.output.split())


def setUpModule():
    """Starts a receiver with a time limit: without a sender, it is killed 10 s after the limit."""
    global limited
    pool = concurrent.futures.ThreadPoolExecutor(1)
    unittest.addModuleCleanup(pool.shutdown)
    folder = tempfile.TemporaryDirectory(prefix="mtstereo-")
    unittest.addModuleCleanup(folder.cleanup)
    limited = pool.submit(run, [PIPELINES / "from-network.sh", f"rtp://:{free_port(4)}", "--sink",
                                "fakesink", "--seconds", "1"], folder.name)


class Case:
    """A network. Delays are ranges [ms] of the paths of the left and the right video; over SRT both
    take the same path, and the delay is the larger one. `both` are options of both scripts."""

    def __init__(self, recipe, left=(0, 0), right=(0, 0), loss=LOSS, both=()):
        self.recipe, self.left, self.right, self.loss, self.both = recipe, left, right, loss, both

    def __str__(self):
        return f"{self.recipe} {self.left} {self.right} ms, loss {100 * self.loss:g} %, " \
               f"{' '.join(self.both)}"

    def paths(self, network, port):
        """The port to send to; the receiver listens on `port`."""
        left, right = ([ms / 1000 for ms in delay] for delay in (self.left, self.right))
        if self.recipe == "srt":
            return network.add_path(port, max(left, right), self.loss)
        first = free_port(4)
        for i in range(4):
            network.add_path(port + i, left if i < 2 else right, self.loss, i + 1, first + i)
        return first


class Outcome:
    def __init__(self, case, counts, log, lost):
        self.case, self.counts, self.log, self.lost = case, counts, log, lost
        self.pairs = sum(counts.values())
        self.wrong = self.pairs - counts["0"]

    def __str__(self):
        return f"{self.case}: {self.pairs} pairs of {FRAMES}, {dict(self.counts)}, " \
               f"{100 * self.lost:.1f} % of the packets lost"


def send_and_receive(folder, case, name):
    """Sends the views through the network of a case, and records the disparities."""
    port = free_port(4)
    recording = folder / f"{name}.mkv"
    with Network() as network:
        to = case.paths(network, port)
        receiver = start_receiver(f"{case.recipe}://:{port}", "--out", recording, *case.both,
                                  folder=folder)
        try:
            wait_for_port(port if case.recipe == "srt" else port + 3, receiver)
            require(run([PIPELINES / "network-sender.sh", "left.mkv", "right.mkv", "--to",
                         f"{case.recipe}://127.0.0.1:{to}", *case.both], folder, 90))
            if case.recipe == "rtp":  # SRT shows the end of the sender
                time.sleep(1)
                stop(receiver, signal.SIGINT)
            output, errors = receiver.communicate(timeout=30 * SLOW)
        finally:
            stop(receiver)
        return Outcome(case, differences(recording, folder), output + errors, network.share_lost())


def start_receiver(*words, folder):
    """Starts the pipeline of the script, which gets interrupts itself."""
    shown = require(run([PIPELINES / "from-network.sh", *words, "--dry-run"], folder))
    return start(shlex.split("env " + shown.output), folder)


class Pairs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory(prefix="mtstereo-")
        cls.addClassCleanup(cls.temporary.cleanup)
        cls.folder = pathlib.Path(cls.temporary.name)
        make_views(cls.folder)

    def check(self, cases, least=5, most_wrong=0):
        """At most this many pairs may be wrong, and more than `least` must be there: a busy machine
        loses some."""
        with concurrent.futures.ThreadPoolExecutor(1 if MEASURE else 3) as pool:
            outcomes = pool.map(lambda n: send_and_receive(self.folder, cases[n], f"case{n}"),
                                range(len(cases)))
            for case, outcome in zip(cases, outcomes):
                if MEASURE:
                    print(outcome, flush=True)
                with self.subTest(str(case)):
                    self.assertLessEqual(outcome.wrong, most_wrong, f"{outcome}\n{outcome.log}")
                    self.assertGreater(outcome.pairs, least, f"{outcome}\n{outcome.log}")

    # Feature: two videos from another computer
    def test_pairs_are_right_with_delay_and_loss(self):
        # Lost packets are sent again in time if the latency is some times the way there and back.
        self.check([Case("srt", (0, 50), both=LONG + PHRASE), Case("rtp", right=(30, 30)),
                    Case("rtp", (100, 100), (15, 15))])

    @unittest.skipUnless(MEASURE, "MTSTEREO_NETWORK=1 measures more networks")
    def test_more_networks(self):
        loss = [0, LOSS]
        srt = [Case("srt", delay, loss=share, both=LONG)
               for delay in ((0, 0), (30, 30), (0, 100), (100, 100)) for share in loss]
        rtp = [Case("rtp", (left, left), (right, right), share)
               for left, right in ((0, 0), (15, 0), (0, 30), (60, 0), (0, 100)) for share in loss]
        self.check(srt + rtp + [Case("rtp", (0, 100), (0, 100), share) for share in loss])

    @unittest.skipUnless(MEASURE, "MTSTEREO_NETWORK=1 measures more networks")
    def test_short_latency_loses_frames(self):
        # The demultiplexer can correct its times at the first gap: between two frames of a pair.
        short = ("--latency", "40")
        self.check([Case("srt", (0, 0), both=short), Case("srt", (30, 30), both=short),
                    Case("srt", (100, 100), both=short), Case("srt", (30, 30), loss=0.1, both=short)],
                   least=0, most_wrong=1)

    def test_a_shift_by_one_frame_is_counted(self):
        require(run([PIPELINES / "from-files.sh", "left.mkv", "late.mkv", "--out", "shifted.mkv",
                     "--set", "sync-mode=arrival"], self.folder))
        counts = differences(self.folder / "shifted.mkv", self.folder)
        self.assertEqual(counts, {"1": FRAMES - 1})


class Use(ClipTest):
    """Options, addresses and errors of both scripts."""

    def shown(self, *words):
        done = self.run_script(*words, "--dry-run")
        self.assert_succeeds(done)
        return done.output

    def test_time_limit_is_not_a_failure(self):
        self.assert_succeeds(limited.result())

    def test_sender_without_receiver_fails(self):
        sent = self.run_script("network-sender.sh", "left.mp4", "right.mp4", "--to",
                               f"srt://127.0.0.1:{free_port()}")
        self.assert_rejects(sent, "Failed to write to SRT socket", 1)

    def test_connection_without_frames_ends_the_receiver(self):
        port = free_port()  # the clip is shorter than the latency
        receiver = start([PIPELINES / "from-network.sh", f"srt://:{port}", "--sink", "fakesink",
                          "--latency", "2000"], self.folder)
        try:
            wait_for_port(port, receiver)
            self.run_script("network-sender.sh", "left.mp4", "right.mp4", "--to",
                            f"srt://127.0.0.1:{port}")
            _, errors = receiver.communicate(timeout=30 * SLOW)
        finally:
            stop(receiver)
        self.assertEqual(receiver.returncode, 1, errors)
        self.assertIn("Stream doesn't contain enough data", errors)

    # Feature: two videos from another computer
    def test_left_and_right_are_linked_by_pid_and_session(self):
        srt = self.shown("from-network.sh")
        self.assertRegex(srt, r"net\.video_0_0041 .*m\.sink_left net\.video_0_0042 .*m\.sink_right")
        rtp = self.shown("from-network.sh", "rtp://:5000")
        self.assertRegex(rtp, r"net\.recv_rtp_src_0_1_96 .*m\.sink_left "
                         r"net\.recv_rtp_src_1_2_96 .*m\.sink_right")

    def test_options_replace_the_sync_mode(self):
        rtp = self.shown("from-network.sh", "rtp://:5000", "--set", "sync-mode=arrival")
        self.assertGreater(rtp.index("sync-mode=arrival"), rtp.index("sync-mode=reference-timestamp"))

    def test_cameras_get_the_requested_caps(self):
        shown = self.shown("network-sender.sh", "/dev/video0", "/dev/video2", "--size", "320x240",
                           "--rate", "15", "--bitrate", "3000")
        for words in ("v4l2src device=/dev/video0", "v4l2src device=/dev/video2", "bitrate=3000",
                      "width=320,height=240,framerate=15/1"):
            self.assertIn(words, shown)

    def test_missing_inputs_are_named(self):
        for words, says in ((["no.mp4", "left.mp4"], "no.mp4"),
                            (["/dev/video97", "/dev/video98"], "/dev/video97"),
                            (["left", "left.mp4"], "folder")):
            self.assert_rejects(self.run_script("network-sender.sh", *words), says, 1)

    def test_invalid_options_are_named(self):
        files, short = ["left.mp4", "right.mp4"], ["--passphrase", "short"]
        for words, says in (
                (["from-network.sh", "5000", "5002"], "rtp://:5000"),
                (["from-network.sh", "5000"], "srt://[HOST]:PORT"),
                (["from-network.sh", "http://a", "http://b"], "http://a"),
                (["from-network.sh", "rtsp://a/left"], "two rtsp://"),
                (["from-network.sh", "srt://host"], "srt://HOST:PORT"),
                (["from-network.sh", "srt://:0"], "1 to 65535"),
                (["from-network.sh", "srt://:70000"], "1 to 65535"),
                (["from-network.sh", "rtp://:65533"], "four ports"),
                (["from-network.sh", "srt://:7001", "--latency", "long"], "--latency"),
                (["from-network.sh", "srt://:7001", *short], "10 to 79"),
                (["from-network.sh", "rtp://:5000", *short], "not encrypted"),
                (["from-network.sh", "srt://:7001", "--ports", "5000,5002"], "--ports"),
                (["network-sender.sh", "left.mp4"], "LEFT and RIGHT"),
                (["network-sender.sh", *files, "--to", "192.168.1.20"], "--to"),
                (["network-sender.sh", *files, "--to", "rtp://:5000"], "rtp://HOST:PORT"),
                (["network-sender.sh", *files, "--to", "srt://host"], "srt://HOST:PORT"),
                (["network-sender.sh", *files, "--bitrate", "high"], "--bitrate"),
                (["network-sender.sh", *files, "--size", "big"], "--size"),
                (["network-sender.sh", *files, "--rate", "fast"], "--rate"),
                (["network-sender.sh", *files, "--latency", "-1"], "--latency"),
                (["network-sender.sh", *files, *short], "10 to 79")):
            self.assert_rejects(self.run_script(*words), says, 2)


if __name__ == "__main__":
    unittest.main(verbosity=2)
