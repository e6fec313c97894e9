// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace panvo::evaluation {

// Permitted difference of a run from the expected one. Both zero: files must be bit-identical, as for replays on one
// machine.
struct RunTolerance {
  double position_m = 0.0;
  double rotation_deg = 0.0;
  bool is_exact() const { return position_m == 0.0 && rotation_deg == 0.0; }
};

struct FileComparison {
  std::string name;                       // "odometry_binocular.tum"
  std::size_t lines = 0;                  // expected number of poses or events
  std::optional<std::string> difference;  // first difference beyond the tolerance: "line 12: ..."
  std::optional<double> worst_m;          // largest pose difference; nullopt for files that are not trajectories
  std::optional<double> worst_deg;
};

// Compares the result files of a run (trajectories *.tum, events *.csv) with those of an earlier one, in order of name.
// With a tolerance, poses of equal stamps may differ by it, and of events only stamps, ids and states must be equal,
// not measured numbers. Throws InputError if a folder has no such files or a trajectory cannot be read.
std::vector<FileComparison> compare_runs(const std::filesystem::path& run, const std::filesystem::path& expected,
                                         const RunTolerance& tolerance = {});

}  // namespace panvo::evaluation
