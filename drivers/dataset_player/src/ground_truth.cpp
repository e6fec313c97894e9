// SPDX-License-Identifier: Apache-2.0
#include "panvo/dataset_player/ground_truth.hpp"

#include <cmath>
#include <initializer_list>

#include "calibration_values.hpp"
#include "layouts.hpp"
#include "text_file.hpp"

namespace panvo::dataset_player {
namespace {

namespace fs = std::filesystem;

std::optional<fs::path> first_existing(std::initializer_list<fs::path> files) {
  for (const auto& file : files) {
    const auto normal = file.lexically_normal();  // "poses/../sequences" exists only if "poses" does
    if (fs::exists(normal)) return normal;
  }
  return std::nullopt;
}

}  // namespace

std::optional<fs::path> find_euroc_ground_truth(const fs::path& directory) {
  const auto root = euroc_root(directory);
  return first_existing(
      {root / "state_groundtruth_estimate0" / "data.csv", root / "vicon0" / "data.csv", root / "mocap0" / "data.csv"});
}

std::optional<fs::path> find_kitti_ground_truth(const fs::path& directory) {
  // "sequences/03/" and "sequences/03" name the same folder, but only the latter ends in 03.
  const auto folder = fs::weakly_canonical(directory);
  const auto of_sequence = fs::path("poses") / (folder.filename().string() + ".txt");
  return first_existing({directory / "poses.txt", folder / ".." / of_sequence, folder / ".." / ".." / of_sequence});
}

std::optional<fs::path> find_ground_truth(const fs::path& directory) {
  const auto file = find_euroc_ground_truth(directory);
  return file ? file : find_kitti_ground_truth(directory);
}

std::vector<GroundTruthPose> read_euroc_poses(const fs::path& path) {
  Eigen::Isometry3d sensor_from_base =
      Eigen::Isometry3d::Identity();  // identity for the state, which is that of the body
  if (const auto beside = path.parent_path() / "sensor.yaml"; fs::exists(beside)) {
    with_dataset_error([&] {
      calibration_files::YamlMap sensor(beside, kSensorFile);
      if (sensor.has("T_BS")) sensor_from_base = read_base_from_sensor(sensor).inverse();
      sensor.check();
    });
  }
  const TextFile file(path, TextFile::Separator::kComma);
  std::vector<GroundTruthPose> poses;
  for (const auto& line : file.lines()) {
    const auto stamp_ns = file.nanoseconds(line, 0);
    if (!poses.empty()) file.expect_later(line, poses.back().stamp_ns, stamp_ns);
    const auto value = [&](std::size_t field) { return file.number(line, field); };
    const Eigen::Quaterniond rotation(value(4), value(5), value(6), value(7));
    if (std::abs(rotation.norm() - 1.0) > 1e-2)
      file.fail(line, "contains a quaternion whose norm is not 1; correct or remove the line");
    Eigen::Isometry3d map_from_sensor = Eigen::Isometry3d::Identity();
    map_from_sensor.linear() = rotation.normalized().toRotationMatrix();
    map_from_sensor.translation() = Eigen::Vector3d(value(1), value(2), value(3));
    poses.push_back({stamp_ns, map_from_sensor * sensor_from_base});
  }
  return poses;
}

std::vector<Eigen::Isometry3d> read_kitti_poses(const fs::path& path) {
  const TextFile file(path, TextFile::Separator::kBlank);
  const auto base_from_camera = base_from_optical();
  std::vector<Eigen::Isometry3d> poses;
  for (const auto& line : file.lines()) {
    RowMajor34d matrix;
    for (int i = 0; i < 12; ++i) matrix(i / 4, i % 4) = file.number(line, static_cast<std::size_t>(i));
    const Eigen::Matrix3d rotation = matrix.leftCols<3>();
    if ((rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm() > 1e-3 || rotation.determinant() < 0.0) {
      file.fail(line, "is not a pose: its first three columns are not a rotation; copy the file again");
    }
    Eigen::Isometry3d first_from_camera = Eigen::Isometry3d::Identity();
    first_from_camera.linear() = Eigen::Quaterniond(rotation).normalized().toRotationMatrix();
    first_from_camera.translation() = matrix.col(3);
    poses.push_back(base_from_camera * first_from_camera * base_from_camera.inverse());
  }
  return poses;
}

std::vector<std::int64_t> read_kitti_times(const fs::path& path) {
  const TextFile file(path, TextFile::Separator::kBlank);
  std::vector<std::int64_t> stamps_ns;
  for (const auto& line : file.lines()) {
    const auto stamp_ns = file.seconds_as_ns(line, 0);
    if (!stamps_ns.empty()) file.expect_later(line, stamps_ns.back(), stamp_ns);
    stamps_ns.push_back(stamp_ns);
  }
  return stamps_ns;
}

std::optional<fs::path> find_kitti_times(const fs::path& poses) {
  const auto folder = fs::weakly_canonical(poses).parent_path(), sequence = poses.stem();
  return first_existing({folder / "times.txt", folder / ".." / sequence / "times.txt",
                         folder / ".." / "sequences" / sequence / "times.txt"});
}

}  // namespace panvo::dataset_player
