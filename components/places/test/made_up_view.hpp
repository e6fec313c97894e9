// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "panvo/landmarks/panoramic_landmark.hpp"
#include "panvo/vision/angle.hpp"
#include "panvo/vision/pose.hpp"

namespace panvo::places::test {

/// Things around a place, each with a look of its own, and their views.
class MadeUpScene {
 public:
  explicit MadeUpScene(std::uint64_t seed) : random_(seed) {}

  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11U) * 0x1p-53;
  }

  /// Things between two azimuths, 2 to 12 m away, up to 30 degrees above or below the horizon.
  void add_things(int count, double from_deg = -180.0, double to_deg = 180.0) {
    for (int i = 0; i < count; ++i) {
      const double azimuth = uniform(from_deg, to_deg) * vision::kDegree, range_m = uniform(2.0, 12.0);
      const double elevation = uniform(-30.0, 30.0) * vision::kDegree;
      points_.push_back(range_m * Eigen::Vector3d(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                                                  std::cos(elevation) * std::cos(azimuth)));
      looks_.push_back(new_look());
    }
  }

  /// Clouds: so far that they are at the same bearings everywhere.
  void add_clouds(int count) {
    for (int i = 0; i < count; ++i) {
      const double azimuth = uniform(-std::numbers::pi, std::numbers::pi),
                   elevation = uniform(12.0, 50.0) * vision::kDegree;
      points_.push_back(1e6 * Eigen::Vector3d(std::cos(elevation) * std::sin(azimuth), -std::sin(elevation),
                                              std::cos(elevation) * std::cos(azimuth)));
      looks_.push_back(new_look());
    }
  }

  /// Parts of the vehicle all round, more than 20 degrees below the horizon; to be viewed from the origin.
  void add_vehicle(int count) {
    for (int i = 0; i < count; ++i) {
      const double azimuth = uniform(-std::numbers::pi, std::numbers::pi);
      const double elevation = uniform(22.0, 40.0) * vision::kDegree;
      points_.emplace_back(std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                           std::cos(elevation) * std::cos(azimuth));
      looks_.push_back(new_look());
    }
  }

  /// Keypoints from a position, with noise of the bearings.
  std::vector<landmarks::Keypoint> view(const Eigen::Isometry3d& place_from_view, double noise_deg = 0.2) {
    std::vector<landmarks::Keypoint> keypoints;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      keypoints.push_back(keypoint(place_from_view.inverse() * points_[i], looks_[i], noise_deg));
    }
    return keypoints;
  }

  /// As many keypoints that nothing else looks like.
  std::vector<landmarks::Keypoint> others(int count) {
    MadeUpScene scene(random_());
    scene.add_things(count);
    return scene.view(Eigen::Isometry3d::Identity());
  }

  landmarks::Keypoint keypoint(const Eigen::Vector3d& point, const std::array<std::uint8_t, 128>& look,
                               double noise_deg) {
    landmarks::Keypoint keypoint;
    const auto noise = [&] { return noise_deg * vision::kDegree * uniform(-1.7, 1.7); };
    keypoint.bearing = (point.normalized() + Eigen::Vector3d{noise(), noise(), noise()}).normalized().cast<float>();
    keypoint.descriptor = look;
    for (auto& value : keypoint.descriptor) value = static_cast<std::uint8_t>(value + random_() % 8);
    return keypoint;
  }

  std::array<std::uint8_t, 128> new_look() {
    std::array<std::uint8_t, 128> look{};
    for (auto& value : look) value = static_cast<std::uint8_t>(random_() % 120);
    return look;
  }

 private:
  std::mt19937_64 random_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<std::array<std::uint8_t, 128>> looks_;
};

/// place_from_view after a turn to the left, a tilt about the axis to the right, and a step to (x right, z ahead).
inline Eigen::Isometry3d moved(double heading_deg, double tilt_deg, double x_m, double z_m) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = vision::so3_exp(Eigen::Vector3d(0.0, -heading_deg * vision::kDegree, 0.0)) *
                  vision::so3_exp(Eigen::Vector3d(tilt_deg * vision::kDegree, 0.0, 0.0));
  pose.translation() = Eigen::Vector3d(x_m, 0.0, z_m);
  return pose;
}

inline std::vector<landmarks::Keypoint> joined(std::vector<landmarks::Keypoint> a,
                                               const std::vector<landmarks::Keypoint>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace panvo::places::test
