# SPDX-License-Identifier: Apache-2.0
"""Stereo odometry on made-up pairs with known motion, and its arguments."""
import sys
import threading
import unittest

import numpy as np
import panvo

from scenes import BASELINE_M, FOCAL_PX, HEIGHT, STEP_M, WIDTH, Corridor

CALIBRATION = dict(width=WIDTH, height=HEIGHT, fx=FOCAL_PX, fy=FOCAL_PX, cx=(WIDTH - 1) / 2, cy=(HEIGHT - 1) / 2, baseline_m=BASELINE_M)


def calibration(**changed):
    return panvo.StereoCalibration.rectified(**{**CALIBRATION, **changed})


def drive(frames=8, arrange=lambda image: image, parameters=None):
    odometry, corridor = panvo.StereoOdometry(calibration(), parameters), Corridor()
    return [odometry.track(*map(arrange, corridor.pair(i)), 0.1 * i) for i in range(frames)]


class Odometry(unittest.TestCase):
    def test_measures_a_known_motion(self):
        for i, estimate in enumerate(drive()):
            self.assertTrue(estimate.reliable, estimate.reason)
            np.testing.assert_allclose(estimate.pose[:3, 3], [i * STEP_M, 0, 0], atol=0.01)
            np.testing.assert_allclose(estimate.pose[:3, :3], np.eye(3), atol=0.003)
        self.assertEqual(estimate.covariance.shape, (6, 6))
        self.assertTrue((np.linalg.eigvalsh(estimate.covariance) > 0).all())
        self.assertGreater(estimate.inliers, 50)
        np.testing.assert_allclose(estimate.motion[:3, 3], [STEP_M, 0, 0], atol=0.01)

    def test_gives_equal_poses_for_equal_input_of_any_memory_layout(self):
        layouts = {
            "crop": lambda image: np.pad(image, 5)[5:-5, 5:-5],
            "every second column": lambda image: np.repeat(image, 2, 1)[:, ::2],
            "upside down": lambda image: image[::-1].copy()[::-1],
            "column-major": np.asfortranarray,
            "bgr": lambda image: np.repeat(image[:, :, None], 3, 2),
        }
        expected = [estimate.tum for estimate in drive(4)]
        for name, arrange in layouts.items():
            with self.subTest(name):
                np.testing.assert_array_equal([estimate.tum for estimate in drive(4, arrange)], expected)

    def test_gives_the_pose_of_the_vehicle_on_which_the_camera_is_placed(self):
        placed, corridor = calibration(), Corridor()
        placed.base_from_left = [[0, 0, 1, 0.5], [-1, 0, 0, 0.2], [0, -1, 0, 1.0], [0, 0, 0, 1]]  # looking forward
        odometry = panvo.StereoOdometry(placed)
        for i in range(4):
            estimate = odometry.track(*corridor.pair(i), stamp_ns=i * 100_000_000)
        np.testing.assert_allclose(estimate.pose[:3, 3], [0, -3 * STEP_M, 0], atol=0.01)
        self.assertEqual(estimate.stamp_ns, 300_000_000)
        np.testing.assert_allclose(estimate.tum[:4], [0.3, 0, -3 * STEP_M, 0], atol=0.01)

    def test_says_why_a_pair_is_not_reliable(self):
        odometry, corridor = panvo.StereoOdometry(calibration()), Corridor()
        odometry.track(*corridor.pair(0), 0.0)
        black = odometry.track(np.zeros((HEIGHT, WIDTH), np.uint8), corridor.pair(1)[1], 0.1)
        self.assertFalse(black.reliable)
        self.assertIn("black", black.reason)
        left, right = corridor.pair(2)
        late = odometry.track(left, right, 0.05)
        self.assertFalse(late.reliable)
        self.assertTrue(odometry.track(*corridor.pair(3), 0.3).reliable)

    def test_takes_parameters_by_name_and_range(self):
        self.assertGreater(len(drive(3, parameters={"tracking.front_end": "sift"})), 0)
        few = drive(3, parameters={"tracking.max_features": 100})[-1]
        self.assertLess(few.detected, 0.7 * drive(3)[-1].detected)
        described = panvo.StereoOdometry.parameters()["tracking.max_features"]
        self.assertEqual((described["default"], described["min"], described["max"]), (300, 50, 5000))
        for wrong, said in [({"tracking.max_features": 7}, "50 to 5000, not 7"), ({"tracking.max_features": "many"}, "not 'many'"),
                            ({"tracking.max_features": 100.5}, "whole number"), ({"tracking.front_end": "orb"}, "'klt', 'sift'"),
                            ({"max_features": 100}, "'max_features' is not a parameter"), ({"motion.loss_scale": float("nan")}, "not nan"),
                            ({"motion.window_keyframes": 3}, "must be less than motion.window_keyframes")]:
            with self.subTest(wrong), self.assertRaisesRegex(ValueError, said):
                panvo.StereoOdometry(calibration(), wrong)
        with self.assertRaisesRegex(TypeError, "expected a dict .* not list"):
            panvo.StereoOdometry(calibration(), ["tracking"])

    def test_lets_other_threads_run(self):
        odometry, pairs, go, ran = panvo.StereoOdometry(calibration()), [Corridor().pair(i) for i in range(2)], threading.Event(), []
        thread = threading.Thread(target=lambda: (go.wait(), ran.append(True)))
        self.addCleanup(sys.setswitchinterval, sys.getswitchinterval())
        thread.start()
        sys.setswitchinterval(1000)  # the interpreter itself does not switch
        go.set()
        for i in range(200):  # NumPy would let others run as well
            odometry.track(*pairs[i % 2], 0.1 * i)
            if ran:
                break
        self.assertTrue(ran)
        thread.join()

    def test_may_be_shared_by_threads(self):
        odometry, corridor, ran = panvo.StereoOdometry(calibration()), Corridor(), []

        def track():
            for i in range(6):
                ran.append(odometry.track(*corridor.pair(i), 0.1 * i))

        threads = [threading.Thread(target=track) for _ in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(ran), 18)


class Arguments(unittest.TestCase):
    def setUp(self):
        self.odometry = panvo.StereoOdometry(calibration())
        self.left, self.right = Corridor().pair(0)

    def assert_refused(self, error, said, left, right, *stamp, **stamps):
        with self.assertRaisesRegex(error, said):
            self.odometry.track(left, right, *stamp, **stamps)

    def test_of_the_wrong_type_are_named(self):
        self.assert_refused(TypeError, "left: expected dtype uint8, not float64", self.left / 255.0, self.right, 0.0)
        self.assert_refused(TypeError, "right: expected dtype uint8, not uint16", self.left, self.right.astype(np.uint16), 0.0)
        self.assert_refused(TypeError, "left: expected a NumPy array of uint8, not list", self.left.tolist(), self.right, 0.0)
        self.assert_refused(TypeError, "right: expected a NumPy array of uint8, not NoneType", self.left, None, 0.0)

    def test_of_the_wrong_shape_are_named(self):
        self.assert_refused(ValueError, r"left: expected shape .* not \(320, 480, 4\)", np.zeros((HEIGHT, WIDTH, 4), np.uint8), self.right, 0.0)
        self.assert_refused(ValueError, r"right: expected shape .* not \(480,\)", self.left, self.right[0], 0.0)
        self.assert_refused(ValueError, r"left: expected shape .* not \(0, 480\)", self.left[:0], self.right, 0.0)
        self.assert_refused(ValueError, "right: expected 480 x 320 px .* not 479 x 320", self.left, self.right[:, 1:], 0.0)

    def test_need_one_stamp(self):
        self.assert_refused(TypeError, "either stamp_s or stamp_ns", self.left, self.right)
        self.assert_refused(TypeError, "either stamp_s or stamp_ns", self.left, self.right, 0.0, stamp_ns=0)
        self.assert_refused(TypeError, "stamp_s: expected a number, not str", self.left, self.right, "now")
        self.assert_refused(TypeError, "stamp_ns: expected an int, not float", self.left, self.right, stamp_ns=0.5)
        self.assert_refused(ValueError, "stamp_s: .* not nan", self.left, self.right, float("nan"))
        self.assert_refused(ValueError, "stamp_ns: does not fit", self.left, self.right, stamp_ns=2**70)


class Calibration(unittest.TestCase):
    def test_shows_what_it_holds(self):
        made = calibration()
        np.testing.assert_array_equal(made.camera_matrix, [[FOCAL_PX, 0, (WIDTH - 1) / 2], [0, FOCAL_PX, (HEIGHT - 1) / 2], [0, 0, 1]])
        self.assertEqual((made.width, made.height, made.baseline_m), (WIDTH, HEIGHT, BASELINE_M))
        self.assertTrue(made.is_rectified)
        self.assertIn("480 x 320 px, rectified", repr(made))

    def test_of_a_rectified_pair_keeps_its_images(self):
        left, right = Corridor().pair(0)
        for image, rectified in zip((left, right), calibration().rectify(left, right)):
            np.testing.assert_array_equal(rectified, image)
            self.assertFalse(np.shares_memory(rectified, image))

    def test_that_cannot_be_is_refused(self):
        for wrong in ({"fx": float("nan")}, {"baseline_m": float("nan")}, {"baseline_m": -0.5}, {"cx": float("inf")}, {"width": 0}):
            with self.subTest(wrong), self.assertRaisesRegex(ValueError, "invalid rectified calibration:"):
                calibration(**wrong)
        with self.assertRaisesRegex(ValueError, r"base_from_left: expected shape \(4, 4\), not \(3, 4\)"):
            calibration().base_from_left = np.eye(4)[:3]
        with self.assertRaisesRegex(ValueError, "base_from_left: expected finite numbers"):
            calibration().base_from_left = np.full((4, 4), np.nan)
        with self.assertRaisesRegex(ValueError, "base_from_left: expected a rigid transform"):
            calibration().base_from_left = 2 * np.eye(4)


if __name__ == "__main__":
    unittest.main()
