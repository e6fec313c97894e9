// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "panvo/evaluation/trajectory.hpp"

namespace panvo::evaluation {

// All readers throw InputError (file, line, remedy) for a file that is missing, empty, of a different format, not
// finite, not in order of time, or with invalid rotations. Lines that start with '#' and blank lines are skipped.

// `t x y z qx qy qz qw`, t in seconds, read digit by digit to preserve nanoseconds.
Trajectory read_tum(const std::filesystem::path& file);

// state_groundtruth_estimate0/data.csv: stamp in ns, position, quaternion w first; further columns are ignored.
Trajectory read_euroc(const std::filesystem::path& file);

// KITTI odometry: one 3x4 matrix per line, first left optical frame from left optical frame. Converted to REP 103 axes
// (x forward, y left, z up) at the same camera, comparable with panvo's base_link. Stamps, in seconds, from `times`; if
// that is empty, the nominal 10 Hz of the data set, from 0.
Trajectory read_kitti(const std::filesystem::path& file, const std::filesystem::path& times = {});

// Reads a file in any of these formats (recognised by its first line) or a folder: a run folder (odometry_enhanced.tum,
// else odometry_binocular.tum), a EuRoC/ASL data set, a KITTI sequence.
Trajectory read_trajectory(const std::filesystem::path& file_or_folder);

}  // namespace panvo::evaluation
