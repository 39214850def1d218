#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The figures of docs/results.md.

  results.py                       fills the tables of the page from docs/figures/results.json
  results.py --check               reports whether page, README.md and docs/choosing.md state these figures
  results.py --measure EVAL DATA   measures first: EVAL is mtstereo-eval, DATA the folder of the pairs

DATA has the pairs of docs/results.md in the folders of GROUPS. Times are not measured. The exit status is 1 if
something differs or a program fails.
"""
import argparse
import json
import pathlib
import re
import subprocess
import sys
import tempfile

DOCS = pathlib.Path(__file__).resolve().parents[1]
STORED = DOCS / "figures/results.json"
PAGE = DOCS / "results.md"

GROUPS = {"ten": ("middlebury", "kitti2015", "sceneflow", "eth3d"),
          "more": ("more/kitti2015", "more/middlebury2006_third", "more/middlebury_v3_quarter")}
FAMILIES = {"Middlebury (6)": "middlebury", "KITTI 2015 (1)": "kitti2015", "FlyingThings3D (2)": "sceneflow",
            "ETH3D (1)": "eth3d"}
MODES = ("sparse", "semi-dense", "dense", "full")
METHODS = {**{mode: ("--mode", mode) for mode in MODES},
           **{f"fast, {mode}": ("--preset", "fast", "--mode", mode) for mode in MODES},
           **{f"paper, {mode}": ("--preset", "paper", "--mode", mode) for mode in MODES[:2]}}
BASELINES = {"sgbm-3way": "OpenCV SGBM 3WAY", "sgbm-hh": "OpenCV SGBM HH"}
KINDS = ("noise=5", "noise=10", "jpeg=50", "jpeg=20", "h264=35", "dark=0.15", "bright=1.8", "blur-right=1", "soft2x",
         "cam", "cam2x", "lower-right=1")
THRESHOLDS = (100, 120, 140, 160, 180)
DENSITIES = (20, 30, 40, 50, 60, 70, 75, 80)
CURVES = {"mtstereo": "mtstereo", "sgbm-hh": "SGBM HH", "sgbm-hh + filters": "SGBM HH, best filters"}


def evaluate(program, data, group, *options):
    """The report of mtstereo-eval on the pairs of a group."""
    with tempfile.TemporaryDirectory() as folder:
        report = pathlib.Path(folder) / "report.json"
        subprocess.run([program, *GROUPS[group], "--warm-up", "0", "--json", report, *options], cwd=data, check=True,
                       stdout=subprocess.DEVNULL)
        return json.loads(report.read_text(encoding="utf-8"))


def figures_of(mean):
    return {"avgerr": round(mean["all"]["avgerr"], 5), "d_all": round(mean["all"]["d_all"], 5),
            "density": round(mean["density"], 4)}


def family_means(report, method):
    """{family: figures}: means over the pairs of each folder."""
    found = {}
    for name, folder in FAMILIES.items():
        pairs = [pair["results"][method] for pair in report["pairs"] if pair["name"].startswith(folder + "/")]
        mean = {key: sum(pair["all"][key] for pair in pairs) / len(pairs) for key in ("avgerr", "d_all")}
        found[name] = figures_of({"all": mean, "density": sum(pair["density"] for pair in pairs) / len(pairs)})
    return found


def confidence_figures(program, data):
    """{kind: {group: {threshold: D-all}}} of mode semi-dense."""
    found = {}
    for group in GROUPS:
        report = evaluate(program, data, group, "--min-confidence", "0", "--curve", "--degrade", ",".join(KINDS))
        for kind in [{"kind": "clean", "curve": report["curve"]}, *report["degraded"]]:
            points = {point["threshold"]: point["d_all"] for point in kind["curve"]["curves"][0]["points"]}
            row = {str(threshold): round(points[threshold], 5) for threshold in THRESHOLDS}
            found.setdefault(kind["kind"], {})[group] = row
    return found


def measure(program, data):
    found = {"methods": {}, "families": {}, "degraded": {}, "equal": {},
             "confidence": confidence_figures(program, data)}
    baselines = ("--compare", ",".join(BASELINES))
    for group in GROUPS:
        for name, options in METHODS.items():
            report = evaluate(program, data, group, *options, *(baselines if name == "dense" else ()))
            found["version"] = report["library_version"]
            for method, mean in report["mean"].items():
                label = BASELINES.get(method, name)
                found["methods"].setdefault(label, {})[group] = figures_of(mean)
                if group == "ten" and (label in MODES or method == "sgbm-3way"):
                    found["families"][label] = family_means(report, method)
    for mode in ("semi-dense", "dense"):
        report = evaluate(program, data, "ten", "--mode", mode, "--degrade", ",".join(KINDS), "--compare", "sgbm-hh")
        for kind in report["degraded"]:
            row = found["degraded"].setdefault(kind["kind"], {})
            row[mode] = figures_of(kind["mean"]["mtstereo"])
            row["sgbm-hh"] = figures_of(kind["mean"]["sgbm-hh"])
    report = evaluate(program, data, "ten", "--mode", "dense", "--min-confidence", "0", "--compare", "sgbm-hh", "--curve")
    for curve in report["curve"]["curves"]:
        points = {round(point["density"]): point for point in curve["at_density"]}
        found["equal"][curve["name"]] = {str(density): points[density]["d_all"] for density in DENSITIES}
    return found


def table(heading, rows):
    lines = [heading, ["---"] * len(heading), *rows]
    return "".join("| " + " | ".join(line) + " |\n" for line in lines)


def errors(figures):
    """D-all with two significant digits."""
    value = figures["d_all"]
    return f"{value:.2f}" if value < 1 else f"{value:.1f}"


def methods_table(found):
    order = [*MODES, *BASELINES.values(), *(name for name in METHODS if name not in MODES)]
    rows = []
    for name in order:
        row = [name if name in BASELINES.values() else f"`{name}`" if name in MODES else f"preset {name}"]
        for group in GROUPS:
            figures = found["methods"][name][group]
            row += [f"{figures['avgerr']:.2f}", errors(figures), f"{figures['density']:.1f}"]
        rows.append(row)
    heading = ["", "ten pairs: avgerr px", "D-all %", "density %", "17 pairs: avgerr px", "D-all %", "density %"]
    return table(heading, rows)


def cell(figures):
    return f"{errors(figures)} at {figures['density']:.0f}"


def families_table(found):
    order = sorted(found["families"], key=[*MODES, *BASELINES.values()].index)
    return table(["D-all % at density %", *FAMILIES],
                 [[f"`{name}`" if name in MODES else name, *map(cell, found["families"][name].values())]
                  for name in order])


def degraded_table(found):
    rows = [[f"`{kind}`", cell(row["semi-dense"]), cell(row["dense"]), cell(row["sgbm-hh"])]
            for kind, row in found["degraded"].items()]
    return table(["D-all % at density %", "`semi-dense`", "`dense`", "OpenCV SGBM HH"], rows)


def equal_table(found):
    rows = [[label, *("-" if value is None else f"{value:.2f}" for value in found["equal"][name].values())]
            for name, label in CURVES.items()]
    return table(["D-all % at density", *(f"{density} %" for density in DENSITIES)], rows)


def confidence_table(found):
    rows = [[f"`{kind}`" if kind in KINDS else kind,
             *(f"{row['ten'][str(threshold)]:.2f} / {row['more'][str(threshold)]:.2f}" for threshold in THRESHOLDS)]
            for kind, row in found["confidence"].items()]
    return table(["D-all %, ten / 17 pairs", *(f"confidence >= {threshold}" for threshold in THRESHOLDS)], rows)


TABLES = {"methods": methods_table, "families": families_table, "degraded": degraded_table, "equal": equal_table,
          "confidence": confidence_table}


def filled(text, found):
    text = re.sub(r"(?<=Measured with version )[\d.]+", found["version"], text)
    for name, make in TABLES.items():
        begin, end = f"<!-- {name} begin -->\n", f"<!-- {name} end -->"
        if text.count(begin) != 1 or text.count(end) != 1:
            raise ValueError(f"{PAGE} must contain {begin.strip()} and {end} once")
        before, rest = text.split(begin)
        text = before + begin + make(found) + end + rest.split(end)[1]
    return text


def statements(found):
    """What other pages state: (page, text)."""
    ten = {name: figures["ten"] for name, figures in found["methods"].items()}
    dense, sgbm = ten["dense"], ten["OpenCV SGBM 3WAY"]
    yield DOCS.parent / "README.md", f"{errors(dense)} % gross errors at {dense['density']:.0f} % density"
    yield DOCS.parent / "README.md", f"{sgbm['d_all']:.1f} % at {sgbm['density']:.0f} %"
    for mode in MODES:
        yield DOCS / "choosing.md", f"| {errors(ten[mode])} % | {ten[mode]['density']:.0f} % |"


def check(found):
    wrong = [] if PAGE.read_text() == filled(PAGE.read_text(), found) else [f"{PAGE}: run docs/figures/results.py"]
    for page, statement in statements(found):
        if statement not in " ".join(page.read_text().split()):
            wrong.append(f"{page} does not state: {statement}")
    return wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--measure", nargs=2, metavar=("EVAL", "DATA"), type=pathlib.Path)
    options = parser.parse_args()
    if options.measure:
        program, data = (path.resolve() for path in options.measure)
        STORED.write_text(json.dumps(measure(program, data), indent=1) + "\n")
    found = json.loads(STORED.read_text())
    if not options.check:
        PAGE.write_text(filled(PAGE.read_text(), found))
    wrong = check(found)
    print("\n".join(wrong), file=sys.stderr, end="\n" if wrong else "")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
