# SPDX-License-Identifier: Apache-2.0
"""The same recording through the module and through `panvo run stereo --replay`."""
import os
import pathlib
import subprocess
import tempfile
import unittest

import numpy as np
import panvo

from scenes import recorded

SYSTEM = pathlib.Path(__file__).resolve().parents[3] / "config/systems/stereo.yaml"


class Replay(unittest.TestCase):
    def setUp(self):
        if not os.environ.get("PANVO_RUN"):
            self.skipTest("PANVO_RUN does not name the program panvo_run")
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.out = pathlib.Path(scratch.name) / "run"

    def assert_equal(self, name, frames, duration_s):
        folder = recorded(name)
        subprocess.run([os.environ["PANVO_RUN"], SYSTEM, "--dataset", folder, "--replay", "--out", self.out, "--set",
                        f"dataset_player.duration_s={duration_s}"], check=True, capture_output=True, timeout=300)
        expected = np.loadtxt(self.out / "odometry_binocular.tum")
        covariances = np.loadtxt(self.out / "odometry_binocular_covariance.csv", delimiter=",", skiprows=1)[:, 1:37].reshape(-1, 6, 6)
        recording = panvo.Recording(folder)
        odometry = panvo.StereoOdometry(recording.calibration)
        estimates = [odometry.track(pair.left, pair.right, stamp_ns=pair.stamp_ns) for pair in recording.stereo(duration_s=duration_s)]
        self.assertEqual(len(estimates), frames)
        np.testing.assert_array_equal([estimate.tum for estimate in estimates], expected)
        np.testing.assert_array_equal([estimate.covariance for estimate in estimates], covariances)
        return expected, recording

    def test_gives_the_same_poses_of_rectified_images(self):
        path, recording = self.assert_equal("kitti_03", 99, 0)
        self.assertEqual(panvo.evaluate(path, recording.ground_truth)["ate_start_m"], panvo.evaluate(self.out, recording.path)["ate_start_m"])

    def test_gives_the_same_poses_of_raw_images(self):
        self.assert_equal("euroc_v101", 41, 2)


if __name__ == "__main__":
    unittest.main()
