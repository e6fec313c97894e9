# SPDX-License-Identifier: Apache-2.0
"""Tests of endurance.py on synthetic runs."""

import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import endurance  # noqa: E402


def run(memory, descriptors=lambda i: 12, count=100):
    return [endurance.Sample(float(i), memory(i), descriptors(i), 7, 0.1 * i) for i in range(count)]


def failing(samples, status=0):
    return [v.name for v in endurance.judge(status, samples, 0.05) if not v.holds]


class Judge(unittest.TestCase):
    def test_accepts_a_flat_run_whose_begin_grew(self):
        self.assertEqual(failing(run(lambda i: 100.0 if i > 15 else 5.0 * i)), [])

    def test_sees_memory_that_grows_by_more_than_the_tolerance(self):
        self.assertEqual(failing(run(lambda i: 100.0 + 0.2 * i)), ["memory is flat"])

    def test_sees_descriptors_that_leak(self):
        self.assertEqual(failing(run(lambda i: 100.0, lambda i: 12 + i // 10)), ["descriptors are constant"])

    def test_sees_a_crash(self):
        self.assertEqual(failing(run(lambda i: 100.0), status=-11), ["ends well"])

    def test_does_not_judge_what_is_too_short(self):
        self.assertIn("is long enough to judge", failing([]))


class Watch(unittest.TestCase):
    def test_follows_a_process_to_its_end(self):
        with tempfile.TemporaryDirectory() as folder:
            log = pathlib.Path(folder) / "output.log"
            status, samples = endurance.watch(["sh", "-c", "echo said; sleep 0.3; exit 3"], 0.05, log)
            self.assertEqual(status, 3)
            self.assertGreater(len(samples), 1)
            # Its share of pages in common with other shells is small while many of them run.
            self.assertGreater(max(sample.memory_mb for sample in samples), 0.0)
            self.assertEqual(log.read_text(), "said\n")


if __name__ == "__main__":
    unittest.main()
