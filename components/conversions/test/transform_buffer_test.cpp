// SPDX-License-Identifier: Apache-2.0
#include "panvo/conversions/transform_buffer.hpp"

#include <gmock/gmock.h>

#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"

namespace panvo::conversions {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Eigen::Isometry3d transform(double x, double yaw_rad) {
  return Eigen::Translation3d(x, 0, 0) * Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
         Eigen::Isometry3d::Identity();
}

tf2_msgs::msg::TFMessage message(const std::string& parent, const std::string& child,
                                 const Eigen::Isometry3d& parent_from_child) {
  tf2_msgs::msg::TFMessage tf;
  tf.transforms().resize(1);
  tf.transforms()[0].header().frame_id(parent);
  tf.transforms()[0].child_frame_id(child);
  tf.transforms()[0].transform(to_transform(parent_from_child));
  return tf;
}

/// base_link -> mast -> left, base_link -> lidar.
TransformBuffer vehicle() {
  TransformBuffer transforms;
  transforms.add_static(message("mast", "left", transform(0.5, 0.2)));
  transforms.add_static(message("base_link", "mast", transform(1.0, 0.1)));
  transforms.add_static(message("base_link", "lidar", transform(-1.0, 3.0)));
  return transforms;
}

TEST(TransformBuffer, FollowsAChainEitherWay) {
  const auto base_from_left = transform(1.0, 0.1) * transform(0.5, 0.2);
  EXPECT_TRUE(vehicle().lookup("base_link", "left")->isApprox(base_from_left));
  EXPECT_TRUE(vehicle().lookup("left", "base_link")->isApprox(base_from_left.inverse()));
  EXPECT_TRUE(vehicle().lookup("lidar", "left")->isApprox(transform(-1.0, 3.0).inverse() * base_from_left));
}

TEST(TransformBuffer, OfAFrameToItselfIsIdentity) {
  EXPECT_TRUE(TransformBuffer().lookup("left", "left")->isApprox(Eigen::Isometry3d::Identity()));
}

TEST(TransformBuffer, HasNoTransformOfAnUnknownFrame) {
  EXPECT_FALSE(vehicle().lookup("base_link", "right"));
  EXPECT_FALSE(vehicle().lookup("map", "base_link"));
}

TEST(TransformBuffer, ReplacesAStaticTransformThatIsSentAgain) {
  auto transforms = vehicle();
  transforms.add_static(message("base_link", "lidar", transform(-2.0, 0.0)));
  EXPECT_DOUBLE_EQ(transforms.lookup("base_link", "lidar")->translation().x(), -2.0);
}

TEST(TransformBuffer, UnderstandsALeadingSlash) {
  TransformBuffer transforms;
  transforms.add_static(message("/base_link", "/left", transform(1.0, 0.0)));
  EXPECT_TRUE(transforms.lookup("base_link", "left"));
}

TEST(TransformBuffer, SurvivesALoopOfParents) {
  auto transforms = vehicle();
  transforms.add_static(message("left", "base_link", transform(1.0, 0.0)));
  EXPECT_FALSE(transforms.lookup("map", "left"));
}

TEST(TransformBuffer, BoundsFramesAndChains) {
  auto transforms = vehicle();
  std::vector<std::string> problems;
  for (int i = 0; i < 10'000; ++i) {
    for (auto& problem : transforms.add_static(message(std::to_string(i), std::to_string(i + 1), transform(1.0, 0.0))))
      problems.push_back(std::move(problem));
  }
  EXPECT_THAT(problems, ElementsAre("transforms of more than 10000 frames are ignored",
                                    "transforms of more than 10000 frames are ignored",
                                    "transforms of more than 10000 frames are ignored"));
  EXPECT_THAT(transforms.add_static(message("base_link", "mast", transform(2.0, 0.0))), IsEmpty());
  EXPECT_DOUBLE_EQ(transforms.lookup("base_link", "mast")->translation().x(), 2.0);
  EXPECT_DOUBLE_EQ(transforms.lookup("0", "100")->translation().x(), 100.0);
  EXPECT_FALSE(transforms.lookup("0", "101"));
}

TEST(TransformBuffer, NamesWhatItIgnores) {
  TransformBuffer transforms;
  auto zero = message("base_link", "left", transform(1.0, 0.0));
  zero.transforms()[0].transform().rotation().w(0.0);
  EXPECT_THAT(transforms.add_static(zero), ElementsAre(HasSubstr("'base_link' -> 'left' has a rotation quaternion")));
  EXPECT_THAT(transforms.add_static(message("left", "left", transform(1.0, 0.0))),
              ElementsAre(HasSubstr("two different frames")));
  EXPECT_FALSE(transforms.lookup("base_link", "left"));
  EXPECT_THAT(transforms.add_static(message("base_link", "left", transform(1.0, 0.0))), IsEmpty());
}

tf2_msgs::msg::TFMessage moving(const std::string& parent, const std::string& child, std::int64_t stamp_ns,
                                const Eigen::Isometry3d& parent_from_child) {
  auto tf = message(parent, child, parent_from_child);
  tf.transforms()[0].header().stamp(to_stamp(stamp_ns));
  return tf;
}

constexpr std::int64_t kSecond = 1'000'000'000;

/// The vehicle at 0 m and 2 m, at 1 s and 2 s, and its camera.
TransformBuffer driving_vehicle() {
  TransformBuffer transforms = vehicle();
  transforms.add_moving(moving("odom", "base_link", 2 * kSecond, transform(2.0, 0.4)));
  transforms.add_moving(moving("odom", "base_link", 1 * kSecond, transform(0.0, 0.0)));  // arrives late
  return transforms;
}

TEST(TransformBuffer, InterpolatesAMovingFrameAndGoesOnAlongStaticOnes) {
  const auto transforms = driving_vehicle();
  const auto base_from_left = transform(1.0, 0.1) * transform(0.5, 0.2);
  EXPECT_TRUE(transforms.lookup("odom", "left", 2 * kSecond)->isApprox(transform(2.0, 0.4) * base_from_left));
  const auto halfway = vision::interpolate(transform(0.0, 0.0), transform(2.0, 0.4), 0.5);
  EXPECT_TRUE(transforms.lookup("left", "odom", 3 * kSecond / 2)->isApprox((halfway * base_from_left).inverse()));
}

TEST(TransformBuffer, KnowsNoMovingFrameOutsideItsTimes) {
  auto transforms = driving_vehicle();
  EXPECT_FALSE(transforms.lookup("odom", "base_link", 1 * kSecond - 1));
  EXPECT_FALSE(transforms.lookup("odom", "base_link", 2 * kSecond + 1));
  EXPECT_FALSE(transforms.lookup("odom", "base_link")) << "not static";
  EXPECT_TRUE(transforms.lookup("base_link", "left", 99 * kSecond)) << "static: at any time";
  transforms.add_moving(moving("odom", "base_link", 11 * kSecond + 1, transform(3.0, 0.0)));
  EXPECT_FALSE(transforms.lookup("odom", "base_link", 1 * kSecond)) << "older than the history";
  EXPECT_TRUE(transforms.lookup("odom", "base_link", 2 * kSecond));
}

TEST(TransformBuffer, BoundsTheStampsOfAFrame) {
  TransformBuffer transforms;
  for (int i = 0; i <= 20'000; ++i) transforms.add_moving(moving("odom", "base_link", i, transform(i, 0.0)));
  EXPECT_FALSE(transforms.lookup("odom", "base_link", 0));
  EXPECT_DOUBLE_EQ(transforms.lookup("odom", "base_link", 1)->translation().x(), 1.0);
  EXPECT_DOUBLE_EQ(transforms.lookup("odom", "base_link", 20'000)->translation().x(), 20'000.0);
}

TEST(TransformBuffer, ForgetsWhatWasBeforeTheClockWasSetBack) {
  TransformBuffer transforms;
  const auto add = [&](std::int64_t second, double x) {
    transforms.add_moving(moving("odom", "base_link", second * kSecond, transform(x, 0.0)));
  };
  for (const std::int64_t second : {100, 101, 102}) add(second, 1.0);
  for (std::int64_t second = 50; second < 60; ++second) add(second, 2.0);
  ASSERT_TRUE(transforms.lookup("odom", "base_link", 59 * kSecond)) << "by more than the history";
  EXPECT_DOUBLE_EQ(transforms.lookup("odom", "base_link", 59 * kSecond)->translation().x(), 2.0);
  EXPECT_FALSE(transforms.lookup("odom", "base_link", 101 * kSecond));
  for (std::int64_t second = 52; second < 65; ++second) add(second, 3.0);
  EXPECT_DOUBLE_EQ(transforms.lookup("odom", "base_link", 58 * kSecond)->translation().x(), 3.0) << "by less";
  EXPECT_FALSE(transforms.lookup("odom", "base_link", 51 * kSecond)) << "of the clock before";
}

TEST(TransformBuffer, ForgetsTheOldParentOfAFrame) {
  auto transforms = driving_vehicle();
  transforms.add_moving(moving("map", "base_link", 3 * kSecond, transform(5.0, 0.0)));
  EXPECT_FALSE(transforms.lookup("odom", "base_link", 2 * kSecond));
  EXPECT_DOUBLE_EQ(transforms.lookup("map", "base_link", 3 * kSecond)->translation().x(), 5.0);
}

}  // namespace
}  // namespace panvo::conversions
