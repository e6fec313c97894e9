// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "nav_msgs/msg/Odometry.h"
#include "panvo/conversions/result.hpp"
#include "panvo/localizer/integrity.hpp"
#include "panvo/localizer/localizer.hpp"
#include "panvo_msgs/msg/AzimuthChange.h"
#include "panvo_msgs/msg/CorrectionOutcome.h"
#include "panvo_msgs/msg/Integrity.h"
#include "panvo_msgs/msg/LandmarkPoses.h"
#include "panvo_msgs/msg/LocalizationState.h"
#include "panvo_msgs/msg/PositionCorrection.h"
#include "sensor_msgs/msg/TimeReference.h"
#include "tf2_msgs/msg/TFMessage.h"

/// Conversions between the localizer's types and messages.
namespace panvo::localizer {

/// The pose in the map with the twist of the underlying stereo odometry.
nav_msgs::msg::Odometry to_odometry(const LocalizedPose& pose, const nav_msgs::msg::Odometry& stereo,
                                    const std::string& map_frame);

/// map -> odom and odom -> base_link.
tf2_msgs::msg::TFMessage to_transforms(const LocalizedPose& pose, const std::string& map_frame,
                                       const std::string& odom_frame, const std::string& base_frame);

panvo_msgs::msg::CorrectionOutcome to_message(const Correction& correction, const LandmarkSighting& sighting,
                                              const std::string& map_frame);
panvo_msgs::msg::LandmarkPoses to_message(const std::vector<KnownLandmark>& landmarks, std::int64_t stamp_ns,
                                          const std::string& map_frame);
/// `since_ns`: stamp of the last odometry if stale, else of the first pose in this state.
panvo_msgs::msg::LocalizationState to_state(const LocalizedPose& pose, std::int64_t since_ns,
                                            const std::string& map_frame);
panvo_msgs::msg::Integrity to_integrity(const LocalizedPose& pose, const std::vector<Doubt>& doubts,
                                        const IntegrityParameters& parameters, const std::string& map_frame);
/// One moment by the clocks of the odometry and of the panoramic camera.
sensor_msgs::msg::TimeReference to_time_reference(std::int64_t odometry_ns, std::int64_t panorama_ns);

/// The reason names values that are not finite.
conversions::Result<LandmarkSighting> to_sighting(const panvo_msgs::msg::PositionCorrection& message);
AzimuthMeasurement to_azimuth(const panvo_msgs::msg::AzimuthChange& message);

}  // namespace panvo::localizer
