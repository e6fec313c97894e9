// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "panvo/evaluation/trajectory.hpp"

namespace panvo::evaluation {

// All readers throw InputError (file, line, remedy) for a file that is missing, empty, of a different format, not
// finite, not in order of time, or with invalid rotations. Lines that start with '#' and blank lines are skipped.

// `t x y z qx qy qz qw`, t in seconds, read digit by digit to preserve nanoseconds.
Trajectory read_tum(const std::filesystem::path& file);

// Ground truth of EuRoC/ASL: stamp in ns, position, quaternion w first; further columns are ignored. A sensor.yaml beside
// the file places the sensor on the vehicle, as for the data set player.
Trajectory read_euroc(const std::filesystem::path& file);

// KITTI odometry: one 3x4 matrix per line, first left optical frame from left optical frame. Converted to REP 103 axes
// (x forward, y left, z up) at the same camera, comparable with panvo's base_link. Stamps, in seconds, from `times`; if
// that is empty, the nominal 10 Hz of the data set, from 0.
Trajectory read_kitti(const std::filesystem::path& file, const std::filesystem::path& times = {});

// Reads a file in any of these formats (recognised by its first line) or a folder: a run folder (odometry_enhanced.tum,
// else odometry_binocular.tum), or a data set, whose ground truth is found where the data set player finds it.
Trajectory read_trajectory(const std::filesystem::path& file_or_folder);

}  // namespace panvo::evaluation
