// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "panvo/evaluation/trajectory.hpp"

namespace panvo::evaluation {

// All readers throw InputError (file, line, remedy) for a file that is missing, empty, of another shape, not finite,
// not in order of time, or whose rotations are none. Lines that start with '#' and blank lines are passed over.

// `t x y z qx qy qz qw`, t in seconds; decimals are read digit by digit, so nanoseconds survive.
Trajectory read_tum(const std::filesystem::path& file);

// state_groundtruth_estimate0/data.csv: stamp in ns, position, quaternion w first; further columns are ignored.
Trajectory read_euroc(const std::filesystem::path& file);

// KITTI odometry: one 3x4 matrix a line, first left optical frame from left optical frame. Turned to REP 103 at the
// same camera (x forward, y left, z up), so it compares with panvo's base_link. Stamps, in seconds, from `times`;
// where that is empty, the nominal 10 Hz of the data set, from 0.
Trajectory read_kitti(const std::filesystem::path& file, const std::filesystem::path& times = {});

// A file of any of these formats (told apart by its first line), or a folder:
// a run's output (odometry_enhanced.tum, else odometry_binocular.tum), an EuRoC/ASL data set, a KITTI sequence.
Trajectory read_trajectory(const std::filesystem::path& file_or_folder);

}  // namespace panvo::evaluation
