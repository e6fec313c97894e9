// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "panvo/landmarks/panoramic_landmark.hpp"

namespace panvo::stereo_places {

/// SIFT-like descriptors: most values small, few large, length 512.
inline std::array<std::uint8_t, 128> made_up_descriptor(std::mt19937_64& random) {
  std::array<double, 128> values{};
  double squares = 0.0;
  for (auto& value : values) {
    value = std::pow(static_cast<double>(random() % 1000) / 1000.0, 3.0);
    squares += value * value;
  }
  std::array<std::uint8_t, 128> descriptor{};
  std::transform(values.begin(), values.end(), descriptor.begin(), [&](double value) {
    return static_cast<std::uint8_t>(std::min(255.0, 512.0 * value / std::sqrt(squares)));
  });
  return descriptor;
}

/// Points 5 to 30 m ahead, within 60 degrees across, in the frame of the camera (X right, Y down, Z forward).
inline std::vector<landmarks::Keypoint> made_up_place(unsigned seed, int count = 120) {
  std::mt19937_64 random(seed);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() % 100'000) / 100'000.0;
  };
  std::vector<landmarks::Keypoint> place;
  for (int i = 0; i < count; ++i) {
    landmarks::Keypoint keypoint;
    const double depth = uniform(5.0, 30.0);
    const Eigen::Vector3d point{depth * uniform(-0.57, 0.57), depth * uniform(-0.3, 0.2), depth};
    keypoint.point_in_panorama = point.cast<float>();
    keypoint.bearing = point.normalized().cast<float>();
    keypoint.has_point = true;
    keypoint.inverse_range_sigma = 0.002F;
    keypoint.descriptor = made_up_descriptor(random);
    place.push_back(keypoint);
  }
  return place;
}

/// The same points seen from another pose, with noise of the descriptors.
inline std::vector<landmarks::Keypoint> seen_from(std::vector<landmarks::Keypoint> place,
                                                  const Eigen::Isometry3d& place_from_view, unsigned seed = 99) {
  std::mt19937_64 random(seed);
  for (auto& keypoint : place) {
    const Eigen::Vector3d seen = place_from_view.inverse() * keypoint.point_in_panorama.cast<double>();
    keypoint.bearing = seen.normalized().cast<float>();
    keypoint.has_point = false;
    for (auto& value : keypoint.descriptor) {
      value =
          static_cast<std::uint8_t>(std::clamp(static_cast<int>(value) + static_cast<int>(random() % 21) - 10, 0, 255));
    }
  }
  return place;
}

/// A camera that drove `ahead_m` and turned left.
inline Eigen::Isometry3d moved(double ahead_m, double left_rad = 0.0, double right_m = 0.0) {
  Eigen::Isometry3d pose(Eigen::AngleAxisd(-left_rad, Eigen::Vector3d::UnitY()));
  pose.translation() << right_m, 0.0, ahead_m;
  return pose;
}

}  // namespace panvo::stereo_places
