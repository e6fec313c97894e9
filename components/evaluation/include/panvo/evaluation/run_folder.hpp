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

// A trajectory to be evaluated and the other files of its run.
struct Estimate {
  std::string name;
  Trajectory trajectory;
  std::optional<MotionCovariances> covariances;  // odometry_binocular_covariance.csv
  Trajectory odometry;                           // odometry_binocular.tum, to which the covariances belong
  std::optional<StageTimes> timing;              // timing.json
  std::optional<std::size_t> unreliable{};       // frames without measured motion, from quality.csv
};

// Reads a run folder, one `odometry_*.tum` in such a folder, or any other trajectory (then without covariances and
// times). The name is that of the folder or file. Throws InputError.
Estimate read_estimate(const std::filesystem::path& file_or_folder);

// Whether the folder contains trajectories of a run.
bool is_run_folder(const std::filesystem::path& folder);

// Throws InputError for the folder of an incomplete run: interrupted (according to summary.json) or killed.
void require_finished(const std::filesystem::path& file_or_folder);

}  // namespace panvo::evaluation
