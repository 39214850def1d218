#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Plots the figures that mtstereo-eval writes as JSON.

  plot.py curve REPORT.json IMAGE.png   error against density; REPORT.json comes from
                                          'mtstereo-eval --curve ... --json REPORT.json'; with
                                          '--degrade ...', one panel for each kind of images

'-' instead of the JSON file reads standard input. The exit status is 1 if matplotlib is missing or
the image cannot be written, and 2 if the command or the JSON file is invalid.
"""
import argparse
import io
import json
import logging
import math
import pathlib
import sys

COLORS = ("#d22828", "#1464be", "#1e8c46", "#8232aa", "#e68c00")  # of the methods; mtstereo: red
INK, GRID = "#282828", "#e1e1e1"
DPI = 100
MOST_DOTS = 20  # longer lines are drawn without a dot for each point
LARGE, SMALL = 11, 8.5  # font sizes [pt]
MEASURES = (("avgerr", "avgerr [px]"), ("d_all", "D-all [%]"))
COLUMNS = 4  # of panels, one for each kind of images


class InputError(Exception):
    """JSON that is not what the plot needs; the message states why."""


class PlotError(Exception):
    """The image cannot be made; the message states why."""


def matplotlib_modules():
    """The modules that render into memory, without a display and with the default style."""
    # Messages about caches and fonts do not concern the caller.
    logging.getLogger("matplotlib").setLevel(logging.ERROR)
    try:
        # pylint: disable=import-outside-toplevel
        import matplotlib
        from matplotlib import ticker
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure
    except ImportError as error:
        raise PlotError(f"matplotlib cannot be imported ({error}): install the Debian package "
                        "python3-matplotlib") from error
    matplotlib.rcdefaults()
    return Figure, FigureCanvasAgg, ticker


class Canvas:
    """An image of this size [px], written as PNG."""

    def __init__(self, width, height):
        figure, canvas, self.ticker = matplotlib_modules()
        self.size = width, height
        self.figure = figure(figsize=(width / DPI, height / DPI), dpi=DPI, facecolor="white")
        self.canvas = canvas(self.figure)

    def text(self, x, y, text, size):
        """A line of text whose left end is at this point, from the top left corner [px]."""
        self.figure.text(x / self.size[0], 1 - y / self.size[1], text, fontsize=size, color=INK,
                         parse_math=False)

    def axes(self, box, labels, largest, steps=(10, 7)):
        """Axes from 0; the box is (left, top, width, height) [px] from the top left corner."""
        left, top, width, height = box
        axes = self.figure.add_axes((left / self.size[0], 1 - (top + height) / self.size[1],
                                     width / self.size[0], height / self.size[1]))
        x_ticks, y_ticks = (self.ticks(*each) for each in zip(largest, steps))
        axes.set(xticks=x_ticks, yticks=y_ticks, xlim=(0, x_ticks[-1]), ylim=(0, y_ticks[-1]))
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_major_formatter(self.ticker.FormatStrFormatter("%g"))
        axes.set_xlabel(labels[0], loc="right", color=INK, fontsize=LARGE, parse_math=False)
        axes.set_title(labels[1], loc="left", color=INK, fontsize=LARGE, parse_math=False)
        axes.grid(color=GRID)
        axes.set_axisbelow(True)
        axes.tick_params(color=INK, labelcolor=INK)
        return axes

    def ticks(self, most, steps):
        """Round steps from 0, the last one not below `most`."""
        most = most if most > 0 else 1
        locator = self.ticker.MaxNLocator(nbins=steps, steps=[1, 2, 5, 10])
        return [tick for tick in locator.tick_values(0, most) if tick >= 0]

    def legend(self, handles, y, columns):
        self.figure.legend(handles=handles, loc="upper left", ncol=columns, frameon=False,
                           bbox_to_anchor=(50 / self.size[0], 1 - y / self.size[1]),
                           fontsize=LARGE, labelcolor=INK, borderaxespad=0, columnspacing=1.5)

    def write(self, image):
        data = io.BytesIO()
        self.figure.savefig(data, format="png", dpi=DPI, metadata={"Software": "mtstereo-eval"})
        try:
            pathlib.Path(image).write_bytes(data.getvalue())
        except OSError as error:
            raise PlotError(f"{image}: cannot be written: {error.strerror}") from error


def number(value):
    """A finite number."""
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value):
        raise InputError(f"{value!r} is not a number")
    return float(value)


def number_or_gap(value):
    """A number, or NaN for null, at which a line is interrupted."""
    return math.nan if value is None else number(value)


def text(value):
    if not isinstance(value, str):
        raise InputError(f"{value!r} is not a text")
    return value


class Line:
    """One line of a curve plot."""

    def __init__(self, curve):
        self.name = text(curve["name"])
        self.method, self.envelope = int(number(curve["method"])), bool(curve["envelope"])
        self.color = COLORS[self.method % len(COLORS)]
        self.density = [number_or_gap(point["density"]) for point in curve["points"]]
        self.errors = {key: [number_or_gap(point[key]) for point in curve["points"]]
                       for key, _ in MEASURES}
        self.ratios = [number(point["uniqueness_ratio"]) for point in curve["points"]
                       if "uniqueness_ratio" in point]
        self.thresholds = [number(point["threshold"]) for point in curve["points"]
                           if "threshold" in point]

    def style(self):
        dots = not self.envelope and len(self.density) <= MOST_DOTS
        width = 2.6 if self.method == 0 else 1.7 if self.envelope else 0.9
        return {"color": self.color, "linewidth": width, "marker": "o" if dots else None,
                "markersize": 4.5, "label": self.name,
                "zorder": 4 if self.method == 0 else 3}  # mtstereo's line on top


def curve_captions(curve, lines):
    """What was swept, as the lines below a curve plot."""
    def span(values):
        return f"{min(values):g} .. {max(values):g}"

    thresholds = [value for line in lines for value in line.thresholds]
    ratios = [value for line in lines for value in line.ratios]
    captions = []
    if thresholds:
        captions.append(f"{lines[0].name}: threshold on its confidence, {span(thresholds)}.")
    if ratios:
        captions.append(f"Dots: uniquenessRatio {span(ratios)}.")
    if any(line.envelope for line in lines):
        captions.append("+ filters: smallest error over all ratios and thresholds with these "
                        "filters:")
        return [" ".join(captions), text(curve["filters"])]
    return [" ".join(captions)]


def curve_title(curve):
    return (f"{text(curve['dataset'])}, mean of {int(number(curve['pairs']))} pairs, all pixels "
            f"with ground truth, mode {text(curve['mode'])}")


def largest_error(lines, key):
    errors = [value for line in lines for value in line.errors[key] if math.isfinite(value)]
    return max(errors, default=1)


def draw_curve(report, options):
    """Error against density, from the report of mtstereo-eval."""
    if "curve" not in report:
        raise InputError("it has no curve: run mtstereo-eval with --curve")
    curve = report["curve"]
    lines = [Line(entry) for entry in curve["curves"]]
    if not lines:
        raise InputError("the curve has no lines")
    title = options.title or curve_title(curve)
    captions = curve_captions(curve, lines)
    degraded = [entry for entry in report.get("degraded", []) if "curve" in entry]
    if degraded:
        return draw_kinds({"clean": lines} | lines_of_kinds(degraded), options.measure,
                          (title, captions))
    canvas = Canvas(1200, 600)
    canvas.text(60, 26, title, LARGE + 1)
    handles = []
    for (key, label), left in zip(MEASURES, (60, 665)):
        axes = canvas.axes((left, 120, 510, 375), ("density [%]", label),
                           (100, largest_error(lines, key)))
        handles = [axes.plot(line.density, line.errors[key], **line.style())[0] for line in lines]
    canvas.legend(handles, 40, 5)
    for y, caption in zip((569, 589), captions):
        canvas.text(60, y, caption, SMALL)
    return canvas


def lines_of_kinds(degraded):
    """The lines of each kind; a kind that no method completed is left out."""
    lines = {text(entry["kind"]): [Line(line) for line in entry["curve"]["curves"]]
             for entry in degraded}
    return {kind: found for kind, found in lines.items() if found}


def draw_kinds(kinds, measure, texts):
    """One panel for each kind of images: avgerr or D-all against density."""
    title, captions = texts
    rows = -(-len(kinds) // COLUMNS)
    height = 120 + 250 * rows
    canvas = Canvas(1200, height + 45)
    canvas.text(60, 26, title, LARGE + 1)
    handles = []
    for index, (kind, lines) in enumerate(kinds.items()):
        box = (50 + 292 * (index % COLUMNS), 120 + 250 * (index // COLUMNS), 245, 175)
        axes = canvas.axes(box, ("density [%]", dict(MEASURES)[measure]),
                           (100, largest_error(lines, measure)), (5, 5))
        axes.set_title(kind, loc="right", color=INK, fontsize=LARGE, parse_math=False)
        drawn = [axes.plot(line.density, line.errors[measure], **line.style())[0]
                 for line in lines]
        handles = handles or drawn
    canvas.legend(handles, 40, 5)
    for y, caption in zip((height + 10, height + 30), captions):
        canvas.text(60, y, caption, SMALL)
    return canvas


def read_json(file):
    try:
        data = sys.stdin.buffer.read() if file == "-" else pathlib.Path(file).read_bytes()
        result = json.loads(data)
    except OSError as error:
        raise InputError(f"cannot be read: {error.strerror}") from error
    except (ValueError, RecursionError) as error:
        raise InputError(f"is not JSON: {error}") from error
    if not isinstance(result, dict):
        raise InputError("is not a JSON object")
    return result


def plot(options):
    name = "standard input" if options.json == "-" else options.json
    try:
        canvas = draw_curve(read_json(options.json), options)
    except InputError as error:
        raise InputError(f"{name}: {error}") from error
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        raise InputError(f"{name}: is not a curve plot: {error!r}") from error
    canvas.write(options.image)


def parse_options():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    command = commands.add_parser("curve", help="plot error against density")
    command.add_argument("json", metavar="FILE.json", help="'-' reads standard input")
    command.add_argument("image", metavar="IMAGE.png")
    command.add_argument("--title", metavar="TEXT", help="replaces the title")
    command.add_argument("--measure", choices=[key for key, _ in MEASURES], default="avgerr",
                         help="of the panels of degraded images")
    return parser.parse_args()


def main():
    options = parse_options()
    try:
        plot(options)
    except InputError as error:
        print(f"plot.py: {error}", file=sys.stderr)
        return 2
    except PlotError as error:
        print(f"plot.py: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
