# SPDX-License-Identifier: Apache-2.0
"""Compass and places on made-up panoramas that are turned by known angles."""
import math
import unittest

import numpy as np
import panvo

from scenes import panorama, recorded

COLUMN_RAD = 2 * math.pi / 1080


class Compass(unittest.TestCase):
    def test_measures_known_turns(self):
        compass, scene = panvo.Compass(), panorama(1)
        self.assertIsNone(compass.turn(scene, 0.0))
        columns, yaw = 0, {0: 0.0}
        for i, step in enumerate([12, -7, 20], start=1):  # to the left: what is seen moves to the right
            columns += step
            yaw[i * 200_000_000] = columns * COLUMN_RAD
            turn = compass.turn(np.roll(scene, columns, 1), stamp_ns=i * 200_000_000)
            self.assertTrue(turn.valid, turn.reason)
            self.assertAlmostEqual(turn.turn_rad, yaw[turn.stamp_ns] - yaw[turn.from_stamp_ns if turn.from_stamp_ns else 0], delta=2e-3)
            self.assertGreater(turn.variance_rad2, 0)

    def test_says_why_a_turn_is_not_valid(self):
        compass, scene = panvo.Compass(), panorama(1)
        compass.turn(scene, 0.0)
        repeated = compass.turn(scene, 0.2)
        self.assertFalse(repeated.valid)
        self.assertIn("panorama", repeated.reason)
        black = compass.turn(np.zeros_like(scene), 0.4)
        self.assertFalse(black.valid)
        self.assertIn("black", black.reason)

    def test_refuses_what_it_cannot_use(self):
        compass, scene = panvo.Compass({"method": "two_patches"}), panorama(1)
        compass.turn(scene, 1.0)
        with self.assertRaisesRegex(ValueError, "not later than the previous one"):
            compass.turn(scene, 1.0)
        with self.assertRaisesRegex(TypeError, "panorama: expected dtype uint8, not float32"):
            compass.turn(scene.astype(np.float32), 2.0)
        with self.assertRaisesRegex(ValueError, "method must be one of"):
            panvo.Compass({"method": "magnetic"})
        with self.assertRaisesRegex(ValueError, "base_from_panorama: expected a rigid transform"):
            panvo.Compass(base_from_panorama=np.ones((4, 4)))


class Places(unittest.TestCase):
    def setUp(self):
        self.places = panvo.Places()
        self.known = [self.places.describe(panorama(seed)) for seed in (1, 2, 3)]

    def test_are_recognised_at_any_heading(self):
        for columns in (0, 135, -400):
            match = self.places.match(np.roll(panorama(2), columns, 1), self.known)
            self.assertTrue(match.known, match.reason)
            self.assertEqual(match.id, 1)
            self.assertAlmostEqual(match.heading_rad, columns * COLUMN_RAD, delta=0.01)
            self.assertGreater(match.score, 0.8)
            self.assertGreaterEqual(match.inliers, 20)

    def test_are_unknown_if_never_seen(self):
        match = self.places.match(panorama(9), self.known)
        self.assertFalse(match)
        self.assertIsNone(match.id)
        self.assertTrue(match.reason)
        self.assertIn("unknown", repr(match))
        self.assertEqual(self.places.match(panorama(9), []).reason, "no landmarks yet")
        self.assertIn("black", self.places.match(np.zeros((540, 1080), np.uint8), self.known).reason)

    def test_need_panoramas(self):
        with self.assertRaisesRegex(ValueError, "panorama: is not twice as wide as high"):
            self.places.describe(panorama(1)[:, :1000])
        with self.assertRaisesRegex(ValueError, "panorama: .*black"):
            self.places.describe(np.zeros((540, 1080), np.uint8))
        with self.assertRaisesRegex(TypeError, "places: expected Place objects of describe.., not str"):
            self.places.match(panorama(1), ["here"])
        with self.assertRaisesRegex(ValueError, "number 0 was described with other parameters or another seed"):
            panvo.Places(seed=2).match(panorama(1), self.known)

    def test_of_a_recording_are_told_apart(self):
        recording = panvo.Recording(recorded("campus_journey"))
        frames = [frame.image for frame, _ in zip(recording.panoramas(), range(41))]
        known = [self.places.describe(image) for image in frames[::20]]
        self.assertEqual(self.places.match(np.roll(frames[21], 270, 1), known).id, 1)


if __name__ == "__main__":
    unittest.main()
