#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The pipeline scripts with files, and with invalid input."""
import os
import re
import signal
import time
import unittest

from matroska import lose_frames
from support import COMPARE, PIPELINES, SLOW, ClipTest, count_frames, launch, require
from support import run, start, stop

RATE = 24
HEADLESS = ("--sink", "fakesink")


class ReadyPipelines(ClipTest):
    def compare(self, disparity):
        """avgerr [px], D-all [%] and density [%] of a folder of disparity images."""
        done = require(run([COMPARE, "--disparity", disparity, "--truth", "clip/truth"],
                           self.folder))
        return [float(word) for word in done.output.split()[2:5]]

    # Feature: recording without loss
    def test_files_are_recorded_without_lost_frames(self):
        done = self.run_script("from-files.sh", "left.mp4", "right.mp4", "--out", "files.mkv",
                               "--max-disparity", "32", "--set", "threads=1")
        self.assert_succeeds(done)
        self.assertEqual(count_frames("files.mkv", self.folder), 8)

    def test_files_are_shown(self):
        self.assert_succeeds(self.run_script("from-files.sh", "left.mkv", "right.mp4", *HEADLESS))

    @unittest.skipIf(os.path.exists("/dev/dri") or os.path.exists("/dev/fb0"), "has a display")
    def test_without_a_display_the_remedy_is_named(self):
        windows = [word for name in ("DISPLAY", "WAYLAND_DISPLAY") for word in ("-u", name)]
        done = run(["env", *windows, PIPELINES / "from-files.sh", "left.mp4", "right.mp4"],
                   self.folder)
        self.assert_rejects(done, "there is no display: record with --out", 1)

    def test_side_by_side_gives_the_result_of_two_files(self):
        done = self.run_script("from-side-by-side.sh", "side-by-side.mp4", "--out", "sbs.mkv")
        self.assert_succeeds(done)
        self.assertEqual(count_frames("sbs.mkv", self.folder), 8)
        require(run(["bash", "-c", "mkdir -p sbs && gst-launch-1.0 -q filesrc location=sbs.mkv ! "
                     "matroskademux ! avdec_ffv1 ! videoconvert ! video/x-raw,format=GRAY16_BE ! "
                     "pngenc ! multifilesink location=sbs/%06d.png"], self.folder))
        error, _, density = self.compare("sbs")
        # With swapped halves, or not cropped at the center, almost nothing would match.
        self.assertLess(error, 3)
        self.assertGreater(density, 15)

    def test_a_calibration_leads_to_depths_and_clouds(self):
        # The calibration of the rendered clip, in Middlebury's format.
        done = self.run_script("from-files.sh", "left.mp4", "right.mkv", "--calibration",
                               "clip/calib.txt", "--depth", "20", "--cloud", "cloud%d.ply", "--out",
                               "depth%d.png")
        self.assert_succeeds(done)
        self.assertEqual(len(list(self.folder.glob("cloud?.ply"))), 8)
        header = (self.folder / "depth7.png").read_bytes()[24:26]
        self.assertEqual(header, bytes([16, 0]), "16 bit, gray")
        cloud = (self.folder / "cloud7.ply").read_bytes().split(b"end_header")[0]
        self.assertGreater(int(re.search(rb"element vertex (\d+)", cloud)[1]), 1000)

    def test_depths_are_shown_in_colors(self):
        self.assert_succeeds(self.run_script(
            "from-side-by-side.sh", "side-by-side.mp4", "--calibration", "clip/calib.txt",
            "--depth", "20", *HEADLESS))

    # Feature: recording without loss
    # Feature: documented scale that can be selected
    def test_png_images_become_kitti_images(self):
        done = self.run_script("from-png.sh", "left/%06d.png", "right/%06d.png",
                               "new/folder/%06d.png")
        self.assert_succeeds(done)
        self.assertEqual(len(list((self.folder / "new/folder").iterdir())), 8)
        header = (self.folder / "new/folder/000003.png").read_bytes()[24:26]
        self.assertEqual(header, bytes([16, 0]), "16 bit, gray")
        error, _, density = self.compare("new/folder")
        self.assertLess(error, 3)
        self.assertGreater(density, 15)

    def test_first_image_can_be_selected(self):
        done = self.run_script("from-png.sh", "left/%06d.png", "right/%06d.png", "late/%06d.png",
                               "--first", "5")
        self.assert_succeeds(done)
        names = sorted(file.name for file in (self.folder / "late").iterdir())
        self.assertEqual(names, ["000005.png", "000006.png", "000007.png"])

    def lossy(self, side, lost):
        """The clip as a file of independent frames, without some of them."""
        require(launch(f"multifilesrc location={side}/%06d.png caps=image/png,framerate=24/1 ! "
                       f"pngdec ! videoconvert ! jpegenc quality=95 ! matroskamux ! "
                       f"filesink location=whole-{side}.mkv", self.folder))
        name = f"lossy-{side}.mkv"
        count = lose_frames(self.folder / f"whole-{side}.mkv", self.folder / name, lost)
        self.assertEqual(count, 8)
        self.assertEqual(count_frames(name, self.folder), 8 - len(lost))
        return name

    def test_lost_frames_drop_only_their_pairs(self):
        left, right = self.lossy("left", [2]), self.lossy("right", [4, 5])
        done = run(["gst-launch-1.0", "-v", *f"filesrc location={left} ! decodebin ! videoconvert ! "
                    f"m.sink_left filesrc location={right} ! decodebin ! videoconvert ! m.sink_right "
                    "mtstereo name=m ! "
                    "fakesink silent=false".split()], self.folder)
        self.assert_succeeds(done)
        times = re.findall(r"chain .*pts: 0:00:0(\d\.\d\d)", done.text)
        expected = [f"{int(100 * n / RATE) / 100:.2f}" for n in (0, 1, 3, 6, 7)]
        self.assertEqual(times, expected, str(done))

    def test_one_file_with_two_video_tracks_gives_the_result_of_two_files(self):
        for extension, demuxer, muxer in (("mkv", "matroskademux", "matroskamux"),
                                          ("mp4", "qtdemux", "mp4mux")):
            with self.subTest(extension):
                require(launch(f"{muxer} name=file ! filesink location=tracks.{extension} "
                               "filesrc location=left.mkv ! matroskademux ! h264parse ! queue ! "
                               "file.video_0 "
                               "filesrc location=right.mkv ! matroskademux ! h264parse ! queue ! "
                               "file.video_1", self.folder))
                folder = f"tracks-{extension}"
                (self.folder / folder).mkdir()
                require(launch("mtstereo name=m ! videoconvert ! video/x-raw,format=GRAY16_BE ! "
                               f"pngenc ! multifilesink location={folder}/%06d.png "
                               f"filesrc location=tracks.{extension} ! {demuxer} name=file "
                               "file.video_0 ! queue ! decodebin ! videoconvert ! queue ! m.sink_left "
                               "file.video_1 ! queue ! decodebin ! videoconvert ! queue ! "
                               "m.sink_right", self.folder))
                self.assertEqual(len(list((self.folder / folder).iterdir())), 8)
                error, _, density = self.compare(folder)
                # With swapped tracks almost nothing would match.
                self.assertLess(error, 3)
                self.assertGreater(density, 15)

    def test_unlinked_pad_is_reported(self):
        done = run(["gst-launch-1.0", *"videotestsrc ! m.sink_left mtstereo name=m "
                    "timeout=300000000 ! fakesink".split()], self.folder)
        self.assertEqual(done.status, 1, str(done))
        self.assertIn("sink_right is not linked", done.text)

    def test_interrupt_ends_a_pipeline_with_a_silent_source(self):
        process = start(["gst-launch-1.0", "-e", "-v",
                         *"videotestsrc ! video/x-raw,format=GRAY8,width=64,height=48 ! m.sink_left "
                         "appsrc format=time caps=video/x-raw,format=GRAY8,width=64,height=48,"
                         "framerate=30/1 ! m.sink_right mtstereo name=m ! fakesink".split()],
                        self.folder)
        self.addCleanup(stop, process)
        time.sleep(2 * SLOW)  # both sources wait then: an appsrc may miss an end before
        process.send_signal(signal.SIGINT)
        output, errors = process.communicate(timeout=30 * SLOW)
        self.assertEqual(process.returncode, 0, output + errors)
        self.assertIn("Got EOS", output)

    def test_stream_that_ends_early_ends_the_output(self):
        right = self.lossy("right", [5, 6, 7])
        done = self.run_script("from-files.sh", "left.mp4", right, "--out", "short.mkv")
        self.assert_succeeds(done)
        self.assertEqual(count_frames("short.mkv", self.folder), 5)

    def test_cameras_get_the_requested_caps(self):
        done = self.run_script("from-cameras.sh", "/dev/video0", "/dev/video2", "--size", "320x240",
                               "--rate", "15", "--dry-run")
        self.assert_succeeds(done)
        for words in ("v4l2src device=/dev/video0", "v4l2src device=/dev/video2",
                      "width=320,height=240,framerate=15/1"):
            self.assertIn(words, done.output)

    # Feature: demo, scripts and documentation
    def test_camera_pipelines_run_on_test_images(self):
        for words in (["from-cameras.sh", "/dev/video0", "/dev/video2"],
                      ["from-side-by-side.sh", "/dev/video0", "--size", "640x240"]):
            done = self.run_script(*words, "--sink", "fakesink num-buffers=3", "--dry-run")
            self.assert_succeeds(done)
            line = re.sub(r"v4l2src device=\S+", "videotestsrc is-live=true", done.output)
            self.assert_succeeds(run(["bash", "-c", line], self.folder))

    def test_dry_run_prints_a_working_command(self):
        spaced = self.folder / "it's left.mp4"
        spaced.write_bytes((self.folder / "left.mp4").read_bytes())
        done = self.run_script("from-files.sh", spaced, "right.mp4", "--out", "dry run.mkv",
                               "--dry-run")
        self.assert_succeeds(done)
        self.assertFalse((self.folder / "dry run.mkv").exists())
        self.assert_succeeds(run(["bash", "-c", done.output], self.folder))
        self.assertEqual(count_frames("dry run.mkv", self.folder), 8)


class WrongUse(ClipTest):
    def test_missing_inputs_are_named(self):
        for words, says in (
                (["from-files.sh", "left.mp4", "no.mp4"], "no.mp4"),
                (["from-files.sh", "left.mp4", "left"], "folder"),
                (["from-side-by-side.sh", "no.mp4"], "no.mp4"),
                (["from-side-by-side.sh", "clip/calib.txt", *HEADLESS], "type of stream"),
                (["from-files.sh", "left.mp4", "right.mkv", "--calibration", "no.yml"], "no.yml"),
                (["from-cameras.sh", "/dev/video97", "/dev/video98"], "/dev/video97"),
                (["from-side-by-side.sh", "/dev/video97"], "/dev/video97"),
                (["from-png.sh", "left/%06d.png", "nowhere/%06d.png", "o/%06d.png"], "nowhere"),
                (["from-png.sh", "left/%06d.png", "right/%06d.png", "o/%06d.png", "--first", "99"],
                 "000099.png")):
            self.assert_rejects(self.run_script(*words), says, 1)

    def test_input_is_never_overwritten(self):
        before = (self.folder / "left.mp4").read_bytes()
        done = self.run_script("from-files.sh", "left.mp4", "right.mkv", "--out", "./left.mp4")
        self.assert_rejects(done, "the input itself", 1)
        self.assertEqual((self.folder / "left.mp4").read_bytes(), before)

    def test_invalid_options_are_named(self):
        files = ["left.mp4", "right.mp4"]
        for words, says in (
                (["from-files.sh", "left.mp4"], "LEFT and RIGHT"),
                (["from-files.sh", *files, "--mode", "denser"], "--mode"),
                (["from-files.sh", *files, "--max-disparity", "many"], "--max-disparity"),
                (["from-files.sh", *files, "--max-disparity", "5000"], "1 to 1984"),
                (["from-files.sh", *files, "--set", "threads"], "--set"),
                (["from-files.sh", *files, "--seconds", "1.5"], "--seconds"),
                (["from-files.sh", *files, "--seconds"], "--seconds"),
                (["from-files.sh", *files, "--size", "3x3"], "--size"),
                (["from-files.sh", *files, "--depth", "5"], "--calibration"),
                (["from-files.sh", *files, "--calibration", "c", "--depth", "far"], "--depth"),
                (["from-files.sh", *files, "--calibration", "c", "--alpha", "2"], "--alpha"),
                (["from-files.sh", *files, "--alpha", "1"], "--calibration"),
                (["from-files.sh", *files, "--calibration", "c", "--rectified-size", "5"],
                 "--rectified-size"),
                (["from-files.sh", *files, "--calibration", "c", "--cloud", "c.xyz"], "--cloud"),
                (["from-side-by-side.sh", "both.mp4", "--layout", "mixed"], "--layout"),
                (["from-cameras.sh", "/dev/video0"], "two cameras"),
                (["from-cameras.sh", "/dev/video0", "/dev/video2", "--size", "big"], "--size"),
                (["from-cameras.sh", "/dev/video0", "/dev/video2", "--rate", "fast"], "--rate"),
                (["from-side-by-side.sh", "/dev/video0", "--size", "5"], "--size"),
                (["from-png.sh", "left", "right"], "left/%06d.png"),
                (["from-png.sh", "l%d.png", "r%d.png", "--first", "x"], "--first"),
                (["from-png.sh", "l%s%n.png", "r%d.png"], "l%s%n.png")):
            self.assert_rejects(self.run_script(*words), says, 2)

    def test_unknown_property_is_named(self):
        done = self.run_script("from-files.sh", "left.mp4", "right.mp4", *HEADLESS, "--set",
                               "speed=11")
        self.assertNotEqual(done.status, 0, str(done))
        self.assertIn("speed", done.errors)

    def test_failure_leaves_no_empty_file(self):
        done = self.run_script("from-side-by-side.sh", "clip/calib.txt", "--out", "new.mkv")
        self.assert_rejects(done, "type of stream", 1)
        self.assertFalse((self.folder / "new.mkv").exists())

    def test_existing_file_is_kept(self):
        kept = self.folder / "kept"
        kept.mkdir()
        names = ("map.mkv", "000007.png", "points 3.ply")
        for name in names:
            (kept / name).write_bytes(b"of the user")
        for name, options in {
                "map.mkv": ["--out", "kept/map.mkv"],
                "000007.png": ["--out", "kept/%06d.png"],
                "points 3.ply": ["--calibration", "clip/calib.txt", "--cloud", "kept/points %d.ply"],
        }.items():
            done = self.run_script("from-files.sh", "left.mp4", "right.mp4", *options)
            self.assert_rejects(done, f"kept/{name} exists", 1)
        for name in names:
            self.assertEqual((kept / name).read_bytes(), b"of the user")

    def test_missing_build_is_reported(self):
        done = self.run_script("from-files.sh", "left.mp4", "right.mp4", "--build", "nowhere")
        self.assert_rejects(done, "nowhere", 1)

    def test_every_script_has_its_help(self):
        for script in sorted(PIPELINES.glob("*.sh")):
            if script.name in ("common.sh", "demo-raw.sh", "install-packages.sh", "installed_plugin.sh",
                               "network.sh", "plugin.sh"):
                continue
            done = self.run_script(script.name, "--help")
            self.assert_succeeds(done)
            self.assertIn(script.name, done.output.splitlines()[0])
            self.assertNotIn("set -euo", done.output)


if __name__ == "__main__":
    unittest.main(verbosity=2)
