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
                                 const vision::Matrix6d& covariance, const Fleet& fleet) {
  if (!fleet.own()) return;  // no place yet, hence no map
  nav_msgs::msg::Odometry odometry = enhanced;
  odometry.header().frame_id(fleet_frame_);
  odometry.pose().pose(conversions::to_pose(fleet.common_from_own() * map_from_base));
  odometry.pose().covariance(conversions::to_array(fleet.covariance_in_common(covariance)));
  odometry_.publish(std::move(odometry));

  geometry_msgs::msg::TransformStamped transform;
  transform.header().stamp(enhanced.header().stamp());
  transform.header().frame_id(fleet_frame_);
  transform.child_frame_id(enhanced.header().frame_id());
  transform.transform(conversions::to_transform(fleet.common_from_own()));
  tf2_msgs::msg::TFMessage message;
  message.transforms({transform});
  tf_.publish(std::move(message));
}

}  // namespace panvo::fleet
