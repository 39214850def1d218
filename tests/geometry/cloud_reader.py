# SPDX-License-Identifier: LGPL-2.1-or-later
"""A strict reader of binary PLY and PCD files, by the specifications of the formats.

Every deviation is an error: a field with another type, a line that is unknown, missing or surplus
bytes, and files that do not state their unit and axes.
"""
import struct

UNIT = "unit: meter"
AXES = "axes of the left camera: x right, y down, z forward"
PLY_TYPES = {"float": "f", "uchar": "B"}
PCD_TYPES = {("F", 4): "f", ("U", 1): "B"}


class CloudError(Exception):
    """The file is not what it should be."""


def require(condition, problem):
    if not condition:
        raise CloudError(problem)


def header_of(data, last):
    """The lines of a text header up to the line that begins with a word, and the binary rest."""
    lines = []
    while True:
        line, newline, data = data.partition(b"\n")
        require(newline, f"there is no line {last}")
        lines.append(line.decode("ascii"))
        if lines[-1].split(" ")[0] == last:
            return lines, data


def records(data, count, layout):
    size = struct.calcsize(layout)
    require(len(data) == count * size, f"{len(data)} bytes, expected {count} x {size}")
    return list(struct.iter_unpack(layout, data)) if data else []


def read_ply(data):
    lines, data = header_of(data, "end_header")
    require(lines[:2] == ["ply", "format binary_little_endian 1.0"], "another format")
    comments = [line.split(" ", 1)[1] for line in lines if line.startswith("comment ")]
    require(UNIT in comments and AXES in comments, "unit or axes are not stated")
    rest = [line.split(" ") for line in lines[2:-1] if not line.startswith("comment ")]
    require(rest[0][:2] == ["element", "vertex"] and len(rest[0]) == 3, "no vertices")
    require(all(len(words) == 3 and words[0] == "property" for words in rest[1:]), "unknown line")
    names = [words[2] for words in rest[1:]]
    require(names == ["x", "y", "z", "red", "green", "blue", "confidence"], f"fields {names}")
    require(all(words[1] in PLY_TYPES for words in rest[1:]), "another type")
    layout = "<" + "".join(PLY_TYPES[words[1]] for words in rest[1:])
    return records(data, int(rest[0][2]), layout)


def read_pcd(data):
    lines, data = header_of(data, "DATA")
    comments = [line[2:] for line in lines if line.startswith("# ")]
    require(UNIT in comments and AXES in comments, "unit or axes are not stated")
    entries = [line.split(" ") for line in lines if not line.startswith("#")]
    require([words[0] for words in entries] ==
            ["VERSION", "FIELDS", "SIZE", "TYPE", "COUNT", "WIDTH", "HEIGHT", "VIEWPOINT",
             "POINTS", "DATA"], "another order of entries")
    entry = {words[0]: words[1:] for words in entries}
    require(entry["VERSION"] == ["0.7"] and entry["DATA"] == ["binary"], "another format")
    require(entry["FIELDS"] == ["x", "y", "z", "rgb", "confidence"], f"fields {entry['FIELDS']}")
    require(entry["COUNT"] == ["1"] * 5, "fields with several values")
    count = int(entry["POINTS"][0])
    require(int(entry["WIDTH"][0]) * int(entry["HEIGHT"][0]) == count, "width x height")
    types = list(zip(entry["TYPE"], map(int, entry["SIZE"])))
    require(len(types) == 5 and all(kind in PCD_TYPES for kind in types), "another type")
    require(types[3] == ("F", 4), "rgb is not PCL's packed color")
    layout = "<" + "".join(PCD_TYPES[kind] for kind in types).replace("fB", "IB")
    return [(x, y, z, rgb >> 16, rgb >> 8 & 255, rgb & 255, confidence)
            for x, y, z, rgb, confidence in records(data, count, layout)]


def read_cloud(path):
    """The points of a file: x, y, z, red, green, blue, confidence."""
    data = path.read_bytes()
    return read_ply(data) if data.startswith(b"ply\n") else read_pcd(data)
