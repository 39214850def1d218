# SPDX-License-Identifier: LGPL-2.1-or-later
"""The typed stub has the names, members and keywords of the module, and everything has a docstring."""
import ast
import inspect
import pathlib
import unittest

import mtstereo

PACKAGE = pathlib.Path(mtstereo.__file__).parent
STUB = ast.parse((PACKAGE / "__init__.pyi").read_text())


def classes_of_stub():
    return {node.name: node for node in STUB.body if isinstance(node, ast.ClassDef)}


def members_of_stub(node):
    names = {part.name for part in node.body if isinstance(part, ast.FunctionDef)}
    names |= {part.target.id for part in node.body if isinstance(part, ast.AnnAssign)}
    return {name for name in names if not name.startswith("_")}


class Stub(unittest.TestCase):
    def test_has_the_names_of_the_module(self):
        functions = {node.name for node in STUB.body if isinstance(node, ast.FunctionDef)}
        self.assertEqual(functions | classes_of_stub().keys() | {"__version__"}, set(mtstereo.__all__))
        self.assertTrue((PACKAGE / "py.typed").exists())

    def test_has_the_members_of_each_class(self):
        for name, node in classes_of_stub().items():
            with self.subTest(name):
                existing = {member for member in vars(getattr(mtstereo, name)) if not member.startswith("_")}
                self.assertEqual(members_of_stub(node), existing)

    # Feature: every parameter as a keyword, in types and texts
    def test_has_every_parameter_as_a_keyword(self):
        names = [row.name for row in mtstereo.parameter_table()]
        for part in classes_of_stub()["Matcher"].body:
            if isinstance(part, ast.FunctionDef) and part.name in ("__init__", "set"):
                self.assertEqual([keyword.arg for keyword in part.args.kwonlyargs], names)


class Docstrings(unittest.TestCase):
    def test_are_there_for_every_name(self):
        for name in set(mtstereo.__all__) - {"__version__"}:
            item = getattr(mtstereo, name)
            self.assertTrue(inspect.getdoc(item), name)
            for member, value in vars(item).items() if isinstance(item, type) else ():
                if not member.startswith("_"):
                    self.assertTrue(getattr(value, "__doc__", None), f"{name}.{member}")

    def test_name_the_place_where_users_find_a_class(self):
        self.assertEqual(mtstereo.Matcher.__module__, "mtstereo")


if __name__ == "__main__":
    unittest.main(verbosity=2)
