// SPDX-License-Identifier: Apache-2.0
#include "panvo/landmarks/landmark_messages.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "made_up_landmark.hpp"
#include "panvo/interfaces/message_type.hpp"
#include "panvo/interfaces/place_rules.hpp"
#include "panvo/interfaces/topics.hpp"
#include "panvo/landmarks/map_replica.hpp"

namespace panvo::landmarks {
namespace {

using namespace test;
using testing::HasSubstr;
using Message = panvo_msgs::msg::PanoramicLandmark;

Message message_of(std::uint32_t id) { return to_message(made_up_landmark(id), made_up_settings(), "map"); }

TEST(LandmarkMessages, GiveBackTheLandmark) {
  for (std::uint32_t id = 1; id <= 20; ++id) {
    const auto result = to_landmark(message_of(id), made_up_settings());
    ASSERT_TRUE(result) << result.reason();
    EXPECT_EQ(difference(*result, made_up_landmark(id)), "");
  }
}

TEST(LandmarkMessages, GiveItBackOverTheWire) {
  const auto& type = interfaces::message_type<Message>();
  const auto sent = message_of(3);
  interfaces::Bytes bytes(type.serialized_size(&sent));
  type.serialize(&sent, bytes);
  const auto received = std::static_pointer_cast<Message>(type.deserialize(bytes));
  const auto result = to_landmark(*received, made_up_settings());
  ASSERT_TRUE(result) << result.reason();
  EXPECT_EQ(difference(*result, made_up_landmark(3)), "");
}

TEST(LandmarkMessages, CarryFrameStampAndSettings) {
  const auto message = message_of(2);
  EXPECT_EQ(message.header().frame_id(), "map");
  EXPECT_EQ(message.header().stamp().sec(), 1'700'000'020);
  EXPECT_EQ(message.header().stamp().nanosec(), 2u);
  EXPECT_EQ(message.settings(), "band_rows=150\nseed=1\n");
}

TEST(LandmarkMessages, OfOtherSettingsAreRefusedWithWhatDiffers) {
  EXPECT_EQ(to_landmark(message_of(1), {{"band_rows", "160"}, {"seed", "1"}}).reason(),
            "was described with other settings: band_rows is 150 there, 160 here");
}

struct Fault {
  const char* reason;
  std::function<void(Message&)> make;
};

TEST(LandmarkMessages, ThatAreMalformedAreRefusedWithAReason) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const double inf = std::numeric_limits<double>::infinity();
  const Fault faults[] = {
      {"id is 0", [](Message& m) { m.id(0); }},
      {"pose.pose.position is not finite", [=](Message& m) { m.pose().pose().position().x(inf); }},
      {"panorama_pose.orientation is not a unit quaternion",
       [](Message& m) {
         m.panorama_pose().orientation().w(0.0);
         m.panorama_pose().orientation().x(0.0);
         m.panorama_pose().orientation().y(0.0);
         m.panorama_pose().orientation().z(0.0);
       }},
      {"pose.pose.orientation is not a unit quaternion", [](Message& m) { m.pose().pose().orientation().w(3.0); }},
      {"pose.covariance is not finite", [=](Message& m) { m.pose().covariance()[7] = inf; }},
      {"not symmetric", [](Message& m) { m.pose().covariance()[1] += 0.5; }},
      {"negative variance", [](Message& m) { m.pose().covariance()[0] = -1.0; }},
      {"pose.covariance is not positive semidefinite",
       [](Message& m) { m.pose().covariance()[1] = m.pose().covariance()[6] = 10.0; }},
      {"histogram", [](Message& m) { m.histogram().clear(); }},
      {"histogram", [](Message& m) { m.histogram()[0] += 0.1f; }},
      {"histogram", [=](Message& m) { m.histogram()[3] = nan; }},
      {"large_features.value is beyond +-1e+06 or not finite", [=](Message& m) { m.large_features()[4].value(nan); }},
      {"small_features.scale is negative", [](Message& m) { m.small_features()[0].scale(-1.0f); }},
      {"small_features.weight is not between 0 and 1", [](Message& m) { m.small_features()[0].weight(1.5f); }},
      {"small_features.weight is not in descending order",
       [](Message& m) { m.small_features()[0].weight(m.small_features()[1].weight() - 0.1f); }},
      {"keypoints.bearing is not a unit vector", [=](Message& m) { m.keypoints()[1].bearing()[2] = nan; }},
      {"keypoints.point is beyond +-1e+06 or not finite", [=](Message& m) { m.keypoints()[0].point()[0] = nan; }},
      {"keypoints.bearing is not a unit vector",
       [](Message& m) {
         m.keypoints()[0].bearing({0, 0, 0});
       }},
      {"keypoints.inverse_range_sigma is negative", [](Message& m) { m.keypoints()[0].inverse_range_sigma(-1.0f); }},
  };
  for (const auto& fault : faults) {
    auto message = message_of(1);
    fault.make(message);
    const auto result = to_landmark(message, made_up_settings());
    EXPECT_FALSE(result) << fault.reason;
    EXPECT_THAT(result.reason(), HasSubstr(fault.reason));
  }
}

TEST(LandmarkMessages, HaveNoIdThatTheNextCouldNotBeCountedFrom) {
  auto message = message_of(1);
  message.id(interfaces::kMaxLandmarkId);
  auto highest = to_landmark(message, made_up_settings());
  ASSERT_TRUE(highest) << highest.reason();
  MapReplica map;
  auto landmark = *highest;
  map.add(landmark);
  EXPECT_EQ(map.next_id(), interfaces::kMaxLandmarkId + 1);

  message.id(interfaces::kMaxLandmarkId + 1);
  EXPECT_THAT(to_landmark(message, made_up_settings()).reason(), HasSubstr("id is above 4000000000"));
  panvo_msgs::msg::LandmarkPoses poses;
  poses.ids({1, interfaces::kMaxLandmarkId + 1});
  poses.poses().resize(2);
  EXPECT_THAT(to_landmark_poses(poses).reason(), HasSubstr("ids contain one above 4000000000"));
  poses.ids({1, interfaces::kMaxLandmarkId});
  EXPECT_TRUE(to_landmark_poses(poses));
}

TEST(LandmarkTopics, ReachThoseWhoComeLate) {
  EXPECT_EQ(topics::kLandmarks.name, "landmarks");
  EXPECT_EQ(topics::kLandmarks.qos.requested, interfaces::Reliability::kReliable);
  EXPECT_EQ(topics::kLandmarks.qos.durability, interfaces::Durability::kTransientLocal);
  EXPECT_TRUE(topics::kLandmarks.qos.keep_all);
  EXPECT_EQ(topics::kLandmarkMatch.name, "landmarks/match");
}

}  // namespace
}  // namespace panvo::landmarks
