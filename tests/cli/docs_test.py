# SPDX-License-Identifier: Apache-2.0
"""`panvo docs`, with programs in place of doxygen and mkdocs."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PANVO = ROOT / "launch_scripts" / "panvo"
NEEDED = ("bash", "cat", "cp", "dirname", "env", "find", "ls", "mkdir", "mktemp", "readlink", "realpath", "rm", "sed", "touch")
DOXYGEN = ('while read -r key equals value; do [ "$key" != OUTPUT_DIRECTORY ] || eval "out=$value"; done; '
           'mkdir "$out/api"; touch "$out/api/index.html"')
MKDOCS = 'while [ "$1" != --site-dir ]; do shift; done; mkdir "$2"; cp "$PANVO_API/api/index.html" "$2/index.html"'


class Docs(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)
        self.programs = self.folder / "bin"
        self.programs.mkdir()
        for name in NEEDED:
            (self.programs / name).symlink_to(shutil.which(name))
        (self.programs / "python3").symlink_to(sys.executable)  # the first one on the path may need other programs
        self.out = self.folder / "out"

    def make_program(self, name, text):
        file = self.programs / name
        file.write_text(f"#!/bin/sh\n{text}\n", encoding="utf-8")
        file.chmod(0o755)

    def docs(self, *arguments):
        return subprocess.run([str(PANVO), "docs", *map(str, arguments)], cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True,
                              text=True, timeout=60, check=False, env={"PATH": str(self.programs), "TMPDIR": str(self.folder)})

    def assert_fails(self, status, words, *arguments):
        done = self.docs(*arguments)
        self.assertEqual(done.returncode, status, done.stderr)
        self.assertIn(words, done.stderr)
        self.assertEqual(sorted(self.folder.glob("panvo-docs*")), [])

    def test_help(self):
        done = self.docs("--help")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("--out DIR", done.stdout)

    def test_what_is_missing_is_named_with_its_remedy(self):
        self.assert_fails(1, "doxygen not found; 'panvo setup docs' installs it", "--out", self.out)
        self.make_program("doxygen", DOXYGEN)
        self.assert_fails(1, "mkdocs not found; 'panvo setup docs' installs it", "--out", self.out)
        self.assertFalse(self.out.exists())

    def test_wrong_arguments(self):
        self.assert_fails(2, "--out needs a value", "--out")
        self.assert_fails(2, "unknown option '--pdf'", "--pdf")

    def test_replaces_an_earlier_manual_and_nothing_else(self):
        self.make_program("doxygen", DOXYGEN)
        self.make_program("mkdocs", MKDOCS)
        done = self.docs("--out", "out")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue((self.out / "index.html").is_file())
        (self.out / "of_a_former_version.html").touch()
        self.assertEqual(self.docs("--out", "out").returncode, 0)
        self.assertFalse((self.out / "of_a_former_version.html").exists())
        self.assert_fails(1, "does not hold an earlier manual", "--out", self.programs)

    def test_errors_of_mkdocs_are_shown(self):
        self.make_program("doxygen", DOXYGEN)
        self.make_program("mkdocs", "echo a page is wrong; exit 1")
        self.assert_fails(1, "a page is wrong", "--out", self.out)
        self.assertFalse(self.out.exists())


if __name__ == "__main__":
    unittest.main()
