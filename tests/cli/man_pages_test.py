# SPDX-License-Identifier: Apache-2.0
"""The manual pages that come with an installed panvo."""
import gzip
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

from command_test import VERBS, install, panvo

DEVELOPERS = {"test", "build", "bench", "docs", "lint", "package"}  # commands that need a checkout


class ManPages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.command, programs = install(scratch.name)
        cls.pages = programs.parent / "share" / "man" / "man1"

    def page(self, name):
        return gzip.decompress((self.pages / f"{name}.1.gz").read_bytes()).decode()

    def test_exist_for_every_command_that_works_without_a_checkout(self):
        self.assertEqual({file.name for file in self.pages.iterdir()},
                         {"panvo.1.gz"} | {f"panvo-{verb}.1.gz" for verb in VERBS if verb not in DEVELOPERS})

    def test_hold_the_text_of_help(self):
        page = self.page("panvo-run")
        self.assertIn("panvo\\-run \\- run a system: live, on a data set or on a bag", page)
        self.assertIn(".TP\n\\fB\\-\\-bag BAG\\fR\nplay a bag: a rosbag2 folder, or one .db3 or .mcap file\n", page)
        for verb in set(VERBS) - DEVELOPERS:
            with self.subTest(verb=verb):
                words = re.findall(r"\w+", re.sub(r"\\f[BR]|\\\(ga|\\\(aq|\\e|\\&|\\", " ", self.page(f"panvo-{verb}")))
                self.assertFalse(set(re.findall(r"\w+", panvo(verb, "--help", command=self.command).stdout.replace("usage:", ""))) - set(words))

    def test_are_valid(self):
        if not shutil.which("man"):
            self.skipTest("no man; Debian has it in man-db")
        for file in sorted(self.pages.iterdir()):
            done = subprocess.run(["man", "--warnings", "--local-file", "--encoding=utf8", file], env={"PATH": "/usr/bin:/bin", "LC_ALL": "C.UTF-8", "MANWIDTH": "120"},
                                  capture_output=True, text=True, timeout=60, check=True)
            self.assertEqual(done.stderr, "", file.name)


if __name__ == "__main__":
    unittest.main()
