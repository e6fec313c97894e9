// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace panvo::evaluation {

// How far a run may be from the one that is expected. Both zero: every file bit for bit, as replays on one machine are.
struct RunTolerance {
  double position_m = 0.0;
  double rotation_deg = 0.0;
  bool is_exact() const { return position_m == 0.0 && rotation_deg == 0.0; }
};

struct FileComparison {
  std::string name;                       // "odometry_binocular.tum"
  std::size_t lines = 0;                  // that were expected: poses or events
  std::optional<std::string> difference;  // the first that counts: "line 12: ..."
  std::optional<double> worst_m;          // of the poses of a trajectory; absent for other files
  std::optional<double> worst_deg;
};

// Compares what a run left (trajectories *.tum, events *.csv) with what an earlier one left, file by file, sorted by name. With a
// tolerance, poses of the same stamps may differ by it, and of events only what is no measured number (stamps, ids, states) must be
// the same. Throws InputError where a folder has no such files, or a trajectory cannot be read.
std::vector<FileComparison> compare_runs(const std::filesystem::path& run, const std::filesystem::path& expected,
                                         const RunTolerance& tolerance = {});

}  // namespace panvo::evaluation
