// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "panvo/vision/camera.hpp"

namespace panvo::stereo_places {

/// Draws views as partial panoramas, for display: the image in the middle of an equirectangular 540x270, black around it.
class ViewPicture {
 public:
  explicit ViewPicture(const vision::PinholeCamera& camera);

  /// JPEG of a view (CV_8UC1, of the camera's size).
  std::vector<std::uint8_t> draw(const cv::Mat& left) const;

 private:
  cv::Mat columns_, rows_;  // of the view, per pixel of the picture
};

/// Share of the pixels per grey level, 64 bins, sum 1.
std::vector<float> grey_levels(const cv::Mat& left);

}  // namespace panvo::stereo_places
