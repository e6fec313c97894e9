// SPDX-License-Identifier: Apache-2.0
#include "stereo_pair.hpp"

#include "panvo/conversions/camera_info.hpp"
#include "panvo/vision/grey.hpp"

namespace panvo::python {

bool StereoPair::is_rectified() const {
  return conversions::is_rectified(conversions::left_camera(raw, rectified)) &&
         conversions::is_rectified(conversions::right_camera(raw, rectified));
}

Eigen::Isometry3d StereoPair::base_from_rectified_left() const {
  return base_from_left * Eigen::Isometry3d(rectified.rectified_left_from_left.transpose());
}

StereoRectifier::StereoRectifier(const StereoPair& pair) {
  const std::array cameras{conversions::left_camera(pair.raw, pair.rectified),
                           conversions::right_camera(pair.raw, pair.rectified)};
  for (std::size_t eye = 0; eye < cameras.size(); ++eye) {
    const auto& camera = cameras[eye];
    if (!conversions::is_rectified(camera)) maps_[eye].emplace(camera.raw, camera.rectified_from_raw, camera.rectified);
  }
}

std::pair<cv::Mat, cv::Mat> StereoRectifier::rectify(const cv::Mat& left, const cv::Mat& right) const {
  const auto of_eye = [](const std::optional<vision::RectificationMap>& map, const cv::Mat& image) {
    const cv::Mat grey = vision::to_grey(image);
    if (!map) return grey;
    cv::Mat rectified;
    map->apply(grey, rectified);
    return rectified;
  };
  return {of_eye(maps_[0], left), of_eye(maps_[1], right)};
}

}  // namespace panvo::python
