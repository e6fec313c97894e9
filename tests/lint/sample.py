# SPDX-License-Identifier: Apache-2.0
"""Small valid workspaces for the tests of the rules; each test breaks one rule."""
import pathlib
import tempfile
import unittest

TOP = "project(panvo VERSION 0.1.0 LANGUAGES CXX)\n"
LICENCE = "// SPDX-License-Identifier: Apache-2.0\n"


def package_xml(name, depends=(), version="0.1.0"):
    tags = "".join(f"  <depend>{depend}</depend>\n" for depend in depends)
    return (f'<?xml version="1.0"?>\n<package format="3">\n  <name>{name}</name>\n  <version>{version}</version>\n{tags}'
            "  <export>\n    <build_type>cmake</build_type>\n  </export>\n</package>\n")


def cmake_lists(name, finds=()):
    lines = "".join(f"find_package({find} REQUIRED)\n" for find in finds)
    return f"cmake_minimum_required(VERSION 3.25)\nproject({name} VERSION 0.1.0 LANGUAGES CXX)\n{lines}"


def whole_workspace():
    """path -> text of a workspace that breaks no rule: a library and a component that uses it."""
    meta = "names:\n  panvo_vision: {}\n  panvo_compass: {}\n"
    return {
        "CMakeLists.txt": f"{TOP}set(package_folders\n  config/build\n  components/vision\n  components/compass\n  launch_scripts)\n",
        "colcon.meta": meta, "config/build/asan.meta": meta, "config/build/ubsan.meta": meta, "config/build/tsan.meta": meta,
        "config/build/package.xml": package_xml("panvo_build"),
        "config/build/CMakeLists.txt": cmake_lists("panvo_build").replace("CXX", "NONE"),
        "launch_scripts/package.xml": package_xml("panvo_launch_scripts"),
        "launch_scripts/CMakeLists.txt": cmake_lists("panvo_launch_scripts").replace("CXX", "NONE"),
        "launch_scripts/packages.txt": "libeigen3-dev  # why\n",
        "components/vision/package.xml": package_xml("panvo_vision"),
        "components/vision/CMakeLists.txt": cmake_lists("panvo_vision", ["Eigen3"]),
        "components/vision/README.md": "# vision\n",
        "components/vision/include/panvo/vision/pose.hpp": LICENCE + "#pragma once\n#include <Eigen/Core>\n",
        "components/compass/package.xml": package_xml("panvo_compass", ["panvo_vision"]),
        "components/compass/CMakeLists.txt": cmake_lists("panvo_compass", ["panvo_vision"]) + "panvo_add_test(t SOURCES test/compass_test.cpp)\n",
        "components/compass/README.md": "# compass\n",
        "components/compass/src/compass.cpp": LICENCE + '#include "panvo/vision/pose.hpp"\n',
        "components/compass/src/compass_component.cpp": LICENCE + '#include "panvo/runtime/component.hpp"\n',
        "components/compass/test/compass_test.cpp": LICENCE + "#include <gtest/gtest.h>\n",
    }


def write(root, changes):
    """Writes the valid workspace with files added, replaced (text) or removed (None)."""
    for path, text in {**whole_workspace(), **changes}.items():
        if text is not None:
            file = root / path
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text, encoding="utf-8")


class RuleTest(unittest.TestCase):
    def complaints(self, rule, changes=None):
        """What the rule finds in a valid workspace with these changes."""
        with tempfile.TemporaryDirectory() as folder:
            write(pathlib.Path(folder), changes or {})
            return rule.check(pathlib.Path(folder))

    def assert_finds(self, rule, expected, changes):
        complaints = self.complaints(rule, changes)
        self.assertTrue(any(expected in complaint for complaint in complaints), f"{expected!r} not in {complaints}")
