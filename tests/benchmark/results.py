# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads the results of mtstereo-benchmark and mtstereo-benchmark-element."""
import json
import pathlib
import statistics

from compare import MILLISECONDS, InputError


class Measurement:
    """The median of a benchmark: its time, its counters and the spread of its repetitions."""

    def __init__(self, entries, spread):
        self.name = entries[0]["run_name"]
        self.entries, self.spread = entries, spread
        unit = MILLISECONDS[entries[0]["time_unit"]]
        self.milliseconds = self.value("real_time") * unit
        self.processor_milliseconds = self.value("cpu_time") * unit
        if self.milliseconds <= 0:
            raise ValueError(f"{self.name} has no time")

    def value(self, counter):
        return statistics.median(float(entry[counter]) for entry in self.entries)

    def has(self, counter):
        return counter in self.entries[0]

    def part(self, index):
        """A part of the name; '/' separates the parts."""
        return self.name.split("/")[index]

    def settings(self):
        """The parts of the name other than kind, size and options of the run."""
        own = ("iterations:", "repeats:", "manual_time", "real_time", "process_time")
        return "/".join(part for part in self.name.split("/")[2:] if not part.startswith(own))


class Result:
    """A file: its context and its measurements in order."""

    def __init__(self, file):
        try:
            data = json.loads(pathlib.Path(file).read_text(encoding="utf-8"))
            self.context = dict(data["context"])
            self.measurements = measurements_of(data["benchmarks"])
        except OSError as error:
            raise InputError(f"{file}: cannot be read: {error.strerror}") from error
        except (ValueError, KeyError, TypeError, AttributeError) as error:
            raise InputError(f"{file}: is not a result of --benchmark_out={file}: "
                             f"{error!r}") from error
        except RuntimeError as error:
            raise InputError(f"{file}: {error}") from error

    def of(self, kind):
        """The measurements whose name starts with this part."""
        return [one for one in self.measurements if one.part(0) == kind]


def measurements_of(entries):
    repetitions, medians, spreads = {}, {}, {}
    for entry in entries:
        name = entry["run_name"]
        if entry.get("error_occurred"):
            raise RuntimeError(f"{entry['name']} failed: {entry['error_message']}")
        if entry["run_type"] == "iteration":
            repetitions.setdefault(name, []).append(entry)
        elif entry["aggregate_name"] == "median":
            medians[name] = [entry]
        elif entry["aggregate_name"] == "cv":
            spreads[name] = float(entry["real_time"])
    return [Measurement(group, spreads.get(name))
            for name, group in {**repetitions, **medians}.items()]
