// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "panvo/all_round_odometry/all_round_odometry.hpp"
#include "park.hpp"

namespace panvo::all_round_odometry {

inline constexpr int kFrames = 5;  // stereo poses per panorama

/// A drive through the park; the stereo odometry is exact while it is reliable, and stands still while it is not.
class Drive : public ::testing::Test {
 protected:
  enum class Stereo { kGood, kBlind, kSilent, kDeceived };

  /// Panoramas `from` to `to`, each after the stereo poses up to it.
  void go(int from, int to, Stereo stereo, bool has_panoramas = true) {
    for (int now = from; now <= to; ++now) {
      for (int frame = 1; frame <= kFrames; ++frame) add_stereo(now - 1 + frame / static_cast<double>(kFrames), stereo);
      if (has_panoramas) odometry_.add(said(park_.seen(now, Park::references(now))), stereo == Stereo::kSilent);
      while (const auto pose = odometry_.next()) poses_.push_back(*pose);
    }
  }

  /// As the camera says it.
  PanoramaPoints said(PanoramaPoints panorama) const {
    panorama.stamp_ns += late_ns_;
    panorama.now_from_then = stated_from_base_ * panorama.now_from_then * stated_from_base_.transpose();
    for (PointTracks& tracks : panorama.tracks) {
      if (tracks.from_ns >= late_since_ns_) tracks.from_ns += late_ns_;
      for (Sighting& sighting : tracks.sightings) {
        sighting.then = stated_from_base_ * sighting.then;
        sighting.now = stated_from_base_ * sighting.now;
      }
    }
    return panorama;
  }

  void add_stereo(double at, Stereo stereo) {
    if (stereo == Stereo::kSilent) return;
    say_stereo(at, stereo);
    EXPECT_TRUE(odometry_.add(said_));
  }

  void say_stereo(double at, Stereo stereo) {
    const Eigen::Isometry3d step = Park::vehicle(at - 1.0 / kFrames).inverse() * Park::vehicle(at);
    if (stereo == Stereo::kGood) said_.odom_from_base = said_.odom_from_base * step;
    // A lorry that drives ahead at nearly the same speed.
    if (stereo == Stereo::kDeceived)
      said_.odom_from_base = said_.odom_from_base * vision::se3_exp(0.1 * vision::se3_log(step));
    said_.stamp_ns = Park::stamp_ns(0) + std::llround(at * static_cast<double>(kInterval_ns)) - back_ns_;
    said_.is_reliable = stereo != Stereo::kBlind;
    said_.covariance += (said_.is_reliable ? 1e-6 : 0.01) * vision::Matrix6d::Identity();
  }

  /// All clocks are set back while the stereo camera measures: first, poses are refused. The path of panorama `now`.
  void set_back(std::int64_t by_ns, int now) {
    back_ns_ += by_ns;
    late_ns_ -= by_ns;
    for (int frame = 1; frame <= kFrames; ++frame) {
      say_stereo(now - 1 + frame / static_cast<double>(kFrames), Stereo::kGood);
      EXPECT_FALSE(odometry_.add(said_));
    }
    odometry_.begin_again(said_, kFrames);
    const auto pose = odometry_.next();
    ASSERT_TRUE(pose);
    poses_.push_back(*pose);
  }

  double panorama_of(const AllRoundPose& pose) const {
    return static_cast<double>(pose.stamp_ns + back_ns_ - Park::stamp_ns(0)) / static_cast<double>(kInterval_ns);
  }

  double error_m(const AllRoundPose& pose) const {
    return (pose.odom_from_base.translation() - Park::vehicle(panorama_of(pose)).translation()).norm();
  }

  void expect_increasing_stamps() const {
    for (std::size_t i = 1; i < poses_.size(); ++i) EXPECT_GT(poses_[i].stamp_ns, poses_[i - 1].stamp_ns);
  }

  Park park_;
  AllRoundOdometry odometry_{{}, kCamera};
  StereoPose said_;
  std::int64_t late_ns_ = 0, late_since_ns_ = 0;                    // stamps of the panoramas
  std::int64_t back_ns_ = 0;                                        // stamps of the stereo camera
  Eigen::Matrix3d stated_from_base_ = Eigen::Matrix3d::Identity();  // of the camera
  std::vector<AllRoundPose> poses_;
};

}  // namespace panvo::all_round_odometry
