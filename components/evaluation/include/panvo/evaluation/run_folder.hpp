// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "panvo/evaluation/consistency.hpp"
#include "panvo/evaluation/timing.hpp"
#include "panvo/evaluation/trajectory.hpp"

namespace panvo::evaluation {

// What is known of one estimate: its path, and what the run left beside it.
struct Estimate {
  std::string name;
  Trajectory trajectory;
  std::optional<MotionCovariances> covariances;  // odometry_binocular_covariance.csv
  Trajectory odometry;                           // odometry_binocular.tum, which those covariances speak of
  std::optional<StageTimes> timing;              // timing.json
  std::optional<std::size_t> unreliable{};       // frames whose motion was not measured: quality.csv
};

// Reads a run's output folder, one `odometry_*.tum` in such a folder, or any other trajectory (then without
// covariances and times). The name is that of the folder or file. Throws InputError.
Estimate read_estimate(const std::filesystem::path& file_or_folder);

// Whether a run left trajectories in this folder.
bool is_run_folder(const std::filesystem::path& folder);

// Throws InputError for the folder of a run that did not play all there was: interrupted (summary.json says so), or killed.
// What it has is the beginning of a result.
void require_finished(const std::filesystem::path& file_or_folder);

}  // namespace panvo::evaluation
