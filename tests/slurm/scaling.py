#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Measures what docs/appendix/scaling.md states: throughput with the nodes of a Slurm cluster on this machine.

usage: scaling.py BUILD [--nodes 1,2,4] [--tasks 8] [--seconds 5] [--frames 480] [--size 640x480]
BUILD is a build folder. Makes a recording, and prints the tables of the page and the numbers of the
model. It takes about 5 minutes on an idle machine with two processors, and 2 GB in the temporary
folder.
"""
import argparse
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import time

from local_slurm import LocalSlurm

MODEL = pathlib.Path(__file__).resolve().parents[2] / "docs/figures/scaling.py"
# Rendered frames; longer recordings repeat them.
RENDERED = 120
PAIRS_PER_TASK = 240
# Of the recording whose index is timed, as copies of the other one.
COPIES = 15
# Times of plans are the smallest of some, and differences below this are not resolved [s].
REPEATS = 3
RESOLUTION = 0.1
OPTIONS = ["--threads", "1", "--max-disparity", "64"]


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--nodes", default="1,2,4")
    parser.add_argument("--tasks", type=int, default=8, help="tasks that wait (default 8)")
    parser.add_argument("--seconds", type=float, default=5, help="that they wait (default 5)")
    parser.add_argument("--frames", type=int, default=1920, help="of the recording (default 1920)")
    parser.add_argument("--size", default="640x480", help="of a view (default 640x480)")
    return parser.parse_args()


def run(*words, **options):
    """Runs a program; its processor time and its time [s]."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    start = time.monotonic()
    done = subprocess.run([str(word) for word in words], stdin=subprocess.DEVNULL, check=False,
                          capture_output=True, text=True, **options)
    if done.returncode != 0:
        raise SystemExit(f"{words[0]}: {done.stdout}{done.stderr}")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return (after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime,
            time.monotonic() - start)


def use_build(build):
    """Programs of the build use its libraries and its plugin."""
    os.environ["LD_LIBRARY_PATH"] = f"{build / 'core'}:{build / 'core/geometry'}"
    os.environ["GST_PLUGIN_PATH"] = str(build / "gst")


class Programs:
    def __init__(self, build):
        self.run = build / "pipelines/programs/run/mtstereo-run"
        self.fake_run = build / "tests/pipelines/programs/run/fake-run"
        self.render = build / "pipelines/tools/render/mtstereo-render"
        missing = [str(file) for file in vars(self).values() if not file.exists()]
        if missing:
            raise SystemExit("not built: " + ", ".join(missing))


def make_recordings(programs, options, folder):
    """A recording in H.264, and a long one of the same pictures."""
    run(programs.render, folder / "clip", "--size", options.size, "--frames", RENDERED, "--samples", 1)
    for side in ("left", "right"):
        short = folder / "short" / f"street-{side}.mp4"
        for file in (short, folder / "long" / short.name):
            file.parent.mkdir(exist_ok=True)
        run("ffmpeg", "-v", "error", "-framerate", 30, "-stream_loop", -1, "-i",
            folder / f"clip/{side}/%06d.png", "-frames:v", options.frames, "-pix_fmt", "yuv420p",
            "-c:v", "libx264", "-preset", "veryfast", "-bf", 2, "-g", 30, short)
        run("ffmpeg", "-v", "error", "-stream_loop", COPIES - 1, "-i", short, "-c", "copy",
            folder / "long" / short.name)


def size_of(folder, pattern="**/*"):
    return sum(file.stat().st_size for file in folder.glob(pattern) if file.is_file())


def submit(cluster, program, plan):
    """Submits everything. The number of the merge."""
    done = cluster.run(program, "slurm", "--plan", plan)
    found = re.search(r"merge: job (\d+)", done.stdout)
    if found is None:
        raise SystemExit(done.stdout + done.stderr)
    return found[1]


def measure(program, source, nodes, folder):
    """Seconds until all tasks ended, and until the merge ended."""
    plan = folder / "plan"
    shutil.copytree(source / "works", plan / "works")
    shutil.copy(source / "plan.json", plan)
    cluster = LocalSlurm(folder / "slurm", nodes)
    try:
        cluster.start()
        start = time.monotonic()
        merge = submit(cluster, program, plan)
        cluster.wait(lambda: all(name.endswith("-merge") for name, _ in cluster.jobs()),
                     "tasks do not end", 3600)
        tasks = time.monotonic() - start
        cluster.wait_for_jobs()
        whole = time.monotonic() - start
        state = cluster.state_of(merge)
    finally:
        cluster.stop()
    if state != "COMPLETED 0:0":
        raise SystemExit(f"the merge ended with {state}")
    return tasks, whole


def print_row(*values):
    print(f"| {' | '.join(str(value) for value in values)} |", flush=True)


def scale(programs, kind, plan, options, row):
    """A row of a table for each number of nodes. The last cell of the first row."""
    first = None
    cells = []
    for nodes in map(int, options.nodes.split(",")):
        with tempfile.TemporaryDirectory(prefix="mtstereo-scaling-") as folder:
            tasks, whole = measure(getattr(programs, kind), plan, nodes, pathlib.Path(folder))
        first = first or tasks
        cells.append(row(nodes, tasks))
        print_row(nodes, f"{tasks:.1f}", f"{whole:.1f}", f"{first / tasks:.2f}", cells[-1])
    return cells[0]


def waiting_tasks(programs, options, folder):
    """Prints the table. The time that the scheduler takes for a task [s]."""
    pairs = 5
    run(programs.fake_run, "plan", folder, options.tasks * pairs, pairs)
    os.environ["MTSTEREO_FAKE_MS"] = str(round(1000 * options.seconds / pairs))
    print(f"\nTasks that wait: {options.tasks} tasks of {options.seconds:g} s.\n")
    print("| nodes | tasks, s | with merge, s | relative | beyond the waiting, s per task |\n"
          "| --- | --- | --- | --- | --- |")

    def beyond(nodes, tasks):
        rounds = -(-options.tasks // nodes)
        return f"{tasks / rounds - options.seconds:.1f}"
    return float(scale(programs, "fake_run", folder, options, beyond))


def matching_tasks(programs, options, plan):
    print(f"\nTasks that match: {options.frames} pairs of {options.size}, "
          f"{-(-options.frames // PAIRS_PER_TASK)} tasks of {PAIRS_PER_TASK} pairs.\n")
    print("| nodes | tasks, s | with merge, s | relative | pairs/s |\n| --- | --- | --- | --- | --- |")
    scale(programs, "run", plan, options, lambda _, tasks: f"{options.frames / tasks:.1f}")


def plan_time(programs, recording, plan, *options):
    """Processor time of the plan of a recording, which is left at `plan` [s]."""
    times = []
    for _ in range(REPEATS):
        shutil.rmtree(plan, ignore_errors=True)
        times.append(run(programs.run, "plan", recording, "--out", plan, *options, *OPTIONS)[0])
    return min(times)


def further_figures(programs, options, folder, plan, scheduler):
    """Prints them, and returns the options of the model."""
    count = -(-options.frames // PAIRS_PER_TASK)
    processor = [run(programs.run, "task", number, "--plan", plan, "--threads", 1)[0]
                 for number in range(count)]
    short = plan_time(programs, folder / "short", folder / "tiny", "--pairs-per-task", 1)
    start = min(run(programs.run, "task", number, "--plan", folder / "tiny", "--threads", 1)[0]
                for number in range(3))
    pair = (sum(processor) / count - start) / (PAIRS_PER_TASK - 1)
    read = size_of(folder / "short") / options.frames
    written = size_of(plan / "pieces", "*/disparity.mkv")
    merge = run(programs.run, "merge", "--plan", plan)[0]
    merge -= run(programs.run, "merge", "--plan", plan)[0]  # that finds all joined
    index = max(plan_time(programs, folder / "long", folder / "long-plan") - short, RESOLUTION)
    speed = (size_of(folder / "long") - size_of(folder / "short")) / 1e6 / index
    print("\n| further figure, of the same recording | measured |\n| --- | --- |")
    print_row("processor time of a pair, with decoding and encoding", f"{1000 * pair:.0f} ms")
    print_row("processor time of the start of a task", f"{start:.2f} s")
    print_row("size of a pair in the recordings (H.264, both views)", f"{read / 1000:.0f} KB")
    print_row("size of a pair in the results (disparity, FFV1)",
              f"{written / options.frames / 1000:.0f} KB")
    print_row(f"merge, in one process: {written / 1e6:.0f} MB in {merge:.2f} s of processor time",
              f"{written / 1e6 / merge:.0f} MB/s")
    print_row("plan: correction of the views of a recording", f"{short:.1f} s")
    print_row(f"plan: index of {size_of(folder / 'long') / 1e6:.0f} MB in {index:.1f} s or less",
              f"{speed:.0f} MB/s")
    kilobytes = [f"{size / 1000:.0f}" for size in (read, written / options.frames)]
    return ["--pair", f"{pair:.3f}", "--start", f"{scheduler + start:.1f}",
            "--bytes-in", kilobytes[0], "--bytes-out", kilobytes[1], "--prepare", f"{short:.1f}",
            "--index", f"{speed:.0f}", "--merge", f"{written / 1e6 / merge:.0f}"]


def main():
    options = arguments()
    build = options.build.resolve()
    programs = Programs(build)
    use_build(build)
    start = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="mtstereo-scaling-") as name:
        folder = pathlib.Path(name)
        scheduler = waiting_tasks(programs, options, folder / "waiting")
        make_recordings(programs, options, folder)
        plan = folder / "plan"
        run(programs.run, "plan", folder / "short", "--out", plan, "--pairs-per-task", PAIRS_PER_TASK,
            *OPTIONS)
        matching_tasks(programs, options, plan)
        model = further_figures(programs, options, folder, plan, scheduler)
    print(f"\nModel: {MODEL.relative_to(MODEL.parents[2])} {' '.join(model)}\n", flush=True)
    subprocess.run([sys.executable, str(MODEL), *model], check=True)
    print(f"\nmeasured in {time.monotonic() - start:.0f} s, load at the end "
          f"{os.getloadavg()[0]:.1f}")


if __name__ == "__main__":
    main()
