// SPDX-License-Identifier: Apache-2.0
#include "fleet_messages.hpp"

#include <utility>

#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"
#include "panvo/landmarks/landmark_messages.hpp"

namespace panvo::fleet {
namespace {

using conversions::Reason;

geometry_msgs::msg::PoseWithCovariance to_pose_message(const Eigen::Isometry3d& pose,
                                                       const vision::Matrix6d& covariance) {
  geometry_msgs::msg::PoseWithCovariance message;
  message.pose(conversions::to_pose(pose));
  message.covariance(conversions::to_array(covariance));
  return message;
}

template <class Message>
void fill(Message& message, const Sender& sender, MapId map) {
  message.header().stamp(conversions::to_stamp(sender.stamp_ns));
  message.header().frame_id(sender.map_frame);
  message.robot(sender.robot);
  message.map_id(map);
}

panvo_msgs::msg::FleetSighting to_sighting_message(const Sighting& sighting) {
  panvo_msgs::msg::FleetSighting message;
  message.slot(sighting.slot);
  message.own_place(sighting.own_place);
  message.seen_map(sighting.seen.map);
  message.seen_place(sighting.seen.place);
  message.own_from_seen(to_pose_message(sighting.own_from_seen, sighting.covariance));
  message.inliers(sighting.inliers);
  message.travelled_m(sighting.travelled_m);
  return message;
}

panvo_msgs::msg::FleetPeer to_peer(const Fleet& fleet, MapId map, const Member& member) {
  panvo_msgs::msg::FleetPeer peer;
  peer.robot(member.robot);
  peer.map_id(map);
  peer.present(member.is_present);
  peer.places(static_cast<std::uint32_t>(member.map.places().size()));
  peer.version(member.map.version());
  peer.latest_version(member.last.version);
  MapTransform transform;
  const auto joined = fleet.frame().own_from.find(map);
  peer.joined(joined != fleet.frame().own_from.end());
  if (peer.joined()) transform = joined->second;
  if (const auto* join = fleet.own() ? fleet.evidence().find(fleet.own()->id(), map) : nullptr) {
    peer.sightings(static_cast<std::uint32_t>(join->sightings));
    peer.agreeing(static_cast<std::uint32_t>(join->agreeing));
    peer.contradicting(static_cast<std::uint32_t>(join->contradicting));
    peer.seen_places(static_cast<std::uint32_t>(join->seen_places));
    if (!peer.joined()) peer.reason(join->reason);
  }
  peer.map_from_peer(to_pose_message(transform.a_from_b, transform.covariance));
  return peer;
}

}  // namespace

panvo_msgs::msg::FleetMember to_message(const Announcement& announcement, const Sender& sender) {
  panvo_msgs::msg::FleetMember message;
  fill(message, sender, announcement.map);
  message.session(announcement.session);
  message.version(announcement.version);
  message.digest(announcement.digest);
  message.places(announcement.places);
  message.settings(announcement.settings);
  message.common_map(announcement.common_map);
  return message;
}

panvo_msgs::msg::FleetPlaces to_message(const MapChanges& changes, const Sender& sender) {
  panvo_msgs::msg::FleetPlaces message;
  fill(message, sender, changes.map);
  message.session(changes.session);
  message.previous(changes.previous);
  message.version(changes.version);
  for (const auto& place : changes.places) {
    // the settings are announced once for all places
    message.places().push_back(landmarks::to_message(place, {}, {}));
  }
  for (const auto& pose : changes.moved) {
    message.moved().ids().push_back(pose.id);
    message.moved().poses().push_back(to_pose_message(pose.map_from_base, pose.covariance));
  }
  for (const auto& sighting : changes.sightings) message.sightings().push_back(to_sighting_message(sighting));
  return message;
}

panvo_msgs::msg::FleetRequest to_message(const Request& request, const Sender& sender) {
  panvo_msgs::msg::FleetRequest message;
  fill(message, sender, request.map);
  message.has_gap(request.from_version.has_value());
  message.from_version(request.from_version.value_or(0));
  message.keypoints(request.keypoints);
  return message;
}

panvo_msgs::msg::FleetKeypoints to_message(const KeypointAnswer& answer, const Sender& sender) {
  panvo_msgs::msg::FleetKeypoints message;
  fill(message, sender, answer.map);
  message.place(answer.place);
  message.keypoints(landmarks::to_keypoint_messages(answer.keypoints));
  return message;
}

Announcement to_announcement(const panvo_msgs::msg::FleetMember& message) {
  return {message.robot(),  message.map_id(), message.session(),  message.version(),
          message.digest(), message.places(), message.settings(), message.common_map()};
}

Request to_request(const panvo_msgs::msg::FleetRequest& message) {
  return {message.map_id(), message.has_gap() ? std::optional(message.from_version()) : std::nullopt,
          message.keypoints()};
}

KeypointAnswer to_answer(const panvo_msgs::msg::FleetKeypoints& message) {
  return {message.map_id(), message.place(), landmarks::to_keypoints(message.keypoints())};
}

conversions::Result<MapChanges> to_changes(const panvo_msgs::msg::FleetPlaces& message,
                                           const landmarks::DescriptionSettings& settings) {
  MapChanges changes{message.map_id(), message.session(), message.previous(), message.version(), {}, {}, {}};
  const auto text = landmarks::to_text(settings);
  for (auto place : message.places()) {
    place.settings(text);
    const auto landmark = landmarks::to_landmark(place, settings);
    if (!landmark) return Reason{landmark.reason()};
    changes.places.push_back(*landmark);
  }
  const auto moved = landmarks::to_landmark_poses(message.moved());
  if (!moved) return Reason{moved.reason()};
  changes.moved = *moved;
  for (const auto& sighting : message.sightings()) {
    const auto pose = conversions::to_isometry(sighting.own_from_seen().pose());
    if (!pose) return Reason{pose.reason()};
    changes.sightings.push_back({sighting.slot(),
                                 sighting.own_place(),
                                 {sighting.seen_map(), sighting.seen_place()},
                                 *pose,
                                 conversions::to_matrix(sighting.own_from_seen().covariance()),
                                 sighting.inliers(),
                                 sighting.travelled_m()});
  }
  return changes;
}

panvo_msgs::msg::FleetState to_state(const Fleet& fleet, const std::string& fleet_frame, std::int64_t stamp_ns) {
  panvo_msgs::msg::FleetState state;
  state.header().stamp(conversions::to_stamp(stamp_ns));
  state.header().frame_id(fleet_frame);
  state.robot(fleet.robot());
  state.map_id(fleet.own() ? fleet.own()->id() : 0);
  state.common_map(fleet.frame().map);
  state.common_from_map(to_pose_message(fleet.common_from_own(), fleet.covariance_in_common(vision::Matrix6d::Zero())));
  for (const auto& [map, member] : fleet.members().all()) state.peers().push_back(to_peer(fleet, map, member));
  return state;
}

}  // namespace panvo::fleet
