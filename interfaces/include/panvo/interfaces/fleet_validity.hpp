// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "panvo/interfaces/validity.hpp"
#include "panvo_msgs/msg/FleetKeypoints.h"
#include "panvo_msgs/msg/FleetMember.h"
#include "panvo_msgs/msg/FleetPlaces.h"
#include "panvo_msgs/msg/FleetRequest.h"
#include "panvo_msgs/msg/FleetState.h"

/// Rules for the values of messages between robots, see validity.hpp. They come from computers that are not one's own,
/// so every size has a limit.
namespace panvo::interfaces {

/// Limits of one message; a map is sent in many.
inline constexpr std::size_t kMaxFleetPlaces = 64;
inline constexpr std::size_t kMaxFleetMoves = 10'000;
inline constexpr std::size_t kMaxFleetSightings = 1000;
inline constexpr std::size_t kMaxFleetKeypoints = 2000;  ///< of one place
inline constexpr std::size_t kMaxFleetWanted = 64;       ///< places in a request

Problem problem_of(const panvo_msgs::msg::FleetMember& message);
Problem problem_of(const panvo_msgs::msg::FleetPlaces& message);
Problem problem_of(const panvo_msgs::msg::FleetRequest& message);
Problem problem_of(const panvo_msgs::msg::FleetKeypoints& message);
Problem problem_of(const panvo_msgs::msg::FleetState& message);
Problem problem_of(const panvo_msgs::msg::FleetSighting& sighting);
Problem problem_of(const panvo_msgs::msg::FleetPeer& peer);

/// Stamps of other robots are by other clocks, which may be hours off: nobody compares them.
template <>
inline constexpr bool kIsStampedWhenSent<panvo_msgs::msg::FleetMember> = false;
template <>
inline constexpr bool kIsStampedWhenSent<panvo_msgs::msg::FleetPlaces> = false;
template <>
inline constexpr bool kIsStampedWhenSent<panvo_msgs::msg::FleetRequest> = false;
template <>
inline constexpr bool kIsStampedWhenSent<panvo_msgs::msg::FleetKeypoints> = false;

}  // namespace panvo::interfaces
