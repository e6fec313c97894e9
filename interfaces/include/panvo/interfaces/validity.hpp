// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "diagnostic_msgs/msg/DiagnosticArray.h"
#include "geometry_msgs/msg/PoseStamped.h"
#include "geometry_msgs/msg/PoseWithCovarianceStamped.h"
#include "geometry_msgs/msg/TwistStamped.h"
#include "geometry_msgs/msg/TwistWithCovarianceStamped.h"
#include "nav_msgs/msg/Odometry.h"
#include "nav_msgs/msg/Path.h"
#include "panvo/interfaces/message_type.hpp"
#include "panvo_msgs/msg/AzimuthChange.h"
#include "panvo_msgs/msg/CorrectionOutcome.h"
#include "panvo_msgs/msg/Integrity.h"
#include "panvo_msgs/msg/LandmarkMatch.h"
#include "panvo_msgs/msg/LandmarkPoses.h"
#include "panvo_msgs/msg/LocalizationState.h"
#include "panvo_msgs/msg/OdometryQuality.h"
#include "panvo_msgs/msg/PanoramaPoints.h"
#include "panvo_msgs/msg/PanoramicLandmark.h"
#include "panvo_msgs/msg/PositionCorrection.h"
#include "rcl_interfaces/msg/Log.h"
#include "rosgraph_msgs/msg/Clock.h"
#include "sensor_msgs/msg/CameraInfo.h"
#include "sensor_msgs/msg/CompressedImage.h"
#include "sensor_msgs/msg/Image.h"
#include "sensor_msgs/msg/Imu.h"
#include "sensor_msgs/msg/PointCloud2.h"
#include "tf2_msgs/msg/TFMessage.h"

/// Rules for the values of messages, declared once per type; MessageType::problem calls them without the C++ class. The
/// runtime drops messages that violate a rule before they reach a component; stores and files use the same functions. A
/// stamp must be well formed; whether its time is plausible cannot be checked without a clock. Pixels and points are
/// not inspected, so that a check takes microseconds.
///
/// Each function returns the first violation, e.g. "pose.covariance is not finite", or nullopt if the message is valid.
/// The texts contain no values of the message, so that there are few different ones.
namespace panvo::interfaces {

using Problem = std::optional<std::string>;

// validity_poses.cpp
Problem problem_of(const geometry_msgs::msg::PoseStamped& message);
Problem problem_of(const geometry_msgs::msg::PoseWithCovariance& message);
Problem problem_of(const geometry_msgs::msg::PoseWithCovarianceStamped& message);
Problem problem_of(const geometry_msgs::msg::TwistStamped& message);
Problem problem_of(const geometry_msgs::msg::TwistWithCovarianceStamped& message);
Problem problem_of(const nav_msgs::msg::Odometry& message);
Problem problem_of(const nav_msgs::msg::Path& message);
/// An invalid transform does not invalidate the others: receivers check each with problem_of(TransformStamped).
Problem problem_of(const tf2_msgs::msg::TFMessage& message);
Problem problem_of(const geometry_msgs::msg::TransformStamped& message);

// validity_sensors.cpp
Problem problem_of(const sensor_msgs::msg::Image& message);
Problem problem_of(const sensor_msgs::msg::CompressedImage& message);
/// All zeros, from an uncalibrated camera, are valid; readers that need a calibration report them.
Problem problem_of(const sensor_msgs::msg::CameraInfo& message);
Problem problem_of(const sensor_msgs::msg::Imu& message);
Problem problem_of(const sensor_msgs::msg::PointCloud2& message);

// validity_places.cpp
Problem problem_of(const panvo_msgs::msg::PanoramicLandmark& message);
Problem problem_of(const panvo_msgs::msg::LandmarkPoses& message);
Problem problem_of(const panvo_msgs::msg::LandmarkMatch& message);

// validity_results.cpp
Problem problem_of(const panvo_msgs::msg::AzimuthChange& message);
Problem problem_of(const panvo_msgs::msg::CorrectionOutcome& message);
Problem problem_of(const panvo_msgs::msg::Integrity& message);
Problem problem_of(const panvo_msgs::msg::LocalizationState& message);
Problem problem_of(const panvo_msgs::msg::OdometryQuality& message);
Problem problem_of(const panvo_msgs::msg::PanoramaPoints& message);
Problem problem_of(const panvo_msgs::msg::PositionCorrection& message);
Problem problem_of(const diagnostic_msgs::msg::DiagnosticArray& message);
Problem problem_of(const rcl_interfaces::msg::Log& message);
Problem problem_of(const rosgraph_msgs::msg::Clock& message);

/// Set by an operator on a map, possibly stamped by the clock of another computer.
template <>
inline constexpr bool kIsStampedWhenSent<geometry_msgs::msg::PoseWithCovarianceStamped> = false;
/// The stamp is that of the panorama most similar to the landmark, which may be seconds before that of the previous
/// message.
template <>
inline constexpr bool kIsStampedWhenSent<panvo_msgs::msg::LandmarkMatch> = false;
template <>
inline constexpr bool kIsStampedWhenSent<panvo_msgs::msg::PositionCorrection> = false;

}  // namespace panvo::interfaces
