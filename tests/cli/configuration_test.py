# SPDX-License-Identifier: Apache-2.0
"""The configurations in which packages and users build the whole project, but its developers do not."""

import pathlib
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Configuration(unittest.TestCase):
    def configure(self, *options):
        with tempfile.TemporaryDirectory() as build:
            configured = subprocess.run(["cmake", "-S", ROOT, "-B", build, *options], text=True, capture_output=True, check=False)
        self.assertEqual(configured.returncode, 0, configured.stderr)

    def test_the_project_is_configured_without_its_tests(self):
        self.configure("-DBUILD_TESTING=OFF")


if __name__ == "__main__":
    unittest.main()
