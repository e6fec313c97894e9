// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <string>

#include "panvo/landmarks/description_settings.hpp"
#include "panvo/landmarks/panoramic_landmark.hpp"

namespace panvo::landmarks::test {

/// Uniform in [0, 1), identical on all platforms.
inline double share(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

inline Eigen::Isometry3d made_up_pose(std::mt19937_64& random, double extent_m) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::Quaterniond{share(random) - 0.5, share(random), share(random), share(random)}
                      .normalized()
                      .toRotationMatrix();
  pose.translation() = extent_m * Eigen::Vector3d{share(random) - 0.5, share(random) - 0.5, 0.01 * share(random)};
  return pose;
}

/// A complete landmark derived from its id: 64 bins, 100 features per scale, `keypoints`, every second one with a
/// point.
inline PanoramicLandmark made_up_landmark(std::uint32_t id, std::size_t keypoints = 20, double extent_m = 1000.0) {
  std::mt19937_64 random(id);
  PanoramicLandmark landmark;
  landmark.id = id;
  landmark.stamp_ns = 1'700'000'000'000'000'000 + std::int64_t{id} * 10'000'000'001;
  landmark.map_from_base = made_up_pose(random, extent_m);
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column <= row; ++column) {
      landmark.covariance(row, column) = landmark.covariance(column, row) =
          row == column ? 1.0 + share(random) : 0.1 * share(random);
    }
  }
  landmark.base_from_panorama = made_up_pose(random, 1.0);
  landmark.is_junction = random() % 2 == 0;
  landmark.description.histogram.assign(64, 1.0f / 64.0f);
  for (auto* features : {&landmark.description.large, &landmark.description.small}) {
    for (int i = 0; i < 100; ++i) {
      features->push_back({static_cast<std::uint16_t>(random() % 400), static_cast<float>(share(random) - 0.5),
                           static_cast<float>(0.1 + share(random)), 1.0f - static_cast<float>(i) / 128.0f});
    }
  }
  for (std::size_t i = 0; i < keypoints; ++i) {
    Keypoint keypoint;
    keypoint.bearing =
        Eigen::Vector3d{share(random) - 0.5, 0.1 * share(random), share(random) - 0.5}.normalized().cast<float>();
    keypoint.size_px = static_cast<float>(2.0 + 10.0 * share(random));
    for (auto& byte : keypoint.descriptor) byte = static_cast<std::uint8_t>(random() >> 56);
    keypoint.has_point = i % 2 == 0;
    if (keypoint.has_point) {
      keypoint.point_in_panorama = keypoint.bearing * static_cast<float>(5.0 + 50.0 * share(random));
      keypoint.inverse_range_sigma = static_cast<float>(0.1 * share(random));
    }
    landmark.keypoints.push_back(keypoint);
  }
  landmark.thumbnail.resize(1000);
  for (auto& byte : landmark.thumbnail) byte = static_cast<std::uint8_t>(random() >> 56);
  return landmark;
}

/// Name of the first part in which two landmarks differ; empty if equal, with rotations up to rounding.
inline std::string difference(const PanoramicLandmark& a, const PanoramicLandmark& b, bool with_bulk = true) {
  const auto is_same_pose = [](const Eigen::Isometry3d& p, const Eigen::Isometry3d& q) {
    return p.translation() == q.translation() && (p.linear() - q.linear()).cwiseAbs().maxCoeff() < 1e-14;
  };
  if (a.id != b.id) return "id";
  if (a.stamp_ns != b.stamp_ns) return "stamp";
  if (!is_same_pose(a.map_from_base, b.map_from_base)) return "pose";
  if (a.covariance != b.covariance) return "covariance";
  if (!is_same_pose(a.base_from_panorama, b.base_from_panorama)) return "pose of the panorama";
  if (a.is_junction != b.is_junction) return "junction";
  if (!(a.description == b.description)) return "description";
  if (with_bulk && !(a.keypoints == b.keypoints)) return "keypoints";
  if (with_bulk && a.thumbnail != b.thumbnail) return "thumbnail";
  return "";
}

inline DescriptionSettings made_up_settings() { return {{"band_rows", "150"}, {"seed", "1"}}; }

/// The message of the exception thrown by `action`; "" if it throws none.
template <class Exception, class Action>
std::string error_of(Action action) {
  try {
    action();
  } catch (const Exception& error) {
    return error.what();
  }
  return "";
}

}  // namespace panvo::landmarks::test
