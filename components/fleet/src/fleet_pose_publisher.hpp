// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <string>

#include "nav_msgs/msg/Odometry.h"
#include "panvo/fleet/fleet.hpp"
#include "panvo/runtime/context.hpp"
#include "tf2_msgs/msg/TFMessage.h"

namespace panvo::fleet {

/// Publishes the pose in the fleet's frame: odometry/fleet and the transform fleet -> map.
class FleetPosePublisher {
 public:
  FleetPosePublisher(runtime::Context& context, std::string fleet_frame);

  /// `enhanced`: a message of odometry/enhanced, with its pose and covariance.
  void publish(const nav_msgs::msg::Odometry& enhanced, const Eigen::Isometry3d& map_from_base,
               const vision::Matrix6d& covariance, const Fleet& fleet);

 private:
  const std::string fleet_frame_;
  runtime::Output<nav_msgs::msg::Odometry> odometry_;
  runtime::Output<tf2_msgs::msg::TFMessage> tf_;
};

}  // namespace panvo::fleet
