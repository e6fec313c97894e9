// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/trajectory_files.hpp"

#include <cmath>
#include <string>

#include "of_data_set.hpp"
#include "panvo/dataset_player/ground_truth.hpp"
#include "panvo/evaluation/input_error.hpp"
#include "text_file.hpp"

namespace panvo::evaluation {
namespace {

namespace fs = std::filesystem;

// Tolerance for rounded digits.
constexpr std::int64_t kKittiNominalPeriodNs = 100'000'000;

bool has_content(const fs::path& file) {
  std::error_code error;
  return fs::is_regular_file(file, error) && fs::file_size(file, error) > 0;
}

Trajectory read_file(const fs::path& file) {
  const std::vector<Line> lines = read_lines(file);
  const Line& first = lines.front();
  if (first.text.find(',') != std::string::npos) return read_euroc(file);
  const std::size_t columns = Fields(file, first, ' ').size();
  if (columns == 12) return read_kitti(file, dataset_player::find_kitti_times(file).value_or(fs::path()));
  if (columns == 8) return read_tum(file);
  throw InputError(file, first.number, "unknown trajectory format: " + std::to_string(columns) + " columns",
                   "use TUM (8 columns), KITTI poses (12 columns) or EuRoC csv");
}

Trajectory read_folder(const fs::path& folder) {
  for (const char* name : {"odometry_enhanced.tum", "odometry_binocular.tum"}) {
    if (has_content(folder / name)) return read_tum(folder / name);
  }
  // A run that ended early leaves an empty file; its error is more helpful than "no trajectory in this folder".
  if (fs::exists(folder / "odometry_binocular.tum")) return read_tum(folder / "odometry_binocular.tum");
  if (const auto file = dataset_player::find_ground_truth(folder)) return read_file(*file);
  if (fs::exists(folder / "data.csv")) return read_file(folder / "data.csv");
  throw InputError(
      folder, "no trajectory in this folder",
      "it should contain odometry_enhanced.tum or odometry_binocular.tum (a run), data.csv in mav0 of "
      "state_groundtruth_estimate0, vicon0 or mocap0 (EuRoC/ASL; leica0 holds positions only), or poses.txt "
      "(KITTI); or name a file");
}

}  // namespace

Trajectory read_tum(const fs::path& file) {
  Trajectory trajectory{{}, file, "TUM"};
  for (const Line& line : read_lines(file)) {
    const Fields fields(file, line, ' ');
    fields.expect(8, false, "t x y z qx qy qz qw");
    const Eigen::Vector3d position(fields.number(1), fields.number(2), fields.number(3));
    const Eigen::Quaterniond orientation(fields.number(7), fields.number(4), fields.number(5), fields.number(6));
    if (std::abs(orientation.norm() - 1.0) > kRotationTolerance) {
      fields.fail("the quaternion has norm " + std::to_string(orientation.norm()) + " instead of 1",
                  "check the order of the columns: qx qy qz qw");
    }
    const std::int64_t stamp_ns = fields.seconds_as_ns(0);
    if (!trajectory.poses.empty() && stamp_ns <= trajectory.poses.back().stamp_ns) {
      fields.fail("the stamp " + std::to_string(stamp_ns) + " ns is not after the previous one, " +
                      std::to_string(trajectory.poses.back().stamp_ns) + " ns",
                  "sort the file by time and remove repeated lines");
    }
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = orientation.normalized().toRotationMatrix();
    pose.translation() = position;
    trajectory.poses.push_back({stamp_ns, pose});
  }
  return trajectory;
}

Trajectory read_euroc(const fs::path& file) {
  Trajectory trajectory{{}, file, "EuRoC"};
  for (const auto& pose : of_data_set([&] { return dataset_player::read_euroc_poses(file); })) {
    trajectory.poses.push_back({pose.stamp_ns, pose.map_from_base});
  }
  if (trajectory.poses.empty()) throw InputError(file, "is empty", "copy the data set again");
  return trajectory;
}

Trajectory read_kitti(const fs::path& file, const fs::path& times) {
  const auto poses = of_data_set([&] { return dataset_player::read_kitti_poses(file); });
  if (poses.empty()) throw InputError(file, "is empty", "copy the data set again");
  Trajectory trajectory{{}, file, times.empty() ? "KITTI, nominal 10 Hz" : "KITTI"};
  std::vector<std::int64_t> stamps;
  if (!times.empty()) {
    stamps = of_data_set([&] { return dataset_player::read_kitti_times(times); });
    if (stamps.size() < poses.size()) {
      throw InputError(times,
                       std::to_string(stamps.size()) + " stamps for the " + std::to_string(poses.size()) +
                           " poses of " + file.string(),
                       "give one stamp per pose");
    }
  }
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const std::int64_t stamp_ns = times.empty() ? static_cast<std::int64_t>(i) * kKittiNominalPeriodNs : stamps[i];
    trajectory.poses.push_back({stamp_ns, poses[i]});
  }
  return trajectory;
}

Trajectory read_trajectory(const fs::path& file_or_folder) {
  std::error_code error;
  if (!fs::exists(file_or_folder, error)) throw InputError(file_or_folder, "no such file or folder", "check the path");
  return fs::is_directory(file_or_folder, error) ? read_folder(file_or_folder) : read_file(file_or_folder);
}

}  // namespace panvo::evaluation
