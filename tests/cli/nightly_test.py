# SPDX-License-Identifier: Apache-2.0
"""Table and exit status of .ci/nightly, with a `panvo` that only writes down how it was called."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
FAILING_TSAN = """#!/bin/sh
echo "$PANVO_BUILD" "$@" >>"$(dirname "$0")/calls"
echo "said by $*"
[ "$*" != "test --sanitize tsan" ] || exit 3
"""


class Nightly(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.checkout = pathlib.Path(scratch.name)
        for name in (".ci", "launch_scripts"):
            (self.checkout / name).mkdir()
        shutil.copy(ROOT / ".ci" / "nightly", self.checkout / ".ci")
        panvo = self.checkout / "launch_scripts" / "panvo"
        panvo.write_text(FAILING_TSAN, encoding="utf-8")
        panvo.chmod(0o755)

    def nightly(self, *arguments):
        clean = {name: value for name, value in os.environ.items() if not name.startswith("PANVO_")}
        command = [self.checkout / ".ci" / "nightly", *arguments]
        return subprocess.run(command, env=clean, capture_output=True, text=True, timeout=60, check=False)

    def test_goes_on_after_a_failing_step_and_lists_all(self):
        done = self.nightly("tsan", "clang", "tidy")
        self.assertEqual(done.returncode, 1)
        table = done.stdout.splitlines()[-4:]
        self.assertRegex(table[0], r"^tsan +failed \(status 3\) +0:00:0\d$")
        self.assertRegex(table[1], r"^clang +passed +0:00:0\d$")
        self.assertRegex(table[2], r"^tidy +passed +0:00:0\d$")
        self.assertEqual(table[3], "1 of 3 steps failed")
        self.assertIn("said by test --sanitize tsan", done.stdout, "the end of the log of the step that failed")
        calls = (self.checkout / "launch_scripts" / "calls").read_text(encoding="utf-8").splitlines()
        self.assertEqual([line.split() for line in calls], [["test", "--sanitize", "tsan"], ["clang", "build"], ["lint", "--tidy"]])
        self.assertEqual((self.checkout / "build/nightly/tidy.log").read_text(encoding="utf-8"), "said by lint --tidy\n")

    def test_runs_every_fuzzer_and_names_those_with_findings(self):
        programs = self.checkout / "build/fuzz/panvo_bin"
        programs.mkdir(parents=True)
        for name, status in (("bad_fuzzer", 1), ("good_fuzzer", 0)):
            (programs / name).write_text(f'#!/bin/sh\necho "{name} $1"\nexit {status}\n', encoding="utf-8")
            (programs / name).chmod(0o755)
        done = self.nightly("--fuzz-time", "7", "fuzz")
        self.assertEqual(done.returncode, 1)
        self.assertIn("bad_fuzzer -max_total_time=7\ngood_fuzzer -max_total_time=7\nfuzzers with findings: bad_fuzzer\n", done.stdout)

    def test_mistakes_run_nothing(self):
        done = self.nightly("asan", "gcc")
        self.assertEqual((done.returncode, done.stdout), (2, ""))
        self.assertIn("unknown step 'gcc'; steps: clang asan", done.stderr)
        self.assertEqual(self.nightly("--fuzz-time", "long").returncode, 2)

    def test_help_has_every_step(self):
        done = self.nightly("--help")
        self.assertEqual(done.returncode, 0)
        for step in self.nightly("?").stderr.split("steps:")[1].split():
            self.assertRegex(done.stdout, rf"(?m)^  (?:\w+, )*{step}\b")


if __name__ == "__main__":
    unittest.main()
