# SPDX-License-Identifier: Apache-2.0
"""The type stubs name exactly what the compiled module has, and the package exports it."""
import ast
import pathlib
import unittest

import panvo
import panvo._core

STUBS = ast.parse(pathlib.Path(panvo.__file__).with_name("_core.pyi").read_text(encoding="utf-8"))
INTERNAL = {"Frames", "Messages"}  # iterators, which the stubs call Iterator


def members(node):
    found = {part.name for part in node.body if isinstance(part, ast.FunctionDef)}
    return found | {part.target.id for part in node.body if isinstance(part, ast.AnnAssign)}


def is_own(name):
    return not name.startswith("_") or name in ("__getitem__", "__iter__", "__bool__", "__version__")


class Stubs(unittest.TestCase):
    def test_name_all_classes_and_functions(self):
        named = {node.name for node in STUBS.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
        present = {name for name in vars(panvo._core) if is_own(name)} - INTERNAL - {"__version__"}
        self.assertEqual(named, present)
        self.assertEqual(set(panvo.__all__), present | {"__version__"})

    def test_name_all_members(self):
        for node in STUBS.body:
            if isinstance(node, ast.ClassDef):
                present = {name for name in vars(getattr(panvo, node.name)) if is_own(name)}
                self.assertEqual({name for name in members(node) if is_own(name)}, present, node.name)

    def test_are_explained_at_run_time(self):
        for name in panvo.__all__:
            if name != "__version__":
                self.assertTrue(getattr(panvo, name).__doc__, name)
        self.assertTrue(pathlib.Path(panvo.__file__).with_name("py.typed").exists())


if __name__ == "__main__":
    unittest.main()
