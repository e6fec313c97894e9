// SPDX-License-Identifier: Apache-2.0
#include "panvo/evaluation/trajectory_files.hpp"

#include <cmath>
#include <string>

#include "panvo/evaluation/input_error.hpp"
#include "text_file.hpp"

namespace panvo::evaluation {
namespace {

namespace fs = std::filesystem;

// Tolerance for rounded digits.
constexpr double kRotationTolerance = 1e-3;
constexpr std::int64_t kKittiNominalPeriodNs = 100'000'000;

Eigen::Isometry3d make_pose(const Eigen::Vector3d& position_m, const Eigen::Quaterniond& orientation,
                            const Fields& fields) {
  if (std::abs(orientation.norm() - 1.0) > kRotationTolerance) {
    fields.fail("the quaternion has norm " + std::to_string(orientation.norm()) + " instead of 1",
                "check the order of the columns (TUM: qx qy qz qw, EuRoC: w first)");
  }
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = orientation.normalized().toRotationMatrix();
  pose.translation() = position_m;
  return pose;
}

void append(Trajectory& trajectory, std::int64_t stamp_ns, const Eigen::Isometry3d& pose, const Fields& fields) {
  if (!trajectory.poses.empty() && stamp_ns <= trajectory.poses.back().stamp_ns) {
    fields.fail("the stamp " + std::to_string(stamp_ns) + " ns is not after the previous one, " +
                    std::to_string(trajectory.poses.back().stamp_ns) + " ns",
                "sort the file by time and remove repeated lines");
  }
  trajectory.poses.push_back({stamp_ns, pose});
}

// base_link: x forward, y left, z up; optical: x right, y down, z forward.
Eigen::Isometry3d base_from_optical() {
  Eigen::Isometry3d transform = Eigen::Isometry3d::Identity();
  transform.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return transform;
}

std::vector<std::int64_t> read_kitti_times(const fs::path& file) {
  std::vector<std::int64_t> stamps;
  for (const Line& line : read_lines(file)) {
    const Fields fields(file, line, ' ');
    fields.expect(1, false, "seconds");
    stamps.push_back(fields.seconds_as_ns(0));
  }
  return stamps;
}

bool has_content(const fs::path& file) {
  std::error_code error;
  return fs::is_regular_file(file, error) && fs::file_size(file, error) > 0;
}

// In the original folders of KITTI, poses/03.txt belongs to sequences/03/times.txt.
fs::path kitti_times_of(const fs::path& poses) {
  const fs::path beside = poses.parent_path() / "times.txt";
  const fs::path apart = poses.parent_path().parent_path() / "sequences" / poses.stem() / "times.txt";
  if (has_content(beside)) return beside;
  return has_content(apart) ? apart : fs::path();
}

Trajectory read_file(const fs::path& file) {
  const std::vector<Line> lines = read_lines(file);
  const Line& first = lines.front();
  if (first.text.find(',') != std::string::npos) return read_euroc(file);
  const std::size_t columns = Fields(file, first, ' ').size();
  if (columns == 12) return read_kitti(file, kitti_times_of(file));
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
  for (const char* name :
       {"mav0/state_groundtruth_estimate0/data.csv", "state_groundtruth_estimate0/data.csv", "data.csv"}) {
    if (fs::exists(folder / name)) return read_euroc(folder / name);
  }
  if (fs::exists(folder / "poses.txt")) return read_kitti(folder / "poses.txt", kitti_times_of(folder / "poses.txt"));
  const fs::path sequence = fs::absolute(folder / "").parent_path();
  const fs::path kitti = sequence.parent_path().parent_path() / "poses" / (sequence.filename().string() + ".txt");
  if (fs::exists(kitti)) return read_kitti(kitti, kitti_times_of(kitti));
  throw InputError(folder, "no trajectory in this folder",
                   "it should contain odometry_enhanced.tum or odometry_binocular.tum (a run), "
                   "mav0/state_groundtruth_estimate0/data.csv (EuRoC/ASL) or poses.txt (KITTI); or name a file");
}

}  // namespace

Trajectory read_tum(const fs::path& file) {
  Trajectory trajectory{{}, file, "TUM"};
  for (const Line& line : read_lines(file)) {
    const Fields fields(file, line, ' ');
    fields.expect(8, false, "t x y z qx qy qz qw");
    const Eigen::Vector3d position(fields.number(1), fields.number(2), fields.number(3));
    const Eigen::Quaterniond orientation(fields.number(7), fields.number(4), fields.number(5), fields.number(6));
    append(trajectory, fields.seconds_as_ns(0), make_pose(position, orientation, fields), fields);
  }
  return trajectory;
}

Trajectory read_euroc(const fs::path& file) {
  Trajectory trajectory{{}, file, "EuRoC"};
  for (const Line& line : read_lines(file)) {
    const Fields fields(file, line, ',');
    fields.expect(8, true, "stamp_ns,x,y,z,qw,qx,qy,qz");
    const Eigen::Vector3d position(fields.number(1), fields.number(2), fields.number(3));
    const Eigen::Quaterniond orientation(fields.number(4), fields.number(5), fields.number(6), fields.number(7));
    append(trajectory, fields.integer(0), make_pose(position, orientation, fields), fields);
  }
  return trajectory;
}

Trajectory read_kitti(const fs::path& file, const fs::path& times) {
  const std::vector<Line> lines = read_lines(file);
  std::vector<std::int64_t> stamps;
  if (!times.empty()) {
    stamps = read_kitti_times(times);
    if (stamps.size() < lines.size()) {
      throw InputError(times,
                       std::to_string(stamps.size()) + " stamps for the " + std::to_string(lines.size()) +
                           " poses of " + file.string(),
                       "give one stamp per pose");
    }
  }
  Trajectory trajectory{{}, file, times.empty() ? "KITTI, nominal 10 Hz" : "KITTI"};
  const Eigen::Isometry3d turn = base_from_optical();
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const Fields fields(file, lines[i], ' ');
    fields.expect(12, false, "the 12 numbers of a 3x4 matrix, row by row");
    Eigen::Matrix<double, 3, 4> matrix;
    for (std::size_t k = 0; k < 12; ++k) matrix(static_cast<int>(k / 4), static_cast<int>(k % 4)) = fields.number(k);
    const Eigen::Matrix3d rotation = matrix.leftCols<3>();
    if ((rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() > kRotationTolerance ||
        rotation.determinant() < 0.0) {
      fields.fail("the left 3x3 part is not a rotation", "check that the matrix is written row by row");
    }
    const Eigen::Isometry3d optical = make_pose(matrix.col(3), Eigen::Quaterniond(rotation).normalized(), fields);
    const std::int64_t stamp_ns = times.empty() ? static_cast<std::int64_t>(i) * kKittiNominalPeriodNs : stamps[i];
    append(trajectory, stamp_ns, turn * optical * turn.inverse(), fields);
  }
  return trajectory;
}

Trajectory read_trajectory(const fs::path& file_or_folder) {
  std::error_code error;
  if (!fs::exists(file_or_folder, error)) throw InputError(file_or_folder, "no such file or folder", "check the path");
  return fs::is_directory(file_or_folder, error) ? read_folder(file_or_folder) : read_file(file_or_folder);
}

}  // namespace panvo::evaluation
