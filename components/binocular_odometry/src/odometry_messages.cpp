// SPDX-License-Identifier: Apache-2.0
#include "odometry_messages.hpp"

#include "panvo/binocular_odometry/base_motion.hpp"
#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/vision/pose.hpp"

namespace panvo::binocular_odometry {
using vision::Matrix6d;
using vision::Vector6d;

nav_msgs::msg::Odometry to_odometry(const OdometryEstimate& estimate, const Eigen::Isometry3d& base_from_left,
                                    std::optional<std::int64_t> previous_stamp_ns, const std::string& odom_frame,
                                    const std::string& base_frame) {
  nav_msgs::msg::Odometry odometry;
  odometry.header().stamp(conversions::to_stamp(estimate.stamp_ns));
  odometry.header().frame_id(odom_frame);
  odometry.child_frame_id(base_frame);

  const UncertainPose odom_from_base =
      motion_of_base(base_from_left, estimate.odom_from_left, estimate.odom_from_left_covariance);
  odometry.pose().pose(conversions::to_pose(odom_from_base.pose));
  odometry.pose().covariance(conversions::to_array(odom_from_base.covariance));

  const double interval_s =
      previous_stamp_ns ? static_cast<double>(estimate.stamp_ns - *previous_stamp_ns) * 1e-9 : 0.0;
  if (interval_s <= 0.0) return odometry;
  const UncertainPose motion =
      motion_of_base(base_from_left, estimate.previous_from_current, estimate.previous_from_current_covariance);
  const Vector6d twist = vision::se3_log(motion.pose) / interval_s;
  // The covariance is in the axes of the previous base_frame, the twist in those of the current one.
  Matrix6d current_from_previous = Matrix6d::Zero();
  current_from_previous.topLeftCorner<3, 3>() = motion.pose.linear().transpose();
  current_from_previous.bottomRightCorner<3, 3>() = motion.pose.linear().transpose();
  const Matrix6d covariance =
      current_from_previous * motion.covariance * current_from_previous.transpose() / (interval_s * interval_s);
  auto& message = odometry.twist().twist();
  message.linear().x(twist[0]);
  message.linear().y(twist[1]);
  message.linear().z(twist[2]);
  message.angular().x(twist[3]);
  message.angular().y(twist[4]);
  message.angular().z(twist[5]);
  odometry.twist().covariance(conversions::to_array(covariance));
  return odometry;
}

tf2_msgs::msg::TFMessage to_transform(const nav_msgs::msg::Odometry& odometry) {
  const auto& pose = odometry.pose().pose();
  geometry_msgs::msg::TransformStamped stamped;
  stamped.header(odometry.header());
  stamped.child_frame_id(odometry.child_frame_id());
  stamped.transform().translation().x(pose.position().x());
  stamped.transform().translation().y(pose.position().y());
  stamped.transform().translation().z(pose.position().z());
  stamped.transform().rotation(pose.orientation());
  tf2_msgs::msg::TFMessage message;
  message.transforms({stamped});
  return message;
}

panvo_msgs::msg::OdometryQuality to_quality(const OdometryEstimate& estimate, const std::string& base_frame) {
  panvo_msgs::msg::OdometryQuality quality;
  quality.header().stamp(conversions::to_stamp(estimate.stamp_ns));
  quality.header().frame_id(base_frame);
  quality.detected(static_cast<std::uint32_t>(estimate.quality.detected));
  quality.tracked(static_cast<std::uint32_t>(estimate.quality.tracked));
  quality.matched(static_cast<std::uint32_t>(estimate.quality.matched));
  quality.inliers(static_cast<std::uint32_t>(estimate.quality.inliers));
  quality.inlier_ratio(estimate.quality.inlier_ratio);
  quality.residual_px(estimate.quality.residual_px);
  quality.reliable(estimate.quality.reliable);
  quality.reason(estimate.quality.reason);
  return quality;
}

}  // namespace panvo::binocular_odometry
