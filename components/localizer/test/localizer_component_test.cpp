// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "localizer_on_topics.hpp"

namespace panvo::localizer {
namespace {

namespace states = panvo_msgs::msg::LocalizationState_Constants;
namespace outcomes = panvo_msgs::msg::CorrectionOutcome_Constants;

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

TEST_F(LocalizerOnTopics, PublishesPoseAndFramesWithEachOdometry) {
  load();
  drive(0, 51);
  ASSERT_THAT(enhanced_, SizeIs(51));
  EXPECT_EQ(enhanced_.back()->header().frame_id(), "map");
  EXPECT_EQ(enhanced_.back()->child_frame_id(), "base_link");
  EXPECT_EQ(conversions::stamp_ns(*enhanced_.back()), stamp(50));
  EXPECT_NEAR(enhanced_.back()->pose().pose().position().x(), 10.0, 1e-9);
  EXPECT_NEAR(enhanced_.back()->twist().twist().linear().x(), 5.0, 1e-12);
  ASSERT_THAT(tf_, SizeIs(51));
  ASSERT_THAT(tf_.back()->transforms(), SizeIs(2));
  EXPECT_EQ(tf_.back()->transforms()[0].header().frame_id(), "map");
  EXPECT_EQ(tf_.back()->transforms()[0].child_frame_id(), "odom");
  EXPECT_EQ(tf_.back()->transforms()[1].child_frame_id(), "base_link");
  EXPECT_NEAR(tf_.back()->transforms()[1].transform().translation().x(), 10.0, 1e-9);
  ASSERT_THAT(paths_, Not(IsEmpty()));
  EXPECT_EQ(paths_.back()->header().frame_id(), "map");
  ASSERT_THAT(states_, Not(IsEmpty()));
  EXPECT_EQ(states_.back()->state(), states::TRACKING);
}

TEST_F(LocalizerOnTopics, CorrectsThePositionAndSaysByHowMuch) {
  load({{"fusion.clock_sigma_s", "0"}});
  drive(0, 51);
  publish_landmark(1, stamp(25), at(5.0, 0.0, 0.0));
  ASSERT_THAT(poses_, SizeIs(1));
  EXPECT_EQ(poses_[0]->ids().at(0), 1U);
  drive(51, 151);
  // after 30 m the landmark is seen 24 m behind and 0.5 m to the left: less far than odometry reports
  publish_correction(1, stamp(150), at(24.5, -0.5, 0.0));
  ASSERT_THAT(outcomes_, SizeIs(1));
  EXPECT_EQ(outcomes_[0]->outcome(), outcomes::APPLIED) << outcomes_[0]->reason();
  EXPECT_NEAR(outcomes_[0]->before().position().x(), 30.0, 1e-6);
  EXPECT_NEAR(outcomes_[0]->after().position().x(), 29.5, 0.1);
  EXPECT_NEAR(outcomes_[0]->after().position().y(), -0.5, 0.1);
  drive(151, 152);
  EXPECT_NEAR(enhanced_.back()->pose().pose().position().x(), 29.7, 0.1);
  EXPECT_NEAR(tf_.back()->transforms()[1].transform().translation().x(), 30.2, 1e-6) << "odom does not jump";
  EXPECT_NEAR(tf_.back()->transforms()[0].transform().translation().x(), -0.5, 0.1) << "the map does";
}

/// Messages that, unchecked, would block or stop it for good; it continues with the next ones.
TEST_F(LocalizerOnTopics, GoesOnAfterMessagesThatNoSensorSends) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  vision::Matrix6d indefinite = 1e-4 * vision::Matrix6d::Identity();
  indefinite(0, 1) = indefinite(1, 0) = 1.0;
  load();
  publish_landmark(1, stamp(-1000), at(5.0, 0.0, 0.0));
  drive(0, 20);
  nav_msgs::msg::Odometry odometry = *enhanced_.back();
  odometry.header().stamp(conversions::to_stamp(stamp(20)));
  odometry.pose().covariance()[14] = nan;
  harness_.publish(topics::kOdometryBinocular, odometry);
  odometry.pose().covariance()[14] = 1.0;
  odometry.pose().pose().position().x(1e200);
  harness_.publish(topics::kOdometryBinocular, odometry);
  geometry_msgs::msg::PoseWithCovarianceStamped said;
  said.header().frame_id("map");
  said.pose().covariance(conversions::to_array(indefinite));
  harness_.publish(topics::kInitialPose, said);
  said.pose().covariance(conversions::to_array(1e308 * vision::Matrix6d::Identity()));
  harness_.publish(topics::kInitialPose, said);
  said.pose().covariance(conversions::to_array(vision::Matrix6d::Identity()));
  said.pose().pose().position().x(1e200);
  harness_.publish(topics::kInitialPose, said);
  panvo_msgs::msg::PositionCorrection correction;
  correction.header().stamp(conversions::to_stamp(stamp(19)));
  correction.landmark_id(1);
  correction.state(panvo_msgs::msg::PositionCorrection_Constants::FULL);
  correction.landmark_from_base().covariance(conversions::to_array(indefinite));
  harness_.publish(topics::kCorrection, correction);
  panvo_msgs::msg::PanoramicLandmark landmark;
  landmark.header().stamp(conversions::to_stamp(stamp(-1000)));
  landmark.id(2);
  landmark.histogram({1.0F});
  landmark.pose().pose().position().x(nan);
  harness_.publish(topics::kLandmarks, landmark);
  panvo_msgs::msg::AzimuthChange azimuth;
  azimuth.header().stamp(conversions::to_stamp(stamp(19)));
  azimuth.from_stamp(conversions::to_stamp(stamp(18)));
  azimuth.azimuth_change_rad(1.0);
  azimuth.variance_rad2(1e-300);
  azimuth.valid(true);
  harness_.publish(topics::kAzimuthChange, azimuth);

  const std::size_t told = enhanced_.size();
  drive(21, 41);
  EXPECT_EQ(enhanced_.size(), told + 20);
  for (const auto& pose : enhanced_) {
    EXPECT_LT(std::abs(pose->pose().pose().position().x()), 20.0);
    EXPECT_GT(pose->pose().covariance()[0], 0.0);
  }
  EXPECT_THAT(harness_.container().run(), IsEmpty());
}

TEST_F(LocalizerOnTopics, WaitsForOdometryThatIsBehindAPanorama) {
  load();
  drive(0, 10);
  publish_landmark(1, stamp(5), at(1.0, 0.0, 0.0));
  publish_correction(1, stamp(12), at(1.4, 0.0, 0.0));
  EXPECT_THAT(outcomes_, IsEmpty());
  drive(10, 13);
  ASSERT_THAT(outcomes_, SizeIs(1));
}

TEST_F(LocalizerOnTopics, WaitsForNoOdometryWhereAPanoramaIsAMomentLaterThanTheLast) {
  load({{"fusion.clock_sigma_s", "0"}});
  drive(0, 13);
  publish_landmark(1, stamp(5), at(1.0, 0.0, 0.0));
  publish_correction(1, stamp(12) + 4'000'000, at(1.42, 0.1, 0.0));
  ASSERT_THAT(outcomes_, SizeIs(1));
  EXPECT_EQ(outcomes_[0]->outcome(), outcomes::APPLIED) << outcomes_[0]->reason();
  EXPECT_NEAR(outcomes_[0]->before().position().x(), 2.42, 1e-6) << "4 ms at 5 m/s";
  publish_correction(1, stamp(12) + 8'000'000, at(1.44, 0.1, 0.0));
  EXPECT_THAT(outcomes_, SizeIs(1)) << "no extrapolation beyond 5 ms";
  drive(13, 14);
  EXPECT_THAT(outcomes_, SizeIs(2));
  EXPECT_GT(outcomes_[0]->after().position().y(), 0.01);
  EXPECT_NEAR(enhanced_.back()->pose().pose().position().y(), outcomes_[0]->after().position().y(), 0.005)
      << "the next pose includes it";
}

TEST_F(LocalizerOnTopics, TakesNoRejectedCorrection) {
  load();
  drive(0, 10);
  publish_landmark(1, stamp(5), at(1.0, 0.0, 0.0));
  publish_correction(1, stamp(8), at(0.6, 0.0, 0.0), panvo_msgs::msg::PositionCorrection_Constants::REJECTED);
  EXPECT_THAT(outcomes_, IsEmpty());
}

TEST_F(LocalizerOnTopics, DoesNotKnowWhereItIsInAMapOfAnEarlierDayUntilTwoPanoramasSaySo) {
  load();
  publish_landmark(9, kBegin_ns - 86'400'000'000'000, at(300.0, 100.0, 1.0));
  drive(0, 20);
  ASSERT_THAT(states_, Not(IsEmpty()));
  EXPECT_EQ(states_.back()->state(), states::UNLOCATED);
  EXPECT_GT(enhanced_.back()->pose().covariance()[0], 1e6);
  publish_correction(9, stamp(14), at(1.0, 0.0, 0.0));
  publish_correction(9, stamp(19), at(2.0, 0.0, 0.0));
  ASSERT_THAT(outcomes_, SizeIs(2));
  EXPECT_EQ(outcomes_[0]->outcome(), outcomes::REJECTED);
  EXPECT_EQ(outcomes_[1]->outcome(), outcomes::APPLIED);
  drive(20, 21);
  EXPECT_EQ(states_.back()->state(), states::RELOCALISED);
  const Eigen::Vector3d expected = at(300.0, 100.0, 1.0) * Eigen::Vector3d(2.2, 0.0, 0.0);
  EXPECT_NEAR(enhanced_.back()->pose().pose().position().x(), expected.x(), 0.1);
  EXPECT_NEAR(enhanced_.back()->pose().pose().position().y(), expected.y(), 0.1);
}

TEST_F(LocalizerOnTopics, GoesOnWhenOdometryWasRestartedNearItsOrigin) {
  load();
  drive(0, 50);
  // It is silent for 2 s, and begins at 0 again.
  for (int i = 100; i < 112; ++i) publish_odometry(i, at(0.2 * (i - 100), 0.0, 0.0), 1e-4 + 1e-4 * (i - 100));
  EXPECT_TRUE(harness_.log_contains("restarted from another origin"));
  const auto& last = enhanced_.back()->pose();
  const double sigma_m = std::sqrt(last.covariance()[0]);
  EXPECT_GT(sigma_m, 3.0) << "of a vehicle whose motion is unknown for 2 s";
  EXPECT_NEAR(last.pose().position().x(), 22.2, sigma_m);
  EXPECT_EQ(states_.back()->state(), states::TRACKING);
}

TEST_F(LocalizerOnTopics, SaysThatTheLandmarksMayBeOfAnotherPlace) {
  load();
  publish_landmark(9, kBegin_ns - 86'400'000'000'000, at(300.0, 100.0, 1.0));
  drive(0, 2450);
  EXPECT_FALSE(harness_.log_contains("is it a map of another area?"));
  drive(2450, 2550);
  EXPECT_TRUE(harness_.log_contains("is it a map of another area?"));
}

TEST_F(LocalizerOnTopics, SaysThatThereIsNoOdometryAnyMore) {
  load();
  drive(0, 10);
  for (int i = 1; i < 10; ++i) publish_azimuth(stamp(10 * i), stamp(10 * i + 10), 0.0);
  ASSERT_THAT(states_, Not(IsEmpty()));
  EXPECT_EQ(states_.back()->state(), states::STALE);
  EXPECT_THAT(states_.back()->reason(), HasSubstr("no /odometry/binocular for"));
}

TEST_F(LocalizerOnTopics, SaysThatThereAreNoPanoramasAnyMore) {
  load();
  drive(0, 10);
  publish_azimuth(stamp(0), stamp(5), 0.0);
  drive(10, 300);
  EXPECT_TRUE(harness_.log_contains("no panorama for 10 s"));
  EXPECT_EQ(states_.back()->state(), states::TRACKING) << "it drifts, but is localised";
}

TEST_F(LocalizerOnTopics, TellsOfUnreliableOdometryAndOfTheCompass) {
  load();
  drive(0, 50);
  drive_with_quality(50, 60, false);
  publish_azimuth(stamp(50), stamp(55), 0.0);
  drive_with_quality(60, 61, false);
  EXPECT_EQ(states_.back()->state(), states::COMPASS_ONLY);
  drive_with_quality(61, 120, false);
  EXPECT_EQ(states_.back()->state(), states::LOST);
  drive_with_quality(120, 121, true);
  EXPECT_EQ(states_.back()->state(), states::TRACKING);
}

TEST_F(LocalizerOnTopics, WeighsATurnThatOnlyTheCompassSeesByTheVariances) {
  constexpr double kTurn_rad = 0.004;
  constexpr double kStep_rad2 = 1e-6;  // five steps have five times the compass variance
  load({{"fusion.clock_sigma_s", "0"},
        {"fusion.compass_turn_error_ratio", "0"},
        {"fusion.compass_correlation_ratio", "1"}});
  const auto drive_on = [&](int from, int to) {
    for (int i = from; i < to; ++i) {
      publish_quality(i, true);
      publish_odometry(i, at(0.2 * i, 0.0, 0.0), kStep_rad2 * (1 + i));
    }
  };
  drive_on(0, 6);
  publish_azimuth(stamp(0), stamp(5), kTurn_rad);
  drive_on(6, 60);
  const auto pose = conversions::to_isometry(enhanced_.back()->pose().pose());
  ASSERT_TRUE(pose);
  EXPECT_NEAR(std::asin(pose->linear()(1, 0)) / kTurn_rad, 5.0 / (5.0 + 1.0), 0.01);
}

TEST_F(LocalizerOnTopics, KeepsItsPathsShort) {
  load({{"path_step_m", "0.01"}});
  for (int i = 0; i < 9000; ++i) publish_odometry(i, at(0.2 * i, 0.0, 0.0), 1e-3);
  ASSERT_THAT(paths_, Not(IsEmpty()));
  EXPECT_LE(paths_.back()->poses().size(), 4000U);
  EXPECT_GE(paths_.back()->poses().size(), 1900U);
  EXPECT_NEAR(paths_.back()->poses().front().pose().position().x(), 0.0, 1e-9);
}

}  // namespace
}  // namespace panvo::localizer
