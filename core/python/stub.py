# SPDX-License-Identifier: LGPL-2.1-or-later
"""stub.py TEMPLATE STUB FOLDER: writes the typed stub of the module. The keywords of Matcher come from the parameter
table, which the binding in FOLDER has."""
import pathlib
import sys

TYPES = {"int": "int", "float": "float", "bool": "bool", "levels": "str | Sequence[int]"}


def type_of(parameter):
    if parameter.type == "choice":
        return "Literal[" + ", ".join(f'"{word}"' for word in parameter.choices) + "]"
    return TYPES[parameter.type]


def main():
    template, stub, folder = sys.argv[1:]
    sys.dont_write_bytecode = True
    sys.path.insert(0, folder)
    import _mtstereo
    keywords = [f"        {row.name}: {type_of(row)} | None = ...," for row in _mtstereo.parameter_table()]
    text = pathlib.Path(template).read_text(encoding="utf-8")
    pathlib.Path(stub).write_text(text.replace("        # @KEYWORDS@", "\n".join(keywords)), encoding="utf-8")


if __name__ == "__main__":
    main()
