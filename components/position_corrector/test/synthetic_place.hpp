// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <opencv2/imgproc.hpp>
#include <random>

#include "panvo/landmarks/keypoints.hpp"
#include "panvo/landmarks/panorama_describer.hpp"

namespace panvo::position_corrector {

inline constexpr int kColumns = 1080;
inline constexpr int kRows = 540;

/// A seamless random panorama, different for each seed.
inline cv::Mat place(unsigned seed) {
  std::mt19937_64 random(seed);
  cv::Mat panorama(kRows, kColumns, CV_8UC1, cv::Scalar(110));
  for (int i = 0; i < 900; ++i) {
    const int width = 4 + static_cast<int>(random() % 50);
    const int height = 4 + static_cast<int>(random() % 40);
    const cv::Rect box{static_cast<int>(random() % kColumns), 120 + static_cast<int>(random() % 220), width, height};
    const cv::Scalar grey(static_cast<double>(20 + random() % 210));
    cv::rectangle(panorama, box, grey, cv::FILLED);
    cv::rectangle(panorama, box - cv::Point(kColumns, 0), grey, cv::FILLED);
  }
  return panorama;
}

/// The view after a left turn: everything moves to the right.
inline cv::Mat turned(const cv::Mat& panorama, int columns) {
  cv::Mat result(panorama.size(), panorama.type());
  for (int u = 0; u < kColumns; ++u) panorama.col(u).copyTo(result.col((u + columns) % kColumns));
  return result;
}

/// A landmark of a panorama with all points at a distance of 20 m.
inline landmarks::PanoramicLandmark landmark_of(const cv::Mat& panorama, const landmarks::PanoramaDescriber& describer,
                                                const Eigen::Vector3d& position) {
  landmarks::PanoramicLandmark landmark;
  landmark.map_from_base.translation() = position;
  landmark.description = describer.describe(panorama);
  landmark.keypoints = landmarks::detect_keypoints(panorama, {});
  for (auto& keypoint : landmark.keypoints) {
    keypoint.has_point = true;
    keypoint.point_in_panorama = 20.0F * keypoint.bearing;
    keypoint.inverse_range_sigma = 0.001F;
  }
  return landmark;
}

}  // namespace panvo::position_corrector
