// SPDX-License-Identifier: Apache-2.0
#include "fusion_messages.hpp"

#include <algorithm>

#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"

namespace panvo::odometry_fusion {
namespace {

constexpr double kNotMeasured = -1.0;     // in the first element of a covariance, REP 145
constexpr double kLeanWithGyro = 0.7e-4;  // rad/m: its bias at a few metres per second

}  // namespace

conversions::Result<GyroSample> to_gyro(const sensor_msgs::msg::Imu& message, const Eigen::Isometry3d& base_from_imu) {
  const auto& covariance = message.angular_velocity_covariance();
  if (covariance[0] == kNotMeasured) return conversions::Reason{"measures no angular velocity"};
  return GyroSample{conversions::stamp_ns(message),
                    base_from_imu.linear() * conversions::to_eigen(message.angular_velocity()),
                    std::max({0.0, covariance[0], covariance[4], covariance[8]})};
}

conversions::Result<WheelSample> to_wheels(std::int64_t stamp_ns, const geometry_msgs::msg::TwistWithCovariance& twist,
                                           const Eigen::Isometry3d& base_from_wheels) {
  const auto& covariance = twist.covariance();
  if (covariance[0] == kNotMeasured) return conversions::Reason{"measures no velocity"};
  const Eigen::Vector3d rate = base_from_wheels.linear() * conversions::to_eigen(twist.twist().angular());
  const Eigen::Vector3d velocity = base_from_wheels.linear() * conversions::to_eigen(twist.twist().linear()) -
                                   rate.cross(base_from_wheels.translation());
  return WheelSample{
      stamp_ns, velocity.x(), velocity.y(), rate.z(), std::max(0.0, covariance[0]), std::max(0.0, covariance[35])};
}

nav_msgs::msg::Odometry to_odometry(const FusedPose& fused, const nav_msgs::msg::Odometry& frames) {
  nav_msgs::msg::Odometry odometry;
  odometry.header().stamp(conversions::to_stamp(fused.stamp_ns));
  odometry.header().frame_id(frames.header().frame_id());
  odometry.child_frame_id(frames.child_frame_id());
  odometry.pose().pose(conversions::to_pose(fused.odom_from_base));
  odometry.pose().covariance(conversions::to_array(fused.covariance));
  odometry.twist().twist().linear(conversions::to_vector3(fused.twist.head<3>()));
  odometry.twist().twist().angular(conversions::to_vector3(fused.twist.tail<3>()));
  odometry.twist().covariance(conversions::to_array(fused.twist_covariance));
  return odometry;
}

panvo_msgs::msg::OdometryQuality to_quality(const FusedPose& fused, const conversions::OdometryJoin::Quality& of_stereo,
                                            const std::string& base_frame) {
  panvo_msgs::msg::OdometryQuality quality;
  quality.header().stamp(conversions::to_stamp(fused.stamp_ns));
  quality.header().frame_id(base_frame);
  quality.reliable(fused.is_reliable);
  // With a gyroscope, rotations do not depend on which points of the image are inliers.
  quality.inlier_ratio(fused.uses_gyro ? 1.0 : 1.0 - of_stereo.outlier_share);
  quality.lean_sigma_rad_per_m(fused.uses_gyro ? kLeanWithGyro : of_stereo.lean_sigma_rad_per_m);
  if (!fused.is_reliable) quality.reason("neither images nor wheels measure the motion");
  return quality;
}

}  // namespace panvo::odometry_fusion
