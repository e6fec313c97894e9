// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "diagnostic_msgs/msg/DiagnosticArray.h"
#include "geometry_msgs/msg/PoseStamped.h"
#include "geometry_msgs/msg/PoseWithCovarianceStamped.h"
#include "geometry_msgs/msg/TwistStamped.h"
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

/// What messages may hold, declared once for each type: MessageType::problem has it for those who do not know the class. The runtime hands no
/// message to a component for which there is an answer here; stores and files go through the same functions. Stamps are judged by their form
/// only: what time they may be is known to who has a clock. Pixels and points are not looked at, so that no check costs more than some
/// microseconds.
///
/// nullopt: nothing is wrong; else what is, without a subject ("pose.covariance is not finite"). Never a value: there are few texts.
namespace panvo::interfaces {

using Problem = std::optional<std::string>;

// validity_poses.cpp
Problem problem_of(const geometry_msgs::msg::PoseStamped& message);
Problem problem_of(const geometry_msgs::msg::PoseWithCovariance& message);
Problem problem_of(const geometry_msgs::msg::PoseWithCovarianceStamped& message);
Problem problem_of(const geometry_msgs::msg::TwistStamped& message);
Problem problem_of(const nav_msgs::msg::Odometry& message);
Problem problem_of(const nav_msgs::msg::Path& message);
/// One bad transform does not make the others bad: each is judged by who takes it in, with problem_of(TransformStamped).
Problem problem_of(const tf2_msgs::msg::TFMessage& message);
Problem problem_of(const geometry_msgs::msg::TransformStamped& message);

// validity_sensors.cpp
Problem problem_of(const sensor_msgs::msg::Image& message);
Problem problem_of(const sensor_msgs::msg::CompressedImage& message);
/// One of zeros, of a camera that is not calibrated, is none the less a message: its reader says so.
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
Problem problem_of(const panvo_msgs::msg::PositionCorrection& message);
Problem problem_of(const diagnostic_msgs::msg::DiagnosticArray& message);
Problem problem_of(const rcl_interfaces::msg::Log& message);
Problem problem_of(const rosgraph_msgs::msg::Clock& message);

/// Stamped by whoever clicked on a map, perhaps by a clock of his own.
template <>
inline constexpr bool kIsStampedWhenSent<geometry_msgs::msg::PoseWithCovarianceStamped> = false;
/// These bear the stamp of the panorama that showed the place best, which may lie seconds before the last that was told of.
template <>
inline constexpr bool kIsStampedWhenSent<panvo_msgs::msg::LandmarkMatch> = false;
template <>
inline constexpr bool kIsStampedWhenSent<panvo_msgs::msg::PositionCorrection> = false;

}  // namespace panvo::interfaces
