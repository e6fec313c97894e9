// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmark_builder/ground_projection.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "panvo/vision/equirectangular.hpp"

namespace panvo::landmark_builder {

GroundProjection::GroundProjection(const GroundProjectionParameters& parameters,
                                   const Eigen::Isometry3d& base_from_panorama, cv::Size panorama_size)
    : size_(panorama_size),
      camera_(base_from_panorama.translation().head<2>()),
      camera_height_m_(base_from_panorama.translation().z() - parameters.ground_height_m) {
  if (panorama_size.width <= 0 || panorama_size.width != 2 * panorama_size.height) {
    throw std::invalid_argument("ground projection: the panorama of " + std::to_string(panorama_size.width) + " x " +
                                std::to_string(panorama_size.height) + " px is not twice as wide as high");
  }
  if (!(camera_height_m_ > 0.0)) {
    throw std::invalid_argument("ground projection: the panoramic camera is " + std::to_string(camera_height_m_) +
                                " m above the ground; the height must be positive");
  }
  grid_.resolution_m = parameters.resolution_m;
  grid_.side = 2 * static_cast<int>(std::lround(parameters.radius_m / parameters.resolution_m)) + 1;
  const vision::Equirectangular equirectangular{size_.width, size_.height};
  const Eigen::Isometry3d panorama_from_base = base_from_panorama.inverse();
  cv::Mat places(grid_.side, grid_.side, CV_32FC2);
  for (int row = 0; row < grid_.side; ++row) {
    for (int column = 0; column < grid_.side; ++column) {
      const Eigen::Vector2d point = grid_.point({column, row});
      const Eigen::Vector3d in_panorama =
          panorama_from_base * Eigen::Vector3d(point.x(), point.y(), parameters.ground_height_m);
      const Eigen::Vector2d pixel = equirectangular.project(in_panorama);
      places.at<cv::Vec2f>(row, column) = {static_cast<float>(pixel.x()), static_cast<float>(pixel.y())};
    }
  }
  cv::convertMaps(places, cv::noArray(), places_, fractions_, CV_16SC2);
}

cv::Mat GroundProjection::project(const cv::Mat& panorama) const {
  if (panorama.size() != size_ || (panorama.type() != CV_8UC1 && panorama.type() != CV_8UC3)) {
    throw std::invalid_argument("ground projection: the panorama has another size or type than configured");
  }
  cv::Mat view;
  cv::remap(panorama, view, places_, fractions_, cv::INTER_LINEAR, cv::BORDER_WRAP);
  return view;
}

}  // namespace panvo::landmark_builder
