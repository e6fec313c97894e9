// SPDX-License-Identifier: Apache-2.0
#include "panvo/calibration_files/rigid_transform.hpp"

#include "panvo/vision/pose.hpp"

namespace panvo::calibration_files {
namespace {

constexpr double kRotationTolerance = 1e-3;  // files may hold few digits

bool is_rigid(const Eigen::Matrix4d& matrix) {
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();
  return (rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm() <= kRotationTolerance &&
         rotation.determinant() > 0.0 && (matrix.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).norm() <= 1e-9;
}

}  // namespace

Eigen::Matrix4d read_rigid_matrix(YamlMap& map, const std::string& key) {
  const std::size_t problems = map.problems();
  const auto values = map.numbers(key, 16);
  Eigen::Matrix4d matrix = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(values.data());
  if (is_rigid(matrix)) return matrix;
  if (map.problems() == problems) map.reject(key, "is not a rigid transform; give the 4 x 4 matrix row by row");
  return Eigen::Matrix4d::Identity();
}

Eigen::Isometry3d read_rigid_transform(YamlMap& map, const std::string& key) {
  const Eigen::Matrix4d matrix = read_rigid_matrix(map, key);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = vision::nearest_rotation(matrix.topLeftCorner<3, 3>());
  pose.translation() = matrix.topRightCorner<3, 1>();
  return pose;
}

}  // namespace panvo::calibration_files
