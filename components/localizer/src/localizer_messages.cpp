// SPDX-License-Identifier: Apache-2.0
#include "localizer_messages.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "panvo/conversions/pose.hpp"
#include "panvo/conversions/time.hpp"

namespace panvo::localizer {
namespace {

geometry_msgs::msg::TransformStamped transform(std::int64_t stamp_ns, const std::string& parent,
                                               const std::string& child, const Eigen::Isometry3d& parent_from_child) {
  geometry_msgs::msg::TransformStamped stamped;
  stamped.header().stamp(conversions::to_stamp(stamp_ns));
  stamped.header().frame_id(parent);
  stamped.child_frame_id(child);
  stamped.transform(conversions::to_transform(parent_from_child));
  return stamped;
}

std::uint8_t to_constant(CorrectionKind kind) {
  using namespace panvo_msgs::msg::CorrectionOutcome_Constants;
  switch (kind) {
    case CorrectionKind::kApplied:
      return APPLIED;
    case CorrectionKind::kBetterKnown:
      return BETTER_KNOWN;
    case CorrectionKind::kRejected:
      return REJECTED;
  }
  throw std::logic_error("an outcome without a constant");
}

std::uint8_t to_constant(State state) {
  using namespace panvo_msgs::msg::LocalizationState_Constants;
  switch (state) {
    case State::kStarting:
      return STARTING;
    case State::kUnlocated:
      return UNLOCATED;
    case State::kTracking:
      return TRACKING;
    case State::kCompassOnly:
      return COMPASS_ONLY;
    case State::kLost:
      return LOST;
    case State::kRelocalised:
      return RELOCALISED;
    case State::kStale:
      return STALE;
  }
  throw std::logic_error("a state without a constant");
}

}  // namespace

nav_msgs::msg::Odometry to_odometry(const LocalizedPose& pose, const nav_msgs::msg::Odometry& stereo,
                                    const std::string& map_frame) {
  nav_msgs::msg::Odometry odometry;
  odometry.header().stamp(conversions::to_stamp(pose.stamp_ns));
  odometry.header().frame_id(map_frame);
  odometry.child_frame_id(stereo.child_frame_id());
  odometry.pose().pose(conversions::to_pose(pose.map_from_base));
  odometry.pose().covariance(conversions::to_array(pose.covariance));
  odometry.twist(stereo.twist());
  return odometry;
}

tf2_msgs::msg::TFMessage to_transforms(const LocalizedPose& pose, const std::string& map_frame,
                                       const std::string& odom_frame, const std::string& base_frame) {
  tf2_msgs::msg::TFMessage message;
  message.transforms({transform(pose.stamp_ns, map_frame, odom_frame, pose.map_from_odom),
                      transform(pose.stamp_ns, odom_frame, base_frame, pose.odom_from_base)});
  return message;
}

panvo_msgs::msg::CorrectionOutcome to_message(const Correction& correction, const LandmarkSighting& sighting,
                                              const std::string& map_frame) {
  panvo_msgs::msg::CorrectionOutcome message;
  message.header().stamp(conversions::to_stamp(sighting.stamp_ns));
  message.header().frame_id(map_frame);
  message.landmark_id(sighting.landmark_id);
  message.outcome(to_constant(correction.kind));
  message.reason(correction.reason);
  message.chi_square(correction.chi_square);
  message.before(conversions::to_pose(correction.map_from_base_before));
  message.after(conversions::to_pose(correction.map_from_base_after));
  return message;
}

panvo_msgs::msg::LandmarkPoses to_message(const std::vector<KnownLandmark>& landmarks, std::int64_t stamp_ns,
                                          const std::string& map_frame) {
  panvo_msgs::msg::LandmarkPoses message;
  message.header().stamp(conversions::to_stamp(stamp_ns));
  message.header().frame_id(map_frame);
  for (const auto& landmark : landmarks) {
    message.ids().push_back(landmark.id);
    geometry_msgs::msg::PoseWithCovariance pose;
    pose.pose(conversions::to_pose(landmark.map_from_base));
    pose.covariance(conversions::to_array(landmark.covariance));
    message.poses().push_back(std::move(pose));
  }
  return message;
}

panvo_msgs::msg::Integrity to_integrity(const LocalizedPose& pose, const std::vector<Doubt>& doubts,
                                        const IntegrityParameters& parameters, const std::string& map_frame) {
  const Integrity integrity = assess(pose, doubts, parameters);
  panvo_msgs::msg::Integrity message;
  message.header().stamp(conversions::to_stamp(pose.stamp_ns));
  message.header().frame_id(map_frame);
  message.usable(integrity.is_usable);
  message.reason(integrity.reason);
  message.risk(parameters.risk);
  message.horizontal_protection_level_m(integrity.protection_level_m);
  message.alert_limit_m(parameters.alert_limit_m);
  return message;
}

panvo_msgs::msg::LocalizationState to_state(const LocalizedPose& pose, std::int64_t since_ns,
                                            const std::string& map_frame) {
  panvo_msgs::msg::LocalizationState message;
  message.header().stamp(conversions::to_stamp(pose.stamp_ns));
  message.header().frame_id(map_frame);
  message.state(to_constant(pose.state));
  message.reason(pose.reason);
  message.since(conversions::to_stamp(since_ns));
  message.position_sigma_m(vision::horizontal_sigma(pose.covariance));
  message.heading_sigma_rad(std::sqrt(std::max(0.0, pose.covariance(5, 5))));
  return message;
}

sensor_msgs::msg::TimeReference to_time_reference(std::int64_t odometry_ns, std::int64_t panorama_ns) {
  sensor_msgs::msg::TimeReference message;
  message.header().stamp(conversions::to_stamp(odometry_ns));
  message.time_ref(conversions::to_stamp(panorama_ns));
  message.source("panoramic camera");
  return message;
}

conversions::Result<LandmarkSighting> to_sighting(const panvo_msgs::msg::PositionCorrection& message) {
  const auto pose = conversions::to_isometry(message.landmark_from_base().pose());
  if (!pose) return conversions::Reason{pose.reason()};
  LandmarkSighting sighting;
  sighting.stamp_ns = conversions::stamp_ns(message);
  sighting.landmark_id = message.landmark_id();
  sighting.landmark_from_base = *pose;
  sighting.covariance = conversions::to_matrix(message.landmark_from_base().covariance());
  sighting.stands_alone = message.state() != panvo_msgs::msg::PositionCorrection_Constants::WEAK;
  return sighting;
}

AzimuthMeasurement to_azimuth(const panvo_msgs::msg::AzimuthChange& message) {
  return {conversions::to_ns(message.from_stamp()),
          conversions::stamp_ns(message),
          message.azimuth_change_rad(),
          message.variance_rad2(),
          message.motion_azimuth_rad(),
          message.motion_azimuth_variance_rad2(),
          message.side_parallax_rad()};
}

}  // namespace panvo::localizer
