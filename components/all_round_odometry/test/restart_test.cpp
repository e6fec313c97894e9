// SPDX-License-Identifier: Apache-2.0
// A stereo odometry that is restarted with another origin.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <tuple>

#include "drive.hpp"

namespace panvo::all_round_odometry {
namespace {

enum class Before { kBlind, kSetClock };  // what shifted the path
enum class At { kOrigin, kFarAway };      // with a covariance that restarts at zero, or one that is constant

class Restart : public Drive {
 protected:
  void shift_path(Before before) {
    go(1, 20, Stereo::kGood);
    if (before == Before::kSetClock) {
      said_ = {};
      set_back(10'000'000'000, 21);
      begin_ = poses_.size();
      go(22, 25, Stereo::kGood);
    } else {
      go(21, 23, Stereo::kBlind);
      go(24, 25, Stereo::kGood);
    }
  }

  void restart(At at) {
    if (at == At::kOrigin) said_.covariance.setZero();
    said_.odom_from_base.setIdentity();
    if (at == At::kFarAway) said_.odom_from_base.translation().x() = 1000.0;
  }

  /// Error of the motion between two poses.
  double drift_m(const AllRoundPose& from, const AllRoundPose& to) const {
    const Eigen::Isometry3d truth = Park::vehicle(panorama_of(from)).inverse() * Park::vehicle(panorama_of(to));
    return ((from.odom_from_base.inverse() * to.odom_from_base).translation() - truth.translation()).norm();
  }

  void expect_no_jump() const {
    for (std::size_t i = begin_ + 1; i < poses_.size(); ++i) {
      const double way_m = (poses_[i].odom_from_base.translation() - poses_[i - 1].odom_from_base.translation()).norm();
      EXPECT_LT(way_m, 1.2 * (panorama_of(poses_[i]) - panorama_of(poses_[i - 1])) + 0.1) << panorama_of(poses_[i]);
    }
  }

  std::size_t begin_ = 0;  // of the poses of one clock
};

class AfterAShift : public Restart, public ::testing::WithParamInterface<std::tuple<Before, At, int>> {};

TEST_P(AfterAShift, IsBridgedByPanoramas) {
  const auto [before, at, gap] = GetParam();
  shift_path(before);
  const AllRoundPose last = poses_.back();
  go(26, 25 + gap, Stereo::kSilent);
  restart(at);
  go(26 + gap, 40 + gap, Stereo::kGood);
  EXPECT_LT(drift_m(last, poses_.back()), 0.5);
  EXPECT_TRUE(poses_.back().is_reliable);
  EXPECT_FALSE(poses_.back().agreeing_share) << "the stereo odometry is used again";
  EXPECT_EQ(poses_.back().stamp_ns, said_.stamp_ns);
  expect_no_jump();
}

TEST_P(AfterAShift, IsAnUnmeasuredGapWithoutPanoramas) {
  const auto [before, at, gap] = GetParam();
  shift_path(before);
  const AllRoundPose last = poses_.back();
  restart(at);
  const std::size_t begin = poses_.size();
  go(26 + gap, 40 + gap, Stereo::kGood, false);
  ASSERT_GT(poses_.size(), begin);
  EXPECT_FALSE(poses_[begin].is_reliable);
  EXPECT_TRUE(poses_.back().is_reliable);
  const double way_m = 1.0 + gap;
  EXPECT_LT(drift_m(last, poses_[begin]), 0.1 + 0.5 * way_m) << "it goes on where the motion leads";
  EXPECT_GT(vision::horizontal_sigma(poses_[begin].covariance),
            std::hypot(vision::horizontal_sigma(last.covariance), 0.9 * way_m));
  expect_no_jump();
}

INSTANTIATE_TEST_SUITE_P(Of, AfterAShift,
                         ::testing::Combine(::testing::Values(Before::kBlind, Before::kSetClock),
                                            ::testing::Values(At::kOrigin, At::kFarAway), ::testing::Values(0, 5, 15)));

TEST_F(Restart, IsBridgedByPanoramasThatContinuedTheOdometry) {
  for (const At at : {At::kOrigin, At::kFarAway}) {
    odometry_ = AllRoundOdometry({}, kCamera);
    said_ = {};
    poses_.clear();
    go(1, 20, Stereo::kGood);
    go(21, 35, Stereo::kSilent);
    ASSERT_LT(error_m(poses_.back()), 0.5);
    restart(at);
    go(36, 45, Stereo::kGood);
    EXPECT_FALSE(poses_.back().agreeing_share);
    EXPECT_LT(error_m(poses_.back()), 0.5);
    expect_no_jump();
  }
}

TEST_F(Restart, IsNoSingleWrongPose) {
  shift_path(Before::kBlind);
  const double error_before_m = error_m(poses_.back());
  StereoPose empty = said_;
  empty.stamp_ns += kInterval_ns / 10;
  empty.odom_from_base.setIdentity();
  empty.covariance.setZero();
  EXPECT_TRUE(odometry_.add(empty));
  EXPECT_FALSE(odometry_.add(empty)) << "twice";
  EXPECT_FALSE(odometry_.next()) << "the restart would appear as motion of the vehicle";
  go(26, 30, Stereo::kGood);
  EXPECT_LT(error_m(poses_.back()), error_before_m + 0.1);
  expect_no_jump();
}

/// A reader refuses stamps of the new time at first, so that panoramas continue the odometry.
TEST_F(Restart, WithASetClockTakesTheMotionThatTheStereoOdometryMeasuredMeanwhile) {
  go(1, 20, Stereo::kGood);
  go(21, 22, Stereo::kSilent);
  ASSERT_TRUE(poses_.back().agreeing_share);
  for (int frame = 1; frame <= 3 * kFrames; ++frame)
    say_stereo(20.0 + frame / static_cast<double>(kFrames), Stereo::kGood);
  set_back(10'000'000'000, 24);
  EXPECT_LT(error_m(poses_.back()), 0.01);
}

/// The same, for a clock that is set forward.
TEST_F(Restart, IsNotWhereAClockIsSetForward) {
  go(1, 20, Stereo::kGood);
  go(21, 22, Stereo::kSilent);
  for (int frame = 1; frame <= 3 * kFrames; ++frame)
    say_stereo(20.0 + frame / static_cast<double>(kFrames), Stereo::kGood);
  back_ns_ = -10'000'000'000;
  go(24, 26, Stereo::kGood);
  EXPECT_TRUE(poses_.back().is_reliable);
  EXPECT_FALSE(poses_.back().agreeing_share);
  EXPECT_LT(error_m(poses_.back()), 0.01);
}

/// The uncertainty of the motion since the last pose is that of the stereo odometry's speed.
TEST_F(Restart, WithASetClockLeavesAGapAlsoWithoutPanoramas) {
  go(1, 20, Stereo::kGood, false);
  const double variance_m2 = poses_.back().covariance.trace();
  said_ = {};
  set_back(10'000'000'000, 21);
  EXPECT_GT(poses_.back().covariance.trace(), variance_m2 + 1.0) << "1 m is missing";
}

}  // namespace
}  // namespace panvo::all_round_odometry
