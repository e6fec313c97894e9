// SPDX-License-Identifier: Apache-2.0
#include "panvo/conversions/pose.hpp"

#include <gmock/gmock.h>

#include <limits>

namespace panvo::conversions {
namespace {

using ::testing::HasSubstr;

Eigen::Isometry3d some_pose(double angle_rad) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::AngleAxisd(angle_rad, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  pose.translation() = Eigen::Vector3d(1.5, -2.5, 3.5);
  return pose;
}

TEST(PoseMessage, ComesBackAsItWas) {
  for (const double angle_rad : {0.0, 0.3, 1.5, 3.0, 3.14159, 6.0}) {
    const auto pose = some_pose(angle_rad);
    EXPECT_TRUE(to_isometry(to_pose(pose))->isApprox(pose, 1e-12)) << angle_rad;
    EXPECT_TRUE(to_isometry(to_transform(pose))->isApprox(pose, 1e-12)) << angle_rad;
    EXPECT_GE(to_pose(pose).orientation().w(), 0.0) << angle_rad;
  }
}

TEST(PoseMessage, HasTheQuaternionInRosOrder) {
  Eigen::Isometry3d left_turn = Eigen::Isometry3d::Identity();
  left_turn.linear() = Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  EXPECT_NEAR(to_pose(left_turn).orientation().z(), std::sin(0.25), 1e-12);
  EXPECT_NEAR(to_pose(left_turn).orientation().w(), std::cos(0.25), 1e-12);
}

TEST(PoseMessage, ThatWasNeverFilledInIsNoPose) {
  geometry_msgs::msg::Pose pose;
  pose.orientation().w(0.0);
  EXPECT_THAT(to_isometry(pose).reason(), HasSubstr("length 0"));
}

TEST(PoseMessage, ThatHoldsNoNumberIsNoPose) {
  auto pose = to_pose(some_pose(0.3));
  pose.position().y(std::numeric_limits<double>::quiet_NaN());
  EXPECT_THAT(to_isometry(pose).reason(), HasSubstr("not a number"));
}

TEST(CovarianceArray, IsRowMajorTranslationFirst) {
  vision::Matrix6d covariance;
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) covariance(row, column) = 10 * row + column;
  }
  const auto values = to_array(covariance);
  EXPECT_DOUBLE_EQ(values[1 * 6 + 4], 14.0);
  EXPECT_EQ(to_matrix(values), covariance);
}

}  // namespace
}  // namespace panvo::conversions
