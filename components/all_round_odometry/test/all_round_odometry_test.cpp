// SPDX-License-Identifier: Apache-2.0
#include "panvo/all_round_odometry/all_round_odometry.hpp"

#include <gtest/gtest.h>

#include "drive.hpp"

namespace panvo::all_round_odometry {
namespace {

TEST_F(Drive, ThatBeginsBlindGoesOnOnceTheCameraSees) {
  go(1, 10, Stereo::kBlind);
  go(11, 30, Stereo::kGood);
  ASSERT_GE(poses_.size(), 20U * kFrames);
  EXPECT_TRUE(poses_.back().is_reliable);
  EXPECT_NEAR(panorama_of(poses_.back()), 30.0, 1e-6);
  expect_increasing_stamps();
}

TEST_F(Drive, LeavesReliableStereoOdometryAsItIs) {
  std::vector<StereoPose> stereo;
  for (int now = 1; now <= 20; ++now) {
    for (int frame = 1; frame <= kFrames; ++frame) {
      add_stereo(now - 1 + frame / static_cast<double>(kFrames), Stereo::kGood);
      stereo.push_back(said_);
      const auto pose = odometry_.next();
      ASSERT_TRUE(pose) << "at once";
      EXPECT_EQ(pose->stamp_ns, said_.stamp_ns);
      EXPECT_EQ(pose->odom_from_base.matrix(), said_.odom_from_base.matrix());
      EXPECT_EQ(pose->covariance, said_.covariance);
      EXPECT_TRUE(pose->is_reliable);
      EXPECT_FALSE(pose->agreeing_share);
    }
    odometry_.add(park_.seen(now, Park::references(now)), false);
    EXPECT_FALSE(odometry_.next());
  }
}

TEST_F(Drive, GoesOnByPanoramasWhileTheStereoCameraIsBlind) {
  go(1, 12, Stereo::kGood);
  const std::size_t before = poses_.size();
  go(13, 62, Stereo::kBlind);
  EXPECT_EQ(poses_.size(), before + 50) << "one pose per panorama";
  for (std::size_t i = before; i < poses_.size(); ++i) {
    EXPECT_TRUE(poses_[i].is_reliable);
    EXPECT_TRUE(poses_[i].agreeing_share);
  }
  EXPECT_LT(error_m(poses_.back()), 1.0) << "2 % of 50 m";
  const double sigma_m = vision::horizontal_sigma(poses_.back().covariance);
  EXPECT_LT(error_m(poses_.back()), 3.0 * sigma_m);
  EXPECT_LT(sigma_m, 2.0) << "of use";
  const Eigen::Vector3d way = poses_.back().odom_from_base.translation() - Park::vehicle(12).translation();
  const Eigen::Vector3d along = way.normalized(), across = along.cross(Eigen::Vector3d::UnitZ());
  const Eigen::Matrix3d covariance = poses_.back().covariance.topLeftCorner<3, 3>();
  EXPECT_GT(along.dot(covariance * along), std::pow(0.005 * way.norm(), 2)) << "the error of the scale";
  EXPECT_GT(across.dot(covariance * across), std::pow(0.003 * way.norm(), 2)) << "that of the camera's rotation";
  expect_increasing_stamps();
}

TEST_F(Drive, ReturnsToTheStereoCameraWithoutAJump) {
  go(1, 12, Stereo::kGood);
  go(13, 22, Stereo::kBlind);
  const double error_before_m = error_m(poses_.back());
  go(23, 30, Stereo::kGood);
  EXPECT_FALSE(poses_.back().agreeing_share);
  EXPECT_TRUE(poses_.back().is_reliable);
  EXPECT_NEAR(error_m(poses_.back()), error_before_m, 0.1);
  EXPECT_EQ(poses_.back().stamp_ns, Park::stamp_ns(30));
  for (const AllRoundPose& pose : poses_) EXPECT_TRUE(pose.is_reliable);
  for (std::size_t i = 1; i < poses_.size(); ++i) {
    EXPECT_GE(poses_[i].covariance.trace() + 1e-9, poses_[i - 1].covariance.trace()) << "grows";
  }
  expect_increasing_stamps();
}

TEST_F(Drive, LosesNoStereoPoseThatWaitedForAPanorama) {
  go(1, 12, Stereo::kGood);
  go(13, 14, Stereo::kBlind);
  poses_.clear();
  for (int frame = 1; frame <= kFrames + 3; ++frame) add_stereo(14.0 + frame / 5.0, Stereo::kGood);
  odometry_.add(park_.seen(15, Park::references(15)), false);
  while (const auto pose = odometry_.next()) poses_.push_back(*pose);
  ASSERT_EQ(poses_.size(), 3U) << "those after the panorama, whose pose is that of the stereo pose of the same stamp";
  EXPECT_EQ(poses_.back().stamp_ns, said_.stamp_ns);
}

TEST_F(Drive, GoesOnByPanoramasWhileTheStereoCameraIsSilent) {
  go(1, 12, Stereo::kGood);
  go(13, 30, Stereo::kSilent);
  ASSERT_EQ(poses_.back().stamp_ns, Park::stamp_ns(30));
  EXPECT_TRUE(poses_.back().is_reliable);
  EXPECT_LT(error_m(poses_.back()), 0.5);
}

TEST_F(Drive, SaysUnreliableIfThePanoramasShowNothingEither) {
  go(1, 12, Stereo::kGood);
  const std::size_t before = poses_.size();
  go(13, 20, Stereo::kBlind, false);
  ASSERT_GT(poses_.size(), before);
  EXPECT_EQ(poses_.size(), before + 8 * kFrames) << "none is lost";
  for (std::size_t i = before; i < poses_.size(); ++i) EXPECT_FALSE(poses_[i].is_reliable);
  expect_increasing_stamps();
}

TEST_F(Drive, DoesNotWaitForPanoramasIfThereAreNone) {
  for (int i = 1; i <= 10; ++i) {
    add_stereo(0.2 * i, i < 5 ? Stereo::kGood : Stereo::kBlind);
    ASSERT_TRUE(odometry_.next()) << "stereo pose " << i;
  }
}

TEST_F(Drive, GivesUpIfPanoramasFailToo) {
  go(1, 12, Stereo::kGood);
  go(13, 20, Stereo::kBlind);
  ASSERT_TRUE(poses_.back().is_reliable);
  const AllRoundPose last = poses_.back();
  go(21, 26, Stereo::kBlind, false);
  EXPECT_FALSE(poses_.back().is_reliable);
  EXPECT_LT((poses_.back().odom_from_base.translation() - last.odom_from_base.translation()).norm(), 0.1)
      << "this stereo odometry predicts standstill";
  go(27, 40, Stereo::kGood);
  EXPECT_TRUE(poses_.back().is_reliable);
  expect_increasing_stamps();
}

TEST_F(Drive, FollowsThePanoramasIfAnObjectFillsTheStereoCamera) {
  go(1, 30, Stereo::kGood);
  go(31, 48, Stereo::kDeceived);
  EXPECT_LT(error_m(poses_.back()), 0.6) << "15 m behind by the stereo odometry";
  go(49, 60, Stereo::kGood);
  EXPECT_FALSE(poses_.back().agreeing_share);
  EXPECT_LT(error_m(poses_.back()), 0.6);
  expect_increasing_stamps();
}

TEST_F(Drive, FollowsThePanoramasAlsoBeforeTheClockIsKnown) {
  go(1, 8, Stereo::kGood);
  go(9, 26, Stereo::kDeceived);
  EXPECT_LT(error_m(poses_.back()), 0.6);
}

TEST_F(Drive, FindsHowLateThePanoramasAreStamped) {
  late_ns_ = 270'000'000;
  go(1, 40, Stereo::kGood);
  EXPECT_EQ(poses_.size(), 40U * kFrames);
  for (const AllRoundPose& pose : poses_) ASSERT_FALSE(pose.agreeing_share) << "no other motion, but another time";
  go(41, 60, Stereo::kBlind);
  EXPECT_TRUE(poses_.back().agreeing_share);
  EXPECT_GT(panorama_of(poses_.back()), 59.0);
  EXPECT_LT(error_m(poses_.back()), 0.6) << "1.35 m at the times of the stamps";
  go(61, 70, Stereo::kGood);
  EXPECT_LT(error_m(poses_.back()), 0.6);
  expect_increasing_stamps();
}

TEST_F(Drive, IsNotSureOfPanoramasOfAnUnknownTime) {
  late_ns_ = 3'000'000'000;
  go(1, 60, Stereo::kGood);
  for (const AllRoundPose& pose : poses_) ASSERT_FALSE(pose.agreeing_share) << "no other motion, but another time";
  const std::size_t before = poses_.size();
  go(61, 80, Stereo::kBlind);
  ASSERT_GT(poses_.size(), before);
  for (std::size_t i = before; i < poses_.size(); ++i) {
    EXPECT_TRUE(!poses_[i].is_reliable || error_m(poses_[i]) < 1.0) << panorama_of(poses_[i]);
  }
  expect_increasing_stamps();
}

TEST_F(Drive, BelievesNoMotionOfAnotherTimeWhenTheClockIsSetOnTheWay) {
  go(1, 40, Stereo::kGood);
  late_ns_ = 200'000'000;
  late_since_ns_ = Park::stamp_ns(41);
  go(41, 90, Stereo::kGood);
  for (const AllRoundPose& pose : poses_) ASSERT_FALSE(pose.agreeing_share) << panorama_of(pose);
  go(91, 110, Stereo::kBlind);
  EXPECT_TRUE(poses_.back().agreeing_share);
  EXPECT_LT(error_m(poses_.back()), 0.6);
}

TEST_F(Drive, GoesOnAlthoughTheCameraIsRotatedOtherwiseThanStated) {
  stated_from_base_ = vision::so3_exp({0.01, 0.03, -0.25});
  go(1, 30, Stereo::kGood);
  for (const AllRoundPose& pose : poses_) ASSERT_FALSE(pose.agreeing_share);
  go(31, 60, Stereo::kBlind);
  EXPECT_TRUE(poses_.back().agreeing_share);
  EXPECT_LT(error_m(poses_.back()), 1.0) << "7 m in the stated axes";
}

TEST_F(Drive, DoesNotBelieveAPanoramicCameraThatIsTurned) {
  go(1, 30, Stereo::kGood);
  const Eigen::Matrix3d turn = vision::so3_exp({0.0, 0.0, 0.3});
  for (int now = 31; now <= 50; ++now) {
    for (int frame = 1; frame <= kFrames; ++frame) add_stereo(now - 1 + frame / 5.0, Stereo::kGood);
    auto seen = park_.seen(now, Park::references(now));
    const int turned_at = 31;
    for (PointTracks& tracks : seen.tracks) {
      for (Sighting& sighting : tracks.sightings) {
        sighting.now = turn * sighting.now;
        if (tracks.from_ns >= Park::stamp_ns(turned_at)) sighting.then = turn * sighting.then;
      }
    }
    seen.now_from_then = turn * seen.now_from_then;
    odometry_.add(seen, false);
    while (const auto pose = odometry_.next()) poses_.push_back(*pose);
  }
  EXPECT_FALSE(poses_.back().agreeing_share);
  EXPECT_LT(error_m(poses_.back()), 0.05) << "as by the stereo odometry";
}

TEST_F(Drive, PassesOnPosesThatNoVehicleReachesButDoesNotUseThem) {
  go(1, 12, Stereo::kGood);
  StereoPose absurd = said_;
  absurd.stamp_ns += kInterval_ns / 10;
  absurd.odom_from_base.translation().x() += 1e4;
  EXPECT_TRUE(odometry_.add(absurd));
  const auto passed = odometry_.next();
  ASSERT_TRUE(passed);
  EXPECT_EQ(passed->odom_from_base.matrix(), absurd.odom_from_base.matrix());
  go(13, 30, Stereo::kGood);
  go(31, 40, Stereo::kBlind);
  EXPECT_TRUE(poses_.back().is_reliable);
  EXPECT_LT(error_m(poses_.back()), 0.5);
}

TEST_F(Drive, GoesOnFromAnotherOriginOfTheStereoOdometry) {
  go(1, 12, Stereo::kGood);
  said_.odom_from_base.translation().x() += 1e4;
  go(13, 20, Stereo::kGood);
  EXPECT_EQ(poses_.back().odom_from_base.matrix(), said_.odom_from_base.matrix());
  EXPECT_EQ(poses_.size(), 20U * kFrames);
}

class SetClock : public Drive, public ::testing::WithParamInterface<std::int64_t> {};

TEST_P(SetClock, DoesNotMoveThePath) {
  go(1, 12, Stereo::kGood);
  go(13, 22, Stereo::kBlind);
  go(23, 30, Stereo::kGood);
  const AllRoundPose before = poses_.back();
  const double error_before_m = error_m(before);
  ASSERT_GT((before.odom_from_base.translation() - said_.odom_from_base.translation()).norm(), 5.0) << "shifted";
  set_back(GetParam(), 31);
  EXPECT_NEAR(panorama_of(poses_.back()), 31.0, 1e-6);
  EXPECT_NEAR(error_m(poses_.back()), error_before_m, 0.2) << "less than one step";
  EXPECT_GE(poses_.back().covariance.trace(), before.covariance.trace());
  go(32, 44, Stereo::kGood);
  EXPECT_NEAR(error_m(poses_.back()), error_before_m, 0.2);
  go(45, 54, Stereo::kBlind);
  EXPECT_TRUE(poses_.back().agreeing_share) << "panoramas are used again";
  EXPECT_LT(error_m(poses_.back()), error_before_m + 0.3);
}

TEST_P(SetClock, DoesNotMoveThePathWhilePanoramasContinueIt) {
  go(1, 12, Stereo::kGood);
  go(13, 22, Stereo::kBlind);
  const AllRoundPose before = poses_.back();
  const double error_before_m = error_m(before);
  set_back(GetParam(), 23);
  EXPECT_NEAR(error_m(poses_.back()), error_before_m, 0.2);
  EXPECT_GE(poses_.back().covariance.trace(), before.covariance.trace());
}

TEST_P(SetClock, DoesNotMoveThePathIfTheStereoOdometryWasRestartedToo) {
  go(1, 20, Stereo::kGood);
  const AllRoundPose before = poses_.back();
  said_ = {};
  set_back(GetParam(), 21);
  const double moved_m = (poses_.back().odom_from_base.translation() - before.odom_from_base.translation()).norm();
  EXPECT_LT(moved_m, 0.2);
  EXPECT_GT(poses_.back().covariance.trace(), before.covariance.trace() + 1.0) << "1 m is missing";
  go(22, 30, Stereo::kGood);
  EXPECT_LT(error_m(poses_.back()), 2.0);
}

TEST_P(SetClock, OfThePanoramicCameraAlone) {
  go(1, 12, Stereo::kGood);
  late_ns_ = GetParam();
  late_since_ns_ = Park::stamp_ns(13);
  go(13, 20, Stereo::kGood);
  late_ns_ = 0;  // back
  go(21, 40, Stereo::kGood);
  EXPECT_EQ(poses_.size(), 40U * kFrames);
  go(41, 50, Stereo::kBlind);
  EXPECT_TRUE(poses_.back().agreeing_share) << "panoramas are used again";
  EXPECT_LT(error_m(poses_.back()), 0.5);
  expect_increasing_stamps();
}

INSTANTIATE_TEST_SUITE_P(By, SetClock, ::testing::Values(10'000'000'000, 600'000'000'000));

TEST_F(Drive, RefusesStampsThatDoNotIncrease) {
  go(1, 2, Stereo::kGood);
  EXPECT_FALSE(odometry_.add(said_));
  EXPECT_FALSE(odometry_.next());
}

}  // namespace
}  // namespace panvo::all_round_odometry
