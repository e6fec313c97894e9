// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmarks/panorama_level.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "panvo/vision/angle.hpp"
#include "panvo/vision/equirectangular.hpp"
#include "panvo/vision/panorama_tilt.hpp"

namespace panvo::landmarks {
namespace {

// Keypoints and features bear it: between opposite headings it is twice as much.
constexpr double kLevel_rad = 2.0 * vision::kDegree;

/// Axes of an upright camera (x right, y down, z forward) in the vehicle's (x forward, y left, z up), that looks as far
/// to the left as one with that rotation.
Eigen::Matrix3d upright(const Eigen::Matrix3d& base_from_panorama) {
  Eigen::Vector3d forward = base_from_panorama.col(2);
  forward.z() = 0.0;
  forward.normalize();
  Eigen::Matrix3d axes;
  axes << forward.cross(Eigen::Vector3d::UnitZ()), -Eigen::Vector3d::UnitZ(), forward;
  return axes;
}

bool is_tilted(const Eigen::Matrix3d& base_from_panorama) {
  const double tilt_rad = std::acos(std::clamp(-base_from_panorama(2, 1), -1.0, 1.0));
  return tilt_rad > kLevel_rad && vision::tilt_of_panorama(base_from_panorama) != vision::PanoramaTilt::kOnItsSide;
}

}  // namespace

PanoramaLevel::PanoramaLevel(const Eigen::Isometry3d& base_from_panorama)
    : PanoramaLevel(base_from_panorama, landmarks::is_tilted(base_from_panorama.linear())) {}

PanoramaLevel::PanoramaLevel(const Eigen::Isometry3d& base_from_panorama, bool is_tilted)
    : base_from_panorama_(base_from_panorama), base_from_level_(base_from_panorama), is_tilted_(is_tilted) {
  if (is_tilted) base_from_level_.linear() = upright(base_from_panorama.linear());
}

Eigen::Matrix3d PanoramaLevel::panorama_from_level() const {
  return base_from_panorama_.linear().transpose() * base_from_level_.linear();
}

cv::Mat PanoramaLevel::level(const cv::Mat& panorama) { return levelled(panorama, cv::INTER_LINEAR); }

cv::Mat PanoramaLevel::level_mask(const cv::Mat& mask) { return levelled(mask, cv::INTER_NEAREST); }

cv::Mat PanoramaLevel::levelled(const cv::Mat& panorama, int interpolation) {
  if (!is_tilted_ || panorama.empty()) return panorama;
  if (columns_.size() != panorama.size()) {
    const vision::Equirectangular sphere{panorama.cols, panorama.rows};
    const Eigen::Matrix3d rotation = panorama_from_level();
    columns_.create(panorama.size(), CV_32FC1);
    rows_.create(panorama.size(), CV_32FC1);
    for (int row = 0; row < panorama.rows; ++row) {
      for (int column = 0; column < panorama.cols; ++column) {
        const auto pixel = sphere.project(rotation * sphere.unproject({column, row}));
        columns_.at<float>(row, column) = static_cast<float>(pixel.x());
        rows_.at<float>(row, column) = static_cast<float>(pixel.y());
      }
    }
  }
  cv::Mat level;
  cv::remap(panorama, level, columns_, rows_, interpolation, cv::BORDER_WRAP);
  return level;
}

}  // namespace panvo::landmarks
