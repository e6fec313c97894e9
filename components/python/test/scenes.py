# SPDX-License-Identifier: Apache-2.0
"""Made-up images with known motion, the folder of recordings, and bags written byte by byte."""
import os
import pathlib
import sqlite3
import struct
import unittest

import numpy as np

FOCAL_PX, BASELINE_M = 200.0, 0.5
WIDTH, HEIGHT = 480, 320
STEP_M = 0.1  # of the camera to the right per frame
NEAR_M, FAR_M = 4.0, 10.0


def recorded(name):
    """Path of a recording; skips the test if it does not exist."""
    folders = [pathlib.Path(os.environ["PANVO_DATA"])] if os.environ.get("PANVO_DATA") else [
        parent / "shared/data" for parent in pathlib.Path(__file__).resolve().parents]
    for folder in folders:
        if (folder / name).exists():
            return folder / name
    raise unittest.SkipTest(f"{name} is missing; set PANVO_DATA to the folder of recordings")


def texture(height, width, seed, block=6):
    """Random grey blocks with soft edges."""
    coarse = np.random.default_rng(seed).integers(20, 235, (height // block + 2, width // block + 2))
    fine = np.repeat(np.repeat(coarse, block, 0), block, 1)[:height, :width].astype(float)
    for axis in (0, 1):
        fine = (np.roll(fine, 1, axis) + 2 * fine + np.roll(fine, -1, axis)) / 4
    return fine.astype(np.uint8)


class Corridor:
    """A near and a far wall before a camera that moves to the right, so that all pixels shift by whole numbers."""

    def __init__(self, seed=1):
        self.far = texture(HEIGHT, 4 * WIDTH, seed)
        self.near = texture(HEIGHT, 4 * WIDTH, seed + 1)

    def _view(self, x_m):
        far, near = (round(FOCAL_PX * x_m / depth_m) for depth_m in (FAR_M, NEAR_M))
        image = self.far[:, far:far + WIDTH].copy()
        is_near = np.arange(near, near + WIDTH) % 300 < 150
        image[HEIGHT // 3:, is_near] = self.near[HEIGHT // 3:, near:near + WIDTH][:, is_near]
        return image

    def pair(self, frame):
        x_m = frame * STEP_M
        return self._view(x_m), self._view(x_m + BASELINE_M)


def panorama(seed):
    """540 x 1080 px, grey, continuous over the seam."""
    return (texture(540, 1080, seed, 30) // 2 + texture(540, 1080, seed + 1000, 9) // 2).astype(np.uint8)


class Cdr:
    """Writes the members of a message in little-endian CDR."""

    def __init__(self):
        self.bytes = bytearray(b"\0\1\0\0")

    def put(self, kind, *values):
        for value in values:
            self.bytes += b"\0" * (-(len(self.bytes) - 4) % struct.calcsize(kind))
            self.bytes += struct.pack("<" + kind, value)
        return self

    def text(self, value):
        encoded = value.encode() + b"\0"
        self.put("I", len(encoded)).bytes.extend(encoded)
        return self

    def header(self, stamp_ns, frame):
        return self.put("i", stamp_ns // 10**9).put("I", stamp_ns % 10**9).text(frame)


def image_message(stamp_ns, image, encoding="mono8", frame="left_optical"):
    data = image.tobytes()
    cdr = Cdr().header(stamp_ns, frame).put("I", *image.shape[:2]).text(encoding).put("B", 0).put("I", image.strides[0], len(data))
    return bytes(cdr.bytes + data)


def camera_info_message(stamp_ns, baseline_m=0.0, frame="left_optical"):
    k = [FOCAL_PX, 0, (WIDTH - 1) / 2, 0, FOCAL_PX, (HEIGHT - 1) / 2, 0, 0, 1]
    p = [*k[:3], -FOCAL_PX * baseline_m, *k[3:6], 0, *k[6:], 0]
    cdr = Cdr().header(stamp_ns, frame).put("I", HEIGHT, WIDTH).text("plumb_bob").put("I", 5).put("d", *[0.0] * 5)
    cdr.put("d", *k, *[1, 0, 0, 0, 1, 0, 0, 0, 1], *p).put("I", 0, 0, 0, 0, 0, 0).put("B", 0)
    return bytes(cdr.bytes)


def text_message(text):
    return bytes(Cdr().text(text).bytes)


def write_bag(path, messages):
    """messages: (topic, type, stamp_ns, bytes). A .db3 file as rosbag2 of Humble writes it."""
    bag = sqlite3.connect(path)
    bag.executescript("""
        CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, serialization_format TEXT NOT NULL,
          offered_qos_profiles TEXT NOT NULL);
        CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL, data BLOB NOT NULL);
        CREATE INDEX timestamp_idx ON messages (timestamp ASC);""")
    ids = {}
    for topic, kind, stamp_ns, data in messages:
        if topic not in ids:
            ids[topic] = len(ids) + 1
            bag.execute("INSERT INTO topics VALUES (?, ?, ?, 'cdr', '')", (ids[topic], topic, kind))
        bag.execute("INSERT INTO messages (topic_id, timestamp, data) VALUES (?, ?, ?)", (ids[topic], stamp_ns, data))
    bag.commit()
    bag.close()
    return path
