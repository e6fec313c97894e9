// SPDX-License-Identifier: Apache-2.0
#include "panvo/calibration/board_look.hpp"

#include <Eigen/LU>
#include <cmath>

namespace panvo::calibration {
namespace {

constexpr double kOneLine = 1e-6;  // squared ratio of the corners' spread across and along their principal line

constexpr double kSizeWeight = 0.4;  // 1.5 times the distance counts like a shift by a sixth of the image

}  // namespace

std::optional<BoardLook> look_of(const std::vector<Corner>& corners, const Board& board, const cv::Size& image_size) {
  if (corners.size() < 3) return std::nullopt;
  const auto count = static_cast<double>(corners.size());
  Eigen::Vector2d middle_m = Eigen::Vector2d::Zero(), middle_px = Eigen::Vector2d::Zero();
  for (const auto& corner : corners) {
    middle_m += board.point(corner.id).head<2>() / count;
    middle_px += corner.pixel / count;
  }
  Eigen::Matrix2d on_board = Eigen::Matrix2d::Zero(), image_by_board = Eigen::Matrix2d::Zero();
  for (const auto& corner : corners) {
    const Eigen::Vector2d at_m = board.point(corner.id).head<2>() - middle_m;
    on_board += at_m * at_m.transpose();
    image_by_board += (corner.pixel - middle_px) * at_m.transpose();
  }
  if (!(on_board.determinant() > kOneLine * on_board.trace() * on_board.trace())) return std::nullopt;
  const Eigen::Matrix2d image_from_board = image_by_board * on_board.inverse();  // px/m
  const Eigen::Matrix2d spread = image_from_board * image_from_board.transpose();
  if (!(std::abs(image_from_board.determinant()) > 0.0)) return std::nullopt;
  const double board_m2 = (board.columns + 1) * (board.rows + 1) * board.square_m * board.square_m;
  BoardLook look;
  look.middle = middle_px.cwiseQuotient(Eigen::Vector2d(image_size.width, image_size.height));
  look.size = std::sqrt(std::abs(image_from_board.determinant()) * board_m2 / image_size.area());
  look.slant = Eigen::Vector2d(spread(0, 0) - spread(1, 1), 2.0 * spread(0, 1)) / spread.trace();
  return look;
}

double difference(const BoardLook& a, const BoardLook& b) {
  return (a.middle - b.middle).lpNorm<1>() + kSizeWeight * std::abs(std::log(a.size / b.size)) +
         (a.slant - b.slant).norm();
}

}  // namespace panvo::calibration
