#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Plots the trajectory of a KITTI folder (or any recording) over its ground truth: kitti_trajectory.py FOLDER PICTURE."""
import sys

import matplotlib.pyplot as plt
import numpy as np
import panvo

recording = panvo.Recording(sys.argv[1])
odometry = panvo.StereoOdometry(recording.calibration)
path = np.array([odometry.track(pair.left, pair.right, stamp_ns=pair.stamp_ns).tum for pair in recording.stereo()])
if len(recording.ground_truth):
    plt.plot(-recording.ground_truth[:, 2], recording.ground_truth[:, 1], "k--", label="ground truth")
    print(f"error at the end: {panvo.evaluate(path, recording.ground_truth)['end_error_percent']:.2f} %")
plt.plot(-path[:, 2], path[:, 1], label="panvo")
plt.gca().set(aspect="equal", adjustable="datalim", xlabel="right (m)", ylabel="forward (m)")
plt.legend()
plt.savefig(sys.argv[2], dpi=120)
