// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "localizer_on_topics.hpp"

namespace panvo::localizer {
namespace {

namespace states = panvo_msgs::msg::LocalizationState_Constants;

using ::testing::Contains;
using ::testing::HasSubstr;

TEST_F(LocalizerOnTopics, IsWhereAClickOnTheMapSays) {
  load();
  publish_landmark(9, kBegin_ns - 86'400'000'000'000, at(300.0, 100.0, 1.0));
  geometry_msgs::msg::PoseWithCovarianceStamped click;
  click.header().frame_id("map");
  click.pose().pose(conversions::to_pose(at(310.0, 95.0, 0.5)));
  click.pose().covariance()[0] = click.pose().covariance()[7] = 0.25;
  click.pose().covariance()[35] = 0.0685;
  harness_.publish(topics::kInitialPose, click);
  EXPECT_THAT(harness_.log(), Contains(HasSubstr("no odometry received yet")));
  drive(0, 20);
  EXPECT_EQ(states_.back()->state(), states::UNLOCATED);
  click.header().frame_id("odom");
  harness_.publish(topics::kInitialPose, click);
  EXPECT_THAT(harness_.log(), Contains(HasSubstr("expected 'map' or 'base_link'")));
  click.header().frame_id("map");
  harness_.publish(topics::kInitialPose, click);
  EXPECT_EQ(states_.back()->state(), states::RELOCALISED);
  drive(20, 21);
  const Eigen::Vector3d expected = at(310.0, 95.0, 0.5) * Eigen::Vector3d(0.2, 0.0, 0.0);
  EXPECT_NEAR(enhanced_.back()->pose().pose().position().x(), expected.x(), 0.01);
  EXPECT_NEAR(enhanced_.back()->pose().pose().position().y(), expected.y(), 0.01);
}

TEST_F(LocalizerOnTopics, IsWhereAClickRelativeToTheVehicleSays) {
  load();
  drive(0, 20);
  geometry_msgs::msg::PoseWithCovarianceStamped click;
  click.header().frame_id("map");
  click.pose().pose(conversions::to_pose(at(310.0, 95.0, 0.5)));
  click.pose().covariance(conversions::to_array(4.0 * vision::Matrix6d::Identity()));
  harness_.publish(topics::kInitialPose, click);
  const Eigen::Isometry3d before = *conversions::to_isometry(enhanced_.back()->pose().pose());
  click.header().frame_id("base_link");
  click.pose().pose(conversions::to_pose(at(4.0, -3.0, 0.2)));
  click.pose().covariance(conversions::to_array(1e-6 * vision::Matrix6d::Identity()));
  click.pose().covariance()[0] = 4e-4;
  harness_.publish(topics::kInitialPose, click);
  const Eigen::Isometry3d expected = before * at(4.0, -3.0, 0.2);
  const auto& placed = enhanced_.back()->pose();
  EXPECT_NEAR(placed.pose().position().x(), expected.translation().x(), 0.01);
  EXPECT_NEAR(placed.pose().position().y(), expected.translation().y(), 0.01);
  // Along and across the vehicle as it was.
  const Eigen::Matrix2d axes = before.linear().topLeftCorner<2, 2>();
  const Eigen::Matrix2d spread = axes * Eigen::Vector2d(4e-4, 1e-6).asDiagonal() * axes.transpose();
  EXPECT_NEAR(placed.covariance()[0], spread(0, 0), 5e-5);
  EXPECT_NEAR(placed.covariance()[1], spread(0, 1), 5e-5);
  EXPECT_NEAR(placed.covariance()[7], spread(1, 1), 5e-5);
}

}  // namespace
}  // namespace panvo::localizer
