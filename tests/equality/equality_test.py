#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Feature: files: complete and reproducible
"""The element gives the library's bytes: frames from PNG files and from H.264 files, 1, 2, 4 threads.

Runs on a rendered clip, and on a recorded one if MTSTEREO_TEST_DATA has it.
"""
import argparse
import os
import pathlib
import re
import subprocess
import sys
import tempfile

PASSED, FAILED = [], []
INTERVAL = 5  # pairs from one inspection of the views to the next


def run(command, **options):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True,
                          timeout=300, **options)
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(map(str, command))}\n{done.stdout}\n{done.stderr}")
    return done.stdout


def launch(line):
    run(["gst-launch-1.0", "-q", "-e"] + line.split())


def png_size(file):
    header = pathlib.Path(file).read_bytes()[:24]
    return int.from_bytes(header[16:20], "big"), int.from_bytes(header[20:24], "big")


class Clip:
    """Frames as PNG files: a file name pattern for each side, and their number."""

    def __init__(self, left, right, max_disparity, first, count):
        self.left, self.right = left, right
        self.max_disparity, self.first, self.count = max_disparity, first, count
        self.width, self.height = png_size(str(left) % first)

    def png_source(self, side):
        pattern = getattr(self, side)
        last = self.first + self.count - 1
        return (f"multifilesrc location={pattern} start-index={self.first} stop-index={last} "
                f"caps=image/png,framerate=10/1 ! pngdec ! videoconvert")


def video_source(file):
    return f"filesrc location={file} ! qtdemux ! h264parse ! avdec_h264"


def check(name, sources, raw_format, clip, match_raw, folder):
    files = name.replace(" ", "-")
    raw = {}
    for side, source in sources.items():
        raw[side] = folder / f"{files}-{side}.raw"
        launch(f"{source} ! video/x-raw,format={raw_format} ! filesink location={raw[side]}")
    for mode in ("sparse", "semi-dense"):
        wanted = folder / f"{files}-{mode}-library.raw"
        settings = [f"mode={mode}", f"max-disparity={clip.max_disparity}", "threads=1"]
        run([match_raw, raw["left"], raw["right"], wanted, clip.width, clip.height, clip.count,
             INTERVAL, *settings])
        for threads in (1, 2, 4):
            got = folder / f"{files}-{mode}-{threads}.raw"
            launch(f"mtstereo name=m mode={mode} max-disparity={clip.max_disparity} "
                   f"threads={threads} alignment-interval={INTERVAL} ! filesink location={got} "
                   f"{sources['left']} ! video/x-raw,format={raw_format} ! m.sink_left "
                   f"{sources['right']} ! video/x-raw,format={raw_format} ! m.sink_right")
            a, b = wanted.read_bytes(), got.read_bytes()
            title = f"{name}, {mode}, {threads} threads, {clip.count} frames"
            if a == b and any(a):
                PASSED.append(title)
                print(f"ok   {title}")
            else:
                at = next((i for i, (x, y) in enumerate(zip(a, b)) if x != y), min(len(a), len(b)))
                FAILED.append(title)
                print(f"FAIL {title}: {len(a)} bytes of the library, {len(b)} of the element, "
                      f"first difference at byte {at}")
            got.unlink()


def check_clip(name, clip, match_raw, folder):
    png = {side: clip.png_source(side) for side in ("left", "right")}
    check(f"{name} from PNG", png, "GRAY8", clip, match_raw, folder)
    video = {}
    for side, source in png.items():
        file = folder / f"{side}.mp4"
        launch(f"{source} ! video/x-raw,format=I420 ! x264enc tune=zerolatency quantizer=18 "
               f"pass=quant threads=1 ! h264parse ! qtmux ! filesink location={file}")
        video[side] = video_source(file)
    check(f"{name} from H.264", video, "I420", clip, match_raw, folder)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--match-raw", required=True)
    parser.add_argument("--render", required=True)
    parser.add_argument("--frames", type=int, default=20)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        run([arguments.render, "--size", "322x182", "--frames", arguments.frames, "--scene", "room",
             folder / "clip"])
        first = min(int(re.sub(r"\D", "", file.stem)) for file in (folder / "clip/left").iterdir())
        rendered = Clip(folder / "clip/left/%06d.png", folder / "clip/right/%06d.png", 48, first,
                        arguments.frames)
        (folder / "rendered").mkdir()
        check_clip("rendered", rendered, arguments.match_raw, folder / "rendered")

        recorded = pathlib.Path(os.environ.get("MTSTEREO_TEST_DATA", "")) / "kitti_sequence"
        if (recorded / "image_l").is_dir():
            clip = Clip(recorded / "image_l/%06d.png", recorded / "image_r/%06d.png", 100, 0,
                        min(arguments.frames, INTERVAL + 3))  # the second inspection, and maps after it
            (folder / "recorded").mkdir()
            check_clip("recorded", clip, arguments.match_raw, folder / "recorded")
        else:
            print("skip the recorded clip: MTSTEREO_TEST_DATA names no folder with one")
    print(f"{len(PASSED)} passed, {len(FAILED)} failed")
    return 1 if FAILED else 0


if __name__ == "__main__":
    sys.exit(main())
