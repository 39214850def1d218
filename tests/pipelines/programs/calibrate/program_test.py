#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""mtcalibrate as a process: sources of every kind, its files and messages, and what it refuses."""
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

PROGRAM = os.environ["MTCALIBRATE"]
VIEWS = os.environ["BOARD_VIEWS"]
SLOW = float(os.environ.get("MTSTEREO_SLOW", "1"))
WIDTH, HEIGHT = 384, 288  # of board-views [px]
FOCAL, BASELINE, DELAY = 336, 0.1, 12  # of board-views [px], [m]; of its film [ms]

temporary = tempfile.TemporaryDirectory(prefix="mtstereo-")
FOLDER = pathlib.Path(temporary.name)


def setUpModule():
    subprocess.run([VIEWS, FOLDER / "stills", "14"], check=True)
    subprocess.run([VIEWS, FOLDER / "film", "11", str(DELAY)], check=True)
    (FOLDER / "empty").mkdir()
    (FOLDER / "text.txt").write_text("no video\n")
    (FOLDER / "broken").mkdir()
    (FOLDER / "broken/0.png").write_text("no image\n")


def tearDownModule():
    temporary.cleanup()


def film(side, rate=30, name="film", last=-1):
    return (f'multifilesrc location={name}/{side}/%03d.png stop-index={last} '
            f'caps="image/png,framerate={rate}/1" ! pngdec')


class Program(unittest.TestCase):
    def run_program(self, *words, seconds=60):
        return subprocess.run([PROGRAM, *map(str, words)], cwd=FOLDER, stdin=subprocess.DEVNULL,
                              capture_output=True, text=True, timeout=seconds * SLOW, check=False)

    def calibrate(self, *words, status=0):
        """Runs the program on a fresh folder; returns its output and its report."""
        folder = tempfile.mkdtemp(dir=FOLDER)
        done = self.run_program(*words, "--out", folder)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        report = json.loads((pathlib.Path(folder) / "report.json").read_text())
        return done.stdout, report, pathlib.Path(folder)

    def calibrated_stills(self):
        """A folder with the calibration of the stills, which is made once."""
        made = FOLDER / "calibrated"
        if not made.exists():
            done = self.run_program("--left", "stills/left", "--right", "stills/right", "--out", made)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return pathlib.Path(shutil.copytree(made, tempfile.mkdtemp(dir=FOLDER), dirs_exist_ok=True))

    def refuse(self, expected, *words, status=1):
        folder = tempfile.mkdtemp(dir=FOLDER)
        done = self.run_program(*words, "--out", folder)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        self.assertRegex(done.stderr, expected)
        self.assertFalse((pathlib.Path(folder) / "calibration.yml").exists())

    def check_figures(self, report):
        for side in ("left", "right"):
            self.assertAlmostEqual(report[side]["focal_x"] / FOCAL, 1, delta=0.004)
        self.assertAlmostEqual(report["baseline"] / BASELINE, 1, delta=0.003)
        self.assertLess(report["fit"]["row_median"], 0.2)


class Calibration(Program):
    def test_folders_of_images_and_strict(self):
        output, report, folder = self.calibrate("--left", "stills/left", "--right", "stills/right")
        self.check_figures(report)
        self.assertEqual(report["pairs"]["taken"], 14)
        self.assertTrue(report["fit"]["held_out"])
        self.assertRegex(output, r"rows +median 0\.\d+ px, 95 % below 0\.\d+ px")
        self.assertIn("The left camera is stills/left", output)
        self.assertIn("warning: few-views", output)
        for depth in (1, 2, 5, 10):
            self.assertIn(f" at {depth} m", output)
        text = (folder / "calibration.yml").read_text()
        self.assertTrue(text.startswith("%YAML"))
        for name in ("coverage.png", "rectified.png", "residuals.png", "views/013.jpg"):
            self.assertGreater((folder / name).stat().st_size, 1000, name)
        # The views that it keeps give the same calibration and warnings again.
        _, again, _ = self.calibrate("--left", folder / "left", "--right", folder / "right", "--strict", status=3)
        self.assertEqual(again["left"], report["left"])

    def test_patterns_of_images_and_a_choice_of_the_model(self):
        output, report, _ = self.calibrate("--left", "stills/left/%03d.png", "--right",
                                           "stills/right/*.png", "--model", "auto")
        self.check_figures(report)
        self.assertEqual(report["model"], "plumb-bob")
        self.assertEqual(output.count("of the held-out corners"), 3)

    def test_video_takes_views_at_rest_and_reports_cameras_that_are_not_synchronized(self):
        output, report, _ = self.calibrate("--left", film("left"), "--right", film("right"))
        self.check_figures(report)
        self.assertGreaterEqual(report["pairs"]["taken"], 8)
        self.assertGreater(report["pairs"]["moving"], 40)
        offset = report["quality"]["time_offset"]["seconds"]
        self.assertAlmostEqual(1000 * offset, DELAY, delta=2)
        self.assertRegex(output, r"not-synchronized: .* right one exposes about 1[1-3] ms later")

    def test_swapped_sources_are_written_in_the_right_order(self):
        output, report, folder = self.calibrate("--left", "stills/right", "--right", "stills/left")
        self.check_figures(report)
        self.assertTrue(report["swapped"])
        self.assertLess(report["translation"][0], 0)
        self.assertIn("The left camera is stills/left", output)
        self.assertIn("warning: swapped-inputs", output)
        self.assertEqual((folder / "left/000.png").stat().st_size > 0, True)
        _, again, right = self.calibrate("--left", folder / "left", "--right", folder / "right")
        self.assertFalse(again["swapped"])
        texts = [[each["text"] for each in found["quality"]["warnings"] if each["name"] != "swapped-inputs"]
                 for found in (report, again)]
        self.assertEqual(*texts)
        self.assertEqual((folder / "coverage.png").read_bytes(), (right / "coverage.png").read_bytes())

    def test_one_source_with_both_views(self):
        for option, place in (("--side-by-side", f"xpos={WIDTH}"), ("--top-bottom", f"ypos={HEIGHT}")):
            both = (f"compositor name=c sink_1::{place} {film('left', 5, 'stills')} ! c.sink_0 "
                    f"{film('right', 5, 'stills')} ! c.sink_1 c. ")
            _, report, _ = self.calibrate(option, both, "--stills", "--views", "12")
            self.assertEqual(report["pairs"]["taken"], 12)
            self.check_figures(report)

    def test_files_with_wrong_times_are_paired_by_index(self):
        fast = film("right", 60)
        self.refuse("views? of the board", "--left", film("left"), "--right", fast)
        _, report, _ = self.calibrate("--left", film("left"), "--right", fast, "--pairing", "index")
        self.check_figures(report)

    def test_interrupt_finishes_with_the_views_that_there_are(self):
        folder = pathlib.Path(tempfile.mkdtemp(dir=FOLDER))
        live = " ! identity sync=true"
        running = subprocess.Popen(
            [PROGRAM, "--left", film("left", 15) + live, "--right", film("right", 15) + live,
             "--out", str(folder)], cwd=FOLDER, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
            text=True)
        deadline = time.monotonic() + 60 * SLOW
        while not (folder / "views/005.jpg").exists() and time.monotonic() < deadline:
            time.sleep(0.05)
        running.send_signal(signal.SIGINT)
        output, errors = running.communicate(timeout=30 * SLOW)
        self.assertEqual(running.returncode, 0, output + errors)
        report = json.loads((folder / "report.json").read_text())
        self.assertLess(report["pairs"]["seen"], 110)
        self.assertIn("warning: nothing-held-out", output)


class Refusal(Program):
    both = ("--left", "stills/left", "--right", "stills/right")

    def test_sources_that_do_not_exist(self):
        self.refuse("none.mp4: no such file", "--left", "none.mp4", "--right", "none2.mp4")
        self.refuse("/dev/video99: no such device", "--left", "/dev/video99", "--right",
                    "/dev/video98")
        self.refuse("empty: there are no images", "--left", "empty", "--right", "stills/right")

    def test_sources_that_do_not_work(self):
        test = "videotestsrc num-buffers=4"
        self.refuse(r"left source \(text.txt\): ", "--left", "text.txt", "--right", test)
        self.refuse('right source .*no element "nonsense"', "--left", test, "--right",
                    "videotestsrc ! nonsense")
        self.refuse("0.png: is not an image", "--left", "broken", "--right", "broken/0.png")
        self.refuse("one source gives images", "--left", "stills/left", "--right", test)
        self.refuse("left image is 64x48, the right one 320x240", "--left",
                    test + " ! video/x-raw,width=64,height=48", "--right", test)
        self.refuse("14 images, but film/right has 110", "--left", "stills/left", "--right",
                    "film/right")

    def test_a_source_that_sends_nothing(self):
        silent = "udpsrc port=0 ! application/x-rtp,media=video ! rtpvrawdepay"
        self.refuse(r"left source \(udpsrc .*no frame for 1 s", "--left", silent, "--right",
                    "videotestsrc is-live=true", "--timeout", "1")

    def test_live_video_without_a_board_ends(self):
        self.refuse("no board was found in .*No marker", "--left", "videotestsrc is-live=true",
                    "--right", "videotestsrc is-live=true pattern=ball", "--give-up", "1")

    def test_another_board(self):
        self.refuse("no board was found in 14 .*No marker of this dictionary", *self.both,
                    "--dictionary", "5x5_100")
        self.refuse("are --squares, --pattern and --dictionary those of the board", *self.both,
                    "--squares", "7x5")

    def test_too_few_views(self):
        self.refuse("only 3 different views of the board", "--left", "stills/left/00[0-2].png",
                    "--right", "stills/right/00[0-2].png")
        self.refuse("Hold the board still", "--left", film("left", last=27), "--right",
                    film("right", last=27))

    def test_an_existing_calibration_is_kept(self):
        folder = self.calibrated_stills()
        before = (folder / "calibration.yml").read_bytes()
        done = self.run_program(*self.both, "--out", folder)
        self.assertEqual(done.returncode, 1)
        self.assertIn("has a calibration", done.stderr)
        self.assertEqual((folder / "calibration.yml").read_bytes(), before)
        self.assertEqual(self.run_program(*self.both, "--out", folder, "--overwrite").returncode, 0)

    def test_foreign_images_and_inputs_stay(self):
        folder = FOLDER / "foreign"
        (folder / "left").mkdir(parents=True)
        image = folder / "left/000.png"
        image.write_text("mine")
        done = self.run_program(*self.both, "--out", folder, "--overwrite")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, "left/000.png is in the way, and no earlier run wrote it")
        self.assertEqual(image.read_text(), "mine")
        folder = self.calibrated_stills()
        before = {file: file.read_bytes() for file in folder.rglob("*") if file.is_file()}
        done = self.run_program("--left", folder / "left", "--right", folder / "right", "--out",
                                folder, "--overwrite")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, "left/000.png is an input")
        after = {file: file.read_bytes() for file in folder.rglob("*") if file.is_file()}
        self.assertEqual(after, before)

    def test_files_that_cannot_be_read_are_named_and_leave_no_folder(self):
        images = FOLDER / "one-less"
        shutil.copytree(FOLDER / "stills/right", images)
        (images / "003.png").unlink()
        (FOLDER / "a.gif").write_bytes(b"GIF89a")
        for right, text in ((images, "stills/left/003.png has no partner"),
                            ("stills/none", "stills/none: no such file or folder"),
                            ("none.png", "none.png: no such file or folder"),
                            ("a.gif", "a.gif: is a GIF, which repeats without an end")):
            done = self.run_program("--left", "stills/left", "--right", right, "--out", "new/out")
            self.assertEqual(done.returncode, 1)
            self.assertIn(text, done.stderr)
            self.assertFalse((FOLDER / "new").exists())

    @unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is not installed")
    def test_videos_of_pixels_that_are_not_decoded(self):
        for name in ("gray-left.mkv", "gray-right.mkv"):
            subprocess.run(["ffmpeg", "-v", "error", "-f", "lavfi", "-i", "testsrc=size=64x48:duration=0.2",
                            "-c:v", "ffv1", "-pix_fmt", "gray10le", FOLDER / name], check=True)
        self.refuse(r"source \(gray-.*\): .*-pix_fmt gray16le", "--left", "gray-left.mkv", "--right",
                    "gray-right.mkv", "--timeout", "2")

    def test_a_pair_of_two_sizes_is_named(self):
        images = FOLDER / "two-sizes"
        shutil.copytree(FOLDER / "stills/right", images)
        header = b"P5\n64 48\n255\n"
        for image in sorted(images.iterdir())[1:2]:
            image.unlink()
            image.with_suffix(".pgm").write_bytes(header + bytes(64 * 48))
        done = self.run_program("--left", "stills/left", "--right", images, "--out", "sizes")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, "001.png: the left image is .* the right one 64x48")

    @unittest.skipUnless(shutil.which("ffmpeg"), "ffmpeg is not installed")
    def test_videos_that_players_turn(self):
        subprocess.run(["ffmpeg", "-v", "error", "-f", "lavfi", "-i", "testsrc=size=64x48:duration=0.2",
                        "-c:v", "mpeg4", FOLDER / "plain.mp4"], check=True)
        subprocess.run(["ffmpeg", "-v", "error", "-i", FOLDER / "plain.mp4", "-c", "copy",
                        "-metadata:s:v", "rotate=180", FOLDER / "turned.mp4"], check=True)
        self.refuse("turned.mp4.*: players turn its frames",
                    "--left", "turned.mp4", "--right", "plain.mp4", "--square", 28)
        turned = "filesrc location=turned.mp4 ! decodebin ! videoflip video-direction=auto"
        self.refuse("no board was found", "--left", turned, "--right", "plain.mp4", "--square", 28)

    def test_a_folder_that_cannot_be_written(self):
        done = self.run_program(*self.both, "--out", "/proc/nothing")
        self.assertEqual(done.returncode, 1)
        self.assertIn("/proc/nothing", done.stderr)

    def test_wrong_commands(self):
        for words, expected in (
                ((), "give --left and --right"),
                (("--left", "a"), "both --left and --right"),
                (("--left", "a", "--right", "a"), "the same source"),
                ((*self.both, "--side-by-side", "a"), "give --left and --right"),
                ((*self.both, "--squares", "9"), "not of the form"),
                ((*self.both, "--square", "0.028"), "the unit is mm"),
                ((*self.both, "--square", "nan"), "'nan' is not a number"),
                ((*self.both, "--timeout", "nan"), "'nan' is not a number"),
                ((*self.both, "--model", "pinhole"), "pinhole"),
                (("--board", "a.bmp"), "must end in .pdf or .png")):
            with self.subTest(words):
                done = self.run_program(*words)
                self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
                self.assertIn(expected, done.stderr)


class Board(Program):
    def test_is_printed_in_true_size(self):
        for name in ("board.pdf", "board.png"):
            done = self.run_program("--board", name, "--squares", "8x6", "--square", "30", "--paper",
                                    "A3")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertRegex(done.stdout, r"8x6 squares of 30 mm, markers of 22.5 mm")
        for name in ("board.pdf", "board.png"):  # replaced only if it is a board
            (FOLDER / f"my-{name}").write_text("mine")
            done = self.run_program("--board", f"my-{name}")
            self.assertEqual(done.returncode, 1)
            self.assertIn("is in the way", done.stderr)
            self.assertEqual((FOLDER / f"my-{name}").read_text(), "mine")
        self.assertTrue((FOLDER / "board.pdf").read_bytes().startswith(b"%PDF-1.4"))
        self.assertTrue((FOLDER / "board.png").read_bytes().startswith(b"\x89PNG"))

    def test_that_does_not_fit_is_refused(self):
        done = self.run_program("--board", "large.pdf", "--square", "40")
        self.assertEqual(done.returncode, 1)
        self.assertTrue(re.search("does not fit on A4: choose a larger --paper", done.stderr))


if __name__ == "__main__":
    unittest.main(verbosity=2)
