// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "panvo/all_round_odometry/panorama_points.hpp"
#include "panvo/vision/pose.hpp"

/// A park of points, through which a vehicle drives in a bend at 5 m/s, seen by an ideal tracker with noise.
namespace panvo::all_round_odometry {

inline const Eigen::Vector3d kCamera(-0.3, 0.1, 2.0);  // on the vehicle
inline constexpr double kRadius_m = 50.0;              // of the bend
inline constexpr double kSwerve_rad = 0.2;             // of the heading, to and fro
inline constexpr double kSwerve = 0.4;                 // rad per panorama
inline constexpr std::int64_t kInterval_ns = 200'000'000;

class Park {
 public:
  explicit Park(unsigned seed = 1, double noise_rad = 6e-4) : random_(seed), noise_rad_(noise_rad) {
    std::uniform_real_distribution<double> x(-60.0, 100.0), y(-60.0, 120.0), height(0.0, 12.0);
    while (points_.size() < 4000) {
      const Eigen::Vector3d point(x(random_), y(random_), height(random_));
      if (std::abs((point.head<2>() - Eigen::Vector2d(0.0, kRadius_m)).norm() - kRadius_m) > 5.0)
        points_.push_back(point);
    }
  }

  /// Pose of the vehicle after a number of panoramas.
  static Eigen::Isometry3d vehicle(double panorama) {
    const double yaw_rad = panorama / kRadius_m;
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = vision::so3_exp({0.0, 0.0, yaw_rad + kSwerve_rad * (1.0 - std::cos(kSwerve * panorama))});
    pose.translation() = kRadius_m * Eigen::Vector3d(std::sin(yaw_rad), 1.0 - std::cos(yaw_rad), 0.0);  // 1 m each
    return pose;
  }

  static std::int64_t stamp_ns(int panorama) { return 1'000'000'000 + panorama * kInterval_ns; }

  /// What panorama `now` shows of the points of the given earlier ones, the reference first. Up to `per_reference` of
  /// those within 40 m.
  PanoramaPoints seen(int now, const std::vector<int>& references, std::size_t per_reference = 100) {
    PanoramaPoints seen;
    seen.stamp_ns = stamp_ns(now);
    const Eigen::Isometry3d camera = vehicle(now) * Eigen::Translation3d(kCamera);
    seen.now_from_then = vehicle(now).linear().transpose() * vehicle(references.front()).linear();
    for (const int reference : references) {
      PointTracks& tracks = seen.tracks.emplace_back();
      tracks.from_ns = stamp_ns(reference);
      const Eigen::Isometry3d then = vehicle(reference) * Eigen::Translation3d(kCamera);
      for (std::size_t i = 0; i < points_.size() && tracks.sightings.size() < per_reference; ++i) {
        const Eigen::Vector3d in_then = then.inverse() * points_[i], in_now = camera.inverse() * points_[i];
        if (in_then.norm() > 40.0) continue;
        tracks.sightings.push_back({static_cast<int>(i), in_then.normalized(), noisy(in_now.normalized()),
                                    Eigen::Vector2d::Constant(noise_rad_ * noise_rad_)});
      }
    }
    return seen;
  }

  /// References as a compass chooses them: a new one every third panorama, and two before that.
  static std::vector<int> references(int now) {
    const int latest = (now - 1) / 3 * 3;
    std::vector<int> references;
    for (int reference = latest; reference >= std::max(0, latest - 6); reference -= 3) references.push_back(reference);
    return references;
  }

 private:
  Eigen::Vector3d noisy(const Eigen::Vector3d& bearing) {
    std::normal_distribution<double> noise(0.0, noise_rad_);
    return (bearing + Eigen::Vector3d{noise(random_), noise(random_), noise(random_)}).normalized();
  }

  std::mt19937 random_;
  const double noise_rad_;
  std::vector<Eigen::Vector3d> points_;
};

}  // namespace panvo::all_round_odometry
