# SPDX-License-Identifier: Apache-2.0
"""Recognises the layouts of recordings, and finds all recordings below a folder."""
import euroc
import folders
import kitti

# Name and check of the layouts that the data set player reads.
READABLE = {
    "kitti": ("KITTI odometry", kitti.check),
    "euroc": ("EuRoC/ASL", euroc.check),
    "folders": ("left and right folders", folders.check),
}
DEEPEST = 6


def any_folder(folder, *names):
    return any((folder / name).is_dir() for name in names)


def is_tum_vi(folder):
    mav0 = folder / "mav0"
    return (mav0 / "cam0").is_dir() and not (mav0 / "cam0" / "sensor.yaml").exists() and any_folder(folder, "mav0/mocap0", "dso")


def is_euroc(folder):
    return (folder / "mav0").is_dir() or any((folder / name / "data.csv").exists() for name in ("cam0", "cam2"))


# In this order: the first that fits is taken.
LAYOUTS = (
    ("tum_vi", is_tum_vi),
    ("euroc", is_euroc),
    ("kitti_360", lambda folder: any_folder(folder, "image_00/data_rect", "image_01/data_rect", "image_02/data_rgb", "image_03/data_rgb")),
    ("robotcar", lambda folder: any_folder(folder, "stereo/centre", "mono_left", "mono_rear", "mono_right")),
    ("4seasons", lambda folder: any_folder(folder, "undistorted_images", "distorted_images")),
    ("nclt", lambda folder: any_folder(folder, "lb3/Cam0", "lb3/Cam1")),
    ("kitti", lambda folder: any_folder(folder, "image_0", "image_1", "image_2")),
    ("folders", lambda folder: any_folder(folder, "left") and any_folder(folder, "right")),
)


def layout_of(folder):
    """Key of the data set with this layout, or None."""
    return next((key for key, fits in LAYOUTS if fits(folder)), None)


def recordings(folder, depth=DEEPEST):
    """(folder, key) of each recording in or below a folder, sorted. Links are not followed."""
    key = layout_of(folder)
    if key:
        return [(folder, key)]
    if depth == 0:
        return []
    below = sorted(entry for entry in folder.iterdir() if entry.is_dir() and not entry.is_symlink() and not entry.name.startswith("."))
    return [found for entry in below for found in recordings(entry, depth - 1)]
