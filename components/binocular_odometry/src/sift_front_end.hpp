// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/features2d.hpp>

#include "front_end.hpp"

namespace panvo::binocular_odometry {

/// SIFT features, as in the paper [Lu2015 3; Lowe 2004]: detected and described in each frame, and matched to the
/// tracks by descriptor within a radius of the expected position. Uses the half-size image, because OpenCV's detector
/// doubles its input.
class SiftFrontEnd final : public FrontEnd {
 public:
  explicit SiftFrontEnd(const TrackingParameters& parameters);

  void describe(const vision::ImagePyramid& image) override;
  std::optional<SearchStart> match(Track& track, const Eigen::Vector2d& expected_pixel) override;
  std::vector<Feature> detect(const vision::CellGrid& grid) override;

 private:
  cv::Ptr<cv::SIFT> detector_;
  double radius_px_ = 0.0;
  std::vector<Eigen::Vector2d> pixels_;  // features of this frame, full-size coordinates
  std::vector<float> responses_;
  cv::Mat descriptors_;
};

}  // namespace panvo::binocular_odometry
