// SPDX-License-Identifier: Apache-2.0
#include "panvo/vision/rectification.hpp"

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <sstream>
#include <stdexcept>

namespace panvo::vision {

RectificationMap::RectificationMap(const DistortedCamera& raw, const Eigen::Matrix3d& rectified_from_raw,
                                   const PinholeCamera& rectified)
    : raw_size_(raw.pinhole.width, raw.pinhole.height) {
  const auto matrix = [](const PinholeCamera& camera) {
    return cv::Matx33d(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  };
  const auto& r = rectified_from_raw;
  const cv::Matx33d rotation(r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1), r(2, 2));
  const cv::Matx<double, 1, 5> distortion(raw.distortion.data());
  cv::initUndistortRectifyMap(matrix(raw.pinhole), distortion, rotation, matrix(rectified),
                              {rectified.width, rectified.height}, CV_16SC2, coordinates_, fractions_);
}

void RectificationMap::apply(const cv::Mat& raw_image, cv::Mat& destination) const {
  if (raw_image.size() != raw_size_) {
    std::ostringstream text;
    text << "image of " << raw_image.cols << " x " << raw_image.rows << " px given to a rectification map of a "
         << raw_size_.width << " x " << raw_size_.height << " px camera";
    throw std::invalid_argument(text.str());
  }
  cv::remap(raw_image, destination, coordinates_, fractions_, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
}

}  // namespace panvo::vision
