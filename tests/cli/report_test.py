# SPDX-License-Identifier: Apache-2.0
"""The summary at the end of `panvo test`."""
import contextlib
import io
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "launch_scripts" / "lib"))
import test_report  # noqa: E402

PASSED = '<testcase name="A.Passes" status="run"><system-out>x</system-out></testcase>'
FAILED = '<testcase name="A.Fails" status="fail"><failure message=""/><system-out>x</system-out></testcase>'
DISABLED = '<testcase name="A.Disabled" status="disabled"><disabled message=""/><system-out>Disabled</system-out></testcase>'
SKIPPED = """<testcase name="A.Skips" status="notrun"><skipped message="SKIP_REGULAR_EXPRESSION_MATCHED"/><system-out>[ RUN      ] A.Skips
a_test.cpp:9: Skipped
needs recordings: set PANVO_DATA

[  SKIPPED ] A.Skips (0 ms)
</system-out></testcase>"""


class Report(unittest.TestCase):
    def report(self, *cases, status=0):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "junit.xml")
            file.write_text(f"<testsuite>{''.join(cases)}</testsuite>", encoding="utf-8")
            output = io.StringIO()
            with contextlib.redirect_stdout(output):
                result = test_report.report([file], status)
        return result, output.getvalue().splitlines()

    def test_counts_each_kind_on_the_last_line(self):
        result, lines = self.report(PASSED, PASSED, FAILED, SKIPPED, DISABLED, status=8)
        self.assertEqual(lines[-1], "2 passed, 1 failed, 2 skipped")
        self.assertIn("failed: A.Fails", lines)
        self.assertEqual(result, 1)

    def test_says_why_a_test_was_skipped(self):
        _, lines = self.report(PASSED, SKIPPED)
        self.assertIn("skipped 1: needs recordings: set PANVO_DATA", lines)

    def test_says_what_a_failed_test_said_first_of_its_failure(self):
        said = "\n".join(["[ RUN      ] A.Fails", "a_test.cpp:9: Failure", "Expected: 1", *["more"] * 20, "[  FAILED  ] A.Fails"])
        _, lines = self.report(FAILED.replace("<system-out>x", f"<system-out>{said}"), status=8)
        self.assertEqual(lines[-7:-1], ["    a_test.cpp:9: Failure", "    Expected: 1", *["    more"] * 4])
        said = "\n".join(["ok 1 - one", "not ok 2 - two", "  ---", "  error: 'a is not b'"])
        _, lines = self.report(FAILED.replace("<system-out>x", f"<system-out>{said}"), status=8)
        self.assertEqual([line.strip() for line in lines[-4:-1]], ["not ok 2 - two", "---", "error: 'a is not b'"])

    def test_says_what_a_failed_test_said_last_where_nothing_tells_of_a_failure(self):
        _, lines = self.report(FAILED.replace("<system-out>x", "<system-out>" + "\n".join("abcdefgh")), status=8)
        self.assertEqual(lines[-7:-1], [f"    {letter}" for letter in "cdefgh"])

    def test_is_content_when_nothing_failed(self):
        self.assertEqual(self.report(PASSED, SKIPPED)[0], 0)

    def test_is_not_content_when_ctest_was_not(self):
        result, lines = self.report(PASSED, status=8)
        self.assertEqual((result, lines[-1]), (1, "1 passed, 0 failed, 0 skipped"))

    def test_is_not_content_when_nothing_was_tested(self):
        self.assertEqual(self.report(SKIPPED)[0], 1)
        self.assertEqual(self.report()[0], 1)

    def test_counts_nothing_where_ctest_left_no_file(self):
        with contextlib.redirect_stdout(io.StringIO()):
            self.assertEqual(test_report.report([pathlib.Path("/nowhere/junit.xml")], 1), 1)


if __name__ == "__main__":
    unittest.main()
