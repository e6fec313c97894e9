// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "panvo/conversions/result.hpp"
#include "panvo/fleet/fleet.hpp"
#include "panvo_msgs/msg/FleetKeypoints.h"
#include "panvo_msgs/msg/FleetMember.h"
#include "panvo_msgs/msg/FleetPlaces.h"
#include "panvo_msgs/msg/FleetRequest.h"
#include "panvo_msgs/msg/FleetState.h"

/// Conversions between messages of the fleet and what the algorithms use.
namespace panvo::fleet {

/// What every message of a robot says of it. `stamp_ns`: by the own clock.
struct Sender {
  std::string robot;
  std::string map_frame;
  std::int64_t stamp_ns = 0;
};

panvo_msgs::msg::FleetMember to_message(const Announcement& announcement, const Sender& sender);
panvo_msgs::msg::FleetPlaces to_message(const MapChanges& changes, const Sender& sender);
panvo_msgs::msg::FleetRequest to_message(const Request& request, const Sender& sender);
panvo_msgs::msg::FleetKeypoints to_message(const KeypointAnswer& answer, const Sender& sender);

Announcement to_announcement(const panvo_msgs::msg::FleetMember& message);
Request to_request(const panvo_msgs::msg::FleetRequest& message);
KeypointAnswer to_answer(const panvo_msgs::msg::FleetKeypoints& message);
/// The reason names what is invalid. `settings`: those the sender announced, equal to the own ones.
conversions::Result<MapChanges> to_changes(const panvo_msgs::msg::FleetPlaces& message,
                                           const landmarks::DescriptionSettings& settings);

/// Without bytes and refusals, which the component counts.
panvo_msgs::msg::FleetState to_state(const Fleet& fleet, const std::string& fleet_frame, std::int64_t stamp_ns);

}  // namespace panvo::fleet
