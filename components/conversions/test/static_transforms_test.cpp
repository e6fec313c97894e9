// SPDX-License-Identifier: Apache-2.0
#include "panvo/conversions/static_transforms.hpp"

#include <gmock/gmock.h>

#include "panvo/conversions/pose.hpp"

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
StaticTransforms vehicle() {
  StaticTransforms transforms;
  transforms.add(message("mast", "left", transform(0.5, 0.2)));
  transforms.add(message("base_link", "mast", transform(1.0, 0.1)));
  transforms.add(message("base_link", "lidar", transform(-1.0, 3.0)));
  return transforms;
}

TEST(StaticTransforms, FollowAChainEitherWay) {
  const auto base_from_left = transform(1.0, 0.1) * transform(0.5, 0.2);
  EXPECT_TRUE(vehicle().lookup("base_link", "left")->isApprox(base_from_left));
  EXPECT_TRUE(vehicle().lookup("left", "base_link")->isApprox(base_from_left.inverse()));
  EXPECT_TRUE(vehicle().lookup("lidar", "left")->isApprox(transform(-1.0, 3.0).inverse() * base_from_left));
}

TEST(StaticTransforms, OfAFrameToItselfAreIdentity) {
  EXPECT_TRUE(StaticTransforms().lookup("left", "left")->isApprox(Eigen::Isometry3d::Identity()));
}

TEST(StaticTransforms, ThatAreNotThereAreNotIdentity) {
  EXPECT_FALSE(vehicle().lookup("base_link", "right"));
  EXPECT_FALSE(vehicle().lookup("map", "base_link"));
}

TEST(StaticTransforms, AreReplacedWhenSentAgain) {
  auto transforms = vehicle();
  transforms.add(message("base_link", "lidar", transform(-2.0, 0.0)));
  EXPECT_DOUBLE_EQ(transforms.lookup("base_link", "lidar")->translation().x(), -2.0);
}

TEST(StaticTransforms, UnderstandALeadingSlash) {
  StaticTransforms transforms;
  transforms.add(message("/base_link", "/left", transform(1.0, 0.0)));
  EXPECT_TRUE(transforms.lookup("base_link", "left"));
}

TEST(StaticTransforms, OutliveALoopOfParents) {
  auto transforms = vehicle();
  transforms.add(message("left", "base_link", transform(1.0, 0.0)));
  EXPECT_FALSE(transforms.lookup("map", "left"));
}

TEST(StaticTransforms, TellWhatTheyLeaveOut) {
  StaticTransforms transforms;
  auto zero = message("base_link", "left", transform(1.0, 0.0));
  zero.transforms()[0].transform().rotation().w(0.0);
  EXPECT_THAT(transforms.add(zero), ElementsAre(HasSubstr("'base_link' -> 'left' has a rotation quaternion")));
  EXPECT_THAT(transforms.add(message("left", "left", transform(1.0, 0.0))),
              ElementsAre(HasSubstr("two different frames")));
  EXPECT_FALSE(transforms.lookup("base_link", "left"));
  EXPECT_THAT(transforms.add(message("base_link", "left", transform(1.0, 0.0))), IsEmpty());
}

}  // namespace
}  // namespace panvo::conversions
