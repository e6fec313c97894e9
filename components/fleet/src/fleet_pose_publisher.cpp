// SPDX-License-Identifier: Apache-2.0
#include "fleet_pose_publisher.hpp"

#include <utility>

#include "panvo/conversions/pose.hpp"
#include "panvo/interfaces/fleet_topics.hpp"
#include "panvo/interfaces/topics.hpp"

namespace panvo::fleet {

FleetPosePublisher::FleetPosePublisher(runtime::Context& context, std::string fleet_frame)
    : fleet_frame_(std::move(fleet_frame)),
      odometry_(context.output(topics::kOdometryFleet)),
      tf_(context.output(topics::kTf)) {}

void FleetPosePublisher::publish(const nav_msgs::msg::Odometry& enhanced, const Eigen::Isometry3d& map_from_base,
                                 const vision::Matrix6d& covariance, const CommonFrame& frame) {
  if (frame.map == 0) return;  // no place yet, hence no map
  const MapTransform in_fleet = frame.common_from_own * MapTransform{map_from_base, covariance};
  nav_msgs::msg::Odometry odometry = enhanced;
  odometry.header().frame_id(fleet_frame_);
  odometry.pose().pose(conversions::to_pose(in_fleet.a_from_b));
  odometry.pose().covariance(conversions::to_array(in_fleet.covariance));
  odometry_.publish(std::move(odometry));

  geometry_msgs::msg::TransformStamped transform;
  transform.header().stamp(enhanced.header().stamp());
  transform.header().frame_id(fleet_frame_);
  transform.child_frame_id(enhanced.header().frame_id());
  transform.transform(conversions::to_transform(frame.common_from_own.a_from_b));
  tf2_msgs::msg::TFMessage message;
  message.transforms({transform});
  tf_.publish(std::move(message));
}

}  // namespace panvo::fleet
