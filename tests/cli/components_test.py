# SPDX-License-Identifier: Apache-2.0
"""Everything that is installed belongs to one of the Debian packages; reads the install scripts of a build folder, builds nothing."""
import pathlib
import re
import sys
import unittest

BUILD = pathlib.Path(sys.argv.pop(1))
RULE = re.compile(r'^if\(CMAKE_INSTALL_COMPONENT STREQUAL "([^"]*)" OR NOT CMAKE_INSTALL_COMPONENT\)\n(.*?)^endif\(\)', re.MULTILINE | re.DOTALL)
INSTALLED = re.compile(r'file\(INSTALL DESTINATION "(?:\$\{CMAKE_INSTALL_PREFIX\})?/([^"]*)" TYPE (\w+)(.*?)\)\n', re.DOTALL)
FOR_DEVELOPMENT = re.compile(r"include(/|$)|share/\w+/(cmake|idl)|share/panvo_\w+$")


class Components(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        # A test builds a package in a folder of its own, with a cache of its own.
        others = [cache.parent for cache in BUILD.rglob("CMakeCache.txt") if cache.parent != BUILD]
        files = [file for file in BUILD.rglob("cmake_install.cmake") if not any(other in file.parents for other in others)]
        cls.scripts = [file.read_text(encoding="utf-8") for file in files]
        cls.rules = [rule for script in cls.scripts for rule in RULE.findall(script)]

    def test_every_rule_has_one_of_the_three(self):
        self.assertEqual({component for component, _ in self.rules}, {"panvo", "panvo-simulation", "libpanvo-dev"})
        everything = sum(script.count("file(INSTALL ") for script in self.scripts)
        self.assertEqual(sum(text.count("file(INSTALL ") for _, text in self.rules), everything)

    def test_what_serves_to_compile_is_apart_from_what_runs(self):
        for component, text in self.rules:
            for destination, kind, files in INSTALLED.findall(text):
                if destination.startswith("share/doc/"):
                    continue
                with self.subTest(destination=destination, files=files.strip()):
                    # A library comes as name.so.1.2.3 and name.so.1, and as the link name.so for the linker.
                    links = kind == "SHARED_LIBRARY" and not re.search(r"\.so\.\d|__panvo\.so", files)
                    is_development = bool(FOR_DEVELOPMENT.match(destination)) or '/templates"' in files or "setup.bash" in files or links
                    self.assertEqual(component == "libpanvo-dev", is_development)

    def test_the_simulator_is_apart(self):
        of_simulator = [text for component, text in self.rules if component == "panvo-simulation"]
        for name in ("panvo_bin/panvo_simulate", "libpanvo_simulation_component.so", "libpanvo_simulation.so.", "libpanvo_simulated_world.so."):
            self.assertTrue(any(name in text for text in of_simulator), name)


if __name__ == "__main__":
    unittest.main()
