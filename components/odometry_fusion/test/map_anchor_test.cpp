// SPDX-License-Identifier: Apache-2.0
#include "panvo/odometry_fusion/map_anchor.hpp"

#include <gtest/gtest.h>

namespace panvo::odometry_fusion {
namespace {

/// Drives 1 m/s along the odometry's x axis.
FusedPose at(double t_s) {
  FusedPose fused;
  fused.stamp_ns = std::llround(t_s * 1e9);
  fused.odom_from_base.translation().x() = t_s;
  fused.covariance = 0.01 * t_s * vision::Matrix6d::Identity();
  return fused;
}

Eigen::Isometry3d heading_north(double x_m) {
  Eigen::Isometry3d pose(Eigen::AngleAxisd(M_PI / 2.0, Eigen::Vector3d::UnitZ()));
  pose.translation() << x_m, 0.0, 0.0;
  return pose;
}

TEST(MapAnchor, CarriesAPoseInTheMapOn) {
  MapAnchor anchor;
  for (double t_s : {1.0, 2.0, 2.5}) anchor.add(at(t_s));
  EXPECT_FALSE(anchor.in_map(at(2.7)));
  ASSERT_TRUE(anchor.set(at(2.0).stamp_ns, heading_north(10.0), 0.25 * vision::Matrix6d::Identity()));
  const auto in_map = anchor.in_map(at(2.7));
  ASSERT_TRUE(in_map);
  EXPECT_TRUE(in_map->odom_from_base.translation().isApprox(Eigen::Vector3d(10.0, 0.7, 0.0), 1e-9));
  EXPECT_EQ(in_map->stamp_ns, at(2.7).stamp_ns);
  EXPECT_NEAR(in_map->covariance(1, 1), 0.25 + 0.007, 1e-4);
  EXPECT_NEAR(in_map->covariance(0, 0), 0.25 + 0.007 + 0.25 * 0.49, 1e-2);  // to the side, also by the heading
}

TEST(MapAnchor, RefusesAPoseOfNoFusedStamp) {
  MapAnchor anchor;
  anchor.add(at(1.0));
  EXPECT_FALSE(anchor.set(at(1.01).stamp_ns, heading_north(0.0), vision::Matrix6d::Identity()));
  EXPECT_FALSE(anchor.in_map(at(1.1)));
}

TEST(MapAnchor, IsForgottenAfterTwoSeconds) {
  MapAnchor anchor;
  anchor.add(at(1.0));
  anchor.set(at(1.0).stamp_ns, heading_north(0.0), vision::Matrix6d::Identity());
  EXPECT_TRUE(anchor.in_map(at(2.9)));
  EXPECT_FALSE(anchor.in_map(at(3.1)));
}

TEST(MapAnchor, StartsAnewWithAnEarlierStamp) {
  MapAnchor anchor;
  anchor.add(at(5.0));
  anchor.set(at(5.0).stamp_ns, heading_north(0.0), vision::Matrix6d::Identity());
  anchor.add(at(1.0));
  EXPECT_FALSE(anchor.in_map(at(1.1)));
}

}  // namespace
}  // namespace panvo::odometry_fusion
