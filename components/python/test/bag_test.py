# SPDX-License-Identifier: Apache-2.0
"""Bags: messages as dictionaries, foreign types, damage."""
import gc
import pathlib
import struct
import tempfile
import unittest
import warnings

import numpy as np
import panvo

from scenes import Cdr, camera_info_message, image_message, recorded, text_message, write_bag


class BagTest(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.path = pathlib.Path(scratch.name) / "run.db3"

    def values(self, kind, data):
        self.path.unlink(missing_ok=True)
        message, = panvo.Bag(write_bag(self.path, [("/topic", kind, 1, data)]))
        return message.values


class Messages(BagTest):
    def test_are_listed_by_topic_and_in_order(self):
        bag = panvo.Bag(write_bag(self.path, [("/b", "std_msgs/msg/String", 3, text_message("last")),
                                              ("/a", "std_msgs/msg/String", 1, text_message("first")),
                                              ("/b", "std_msgs/msg/String", 2, text_message("second"))]))
        self.assertEqual({name: (topic.type, topic.message_count) for name, topic in bag.topics.items()},
                         {"/a": ("std_msgs/msg/String", 1), "/b": ("std_msgs/msg/String", 2)})
        self.assertEqual((bag.message_count, bag.start_ns), (3, 1))
        self.assertEqual([message["data"] for message in bag], ["first", "second", "last"])
        self.assertEqual([message.stamp_ns for message in bag.messages("/b")], [2, 3])
        self.assertEqual(len(list(bag.messages(["/a", "/b"]))), 3)
        self.assertEqual(bytes(next(bag.messages("/a")).data), text_message("first"))
        with self.assertRaisesRegex(panvo.BagError, "has no topic /c; its topics are /a, /b|its topics are /b, /a"):
            bag.messages("/c")
        with self.assertRaisesRegex(TypeError, "topics: expected a name or a list of names, not int"):
            bag.messages(7)

    def test_hold_plain_values_and_arrays(self):
        pixels = np.arange(12, dtype=np.uint8).reshape(3, 4)
        image = self.values("sensor_msgs/msg/Image", image_message(1_500_000_000, pixels))
        self.assertEqual(image["header"], {"stamp": {"sec": 1, "nanosec": 500_000_000}, "frame_id": "left_optical"})
        self.assertEqual((image["height"], image["width"], image["encoding"]), (3, 4, "mono8"))
        np.testing.assert_array_equal(image["data"].reshape(3, 4), pixels)
        self.assertFalse(image["data"].flags.writeable)
        info = self.values("sensor_msgs/msg/CameraInfo", camera_info_message(0, 0.5))
        self.assertEqual((info["k"].dtype, info["k"].shape, info["d"].shape, info["p"].shape), (np.float64, (9,), (5,), (12,)))
        self.assertEqual(info["p"][3], -100.0)
        self.assertIs(info["roi"]["do_rectify"], False)
        data = image["data"]
        del image
        gc.collect()
        np.testing.assert_array_equal(data, pixels.ravel())  # the array keeps the message

    def test_of_nested_sequences_are_lists(self):
        transform = Cdr().put("I", 1).header(7 * 10**9, "map").text("odom").put("d", 1, 2, 3, 0, 0, 0, 1)
        message = self.values("tf2_msgs/msg/TFMessage", bytes(transform.bytes))
        self.assertEqual(message["transforms"][0]["transform"]["translation"], {"x": 1.0, "y": 2.0, "z": 3.0})
        self.assertEqual(message["transforms"][0]["child_frame_id"], "odom")
        self.assertEqual(self.values("tf2_msgs/msg/TFMessage", b"\0\1\0\0" + struct.pack("<I", 0)), {"transforms": []})

    def test_in_the_byte_order_of_other_machines_are_read(self):
        big = b"\0\0\0\0" + struct.pack(">I", 2) + b"\0" * 4 + struct.pack(">2d", 1.5, -2.0)
        layout = b"\0\0\0\0" + struct.pack(">II", 0, 0) + big[4:]
        values = self.values("std_msgs/msg/Float64MultiArray", layout)
        np.testing.assert_array_equal(values["data"], [1.5, -2.0])

    def test_of_packages_that_are_loaded_by_name_are_read(self):
        uv = bytes(Cdr().put("f", 0.25, 0.5).bytes)
        self.assertEqual(self.values("visualization_msgs/msg/UVCoordinate", uv), {"u": 0.25, "v": 0.5})

    def test_that_cannot_be_decoded_say_so(self):
        with self.assertRaisesRegex(panvo.DecodeError, "/topic: the type foreign_msgs/msg/Thing .*foreign_msgs"):
            self.values("foreign_msgs/msg/Thing", b"\0\1\0\0")
        for data in (text_message("long text")[:8], b"", b"\0\1", b"\0\1\0\0\xff\xff\xff\xff", b"\0\7\0\0\1\0\0\0\0"):
            with self.subTest(data), self.assertRaises(panvo.DecodeError):
                self.values("std_msgs/msg/String", data)


class Damage(BagTest):
    def test_of_a_truncated_bag_costs_messages_or_raises(self):
        messages = [("/a", "std_msgs/msg/String", i, text_message("x" * 2000 + str(i))) for i in range(200)]
        whole = write_bag(self.path, messages).read_bytes()
        survived = 0
        for share in (0.0, 0.001, 0.3, 0.6, 0.9):
            self.path.write_bytes(whole[:int(share * len(whole))])
            try:
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore")
                    read = [message["data"] for message in panvo.Bag(self.path)]
            except panvo.BagError as error:
                self.assertIn("run.db3", str(error))
                continue
            self.assertLess(len(read), 200)
            self.assertTrue(all(text.startswith("xxx") for text in read))
            survived = max(survived, len(read))
        self.assertGreater(survived, 0)

    def test_of_other_files_is_told(self):
        with self.assertRaisesRegex(panvo.BagError, "nowhere"):
            panvo.Bag(self.path.parent / "nowhere")
        self.path.write_text("not a database, whatever its name says")
        with self.assertRaisesRegex(panvo.BagError, "run.db3"):
            panvo.Bag(self.path)
        with self.assertRaises(TypeError):
            panvo.Bag(7)


class Recorded(unittest.TestCase):
    def test_bags_of_ros_are_read_whole(self):
        for name in ("nav2_turtlebot.mcap", "test_bag_sqlite3", "test_bag_mcap", "tf_example"):
            bag = panvo.Bag(recorded("bags") / name)
            read = 0
            for message in bag:
                try:
                    self.assertIsInstance(message.values, dict)
                except panvo.DecodeError as error:
                    # Not built here, or a type of an older ROS with fewer members.
                    self.assertRegex(str(error), "the type .* is unknown|Range: truncated or not of this type", name)
                read += 1
            self.assertEqual(read, bag.message_count, name)


if __name__ == "__main__":
    unittest.main()
