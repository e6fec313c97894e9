# SPDX-License-Identifier: Apache-2.0
"""Evaluation: trajectories with known errors, and their arguments."""
import pathlib
import tempfile
import unittest

import numpy as np
import panvo


def straight(count=101, step_m=1.0, scale=1.0):
    path = np.zeros((count, 8))
    path[:, 0] = 0.1 * np.arange(count)
    path[:, 1] = scale * step_m * np.arange(count)
    path[:, 7] = 1
    return path


class Evaluation(unittest.TestCase):
    def test_gives_known_errors(self):
        figures = panvo.evaluate(straight(scale=1.02), straight())
        self.assertEqual(figures["pairs"], 101)
        self.assertAlmostEqual(figures["path_length_m"], 100.0)
        self.assertAlmostEqual(figures["end_error_m"], 2.0)
        self.assertAlmostEqual(figures["end_error_percent"], 2.0)
        self.assertAlmostEqual(figures["scale_error_percent"], 2.0)
        self.assertAlmostEqual(figures["ate_start_m"]["max"], 2.0)
        self.assertAlmostEqual(figures["ate_start_m"]["mean"], 1.0)
        self.assertAlmostEqual(figures["ate_se3_m"]["mean"], 0.02 * np.abs(np.arange(101) - 50).mean())
        self.assertAlmostEqual(figures["rpe_per_frame"]["translation_m"]["rmse"], 0.02)
        self.assertIsNone(figures["nees"])
        np.testing.assert_allclose(figures["errors"][-1], [10, 100, 2, 0, 0, 0, 0, 0], atol=1e-9)
        self.assertAlmostEqual(panvo.evaluate(straight(scale=1.02), straight(), align="sim3")["errors"][:, 2].max(), 0)

    def test_takes_arrays_and_files_alike(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "path.tum"
            np.savetxt(file, straight(scale=1.02))
            np.testing.assert_allclose(panvo.read_trajectory(file), straight(scale=1.02))
            self.assertEqual(panvo.evaluate(file, straight())["end_error_m"], panvo.evaluate(straight(scale=1.02), straight())["end_error_m"])
            file.write_text("1 2 3\n")
            with self.assertRaisesRegex(panvo.EvaluationError, "path.tum:1: unknown trajectory format: 3 columns"):
                panvo.read_trajectory(file)
            with self.assertRaisesRegex(panvo.EvaluationError, "no such file"):
                panvo.evaluate(str(file) + "x", straight())

    def test_refuses_arrays_that_are_no_trajectories(self):
        def changed(row, column, value):
            path = straight()
            path[row, column] = value
            return path

        for wrong, said in [(straight()[:, :7], r"estimate: expected shape \(N, 8\).* not \(101, 7\)"), (straight()[0], "estimate: expected shape"),
                            (changed(3, 2, np.nan), "estimate: expected finite numbers"), (changed(3, 7, 2.0), "estimate: row 3: the quaternion has norm 2"),
                            (changed(3, 0, 0.1), "estimate: row 3: the stamp")]:
            with self.subTest(said), self.assertRaisesRegex(ValueError, said):
                panvo.evaluate(wrong, straight())
        with self.assertRaisesRegex(TypeError, "ground_truth: expected a file, a folder or an array of N x 8 .* not list"):
            panvo.evaluate(straight(), straight().tolist())
        with self.assertRaisesRegex(ValueError, "align: expected one of none, se3, sim3, start, not 'best'"):
            panvo.evaluate(straight(), straight(), align="best")
        with self.assertRaisesRegex(ValueError, "tolerance_s: "):
            panvo.evaluate(straight(), straight(), tolerance_s=float("nan"))
        with self.assertRaises(panvo.EvaluationError):
            panvo.evaluate(straight() + [1000, 0, 0, 0, 0, 0, 0, 0], straight())


if __name__ == "__main__":
    unittest.main()
