# SPDX-License-Identifier: Apache-2.0
"""Recordings: made-up KITTI folders and bags, with one thing wrong, and the public recordings."""
import pathlib
import shutil
import tempfile
import unittest
import warnings

import numpy as np
import panvo

from scenes import BASELINE_M, FOCAL_PX, HEIGHT, STEP_M, WIDTH, Corridor, camera_info_message, image_message, panorama, recorded, write_bag

TRUTH = "1 0 0 {x} 0 1 0 0 0 0 1 0\n"


def write_pgm(path, image):
    path.write_bytes(b"P5 %d %d 255\n" % (image.shape[1], image.shape[0]) + image.tobytes())


class RecordingTest(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def kitti(self, frames=4):
        corridor = Corridor()
        for eye in (0, 1):
            (self.folder / f"image_{eye}").mkdir()
            for i in range(frames):
                write_pgm(self.folder / f"image_{eye}" / f"{i:06}.pgm", corridor.pair(i)[eye])
        row = f"{FOCAL_PX} 0 {(WIDTH - 1) / 2} {{}} 0 {FOCAL_PX} {(HEIGHT - 1) / 2} 0 0 0 1 0\n"
        (self.folder / "calib.txt").write_text("P0: " + row.format(0) + "P1: " + row.format(-FOCAL_PX * BASELINE_M))
        (self.folder / "poses.txt").write_text("".join(TRUTH.format(x=i * STEP_M) for i in range(frames)))
        return self.folder

    def bag(self, topics=("/stereo/left/image_raw", "/stereo/right/image_raw"), frames=4, encoding="mono8", infos=True):
        corridor, messages = Corridor(), []
        for i in range(frames):
            stamp = 10**9 + i * 10**8
            for topic, image, baseline_m in zip(topics, corridor.pair(i), (0.0, BASELINE_M)):
                if infos:
                    messages.append((topic.rsplit("/", 1)[0] + "/camera_info", "sensor_msgs/msg/CameraInfo", stamp,
                                     camera_info_message(stamp, baseline_m)))
                colours = image if encoding == "mono8" else np.stack([image] * 3, 2)
                messages.append((topic, "sensor_msgs/msg/Image", stamp, image_message(stamp, colours, encoding)))
        return write_bag(self.folder / "run.db3", messages)


class Folder(RecordingTest):
    def test_gives_its_pairs_with_stamps_and_ground_truth(self):
        recording = panvo.Recording(self.kitti())
        self.assertEqual(recording.kind, "KITTI odometry")
        self.assertIsNone(recording.base_from_panorama)
        pairs = list(recording)
        self.assertEqual([pair.stamp_ns for pair in pairs], [0, 100_000_000, 200_000_000, 300_000_000])
        np.testing.assert_array_equal(pairs[2].left, Corridor().pair(2)[0])
        np.testing.assert_array_equal(pairs[2].right, Corridor().pair(2)[1])
        np.testing.assert_allclose(recording.ground_truth[:, 2], [0, -STEP_M, -2 * STEP_M, -3 * STEP_M], atol=1e-9)
        self.assertEqual([pair.stamp_s for pair in recording.stereo(start_s=0.1, duration_s=0.1)], [0.1, 0.2])
        with self.assertRaises(panvo.RecordingError):
            recording.panoramas()

    def test_feeds_the_odometry(self):
        recording = panvo.Recording(self.kitti(8))
        odometry = panvo.StereoOdometry(recording.calibration)
        path = np.array([odometry.track(pair.left, pair.right, pair.stamp_s).tum for pair in recording.stereo()])
        self.assertLess(panvo.evaluate(path, recording.ground_truth)["ate_start_m"]["max"], 0.01)

    def test_skips_an_unreadable_image_with_a_warning(self):
        image = self.kitti() / "image_1/000002.pgm"
        image.write_bytes(image.read_bytes()[:5])
        with self.assertWarnsRegex(RuntimeWarning, "000002.pgm: .*; frame skipped"):
            self.assertEqual(len(list(panvo.Recording(self.folder))), 3)
        with warnings.catch_warnings(), self.assertRaisesRegex(RuntimeWarning, "000002.pgm"):
            warnings.simplefilter("error")
            list(panvo.Recording(self.folder))

    def test_that_is_incomplete_is_refused_with_the_file(self):
        with self.assertRaisesRegex(panvo.RecordingError, "nowhere"):
            panvo.Recording(self.folder / "nowhere")
        self.kitti()
        (self.folder / "calib.txt").write_text("P0: 1 0 nan 0 0 1 0 0 0 0 1 0\n")
        with self.assertRaisesRegex(panvo.Error, "calib.txt"):
            panvo.StereoCalibration.from_recording(self.folder)
        shutil.rmtree(self.folder / "image_1")
        with self.assertRaisesRegex(panvo.Error, "image_1"):
            panvo.Recording(self.folder)
        with self.assertRaisesRegex(panvo.CalibrationError, "left.yaml"):
            panvo.StereoCalibration.from_camera_info(self.folder / "left.yaml", self.folder / "right.yaml")


class Bag(RecordingTest):
    def assert_corridor(self, recording):
        pairs = list(recording)
        self.assertEqual([pair.stamp_ns for pair in pairs], [10**9 + i * 10**8 for i in range(4)])
        odometry = panvo.StereoOdometry(recording.calibration)
        last = [odometry.track(pair.left, pair.right, stamp_ns=pair.stamp_ns) for pair in pairs][-1]
        np.testing.assert_allclose(last.pose[:3, 3], [3 * STEP_M, 0, 0], atol=0.01)
        return pairs

    def test_gives_the_same_as_a_folder(self):
        recording = panvo.Recording(self.bag())
        self.assertEqual(recording.kind, "bag")
        self.assertEqual(recording.ground_truth.shape, (0, 8))
        self.assertTrue(any("/tf_static" in note for note in recording.notes))
        np.testing.assert_array_equal(self.assert_corridor(recording)[1].left, Corridor().pair(1)[0])
        self.assertEqual([pair.stamp_s for pair in recording.stereo(start_s=0.1, duration_s=0.1)], [1.1, 1.2])

    def test_may_hold_rectified_or_colour_images_under_any_name(self):
        self.assert_corridor(panvo.Recording(self.bag(("/stereo/left/image_rect", "/stereo/right/image_rect"))))
        (self.folder / "run.db3").unlink()
        names = ("/robot/a/picture", "/robot/b/picture")
        roles = {"left": names[0], "right": names[1], "left_info": "/robot/a/camera_info", "right_info": "/robot/b/camera_info"}
        pairs = self.assert_corridor(panvo.Recording(self.bag(names, encoding="rgb8"), topics=roles))
        self.assertEqual(pairs[0].left.shape, (HEIGHT, WIDTH, 3))
        with self.assertRaisesRegex(panvo.RecordingError, "name its topics"):
            panvo.Recording(self.folder / "run.db3")
        with self.assertRaisesRegex(panvo.RecordingError, "has no topic /robot/c"):
            panvo.Recording(self.folder / "run.db3", topics={"left": "/robot/c"})
        with self.assertRaisesRegex(ValueError, "topics: 'front' is not a role"):
            panvo.Recording(self.folder / "run.db3", topics={"front": "/robot/a"})
        with self.assertRaisesRegex(panvo.RecordingError, "left must be sensor_msgs/msg/Image"):
            panvo.Recording(self.folder / "run.db3", topics={"left": "/robot/a/camera_info"})

    def test_without_calibration_has_none(self):
        recording = panvo.Recording(self.bag(infos=False))
        self.assertIsNone(recording.calibration)
        with self.assertRaisesRegex(panvo.RecordingError, "no calibrated stereo camera"):
            panvo.StereoCalibration.from_recording(self.folder / "run.db3")

    def test_gives_panoramas_and_skips_unusable_ones(self):
        images = [panorama(1), panorama(2)[:, :, None].repeat(3, 2)]
        messages = [("/panorama/image", "sensor_msgs/msg/Image", i, image_message(i, image, encoding))
                    for i, (image, encoding) in enumerate(zip(images, ("mono8", "bgr8")))]
        messages.append(("/panorama/image", "sensor_msgs/msg/Image", 2, image_message(2, images[0], "bayer_rggb8")))
        messages.append(("/panorama/image", "sensor_msgs/msg/Image", 3, messages[0][3][:1000]))
        recording = panvo.Recording(write_bag(self.folder / "run.db3", messages))
        with self.assertWarnsRegex(RuntimeWarning, "/panorama/image.*image skipped"):
            frames = list(recording.panoramas())
        self.assertEqual(len(frames), 2)
        for frame, image in zip(frames, images):
            np.testing.assert_array_equal(frame.image, image)


class Recorded(unittest.TestCase):
    def test_euroc_is_raw_and_is_rectified(self):
        recording = panvo.Recording(recorded("euroc_v101"))
        self.assertEqual(recording.kind, "EuRoC/ASL")
        self.assertFalse(recording.calibration.is_rectified)
        pair = next(iter(recording.stereo()))
        left, right = recording.calibration.rectify(pair.left, pair.right)
        self.assertEqual(left.shape, (recording.calibration.height, recording.calibration.width))
        self.assertGreater(np.abs(left.astype(int) - pair.left).mean(), 1)


if __name__ == "__main__":
    unittest.main()
