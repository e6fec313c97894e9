// SPDX-License-Identifier: Apache-2.0
#include "panvo/calibration/planar_pose.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <utility>

#include "panvo/vision/pose.hpp"

namespace panvo::calibration {
namespace {

using Matrix9d = Eigen::Matrix<double, 9, 9>;

constexpr double kOneSolution = 1e-10;  // least ratio of the second smallest to the largest eigenvalue
constexpr double kOnLine = 1e-6;        // relative area of the triangle below which three corners are collinear

/// Whether at most one corner is off some line: noise alone then chooses among many poses. Such a line passes through
/// two of any three corners.
bool are_on_line(const std::vector<Eigen::Vector3d>& places) {
  for (const auto& [a, b] : {std::pair(0, 1), std::pair(0, 2), std::pair(1, 2)}) {
    const Eigen::Vector3d line = places[static_cast<std::size_t>(a)].cross(places[static_cast<std::size_t>(b)]);
    const auto off = std::count_if(places.begin(), places.end(),
                                   [&](const Eigen::Vector3d& place) { return std::abs(line.dot(place)) > kOnLine; });
    if (off <= 1) return true;
  }
  return false;
}

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

  std::vector<Eigen::Vector3d> bearings, places;  // places: homogeneous, in units of `size` around the centre
  Matrix9d normal = Matrix9d::Zero();
  for (const auto& corner : corners) {
    const auto direction = unproject(corner.pixel);
    if (!direction) continue;
    const Eigen::Vector2d place = (board_points[static_cast<std::size_t>(corner.id)].head<2>() - centre) / size;
    bearings.push_back(direction->normalized());
    places.emplace_back(place.homogeneous());
    const Eigen::Matrix3d cross = vision::skew(bearings.back());
    Eigen::Matrix<double, 3, 9> rows;
    rows << place.x() * cross, place.y() * cross, cross;
    normal += rows.transpose() * rows;
  }
  if (places.size() < 4 || are_on_line(places)) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Matrix9d> solver(normal);
  if (!(solver.eigenvalues()[1] > kOneSolution * solver.eigenvalues()[8])) return std::nullopt;
  Eigen::Matrix3d columns = Eigen::Map<const Eigen::Matrix3d>(solver.eigenvectors().col(0).data());
  columns /= std::sqrt(columns.col(0).norm() * columns.col(1).norm());

  double ahead = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) ahead += bearings[i].dot(columns * places[i]);
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
