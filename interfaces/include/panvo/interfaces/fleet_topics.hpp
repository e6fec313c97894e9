// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "nav_msgs/msg/Odometry.h"
#include "panvo/interfaces/topic.hpp"
#include "panvo_msgs/msg/FleetKeypoints.h"
#include "panvo_msgs/msg/FleetMember.h"
#include "panvo_msgs/msg/FleetPlaces.h"
#include "panvo_msgs/msg/FleetRequest.h"
#include "panvo_msgs/msg/FleetState.h"

/// Topics of robots that share places. Names that begin with a slash are the same for all robots, whatever their
/// namespaces. What a robot misses it asks for (panvo_msgs/FleetRequest), so nothing is kept for late joiners.
namespace panvo::topics {

inline constexpr interfaces::Topic<panvo_msgs::msg::FleetMember> kFleetMembers{"/fleet/members", {.depth = 200}};
inline constexpr interfaces::Topic<panvo_msgs::msg::FleetPlaces> kFleetPlaces{"/fleet/places", {.depth = 100}};
inline constexpr interfaces::Topic<panvo_msgs::msg::FleetRequest> kFleetRequests{"/fleet/requests", {.depth = 100}};
inline constexpr interfaces::Topic<panvo_msgs::msg::FleetKeypoints> kFleetKeypoints{"/fleet/keypoints", {.depth = 20}};

inline constexpr interfaces::Topic<panvo_msgs::msg::FleetState> kFleetState{
    "fleet/state", {.durability = interfaces::Durability::kTransientLocal, .depth = 1}};
/// The enhanced pose in the frame that all joined robots share.
inline constexpr interfaces::Topic<nav_msgs::msg::Odometry> kOdometryFleet{"odometry/fleet", interfaces::qos::kResult};

}  // namespace panvo::topics
