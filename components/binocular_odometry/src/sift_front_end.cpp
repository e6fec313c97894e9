// SPDX-License-Identifier: Apache-2.0
#include "sift_front_end.hpp"

#include <limits>
#include <map>

namespace panvo::binocular_odometry {
namespace {

constexpr int kLayers = 2;           // scales per octave; Lowe's 3 cost a quarter more without benefit here
constexpr double kContrast = 0.02;   // half of Lowe's value, for low-contrast roads
constexpr double kRadius = 0.12;     // of the image width: an unpredicted turn of about 10 degrees
constexpr float kMaxRatio2 = 0.64F;  // Lowe's ratio of 0.8, squared
constexpr float kMaxDistance2 = 300.0F * 300.0F;  // for descriptors of length 512

float squared_distance(const cv::Mat& a, const cv::Mat& b, int row) {
  return static_cast<float>(cv::norm(a, b.row(row), cv::NORM_L2SQR));
}

}  // namespace

SiftFrontEnd::SiftFrontEnd(const TrackingParameters& parameters)
    : detector_(cv::SIFT::create(parameters.max_features, kLayers, kContrast)) {}

void SiftFrontEnd::describe(const vision::ImagePyramid& image) {
  const int level = std::min(1, image.levels() - 1);
  const double scale = 1 << level;
  std::vector<cv::KeyPoint> keypoints;
  detector_->detectAndCompute(image[level], cv::noArray(), keypoints, descriptors_);
  radius_px_ = kRadius * image[0].cols;
  pixels_.clear();
  responses_.clear();
  for (const auto& keypoint : keypoints) {
    pixels_.emplace_back(scale * keypoint.pt.x, scale * keypoint.pt.y);
    responses_.push_back(keypoint.response);
  }
}

std::optional<SearchStart> SiftFrontEnd::match(Track& track, const Eigen::Vector2d& expected_pixel) {
  if (track.descriptor.empty()) return std::nullopt;
  float best = std::numeric_limits<float>::max(), second = best;
  size_t found = 0;
  for (size_t i = 0; i < pixels_.size(); ++i) {
    if ((pixels_[i] - expected_pixel).squaredNorm() > radius_px_ * radius_px_) continue;
    const float distance = squared_distance(track.descriptor, descriptors_, static_cast<int>(i));
    // A keypoint with two orientations has two descriptors, which do not compete.
    const bool same_place =
        best < std::numeric_limits<float>::max() && (pixels_[i] - pixels_[found]).squaredNorm() < 4.0;
    if (distance < best) {
      if (!same_place) second = best;
      best = distance;
      found = i;
    } else if (distance < second && !same_place) {
      second = distance;
    }
  }
  if (best > kMaxDistance2 || best > kMaxRatio2 * second) return std::nullopt;
  track.descriptor = descriptors_.row(static_cast<int>(found)).clone();
  return SearchStart{pixels_[found], 1};
}

std::vector<Feature> SiftFrontEnd::detect(const vision::CellGrid& grid) {
  std::map<size_t, size_t> strongest;  // of each cell
  for (size_t i = 0; i < pixels_.size(); ++i) {
    if (!grid.is_free(pixels_[i])) continue;
    const auto [entry, is_new] = strongest.try_emplace(grid.cell(pixels_[i]), i);
    if (!is_new && responses_[i] > responses_[entry->second]) entry->second = i;
  }
  std::vector<Feature> features;
  for (const auto& [cell, i] : strongest) {
    features.push_back({pixels_[i], descriptors_.row(static_cast<int>(i)).clone()});
  }
  return features;
}

}  // namespace panvo::binocular_odometry
