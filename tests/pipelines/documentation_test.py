#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Feature: demo, scripts and documentation
# Feature: recording without loss
"""documentation_test.py PART PARTS: runs every command of README.md and the pages of docs/, headless and on a small clip;
with PARTS above 1 only those of every PARTS-th document, beginning with number PART. The appendix is dated, and not run.

The commands are the lines of ```sh blocks. Each document runs in its own folder, which contains the
files that its examples name. Only hardware that a test machine lacks is replaced: the screen by a
fakesink and cameras by test images. For commands after "# needs a sender" and "# needs a receiver",
the other end is started on the loopback network.
"""
import pathlib
import re
import shutil
import sys
import tempfile
import unittest

from network_support import is_receiver, is_sender, receive, send
from support import BUILD, CALIBRATION, SOURCE, make_clip, make_videos, require, run

DOCUMENTS = [SOURCE / "README.md", *sorted((SOURCE / "docs").glob("*.md")),
             *sorted((SOURCE / "docs/elements").glob("*.md"))]

# Commands that install, build or test; running the tests covers them.
NOT_RUN = re.compile(r"(sudo |apt|DEB_BUILD_OPTIONS=|git |cd |meson |ninja |\./tests/|\./\.ci/|docs/update\.sh"
                     r"|\./docs/update\.sh|\./pipelines/install-packages\.sh)")
RUN = re.compile(r"([A-Z_]+=\S+ +)*(gst-launch-1\.0|gst-inspect-1\.0|\./pipelines/|mtstereo-"
                 r"|\./build/pipelines/|build/pipelines/|depth-of-center|mtcalibrate |mkdir |export )")


def name_of(document):
    return str(document.relative_to(SOURCE)) if document.is_relative_to(SOURCE) else document.name


class Command:
    def __init__(self, document, line_number, text, needs):
        self.where = f"{name_of(document)}:{line_number}"
        self.text, self.needs = text, needs


def commands_of(document):
    """The commands of a document's ```sh blocks, continued lines joined."""
    commands, inside, joined, needs, first = [], False, "", "", 0
    for number, line in enumerate(document.read_text().splitlines(), 1):
        if line.strip().startswith("```"):
            inside, needs = line.strip() == "```sh", ""
            continue
        if not inside or not line.strip():
            continue
        if line.lstrip().startswith("#"):
            needs = line
            continue
        first = first if joined else number
        joined += line
        if joined.endswith("\\"):
            joined = joined[:-1]
            continue
        text = re.sub(r"\s#\s.*$", "", joined.strip())  # a remark after the command
        commands.append(Command(document, first, text.strip(), needs + joined))
        joined = ""
    return commands


def make_data_sets(folder):
    """Small data sets in the public layouts, under the names of docs/evaluation.md."""
    render = BUILD / "pipelines/tools/render/mtstereo-render"
    require(run([render, "trainingF", "--layout", "middlebury", "--size", "160x120", "--frames", "2",
                 "--scene", "room"], folder))
    kitti = folder / "data_scene_flow/training"
    for name, side in (("image_2", "left"), ("image_3", "right")):
        (kitti / name).mkdir(parents=True)
        for n in range(2):
            shutil.copy(folder / side / f"{n:06d}.png", kitti / name / f"{n:06d}_10.png")
    # The matcher's own result is the ground truth: the test runs commands and checks no figures.
    (kitti / "disp_occ_0").mkdir()
    require(run([SOURCE / "pipelines/from-png.sh", "left/%06d.png", "right/%06d.png",
                 "estimate/%06d.png"], folder))
    for n in range(2):
        shutil.copy(folder / f"estimate/{n:06d}.png", kitti / f"disp_occ_0/{n:06d}_10.png")
    shutil.rmtree(folder / "estimate")
    scene = "35mm_focallength/scene_forwards/fast"
    for side in ("left", "right"):
        images = folder / "driving/frames_cleanpass" / scene / side
        images.mkdir(parents=True)
        truth = folder / "driving/disparity" / scene / side
        truth.mkdir(parents=True)
        for n in range(2):
            shutil.copy(folder / side / f"{n:06d}.png", images / f"{n + 1:04d}.png")
            shutil.copy(folder / f"clip/truth/{n:06d}.pfm", truth / f"{n + 1:04d}.pfm")


def prepare(folder):
    """Creates all files that the examples name."""
    make_clip(folder)
    make_videos(folder, 48)  # SRT can lose the first second while it connects
    (folder / "stereo.yaml").write_text(CALIBRATION)
    for side in ("left", "right"):
        shutil.copy(folder / f"{side}.mp4", folder / f"raw-{side}.mp4")
    for name in ("pipelines", "tests", "docs"):
        (folder / name).symlink_to(SOURCE / name)
    (folder / "build").symlink_to(BUILD)
    make_data_sets(folder)
    # Views of a calibration board, in place of cameras.
    require(run([BUILD / "pipelines/tools/render/mtstereo-render", "camera-boards", "--scene", "board",
                 "--size", "320x240", "--poses", "8", "--rest", "1", "--samples", "1"], folder))


def headless(text):
    """The command for a machine without a screen and with little time."""
    if text.startswith("mtstereo-render "):
        return re.sub(r" --size \S+", "", text) + " --size 320x240 --samples 1"
    if text.startswith("./pipelines/demo.sh"):
        short = "" if " left" in text else " --frames 4 --size 160x120"
        return text + " --no-build" + short
    if re.match(r"\./pipelines/from-", text) and "--out" not in text and "--help" not in text:
        text += " --sink 'fakesink sync=false'"
    return re.sub(r"\b(autovideosink|glimagesink|ximagesink|xvimagesink)\b( sync=\w+)?",
                  "fakesink sync=false", text)


def without_camera(text):
    """Test images instead of cameras, as JPEG if the camera is asked for it."""
    if text.startswith("mtcalibrate "):
        for side in ("left", "right"):
            text = re.sub(rf"--{side} /dev/video\d+", f"--{side} camera-boards/{side}", text)
        return text + " --pattern checkerboard --squares 10x7"
    text = re.sub(r"v4l2src device=\S+( ! |\s+!\s+)image/jpeg",
                  r"videotestsrc is-live=true num-buffers=20 ! jpegenc\1image/jpeg", text)
    text = re.sub(r"v4l2src( device=\S+)?", "videotestsrc is-live=true num-buffers=20", text)
    return text


class Pads(unittest.TestCase):
    def test_every_pipeline_names_the_pads_of_the_matcher(self):
        """decodebin links when it is ready: without names, left and right may be swapped."""
        scripts = sorted((SOURCE / "pipelines").glob("*.sh"))
        texts = {command.where: command.text for document in DOCUMENTS
                 for command in commands_of(document)}
        texts.update({script.name: script.read_text() for script in scripts})
        self.assertGreater(sum("m.sink_left" in text for text in texts.values()), 10)
        for where, text in texts.items():
            with self.subTest(where):
                self.assertEqual(re.findall(r"!'?\s+m\.(?!sink_)\S*", text), [])


class Documentation(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        prepared = tempfile.TemporaryDirectory(prefix="mtstereo-")
        cls.addClassCleanup(prepared.cleanup)
        cls.prepared = pathlib.Path(prepared.name)
        prepare(cls.prepared)

    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory(prefix="mtstereo-")
        self.addCleanup(self.temporary.cleanup)
        self.folder = pathlib.Path(self.temporary.name)

    def check(self, document):
        commands = commands_of(document)
        if commands:
            shutil.copytree(self.prepared, self.folder, symlinks=True, dirs_exist_ok=True)
        for command in commands:
            with self.subTest(command.where):
                self.check_command(command)

    def check_command(self, command):
        if NOT_RUN.match(command.text):
            return
        self.assertRegex(command.text, RUN, f"{command.where}: what is this command?")
        text = command.text
        if re.match(r"\./pipelines/(from-|network-)", text) and "needs" in command.needs:
            done = run(["bash", "-c", text + " --dry-run"], self.folder)
            self.assertEqual(done.status, 0, f"{command.where}: {done}")
            text = done.output.strip()
        if "camera" in command.needs and "needs" in command.needs or "v4l2src" in text:
            text = without_camera(text)
        text = headless(text)
        if is_receiver(text) or is_sender(text):
            received, log = (receive if is_receiver(text) else send)(text, self.folder)
            self.assertTrue(received, f"{command.where}: no maps of\n{text}\n{log}")
        elif "rtspsrc" in text:
            self.check_parses(command, text)
        else:
            done = run(["bash", "-c", text], self.folder, 120)
            self.assertEqual(done.status, 0, f"{command.where}: {done}")
            self.assertNotRegex(done.text, "CRITICAL|erroneous", f"{command.where}: {done}")

    def check_parses(self, command, text):
        """No server answers at the address, but the pipeline must be valid."""
        text = re.sub(r"rtsps?://[^ /]+", "rtsp://127.0.0.1:9", text)
        done = run(["bash", "-c", text], self.folder)
        self.assertIsNotNone(done.status, f"{command.where}: {done}")
        self.assertNotRegex(done.text, "erroneous|syntax error|no element|no property",
                            f"{command.where}: {done}")


def add_test(document):
    setattr(Documentation, "test_" + re.sub(r"\W", "_", name_of(document)),
            lambda self: self.check(document))


PARTS, PART = int(sys.argv.pop()), int(sys.argv.pop())
# Those with the most commands are dealt out first, so that the parts take about as long.
for each in sorted(DOCUMENTS, key=lambda document: -len(commands_of(document)))[PART - 1::PARTS]:
    add_test(each)


class Extraction(unittest.TestCase):
    """The extraction of commands: a command that is not found would never run."""

    def commands(self, text):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "page.md"
            file.write_text(text)
            return commands_of(file)

    def test_lines_are_joined_and_remarks_removed(self):
        found = self.commands("a\n```sh\none \\\n  two   # remark\nthree\n```\nfour\n")
        self.assertEqual([c.text for c in found], ["one   two", "three"])
        self.assertEqual([c.where for c in found], ["page.md:3", "page.md:5"])

    def test_other_blocks_are_ignored(self):
        self.assertEqual(self.commands("```cpp\nint a;\n```\n```\nprint\n```\n"), [])

    def test_requirements_apply_to_their_block(self):
        found = self.commands("```sh\n# needs two cameras\none\n```\n```sh\ntwo\n```\n")
        self.assertIn("needs two cameras", found[0].needs)
        self.assertNotIn("needs", found[1].needs)

    def test_commands_of_the_readme_are_found(self):
        texts = [c.text for c in commands_of(SOURCE / "README.md")]
        self.assertGreater(sum(text.startswith("gst-launch-1.0") for text in texts), 0)
        self.assertIn("./pipelines/demo.sh", texts)


if __name__ == "__main__":
    unittest.main(verbosity=2)
