// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/imgproc.hpp>
#include <vector>

#include "made_up_maps.hpp"
#include "panvo/landmarks/keypoints.hpp"
#include "panvo/landmarks/panorama_describer.hpp"

namespace panvo::fleet {

/// A road along x with a place every ten metres, each with a painted panorama. All points are 20 m away.
class PaintedRoad {
 public:
  explicit PaintedRoad(int places) {
    for (int i = 0; i < places; ++i) panoramas_.push_back(paint(static_cast<std::uint64_t>(i) + 1));
  }

  static Eigen::Isometry3d world_from_base(int place) { return flat(10.0 * place, 0.0, 0.0); }
  /// Panorama frame: x right, y down, z forward; base: x forward, y left, z up.
  static Eigen::Isometry3d base_from_panorama() {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
    return pose;
  }
  const cv::Mat& panorama(int place) const { return panoramas_[static_cast<std::size_t>(place)]; }

  landmarks::PanoramicLandmark landmark(int place, std::uint32_t id, const Eigen::Isometry3d& map_from_world,
                                        const landmarks::PanoramaDescriber& describer) const {
    landmarks::PanoramicLandmark landmark;
    landmark.id = id;
    landmark.stamp_ns = 1'000'000'000LL * id;
    landmark.map_from_base = map_from_world * world_from_base(place);
    landmark.covariance = covariance_of(0.02, 0.001);
    landmark.base_from_panorama = base_from_panorama();
    landmark.description = describer.describe(panorama(place));
    landmark.keypoints = landmarks::detect_keypoints(panorama(place), {});
    for (auto& keypoint : landmark.keypoints) {
      keypoint.has_point = true;
      keypoint.point_in_panorama = 20.0F * keypoint.bearing;
      keypoint.inverse_range_sigma = 0.001F;
    }
    return landmark;
  }

 private:
  static cv::Mat paint(std::uint64_t seed) {
    cv::RNG random(seed);
    cv::Mat panorama(540, 1080, CV_8UC1, cv::Scalar(110));
    for (int i = 0; i < 900; ++i) {
      const cv::Rect box{random.uniform(0, 1030), random.uniform(120, 340), random.uniform(4, 54),
                         random.uniform(4, 44)};
      cv::rectangle(panorama, box, cv::Scalar(random.uniform(20, 230)), cv::FILLED);
    }
    return panorama;
  }

  std::vector<cv::Mat> panoramas_;
};

}  // namespace panvo::fleet
