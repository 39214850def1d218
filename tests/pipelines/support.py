# SPDX-License-Identifier: LGPL-2.1-or-later
"""Common parts of the tests of scripts and programs: small clips, and commands with time limits."""
import os
import pathlib
import random
import signal
import socket
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(os.environ["MTSTEREO_SOURCE"])
BUILD = pathlib.Path(os.environ["MTSTEREO_BUILD"])
SLOW = float(os.environ.get("MTSTEREO_SLOW", "1"))  # slowdown factor of a sanitized build
PIPELINES = SOURCE / "pipelines"
RENDER = BUILD / "pipelines/tools/render/mtstereo-render"
COMPARE = BUILD / "pipelines/tools/compare/mtstereo-compare"
CENTER = BUILD / "pipelines/examples/depth-of-center"

# Two cameras with lenses that distort, for clips of the size of make_clip().
CALIBRATION = """%YAML 1.0
---
image_size: [ 160, 120 ]
K1: { rows: 3, cols: 3, dt: d, data: [ 136, 0, 79.5, 0, 136, 59.5, 0, 0, 1 ] }
D1: { rows: 1, cols: 4, dt: d, data: [ -0.02, 0.01, 0, 0 ] }
K2: { rows: 3, cols: 3, dt: d, data: [ 136, 0, 79.5, 0, 136, 59.5, 0, 0, 1 ] }
D2: { rows: 1, cols: 4, dt: d, data: [ -0.02, 0.01, 0, 0 ] }
R: { rows: 3, cols: 3, dt: d, data: [ 1, 0, 0, 0, 1, 0, 0, 0, 1 ] }
T: { rows: 3, cols: 1, dt: d, data: [ -0.1, 0, 0 ] }
"""


class Outcome:
    """The exit status and the outputs of a command."""

    def __init__(self, command, status, output, errors):
        self.command, self.status, self.output, self.errors = command, status, output, errors
        self.text = output + errors

    def __str__(self):
        words = " ".join(map(str, self.command))
        return f"{words}\nstatus {self.status}\n{self.output}\n{self.errors}"


def environment():
    env = dict(os.environ)
    env["GST_PLUGIN_PATH"] = str(BUILD / "gst")
    env["GST_REGISTRY"] = str(BUILD / "tests/pipelines/registry.bin")
    env["GST_DEBUG_NO_COLOR"] = "1"
    env["BUILD"] = str(BUILD)
    env["LC_ALL"] = "C.UTF-8"
    programs = [BUILD / "pipelines" / part for part in
                ("examples", "programs/calibrate", "programs/run", "tools/compare", "tools/eval", "tools/render")]
    env["PATH"] = os.pathsep.join([*map(str, programs), env["PATH"]])
    env.pop("DISPLAY", None)
    env.pop("WAYLAND_DISPLAY", None)
    return env


def start(command, folder):
    """Starts a command in its own session, so that all its processes can be stopped."""
    return subprocess.Popen([str(word) for word in command], cwd=folder, env=environment(),
                            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, text=True, start_new_session=True)


def stop(process, how=signal.SIGKILL):
    try:
        os.killpg(process.pid, how)
    except ProcessLookupError:
        pass


def run(command, folder, seconds=60):
    """Runs a command; one that exceeds the time limit is stopped and has the status None."""
    process = start(command, folder)
    try:
        output, errors = process.communicate(timeout=seconds * SLOW)
        return Outcome(command, process.returncode, output, errors)
    except subprocess.TimeoutExpired:
        stop(process)
        output, errors = process.communicate()
        return Outcome(command, None, output, errors + f"\nstill running after {seconds} s")


def launch(words, folder, seconds=60):
    return run(["gst-launch-1.0", "-q", "-e", *words.split()], folder, seconds)


BLOCK = 4  # ports
reservations = []


def open_udp_ports():
    """The numbers of the UDP ports that are open on this machine."""
    lines = [line for table in ("/proc/net/udp", "/proc/net/udp6") if os.path.exists(table)
             for line in pathlib.Path(table).read_text().splitlines()[1:]]
    return {int(line.split()[1].rpartition(":")[2], 16) for line in lines}


def free_port(count=1):
    """The first of some successive unused UDP ports. No other call returns them, in any process of
    these tests: a TCP socket with the number of the first one reserves its block. They are never
    opened here: a process that another thread starts would keep them open for a while."""
    assert count <= BLOCK
    while True:
        first = random.randrange(20000, 32000, BLOCK)
        reservation = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
        try:
            reservation.bind(("127.0.0.1", first))
        except OSError:
            reservation.close()
            continue
        if open_udp_ports().isdisjoint(range(first, first + count)):
            reservations.append(reservation)
            return first
        reservation.close()


def require(outcome):
    if outcome.status != 0:
        raise AssertionError(str(outcome))
    return outcome


FRAMES = 8  # of a clip
H264 = "video/x-raw,format=I420 ! x264enc pass=quant quantizer=10 ! h264parse"


def make_clip(folder, frames=FRAMES, size="160x120", scene="room"):
    """Renders clip/ into the folder, and links left/ and right/ to its images."""
    require(run([RENDER, "clip", "--frames", str(frames), "--size", size, "--scene", scene], folder))
    for side in ("left", "right"):
        (folder / side).symlink_to(folder / "clip" / side)


def make_videos(folder, frames=None):
    """The clip, repeated up to `frames`, as left, right and side-by-side video files, H.264 in .mp4 and .mkv."""
    count = len(list((folder / "left").glob("*.png")))
    read = (f"multifilesrc location={{}}/%06d.png stop-index={count - 1} loop=true num-buffers={frames or count} "
            "caps=image/png,framerate=24/1 ! pngdec ! videoconvert")
    for side in ("left", "right"):
        require(launch(f"{read.format(side)} ! {H264} ! tee name=t t. ! queue ! mp4mux ! "
                       f"filesink location={side}.mp4 t. ! queue ! matroskamux ! "
                       f"filesink location={side}.mkv", folder))
    width = int.from_bytes((folder / "left/000000.png").read_bytes()[16:20], "big")
    require(launch(f"compositor name=c sink_1::xpos={width} ! videoconvert ! {H264} ! mp4mux ! "
                   f"filesink location=side-by-side.mp4 {read.format('left')} ! c.sink_0 "
                   f"{read.format('right')} ! c.sink_1", folder))


def count_frames(file, folder):
    """Decodes a video file and counts its frames."""
    counted = require(run(["gst-launch-1.0", "filesrc", f"location={file}", "!", "decodebin", "!",
                           "fakesink", "silent=false", "-v"], folder))
    return counted.text.count("chain   ******")


class ClipTest(unittest.TestCase):
    """Tests in a folder with a small clip, which is created once for all of them."""

    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory(prefix="mtstereo-")
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = pathlib.Path(temporary.name)
        make_clip(cls.folder)
        make_videos(cls.folder)

    @classmethod
    def run_script(cls, name, *words, seconds=60):
        return run([PIPELINES / name, *words], cls.folder, seconds)

    def assert_succeeds(self, outcome):
        self.assertEqual(outcome.status, 0, str(outcome))

    def assert_rejects(self, outcome, says, status):
        self.assertEqual(outcome.status, status, str(outcome))
        self.assertIn(says, outcome.errors, str(outcome))
