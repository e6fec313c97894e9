// SPDX-License-Identifier: Apache-2.0
#include "panvo/calibration/planar_pose.hpp"

#include <Eigen/Eigenvalues>

#include "panvo/vision/pose.hpp"

namespace panvo::calibration {
namespace {

using Matrix9d = Eigen::Matrix<double, 9, 9>;

constexpr double kOneSolution =
    1e-10;  // least ratio of the second smallest to the largest eigenvalue; lower for collinear corners

}  // namespace

std::optional<Eigen::Isometry3d> planar_pose(const std::vector<Corner>& corners,
                                             const std::vector<Eigen::Vector3d>& board_points,
                                             const Unproject& unproject) {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double size = 0.0;
  for (const auto& corner : corners) centre += board_points[static_cast<std::size_t>(corner.id)].head<2>();
  centre /= static_cast<double>(std::max<std::size_t>(corners.size(), 1));
  for (const auto& corner : corners)
    size = std::max(size, (board_points[static_cast<std::size_t>(corner.id)].head<2>() - centre).norm());

  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> pairs;  // bearing and normalised board position
  Matrix9d normal = Matrix9d::Zero();
  for (const auto& corner : corners) {
    const auto direction = unproject(corner.pixel);
    if (!direction) continue;
    const Eigen::Vector2d place = (board_points[static_cast<std::size_t>(corner.id)].head<2>() - centre) / size;
    pairs.emplace_back(direction->normalized(), place.homogeneous());
    const Eigen::Matrix3d cross = vision::skew(pairs.back().first);
    Eigen::Matrix<double, 3, 9> rows;
    rows << place.x() * cross, place.y() * cross, cross;
    normal += rows.transpose() * rows;
  }
  if (pairs.size() < 4) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Matrix9d> solver(normal);
  if (!(solver.eigenvalues()[1] > kOneSolution * solver.eigenvalues()[8])) return std::nullopt;
  Eigen::Matrix3d columns = Eigen::Map<const Eigen::Matrix3d>(solver.eigenvectors().col(0).data());
  columns /= std::sqrt(columns.col(0).norm() * columns.col(1).norm());

  double ahead = 0.0;
  for (const auto& [direction, place] : pairs) ahead += direction.dot(columns * place);
  if (ahead < 0.0) columns = -columns;
  Eigen::Matrix3d axes;
  axes << columns.col(0), columns.col(1), columns.col(0).cross(columns.col(1));
  Eigen::Isometry3d camera_from_board = Eigen::Isometry3d::Identity();
  camera_from_board.linear() = vision::nearest_rotation(axes);
  const Eigen::Vector3d of_centre = size * columns.col(2);
  camera_from_board.translation() = of_centre - camera_from_board.linear() * Eigen::Vector3d(centre.x(), centre.y(), 0);
  if (!camera_from_board.matrix().allFinite()) return std::nullopt;
  return camera_from_board;
}

}  // namespace panvo::calibration
