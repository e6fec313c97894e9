// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "panvo/calibration/board_painting.hpp"
#include "panvo/vision/camera_model.hpp"

namespace panvo::calibration::test {

/// Renders images of a board: each pixel is the mean of 4 x 4 rays, followed by lens blur and noise.
class BoardRenderer {
 public:
  BoardRenderer(const Board& board, const vision::LensCamera& lens)
      : board_(board), size_(lens.pinhole.width, lens.pinhole.height) {
    paint_texture();
    const vision::CameraModel model(lens);
    for (int v = 0; v <= size_.height; ++v) {
      for (int u = 0; u <= size_.width; ++u)
        rays_.push_back(model.unproject({u - 0.5, v - 0.5}).value_or(Eigen::Vector3d::Zero()));
    }
  }

  cv::Mat render(const Eigen::Isometry3d& camera_from_board, unsigned seed, double noise = 2.0) const {
    Eigen::Matrix3d camera_from_plane;
    camera_from_plane << camera_from_board.linear().leftCols<2>(), camera_from_board.translation();
    const Eigen::Matrix3d plane_from_camera = camera_from_plane.inverse();
    cv::Mat picture(size_, CV_32F);
    for (int v = 0; v < size_.height; ++v) {
      for (int u = 0; u < size_.width; ++u) picture.at<float>(v, u) = pixel(plane_from_camera, u, v);
    }
    cv::GaussianBlur(picture, picture, {0, 0}, kBlur_px);
    cv::Mat grain(size_, CV_32F);
    cv::RNG random(seed + 1);
    random.fill(grain, cv::RNG::NORMAL, 0.0, noise);
    cv::Mat grey;
    cv::Mat(picture + grain).convertTo(grey, CV_8U);
    return grey;
  }

 private:
  static constexpr int kCells = 64;  // texture pixels along a square's side
  static constexpr int kSamples = 4;
  static constexpr double kBlur_px = 0.6;
  static constexpr float kBackground = 110.0F;

  void paint_texture() {
    texture_ = cv::Mat(kCells * (board_.rows + 3), kCells * (board_.columns + 3), CV_8U, cv::Scalar(225));
    const double cells_per_m = kCells / board_.square_m;
    for (const auto& [area, is_black] : paint(board_)) {
      const auto cell = [&](double at_m) { return static_cast<int>(std::lround(cells_per_m * at_m)) + 2 * kCells; };
      const cv::Point first(cell(area.x), cell(area.y));
      const cv::Point last(cell(area.x + area.width), cell(area.y + area.height));
      texture_(cv::Rect(first, last)).setTo(is_black ? 25 : 225);
    }
  }

  float pixel(const Eigen::Matrix3d& plane_from_camera, int u, int v) const {
    const auto* upper = &rays_[static_cast<std::size_t>(v * (size_.width + 1) + u)];
    const auto* lower = upper + size_.width + 1;
    if (upper[0].isZero() || upper[1].isZero() || lower[0].isZero() || lower[1].isZero()) return 0.0F;
    float sum = 0.0F;
    for (int row = 0; row < kSamples; ++row) {
      const double down = (row + 0.5) / kSamples;
      const Eigen::Vector3d left = plane_from_camera * (upper[0] + down * (lower[0] - upper[0]));
      const Eigen::Vector3d right = plane_from_camera * (upper[1] + down * (lower[1] - upper[1]));
      for (int column = 0; column < kSamples; ++column) sum += meet(left + (column + 0.5) / kSamples * (right - left));
    }
    return sum / (kSamples * kSamples);
  }

  /// Brightness at a homogeneous point `at` of the board plane; its third coordinate is positive in front of the
  /// camera.
  float meet(const Eigen::Vector3d& at) const {
    if (at.z() <= 0.0) return kBackground;
    const double cells_per_m = kCells / board_.square_m;
    const double x = cells_per_m * at.x() / at.z() + 2 * kCells;
    const double y = cells_per_m * at.y() / at.z() + 2 * kCells;
    if (!(x >= 0.0 && y >= 0.0 && x < texture_.cols && y < texture_.rows)) return kBackground;
    return texture_.at<uchar>(static_cast<int>(y), static_cast<int>(x));
  }

  Board board_;
  cv::Size size_;
  cv::Mat texture_;
  std::vector<Eigen::Vector3d> rays_;  ///< through the pixel corners; zero outside the lens model's domain
};

}  // namespace panvo::calibration::test
