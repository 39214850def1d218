#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The generated parts of docs/architecture.md: the table of steps and the diagram.

  mtstereo-figures --steps | architecture.py table
  mtstereo-figures --steps | architecture.py image IMAGE.png

The program prints the steps and the presets that run them. The memory that each step is given and
the stages that it calls are read from the files of the steps. The exit status is 1 if the two do not fit
together or a stage has no test, and if the image cannot be made.
"""
import pathlib
import re
import sys
from dataclasses import dataclass

SOURCE = pathlib.Path(__file__).resolve().parents[2]
ROWS = "core/matcher/steps.cpp"  # the lists
STEPS = ("view_steps", "time_steps", "path_steps", "node_steps", "map_steps", "result_steps", "rating")  # their functions
GROUPS = ("Views", "Nodes", "Costs", "Pyramid", "Maps", "ResultMaps", "ResultBuffers", "PastViews",
          "LastPair")
MODES = ("sparse", "semi-dense", "dense", "full")
INK, FAINT, EDGE = "#282828", "#767676", "#b4b4b4"
GST, CORE, ROOM = "#fdf0dc", "#e4eefa", "#f4f4f4"


class Mismatch(Exception):
    """The sources do not fit together; the message states where."""


@dataclass
class Step:
    list: str     # "View", "Path", ...
    name: str
    reads: list   # groups of the memory that it only reads
    writes: list  # groups that it reads and writes
    stages: list  # "room/stage" of each stage that it calls
    runs: dict    # preset -> modes that run it, as printed by the program


def printed_steps(text):
    """{(list, name): {preset: [mode, ...]}} from the lines of mtstereo-figures --steps."""
    steps = {}
    for line in text.splitlines():
        which, name, *runs = line.split()
        step = steps[which, name] = {}
        for run in runs:
            preset, mode = run.split("/")
            step.setdefault(preset, []).append(mode)
    return steps


def sources():
    return "\n".join((SOURCE / f"core/matcher/{file}.{end}").read_text() for file in STEPS
                     for end in ("hpp", "cpp"))


def declared_functions():
    """{function: "room/stage"} of the stages that the files of the steps include."""
    functions = {}
    for stage in re.findall(r'^#include "(stages/\w+/\w+|matcher/fine_detail)\.hpp"', sources(), re.MULTILINE):
        header = (SOURCE / f"core/{stage}.hpp").read_text()
        for name in re.findall(r"^[A-Za-z][\w:<>&*, ]* (\w+)\(", header, re.MULTILINE):
            functions[name] = stage.removeprefix("stages/")
    return functions


def stages_of(function, bodies, declared, seen=()):
    """The stages that a function of the steps calls, itself or by another one of them."""
    stages = []
    for name in re.findall(r"\b(\w+)\(", bodies[function][1]):
        found = [declared[name]] if name in declared else []
        if name in bodies and name != function and name not in seen:
            found += stages_of(name, bodies, declared, (*seen, function))
        stages += found
    return list(dict.fromkeys(stages))


def read_steps(text):
    """The lists of core/matcher/steps.cpp, with the presets that the program has printed."""
    printed, declared = printed_steps(text), declared_functions()
    # A body is on lines of its own, or on that of its function.
    bodies = {name: (arguments, body) for name, arguments, body in
              re.findall(r"^void (\w+)\(([^{;]*)\) \{(\n.*?^| [^\n]* )\}$", sources(), re.MULTILINE | re.DOTALL)}
    steps = []
    lists = re.findall(r"^constexpr Step k(\w+)List\[\] = \{\n(.*?)^\};", (SOURCE / ROWS).read_text(),
                       re.MULTILINE | re.DOTALL)
    for which, rows in lists:
        for name, function in re.findall(r'^\s*\{"([\w-]+)",.*on<(\w+)>\},$', rows, re.MULTILINE):
            groups = re.findall(r"(const )?(\w+)&", bodies[function][0])
            steps.append(Step(which, name, [group for const, group in groups if const and group in GROUPS],
                              [group for const, group in groups if not const],
                              stages_of(function, bodies, declared), printed.get((which, name))))
    check(steps, printed)
    return steps


def check(steps, printed):
    if [(step.list, step.name) for step in steps] != list(printed):
        raise Mismatch("the steps of core/matcher/steps.cpp are not those that the program prints: "
                       f"{[step.name for step in steps]} and {list(printed)}")
    for step in steps:
        for group in step.writes:
            if group not in GROUPS:
                raise Mismatch(f"{step.name}: {group} is no group of the memory")
        if not step.stages:
            raise Mismatch(f"{step.name} calls no stage")
        for stage in step.stages:
            folder = "" if stage.startswith("matcher/") else "stages/"
            path = f"tests/core/{folder}{stage}_test.cpp"
            if not (SOURCE / path).exists():
                raise Mismatch(f"{step.name}: there is no {path}")


def presets_of(step, steps):
    """Which presets run a step, in few words: "always", "default, fast", "mode dense"."""
    everything = {}
    for preset, modes in (run for other in steps for run in other.runs.items()):
        everything[preset] = [mode for mode in MODES if mode in modes or mode in everything.get(preset, [])]
    if step.runs == everything:
        return "always"
    for mode in ("dense", "full"):
        if step.runs and all(modes == [mode] for modes in step.runs.values()):
            return f"mode {mode}"
    def but_full(preset):
        return [mode for mode in everything[preset] if mode != "full" or preset == "paper"]

    if step.runs == {preset: but_full(preset) for preset in everything}:
        return "all modes but full"
    presets = {}  # which modes -> presets
    for preset, modes in step.runs.items():
        which = "" if modes == everything[preset] else \
            " but full" if modes == but_full(preset) else " " + "/".join(modes)
        presets.setdefault(which, []).append(preset)
    return ", ".join(("/" if which else ", ").join(names) + which
                     for which, names in presets.items()) or "on request"


def table(steps):
    lines = ["| list | step | presets | only reads | reads and writes | stages |",
             "| --- | --- | --- | --- | --- | --- |"]
    for step in steps:
        stages = ", ".join(f"`{stage}`" for stage in step.stages)
        lines.append(f"| {step.list} | `{step.name}` | {presets_of(step, steps)} "
                     f"| {', '.join(step.reads)} | {', '.join(step.writes)} | {stages} |")
    return "\n".join(lines)


# The path of a frame before and after the steps: color, place, what it does.
BEFORE = [
    (GST, "gst/matcher/pairing: Pairing", ["finds two frames of the same time"]),
    (GST, "gst/matcher/engine: Engine", ["maps both buffers, inspects their alignment if due"]),
    (CORE, "core/matcher/matcher: Matcher", ["makes Settings of the Parameters; checks the views",
                                                      "base/guard: turns exceptions into errors"]),
    (CORE, "core/matcher/frame_matcher: FrameMatcher", ["owns the memory (frame_memory) and the threads",
                                                "sizes them if needed, then runs the lists"]),
]
AFTER = [
    (CORE, "core/matcher/matcher: write_disparity16()", ["converts a DisparityView to the 16-bit output"]),
    (GST, "gst/matcher/engine: confidence", ["attaches the confidence map"]),
    (GST, "gst/matcher/output: Output", ["sends the map with the times of the left frame"]),
]


class Drawing:
    """An image in pixels, y downwards."""
    WIDTH, DPI = 846, 100

    def __init__(self, height):
        # pylint: disable=import-outside-toplevel
        import matplotlib
        from matplotlib import patches
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure
        matplotlib.rcdefaults()
        self.patches = patches
        figure = Figure(figsize=(self.WIDTH / self.DPI, height / self.DPI), dpi=self.DPI)
        self.canvas = FigureCanvasAgg(figure)
        self.axes = figure.add_axes((0, 0, 1, 1))
        self.axes.set(xlim=(0, self.WIDTH), ylim=(height, 0))
        self.axes.axis("off")

    def box(self, x, y, width, height, color):
        self.axes.add_patch(self.patches.FancyBboxPatch(
            (x, y), width, height, boxstyle="round,pad=0,rounding_size=6", facecolor=color,
            edgecolor=EDGE, linewidth=1))

    def text(self, x, y, text, size=9.0, color=INK, **options):
        self.axes.text(x, y, text, fontsize=size, color=color, va="center", **options)

    def arrow(self, *points):
        for (x0, y0), (x1, y1) in zip(points[:-2], points[1:-1]):
            self.axes.plot([x0, x1], [y0, y1], color=INK, linewidth=1.4, solid_capstyle="butt")
        self.axes.annotate("", points[-1], points[-2], arrowprops={
            "arrowstyle": "-|>", "color": INK, "linewidth": 1.4, "shrinkA": 0, "shrinkB": 0})

    def write(self, path):
        self.canvas.print_png(path, metadata={"Software": None})


def draw_way(drawing, boxes, top):
    """Boxes from top to bottom with arrows between them. Returns the middle heights of the first
    and of the last one."""
    x, width, y, middles = 16, 370, top, []
    for color, title, lines in boxes:
        height = 34 + 19 * len(lines)
        drawing.box(x, y, width, height, color)
        drawing.text(x + 12, y + 17, title, 9.5, weight="bold")
        for i, line in enumerate(lines):
            drawing.text(x + 12, y + 38 + 19 * i, line)
        if middles:
            drawing.arrow((x + width / 2, y - 22), (x + width / 2, y))
        middles.append(y + height / 2)
        y += height + 22
    return middles[0], middles[-1]


def draw_list(drawing, which, steps, x, top):
    """The box of a list with its steps. Returns the top of the box below."""
    inside = [step for step in steps if step.list == which]
    drawing.box(x, top, 190, 12 + 25 * (len(inside) + 1), ROOM)
    drawing.text(x + 12, top + 18, f"k{which}Steps", 9.5, weight="bold")
    for i, step in enumerate(inside):
        default = "semi-dense" in step.runs.get("default", [])
        drawing.text(x + 28, top + 43 + 25 * i, step.name, 9.5, INK if default else FAINT)
    return top + 59 + 25 * len(inside)


def image(steps, path):
    drawing = Drawing(44 + sum(59 if which != "Node" else 0 for which in {step.list for step in steps}) +
                      25 * sum(step.list != "Node" for step in steps))
    drawing.text(16, 24, "The path of a frame", 9.5, weight="bold")
    drawing.text(434, 24, "core/matcher/steps", 9.5, weight="bold")
    drawing.text(640, 24, "gray: not with the defaults", color=FAINT)
    tops, column, center = {}, 434, 529
    top = 44
    for which in ("View", "Path", "Result", "Size"):
        tops[which] = top
        if which != "View":
            drawing.arrow((center, top - 22), (center, top))
        top = draw_list(drawing, which, steps, column, top)
    below_nodes = draw_list(drawing, "Node", steps, 640, tops["Path"]) - 22
    drawing.arrow((624, tops["View"] + 60), (735, tops["View"] + 60), (735, tops["Path"]))
    drawing.arrow((735, below_nodes), (735, tops["Size"] + 60), (624, tops["Size"] + 60))
    _, last = draw_way(drawing, BEFORE, 44)
    drawing.arrow((386, last), (410, last), (410, tops["View"] + 60), (column, tops["View"] + 60))
    first, _ = draw_way(drawing, AFTER, 700)
    drawing.arrow((column, tops["Size"] + 60), (410, tops["Size"] + 60), (410, first), (386, first))
    drawing.write(path)


def main(arguments):
    if arguments[:1] == ["table"] and len(arguments) == 1:
        print(table(read_steps(sys.stdin.read())))
    elif arguments[:1] == ["image"] and len(arguments) == 2:
        image(read_steps(sys.stdin.read()), arguments[1])
    else:
        print(__doc__, file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except (Mismatch, ImportError, OSError) as error:
        print(f"architecture.py: {error}", file=sys.stderr)
        sys.exit(1)
