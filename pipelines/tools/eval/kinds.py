#!/usr/bin/python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Prints tables (Markdown) of degraded images from the reports of mtstereo-eval.

  kinds.py modes REPORT.json...   avgerr / D-all / density of each kind of images, one column for each
                                  report; they come from 'mtstereo-eval --degrade ... --json REPORT.json'
                                  with different modes or presets
  kinds.py equal REPORT.json      the errors of the first method and of another one at equal density, for
                                  each kind of images; the report comes from 'mtstereo-eval --degrade ...
                                  --compare ... --curve --json REPORT.json'
  kinds.py density REPORT.json    the densities of both at equal D-all, from the same report

The exit status is 2 if the command or a JSON file is invalid.
"""
import argparse
import json
import pathlib
import sys


class InputError(Exception):
    """A report that has no such figures; the message states why."""


def read_report(file):
    try:
        report = json.loads(pathlib.Path(file).read_bytes())
    except OSError as error:
        raise InputError(f"{file}: cannot be read: {error.strerror}") from error
    except ValueError as error:
        raise InputError(f"{file}: is not JSON: {error}") from error
    if not isinstance(report, dict) or "mean" not in report:
        raise InputError(f"{file}: is not a report of mtstereo-eval")
    return report


def kinds_of(report):
    """The parts of a report by kind of images; each has the means, and the curve if there is one."""
    clean = {key: report[key] for key in ("mean", "curve") if key in report}
    return {"clean": clean} | {entry["kind"]: entry for entry in report.get("degraded", [])}


def text(value, digits):
    return "-" if value is None else f"{value:.{digits}f}"


def figures(mean):
    errors = mean["all"]
    return (f"{text(errors['avgerr'], 2)} / {text(errors['d_all'], 2)} / "
            f"{text(mean['density'], 1)}")


def label(report):
    """The mode of a report, with its preset if it is not the default."""
    parameters = report["parameters"]
    preset = parameters["preset"]
    return parameters["mode"] if preset == "default" else f"{preset}, {parameters['mode']}"


def print_table(rows):
    rows = [rows[0], ["---"] * len(rows[0]), *rows[1:]]
    for row in rows:
        print("| " + " | ".join(row) + " |")


def print_modes(options):
    reports = [read_report(file) for file in options.reports]
    columns = [kinds_of(report) for report in reports]
    print(f"avgerr px / D-all % / density %, {options.method}")
    print()
    rows = [["images", *(label(report) for report in reports)]]
    for kind in columns[0]:
        means = [column.get(kind, {}).get("mean", {}).get(options.method) for column in columns]
        rows.append([kind, *("-" if mean is None else figures(mean) for mean in means)])
    print_table(rows)


def curve_named(curves, name, file):
    for curve in curves:
        if curve["name"] == name:
            return curve
    known = ", ".join(curve["name"] for curve in curves)
    raise InputError(f"{file}: has no curve '{name}'; its curves are {known}")


def print_curves(options, key, measure, digits):
    """Prints the figures `measure` of two curves, for each kind at the values of `key`."""
    parts = {kind: part["curve"] for kind, part in kinds_of(read_report(options.report)).items()
             if part.get("curve", {}).get("curves")}
    if not parts:
        raise InputError(f"{options.report}: has no curve: run mtstereo-eval with --curve")
    curves = parts["clean"]["curves"] if "clean" in parts else next(iter(parts.values()))["curves"]
    other = options.rival or curves[-1]["name"]
    rows = [["images", *(f"{point[key]:g}" for point in curves[0]["at_" + key])]]
    for kind, part in parts.items():
        pair = part["curves"][0], curve_named(part["curves"], other, options.report)
        cells = zip(*([text(point[measure], digits) for point in curve["at_" + key]]
                      for curve in pair))
        rows.append([kind, *(" / ".join(cell) for cell in cells)])
    print(f"{measure}, {curves[0]['name']} / {other}, at equal {key} %")
    print()
    print_table(rows)


def print_equal(options):
    print_curves(options, "density", options.measure, 2 if options.measure == "d_all" else 3)


def print_density(options):
    print_curves(options, "d_all", "density", 1)


def parse_options():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True, metavar="COMMAND")
    modes = commands.add_parser("modes", help="kinds of images x reports")
    modes.add_argument("reports", metavar="REPORT.json", nargs="+")
    modes.add_argument("--method", default="mtstereo", help="default: mtstereo")
    equal = commands.add_parser("equal", help="two methods at equal density")
    density = commands.add_parser("density", help="two methods at equal D-all")
    for command in (equal, density):
        command.add_argument("report", metavar="REPORT.json")
        command.add_argument("--rival", metavar="CURVE", help="default: the last curve")
    equal.add_argument("--measure", choices=("avgerr", "d_all", "bad1"), default="avgerr")
    return parser.parse_args()


def main():
    options = parse_options()
    try:
        {"modes": print_modes, "equal": print_equal, "density": print_density}[options.command](options)
    except InputError as error:
        print(f"kinds.py: {error}", file=sys.stderr)
        return 2
    except (KeyError, TypeError, AttributeError) as error:
        print(f"kinds.py: is not a report of mtstereo-eval: {error!r}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
