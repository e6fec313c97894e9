// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "panvo/localizer/localizer.hpp"

namespace panvo::localizer {

inline constexpr std::int64_t kPeriod_ns = 200'000'000;
inline constexpr double kStep_m = 1.0;
inline constexpr double kSigma_m = 0.02;  // of odometry, per step
inline constexpr double kSigma_rad = 0.003;

/// Laps on a circle of 200 m, with drifting odometry.
class Drive {
 public:
  explicit Drive(unsigned seed) : random_(seed) { poses.push_back(now()); }

  OdometryPose now() const { return {static_cast<std::int64_t>(steps_) * kPeriod_ns, odom_, covariance_, true}; }

  /// `missed_rad`: rotation that odometry misses; `missed_m`: displacement to the left that it misses.
  OdometryPose step(double missed_rad = 0.0, double missed_m = 0.0) {
    ++steps_;
    Eigen::Isometry3d move = Eigen::Isometry3d::Identity();
    move.translation().x() = kStep_m;
    move.linear() = vision::so3_exp(Eigen::Vector3d(0.0, 0.0, 2.0 * M_PI / 200.0));
    const double yaw_before = yaw_rad;
    truth = truth * move;
    truth.linear() = truth.linear() * vision::so3_exp(Eigen::Vector3d(0.0, 0.0, missed_rad));
    truth.translation() += truth.linear() * Eigen::Vector3d(0.0, missed_m, 0.0);
    yaw_rad = yaw_before + 2.0 * M_PI / 200.0 + missed_rad;
    Eigen::Isometry3d measured = move;
    measured.translation() += kSigma_m * noise();
    measured.linear() = vision::so3_exp(kSigma_rad * noise()) * measured.linear();
    vision::Matrix6d gained = vision::Matrix6d::Identity();
    gained.topLeftCorner<3, 3>() *= kSigma_m * kSigma_m;
    gained.bottomRightCorner<3, 3>() *= kSigma_rad * kSigma_rad;
    covariance_ = vision::compose_covariance(odom_, covariance_, measured, gained);
    odom_ = odom_ * measured;
    poses.push_back(now());
    return now();
  }

  /// The turn since the last step, as measured by panoramas with the given error.
  AzimuthMeasurement azimuth(double turn_rad, double sigma_rad) const {
    return {now().stamp_ns - kPeriod_ns, now().stamp_ns, turn_rad, sigma_rad * sigma_rad};
  }

  LandmarkSighting sight(std::uint32_t id, const Eigen::Isometry3d& landmark, double sigma_m = 0.05) {
    LandmarkSighting sighting;
    sighting.stamp_ns = now().stamp_ns;
    sighting.landmark_id = id;
    sighting.landmark_from_base = landmark.inverse() * truth;
    sighting.landmark_from_base.translation() += sigma_m * noise();
    sighting.landmark_from_base.linear() = vision::so3_exp(0.002 * noise()) * sighting.landmark_from_base.linear();
    sighting.covariance.topLeftCorner<3, 3>() = sigma_m * sigma_m * Eigen::Matrix3d::Identity();
    sighting.covariance.bottomRightCorner<3, 3>() = 0.002 * 0.002 * Eigen::Matrix3d::Identity();
    return sighting;
  }

  double yaw_rad = 0.0;
  Eigen::Isometry3d truth = Eigen::Isometry3d::Identity();
  std::vector<OdometryPose> poses;

 private:
  Eigen::Vector3d noise() { return {normal_(random_), normal_(random_), normal_(random_)}; }

  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  int steps_ = 0;
  Eigen::Isometry3d odom_ = Eigen::Isometry3d::Identity();
  vision::Matrix6d covariance_ = vision::Matrix6d::Zero();
};

inline double nees_of(const LocalizedPose& pose, const Drive& drive) {
  const auto error = vision::pose_error(pose.map_from_base, drive.truth);
  return error.dot(pose.covariance.ldlt().solve(error)) / 6.0;
}

inline double error_m(const LocalizedPose& pose, const Drive& drive) {
  return (pose.map_from_base.translation() - drive.truth.translation()).norm();
}

/// The odometry of these drives has no scale error.
inline Parameters of_known_scale() {
  Parameters parameters;
  parameters.scale_sigma = 0.0;
  return parameters;
}

/// Drives a lap with a landmark at metre 20, and passes it again.
struct Round {
  explicit Round(unsigned seed, const Parameters& parameters = of_known_scale()) : drive(seed), localizer(parameters) {
    localizer.add(drive.now());
    for (int i = 0; i < 220; ++i) {
      localizer.add(drive.step());
      if (i == 19) {
        landmark = drive.truth;
        built = localizer.add_built(1, drive.now().stamp_ns);
      }
    }
  }

  Drive drive;
  Localizer localizer;
  Eigen::Isometry3d landmark;
  bool built = false;
};

}  // namespace panvo::localizer
