// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/run_folder.hpp"

#include <string_view>

#include "panvo/evaluation/trajectory_files.hpp"

namespace panvo::evaluation {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kOdometry = "odometry_binocular.tum";
constexpr std::string_view kEnhanced = "odometry_enhanced.tum";
constexpr std::string_view kCovariances = "odometry_binocular_covariance.csv";
constexpr std::string_view kTiming = "timing.json";

// "runs/monday/" and "runs/monday" are both called monday; "." is called as the folder it is.
std::string name_of(const fs::path& file_or_folder) {
  const fs::path path = fs::weakly_canonical(file_or_folder);
  if (fs::is_directory(path)) return path.filename().string();
  return path.stem().string();
}

}  // namespace

Estimate read_estimate(const fs::path& file_or_folder) {
  Estimate estimate;
  estimate.trajectory = read_trajectory(file_or_folder);
  estimate.name = name_of(file_or_folder);
  const fs::path file = estimate.trajectory.source;
  if (file.filename() != kOdometry && file.filename() != kEnhanced) return estimate;

  const fs::path folder = file.parent_path();
  if (fs::exists(folder / kTiming)) estimate.timing = read_timing(folder / kTiming);
  if (fs::exists(folder / kCovariances) && fs::exists(folder / kOdometry)) {
    estimate.covariances = read_motion_covariances(folder / kCovariances);
    estimate.odometry = file.filename() == kOdometry ? estimate.trajectory : read_tum(folder / kOdometry);
  }
  return estimate;
}

}  // namespace panvo::evaluation
