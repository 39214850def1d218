#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Feature: files of the user are kept
"""No run of mtstereo-run changes or removes an input or a foreign file.

Random combinations of commands, options, places of the inputs, foreign files that have the names of
results, runs at the same time and kill -9. After every command, all inputs and foreign files are
compared with what they were. --combinations 1000 takes about half an hour.
"""

import argparse
import collections
import hashlib
import os
import pathlib
import random
import shutil
import signal
import stat
import subprocess
import sys
import tempfile
import time

SKIPPED = 77
TIMEOUT = 120  # [s]
PARAMETERS = ["--max-disparity", "16", "--alignment", "off", "--threads", "1", "--quiet"]

# Names that mtstereo-run writes or might write, below the folder of --out.
NAMES = [
    "disparity.mkv", "depth.mkv", "color.mkv", "confidence.mkv", "run.json", "piece.json",
    "disparity/notes.txt", "disparity/000000.png", "color/mine.png", "confidence/deep/mine",
    "clouds/mine.ply", "unfinished/journal", "unfinished/notes.txt", "unfinished/disparity/mine.png",
    "unfinished/disparity.mkv.mine", "notes.txt", "plan.json", "summary.json", "works/clips.json",
    "works/notes.txt", "pieces/0/mine", "pieces/0/whole.json", "recordings/clips/run.json",
    "recordings/notes.txt", "log/mine.log", "plan/plan.json", "plan/notes.txt", "plan/pieces/1/mine",
    "plan/recordings/clips/mine", "plan/unfinished/mine", "plan/works/mine.json", "clips/run.json",
    "clips/disparity.mkv", "a/disparity.mkv", "a/unfinished/mine", "b/color.mkv", "b/run.json",
]  # fmt: skip
# Formerly whole files of this program, and others that look like them.
TEXTS = [
    "mine\n", "{}\n", '{"kind": "report of mtstereo-run", "files": 7}\n', '{"version": 1}\n',
    "mtstereo-run journal of my trip\n", "\x1aE\xdf\xa3 no video",
]  # fmt: skip


def fingerprint(path):
    """What a path is, and its content."""
    try:
        mode = path.lstat().st_mode
    except (FileNotFoundError, NotADirectoryError):
        return "missing"
    if stat.S_ISREG(mode):
        return hashlib.sha256(path.read_bytes()).hexdigest()
    if stat.S_ISLNK(mode):
        return f"link to {os.readlink(path)}"
    return f"kind {stat.S_IFMT(mode):o}"


def runs_still(group):
    """Whether a process of a group has not ended: the jobs of a program that was killed."""
    for file in pathlib.Path("/proc").glob("[0-9]*/stat"):
        try:
            state, _, its_group = file.read_text(errors="replace").rpartition(")")[2].split()[:3]
        except (OSError, ValueError):
            continue  # it has ended meanwhile
        if int(its_group) == group and state not in "ZX":
            return True
    return False


def ends(group):
    """Waits for the end of a group of processes."""
    last = time.monotonic() + TIMEOUT
    while runs_still(group):
        if time.monotonic() > last:
            os.killpg(group, signal.SIGKILL)
            return False
        time.sleep(0.02)
    return True


class Combination:
    """A folder with inputs and foreign files, and what is done with it."""

    def __init__(self, program, clips, folder, chance):
        self.program, self.folder, self.chance = program, folder, chance
        self.out = folder / "out"
        self.kept = {}  # fingerprints of inputs and foreign files
        self.log = []
        self.statuses = collections.Counter()
        self.groups = []  # of processes
        self.inputs = self.place_inputs(clips)
        for _ in range(chance.choice((0, 0, 1, 1, 2, 4))):
            self.plant()

    def keep(self, path):
        self.kept[path] = fingerprint(path)

    def place_inputs(self, clips):
        """Copies the inputs, maybe into the folder of the results, and maybe with links to them."""
        kind = self.chance.choice(("videos", "videos", "videos", "images", "archive"))
        inside = self.chance.random() < 0.4
        home = self.out if inside else self.folder / "in"
        home.mkdir(parents=True)
        if kind == "archive":
            for name in ("a", "b"):
                shutil.copytree(clips / "videos", home / "archive" / name)
            inputs = [home / "archive"]
        elif kind == "images":
            inputs = [home / name for name in self.chance.choice((("left", "right"), ("disparity", "color")))]
            for view, path in zip(("left", "right"), inputs):
                shutil.copytree(clips / "images" / view, path)
        else:
            names = self.chance.choice((("left.mp4", "right.mp4"), ("color.mkv", "disparity.mkv")))
            inputs = [home / name for name in names]
            for view, path in zip(("left", "right"), inputs):
                shutil.copy(clips / "videos" / f"{view}.mp4", path)
        files = [path for top in inputs for path in ([top] if top.is_file() else top.rglob("*"))]
        for path in files:
            self.keep(path)
        if self.chance.random() < 0.3 and files[0].is_file():
            self.link(files[0])
        return inputs

    def link(self, file):
        path = self.out / self.chance.choice(("disparity.mkv", "color.mkv", "run.json"))
        self.out.mkdir(exist_ok=True)
        if os.path.lexists(path):
            return
        if self.chance.random() < 0.5:
            os.link(file, path)
        else:
            path.symlink_to(file)
        self.keep(path)

    def plant(self):
        """Puts a foreign file where no file is."""
        path = self.out / self.chance.choice(NAMES)
        kind = self.chance.choice(("file", "file", "file", "pipe", "link"))
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            if os.path.lexists(path):
                return
            if kind == "file":
                path.write_text(self.chance.choice(TEXTS))
            elif kind == "pipe":
                os.mkfifo(path)
            else:
                target = self.folder / "target"
                target.write_text("mine\n")
                self.keep(target)
                path.symlink_to(target)
        except (FileExistsError, NotADirectoryError):
            return  # a file has the name of the folder
        self.log.append(f"plant {kind} {path.relative_to(self.folder)}")
        self.keep(path)

    def replace_result(self):
        """The user writes a file of their own over a result."""
        results = [path for path in self.out.rglob("*.*") if path.suffix in (".mkv", ".png")]
        results = [path for path in results if path.is_file() and path not in self.kept]
        results = [path for path in results if "unfinished" not in path.parts and "plan" not in path.parts
                   and "pieces" not in path.parts and "recordings" not in path.parts]  # fmt: skip
        if not results:
            return
        path = self.chance.choice(sorted(results))
        path.unlink()
        path.write_text("the user's own image\n")
        self.log.append(f"replace {path.relative_to(self.folder)}")
        self.keep(path)

    def options(self):
        products = self.chance.sample(("disparity", "color", "confidence"), self.chance.choice((1, 1, 2)))
        return ["--what", ",".join(products), "--format", self.chance.choice(("mkv", "mkv", "png", "pfm")),
                *self.chance.choice(([], ["--resume"], ["--overwrite"], ["--overwrite"])), *PARAMETERS]  # fmt: skip

    def command(self):
        kind = self.chance.choice(("run", "run", "run", "run", "jobs", "jobs", "plan", "task", "merge"))
        if kind in ("task", "merge"):
            plan = self.out / "plan" if (self.out / "plan/plan.json").exists() else self.out
            number = [str(self.chance.choice((0, 0, 1)))] if kind == "task" else []
            pieces = ["--remove-pieces"] if kind == "merge" and self.chance.random() < 0.3 else []
            return [self.program, kind, *number, "--plan", str(plan), *pieces]
        jobs = ["--jobs", "2"] if kind == "jobs" else []
        plan = ["plan"] if kind == "plan" else []
        return [self.program, *plan, *map(str, self.inputs), "--out", str(self.out), *jobs, *self.options()]

    def run(self):
        """Runs a command, or two at the same time, and maybe kills one of them."""
        commands = [self.command()]
        if self.chance.random() < 0.2:
            commands.append(self.chance.choice((commands[0], self.command())))
        self.log.extend(" ".join(command) for command in commands)
        processes = [subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                      stderr=subprocess.PIPE, text=True, errors="replace",
                                      start_new_session=True)
                     for command in commands]  # fmt: skip
        self.groups.extend(process.pid for process in processes)
        if self.chance.random() < 0.3:
            time.sleep(self.chance.uniform(0, 0.6))
            processes[0].kill()
        for process in processes:
            try:
                _, errors = process.communicate(timeout=TIMEOUT)
            except subprocess.TimeoutExpired:
                process.kill()
                process.communicate()
                return "a command does not end"
            self.statuses[process.returncode] += 1
            self.log.append(f"  {process.returncode}: {errors.strip()}")
            if process.returncode not in (0, 1, 3, -9):
                return f"a command ends with {process.returncode}"
        return ""

    def lost(self):
        return [f"{path.relative_to(self.folder)}: {before} is {fingerprint(path)}"
                for path, before in self.kept.items() if fingerprint(path) != before]  # fmt: skip

    def check(self):
        """Does some commands. Returns what is wrong."""
        wrong = self.do_commands()
        if not all([ends(group) for group in self.groups]):
            return ["the jobs of a command do not end"]
        return wrong or self.lost()

    def do_commands(self):
        for step in range(self.chance.choice((1, 2, 2, 3))):
            if step > 0 and self.chance.random() < 0.5:
                self.chance.choice((self.plant, self.replace_result))()
            wrong = self.run()
            if wrong:
                return [wrong]
            if self.lost():
                return self.lost()
        return []


def make_clips(folder):
    for name in ("videos", "images/left", "images/right"):
        (folder / name).mkdir(parents=True)
    for view, column in {"left": 0, "right": 4}.items():
        video = folder / "videos" / f"{view}.mp4"
        subprocess.run(["ffmpeg", "-v", "error", "-f", "lavfi", "-i", "testsrc2=size=100x64:rate=30",
                        "-frames:v", "6", "-vf", f"crop=96:64:{column}:0", "-c:v", "libx264", video],
                       check=True, stdin=subprocess.DEVNULL)  # fmt: skip
        subprocess.run(["ffmpeg", "-v", "error", "-i", video, folder / "images" / view / "%02d.png"],
                       check=True, stdin=subprocess.DEVNULL)  # fmt: skip


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--combinations", type=int, default=25)
    parser.add_argument("--first", type=int, default=1, help="the seed of the first one")
    arguments = parser.parse_args()
    if shutil.which("ffmpeg") is None:
        print("ffmpeg is not installed")
        return SKIPPED
    failed = files = 0
    statuses = collections.Counter()
    with tempfile.TemporaryDirectory(prefix="mtstereo-nothing-lost-") as temporary:
        top = pathlib.Path(temporary)
        make_clips(top / "clips")
        for seed in range(arguments.first, arguments.first + arguments.combinations):
            combination = Combination(arguments.program, top / "clips", top / str(seed), random.Random(seed))
            wrong = combination.check()
            files += len(combination.kept)
            statuses += combination.statuses
            shutil.rmtree(combination.folder)
            if wrong:
                failed += 1
                print(f"combination {seed} (--first {seed} --combinations 1):", *combination.log, *wrong, sep="\n  ")
    print(f"{arguments.combinations} combinations, {sum(statuses.values())} commands with the exit statuses "
          f"{dict(sorted(statuses.items()))}, {files} inputs and foreign files, {failed} combinations failed")  # fmt: skip
    if statuses[0] == 0:
        print("no command succeeded, so nothing was tested")
        return 1
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
