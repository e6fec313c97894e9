// SPDX-License-Identifier: Apache-2.0
#include "panvo/interfaces/fleet_validity.hpp"
#include "panvo/interfaces/place_rules.hpp"
#include "validity_parts.hpp"

namespace panvo::interfaces {
namespace {

constexpr std::size_t kMaxPeers = 1000;
constexpr double kMaxPath_m = 1e9;

void check_sender(Check& check, const std_msgs::msg::Header& header, const std::string& robot, std::uint64_t map) {
  check_header(check, header);
  check.require(!robot.empty(), "robot", "is empty").name("robot", robot);
  check.require(map != 0, "map_id", "is 0");
}

/// Of a place without settings: the sizes of its description are checked by the receiver, who knows the settings.
void check_place(Check& check, const panvo_msgs::msg::PanoramicLandmark& place) {
  check.require(place.keypoints().empty() && place.thumbnail().empty(), "places", "have keypoints or a thumbnail");
  const auto problem = problem_of(place);
  check.require(!problem, "places", "have an invalid landmark: " + problem.value_or(""));
}

}  // namespace

Problem problem_of(const panvo_msgs::msg::FleetSighting& sighting) {
  Check check;
  check.require(sighting.own_place() != 0 && sighting.seen_place() != 0 && sighting.seen_map() != 0, "sightings",
                "name no place");
  check_pose(check, "sightings.own_from_seen.pose", sighting.own_from_seen().pose());
  check.measured_covariance("sightings.own_from_seen.covariance", sighting.own_from_seen().covariance());
  check.within("sightings.travelled_m", sighting.travelled_m(), 0.0, kMaxPath_m);
  return check.problem();
}

Problem problem_of(const panvo_msgs::msg::FleetPeer& peer) {
  Check check;
  check.name({"peers", "robot"}, peer.robot()).text({"peers", "reason"}, peer.reason());
  check_pose(check, "peers.map_from_peer.pose", peer.map_from_peer().pose());
  check.covariance("peers.map_from_peer.covariance", peer.map_from_peer().covariance());
  return check.problem();
}

Problem problem_of(const panvo_msgs::msg::FleetMember& message) {
  Check check;
  check_sender(check, message.header(), message.robot(), message.map_id());
  check.text("settings", message.settings());
  return check.problem();
}

Problem problem_of(const panvo_msgs::msg::FleetPlaces& message) {
  Check check;
  check_sender(check, message.header(), message.robot(), message.map_id());
  check.require(message.previous() < message.version(), "version", "is not later than previous");
  check.at_most("places", message.places().size(), kMaxFleetPlaces);
  check.at_most("moved", message.moved().ids().size(), kMaxFleetMoves);
  check.at_most("sightings", message.sightings().size(), kMaxFleetSightings);
  if (!check.holds()) return check.problem();
  for (const auto& place : message.places()) {
    if (!check.holds()) return check.problem();
    check_place(check, place);
  }
  if (!check.holds()) return check.problem();
  if (const auto problem = problem_of(message.moved())) return "moved is invalid: " + *problem;
  for (const auto& sighting : message.sightings()) {
    if (const auto problem = problem_of(sighting)) return problem;
  }
  return check.problem();
}

Problem problem_of(const panvo_msgs::msg::FleetRequest& message) {
  Check check;
  check_sender(check, message.header(), message.robot(), message.map_id());
  check.at_most("keypoints", message.keypoints().size(), kMaxFleetWanted);
  return check.problem();
}

Problem problem_of(const panvo_msgs::msg::FleetKeypoints& message) {
  Check check;
  check_sender(check, message.header(), message.robot(), message.map_id());
  check.require(message.place() != 0, "place", "is 0");
  check.at_most("keypoints", message.keypoints().size(), kMaxFleetKeypoints);
  for (const auto& keypoint : message.keypoints()) {
    if (!check.holds()) break;
    check_keypoint(check, keypoint.bearing(), keypoint.size_px(), keypoint.has_point(), keypoint.point(),
                   keypoint.inverse_range_sigma());
  }
  return check.problem();
}

Problem problem_of(const panvo_msgs::msg::FleetState& message) {
  Check check;
  check_header(check, message.header());
  check.name("robot", message.robot()).text("last_refusal", message.last_refusal());
  check.at_most("peers", message.peers().size(), kMaxPeers);
  check_pose(check, "common_from_map.pose", message.common_from_map().pose());
  check.covariance("common_from_map.covariance", message.common_from_map().covariance());
  if (!check.holds()) return check.problem();
  for (const auto& peer : message.peers()) {
    if (const auto problem = problem_of(peer)) return problem;
  }
  return check.problem();
}

}  // namespace panvo::interfaces
